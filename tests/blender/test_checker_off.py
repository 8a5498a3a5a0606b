"""The checker comes off whatever happened to the objects while they wore it, and carrying does not carry it."""

import bpy
import fingerprint
import pytest
import scenes
import states
from test_checker import slots


def worn():
    """Whether anything in the file wears a checker, or remembers that it did."""
    return [
        obj.name for obj in bpy.data.objects
        if "koebe_checker_slots" in obj or any(material_is_checker(slot.material) for slot in obj.material_slots)
    ]  # fmt: skip


def material_is_checker(material):
    return material is not None and "koebe_checker_layer" in material


def join(into, *others):
    scenes.select(into, *others)
    bpy.ops.object.join()


def painted(name, color):
    obj = states.plain(name)
    obj.data.materials.append(states.material(color))
    return obj


def carry_pair(source, *targets):
    """The source mapped as shapes are, with the checker on it, as it is by default."""
    scenes.select(source)
    bpy.ops.uv.koebe_uniformize(outer="longest")
    scenes.select(source, *targets)


@pytest.mark.parametrize("target_worn", [False, True])
@pytest.mark.parametrize("target_slots", [0, 1, 2])
def test_carried_is_the_painted_material_not_the_checker(target_worn, target_slots):
    source, target = painted("Source", "Paint"), states.plain("Target")
    for _ in range(target_slots):
        target.data.materials.append(None)
    if target_worn:
        scenes.select(target)
        bpy.ops.uv.koebe_uniformize()
    carry_pair(source, target)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    if not target_worn:
        assert [slot.material.name for slot in target.material_slots] == ["Paint"] * max(target_slots, 1)
    scenes.select(source, target)
    assert bpy.ops.uv.koebe_checker() == {"FINISHED"}
    assert worn() == []
    assert [slot.material.name for slot in source.material_slots] == ["Paint"]
    assert [slot.material.name for slot in target.material_slots] == ["Paint"] * max(target_slots, 1)


def test_a_source_that_has_nothing_beneath_the_checker_gives_nothing():
    source, target = states.plain("Source"), states.plain("Target")
    carry_pair(source, target)
    assert bpy.ops.uv.koebe_carry_texture() == {"FINISHED"}
    assert len(target.material_slots) == 0


def test_a_target_keeps_its_own_material_beneath_the_checker():
    source, target = painted("Source", "Paint"), painted("Target", "Own")
    scenes.select(target)
    bpy.ops.uv.koebe_uniformize()
    carry_pair(source, target)
    bpy.ops.uv.koebe_carry_texture()
    bpy.ops.uv.koebe_checker()
    assert worn() == [] and target.material_slots[0].material.name == "Own"


def test_objects_that_share_a_mesh_without_slots():
    """Whichever of them it is taken off from."""
    for index in range(2):
        states.new_file()
        both = states.twins()
        scenes.select(*both)
        before = fingerprint.fingerprint()
        bpy.ops.uv.koebe_checker()
        assert worn() == [obj.name for obj in sorted(both, key=lambda obj: obj.name)]
        scenes.select(both[index])
        bpy.ops.uv.koebe_checker()
        assert worn() == [] and all(len(obj.material_slots) == 0 for obj in both)
        scenes.select(*both)
        changed = fingerprint.differences(before, fingerprint.fingerprint())
        assert all("material" in name for name in changed), changed  # one lies in the file, worn by nobody


def test_objects_that_share_a_mesh_with_slots():
    first, second = states.twins()
    first.data.materials.append(states.material("Paint"))
    before = slots(first), slots(second)
    scenes.select(first, second)
    bpy.ops.uv.koebe_checker()
    scenes.select(second)
    bpy.ops.uv.koebe_checker()
    assert worn() == [first.name]
    scenes.select(first)
    bpy.ops.uv.koebe_checker()
    assert worn() == [] and (slots(first), slots(second)) == before


@pytest.mark.parametrize("into_slots", [False, True])
@pytest.mark.parametrize("other_slots", [False, True])
@pytest.mark.parametrize("who", ["both", "into", "other"])
def test_after_a_join(into_slots, other_slots, who):
    into = painted("Into", "Paint") if into_slots else states.plain("Into")
    other = painted("Other", "Metal") if other_slots else states.plain("Other")
    scenes.select(*{"both": [into, other], "into": [into], "other": [other]}[who])
    bpy.ops.uv.koebe_checker()
    join(into, other)
    bpy.ops.uv.koebe_checker()
    assert worn() == []
    found = [slot.material and slot.material.name for slot in into.material_slots]
    assert "Paint" in found or not into_slots
    assert "Metal" in found or not (other_slots and who == "into")  # what was shown is what a join keeps
    assert all(polygon.material_index < max(len(found), 1) for polygon in into.data.polygons)


def test_after_a_copy_and_after_a_part_was_separated():
    obj = states.dressed()
    before = slots(obj)
    scenes.select(obj)
    bpy.ops.uv.koebe_checker()
    bpy.ops.object.duplicate()
    copy = bpy.context.active_object
    scenes.select_faces(copy, range(20))
    bpy.ops.mesh.separate(type="SELECTED")
    bpy.ops.object.mode_set(mode="OBJECT")
    part = next(one for one in bpy.data.objects if one not in (obj, copy))
    scenes.select(obj, copy, part)
    bpy.ops.uv.koebe_checker()
    assert worn() == []
    assert slots(obj) == slots(copy) == before
    assert list(part.data.materials) == list(obj.data.materials)  # Blender makes the part's slots anew


def test_what_is_put_into_a_slot_meanwhile_stays():
    obj = states.dressed()
    scenes.select(obj)
    bpy.ops.uv.koebe_checker()
    obj.material_slots[0].material = states.material("Later")
    bpy.ops.uv.koebe_checker()
    assert worn() == [] and obj.material_slots[0].material.name == "Later"
    assert [slot.material and slot.material.name for slot in obj.material_slots][1:] == [None, "Skin", "Metal"]


def test_slots_of_faces_without_materials_are_kept():
    obj = states.numbered()
    scenes.select(obj)
    before = scenes.mesh_state(obj.data)
    for mode in ("OBJECT", "EDIT"):
        bpy.ops.object.mode_set(mode=mode)
        bpy.ops.uv.koebe_checker()
        bpy.ops.uv.koebe_checker()
        bpy.ops.object.mode_set(mode="OBJECT")
        after = scenes.mesh_state(obj.data)
        assert after["face material"] == before["face material"]


def test_an_objects_own_material_on_a_shared_mesh_is_not_thrown_away():
    """The mesh has no slots of its own; one of its objects puts something of its own into the checker's slot."""
    first, second = states.twins()
    scenes.select(first)
    bpy.ops.uv.koebe_checker()
    second.material_slots[0].link = "OBJECT"
    second.material_slots[0].material = states.material("Own")
    scenes.select(first)
    bpy.ops.uv.koebe_checker()
    assert worn() == [] and second.material_slots[0].material.name == "Own"
