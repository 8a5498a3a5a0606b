"""What is linked from another file or overridden: refused with a reason, and everything else is done."""

import bpy
import fingerprint
import library
import pytest
import scenes
import states


def painted():
    obj = states.plain("Far")
    obj.data.materials.append(states.material("Paint"))
    obj.data.uv_layers.new(name="Koebe")
    return obj


OPERATORS = {
    "uniformize": lambda: bpy.ops.uv.koebe_uniformize(layer="New"),
    "distortion": lambda: bpy.ops.uv.koebe_distortion(layer="Koebe"),
    "fill": lambda: bpy.ops.mesh.koebe_fill_holes(),
    "checker": lambda: bpy.ops.uv.koebe_checker(),
}


def of_object(name):
    """What is in the file of that object and its mesh."""
    found = fingerprint.fingerprint()
    return {key: value for key, value in found.items() if name in key.split(": ")[0] and not key.startswith("material")}


@pytest.mark.parametrize("operator", OPERATORS)
@pytest.mark.parametrize("kind", ["linked", "override"])
def test_it_is_refused_alone_and_the_others_are_done(tmp_path, kind, operator):
    path = library.save_away(tmp_path, painted)
    obj = library.link(path) if kind == "linked" else library.override(path)
    scenes.select(obj)
    before = of_object("Far")
    with pytest.raises(RuntimeError, match="Far: .*make it local first"):
        OPERATORS[operator]()
    assert of_object("Far") == before
    good = library.beside(obj)
    good.data.uv_layers.new(name="Koebe")
    alone = fingerprint.of_object(fingerprint.fingerprint(), good)
    before = of_object("Far")
    assert OPERATORS[operator]() == {"FINISHED"}
    assert of_object("Far") == before
    assert fingerprint.of_object(fingerprint.fingerprint(), good) != alone


def test_carrying_to_it_is_refused_too(tmp_path):
    path = library.save_away(tmp_path, painted)
    obj = library.override(path)
    source = library.beside(obj)
    scenes.select(source)
    bpy.ops.uv.koebe_uniformize(outer="longest")
    scenes.select(source, obj)
    before = of_object("Far")
    with pytest.raises(RuntimeError, match="Far: .*override"):
        bpy.ops.uv.koebe_carry_texture()
    assert of_object("Far") == before


def test_what_is_said_to_be_done_is_there_after_saving_and_opening(tmp_path):
    """An overridden object with a mesh of this file: its UVs stay; a checker would not come off, and is not put on."""
    path = library.save_away(tmp_path, painted)
    obj = library.override(path, mesh=False)
    own = scenes.add_panel("Own", size=12)
    obj.data = own.data
    bpy.data.objects.remove(own)
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.mapped and "did not get the checker" in entry.message
    uv = scenes.corner_uv(obj.data, "Koebe").copy()
    slots = [(slot.link, slot.material) for slot in obj.material_slots]
    assert "Koebe Checker" not in [material and material.name for _, material in slots]
    library.through_a_file(tmp_path)
    obj = bpy.data.objects["Far", None]
    assert (scenes.corner_uv(obj.data, "Koebe") == uv).all()


def test_a_linked_mesh_on_an_object_of_this_file_can_wear_the_checker(tmp_path):
    path = library.save_away(tmp_path, painted)
    far = library.link(path)
    obj = bpy.data.objects.new("Near", far.data)
    bpy.context.collection.objects.link(obj)
    scenes.select(obj)
    before = of_object("Near")
    assert bpy.ops.uv.koebe_checker() == {"FINISHED"}
    assert obj.material_slots[0].material.name == "Koebe Checker"
    library.through_a_file(tmp_path)
    obj = bpy.data.objects["Near"]
    scenes.select(obj)
    assert obj.material_slots[0].material.name == "Koebe Checker"
    assert bpy.ops.uv.koebe_checker() == {"FINISHED"}
    assert {k: v for k, v in of_object("Near").items() if "users" not in k} == {
        k: v for k, v in before.items() if "users" not in k
    }


def test_select_buttons_do_not_enter_edit_mode_with_it(tmp_path):
    library.link(library.save_away(tmp_path, painted))
    scenes.select(states.plain("Good"))
    bpy.ops.uv.koebe_uniformize()
    entry = bpy.context.window_manager.koebe_uv.islands[0]
    entry.object_name, entry.object_key = "Far", ""  # as in a file that was saved
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Far: .*make it local first"):
        bpy.ops.uv.koebe_select_loop(loop=1)
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []
