"""Modes and what is seen: nobody leaves Edit Mode, nothing is half done, nothing is selected that should not be."""

import contextlib

import bmesh
import bpy
import fingerprint
import numpy as np
import pytest
import scenes
import states

OPERATORS = {
    "uniformize": lambda: bpy.ops.uv.koebe_uniformize(),
    "checker": lambda: bpy.ops.uv.koebe_checker(),
    "distortion": lambda: bpy.ops.uv.koebe_distortion(layer="Old"),
    "fill": lambda: bpy.ops.mesh.koebe_fill_holes(),
}


def in_edit_mode():
    return {obj.name for obj in bpy.data.objects if obj.mode == "EDIT"}


def hide(obj):
    obj.hide_set(True)


def hide_in_viewports(obj):
    obj.hide_viewport = True


def lock(obj):
    obj.hide_select = True


def hide_its_collection(obj):
    collection = bpy.data.collections.new("Hidden")
    bpy.context.scene.collection.children.link(collection)
    collection.objects.link(obj)
    for other in obj.users_collection:
        if other != collection:
            other.objects.unlink(obj)
    collection.hide_viewport = True


def deselect(obj):
    obj.select_set(False)


def leave(obj):
    """As it is."""


@pytest.mark.parametrize("operator", OPERATORS)
@pytest.mark.parametrize("make", [leave, hide, hide_in_viewports, lock, hide_its_collection, deselect])
def test_all_stay_in_edit_mode_as_they_were_selected(operator, make):
    one, other = states.plain("One"), states.plain("Other")
    for obj in (one, other):
        obj.data.uv_layers.new(name="Old")
    beside = states.plain("Beside")
    states.consistent([one, other, beside])
    scenes.select(one, other)
    scenes.edit_all()
    bmesh.from_edit_mesh(one.data).select_history.add(next(iter(bmesh.from_edit_mesh(one.data).verts)))
    make(other)
    beside.select_set(True)
    before = fingerprint.fingerprint()
    assert OPERATORS[operator]() == {"FINISHED"}
    assert in_edit_mode() == {"One", "Other"} and bpy.context.mode == "EDIT_MESH"
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    kept = ["mode", "selected", "hidden", "hide", "active_", "Beside", "active face"]
    kept += [] if operator == "fill" else ["verts flags", "edges", "faces", "history", "co "]
    assert not [name for name in changed if f"{name} ".split(": ")[-1].startswith(tuple(kept))], changed


def edited_elsewhere():
    """An object whose mesh is in Edit Mode through another one, and a good one; neither is in Edit Mode itself."""
    good, first = states.plain("Good"), states.plain("First")
    for obj in (good, first):
        obj.data.uv_layers.new(name="Old")
    second = bpy.data.objects.new("Second", first.data)
    bpy.context.collection.objects.link(second)
    states.consistent([good, first])
    scenes.select(first)
    bpy.ops.object.mode_set(mode="EDIT")
    first.select_set(False)
    second.select_set(True)
    good.select_set(True)
    bpy.context.view_layer.objects.active = good
    assert bpy.context.mode == "OBJECT" and second.data.is_editmode and second.mode == "OBJECT"
    return good, first, second


@pytest.mark.parametrize("operator", [name for name in OPERATORS if name != "checker"])
def test_a_mesh_in_edit_mode_through_another_object_is_left_alone(operator):
    good, first, second = edited_elsewhere()
    good.select_set(False)
    bpy.context.view_layer.objects.active = second
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Second: .*same mesh is in Edit Mode"):
        OPERATORS[operator]()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []
    good.select_set(True)
    before = fingerprint.fingerprint()
    assert OPERATORS[operator]() == {"FINISHED"}
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    assert any(name.startswith("mesh Good") for name in changed)
    assert not [name for name in changed if name.startswith(("mesh First", "First", "Second"))], changed


def test_the_checker_goes_on_and_off_a_mesh_in_edit_mode_through_another_object():
    good, first, second = edited_elsewhere()
    before = fingerprint.fingerprint()
    for _ in range(2):
        assert bpy.ops.uv.koebe_checker() == {"FINISHED"}
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    assert all("material" in name for name in changed), changed


def test_a_texture_is_not_carried_to_it():
    good, first, second = edited_elsewhere()
    second.select_set(False)
    bpy.ops.uv.koebe_uniformize(outer="longest")
    second.select_set(True)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Second: .*same mesh is in Edit Mode"):
        bpy.ops.uv.koebe_carry_texture()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_a_mesh_that_is_sculpted_is_left_alone():
    obj, good = states.plain("Sculpted"), states.plain("Good")
    scenes.select(obj)
    bpy.ops.object.mode_set(mode="SCULPT")
    bpy.context.view_layer.objects.active = good
    good.select_set(True)
    assert bpy.context.mode == "OBJECT" and obj.mode == "SCULPT" and obj.select_get()
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert "Koebe" in good.data.uv_layers and len(obj.data.uv_layers) == 0


def test_one_vertex_that_is_no_number_is_selected_alone():
    obj = states.plain("Bad")
    obj.data.vertices[7].co.y = np.nan
    scenes.select(obj)
    scenes.select_faces(obj)
    with pytest.raises(RuntimeError, match="delete the selected|NaN|finite"):
        bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.flatnonzero(scenes.read(obj.data.vertices, "select", bool)).tolist() == [7]
    bpy.ops.uv.koebe_select_offenders()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.flatnonzero(scenes.read(obj.data.vertices, "select", bool)).tolist() == [7]


# ---------------------------------------------------------------- the report's buttons


@pytest.mark.parametrize("make", [hide, hide_in_viewports, hide_its_collection])
@pytest.mark.parametrize("button", [
    "koebe_select_loop", "koebe_select_flipped", "koebe_select_cuts", "koebe_select_offenders",
])  # fmt: skip
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_a_button_on_a_hidden_object_changes_nothing(make, button, mode):
    obj, other = states.plain("Seen no more"), states.plain("Other")
    if button == "koebe_select_offenders":
        obj.data.vertices[7].co.y = np.nan
    scenes.select(obj)
    states.consistent([obj, other])
    scenes.select(obj)
    with contextlib.suppress(RuntimeError):  # it has offenders then
        bpy.ops.uv.koebe_uniformize()
    if button == "koebe_select_cuts":  # which wants some
        bpy.context.window_manager.koebe_uv.islands[0].cut_edges = "[5]"
    make(obj)
    scenes.select(other)
    bpy.ops.object.mode_set(mode=mode)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Seen no more: it is hidden"):
        getattr(bpy.ops.uv, button)()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_a_button_on_an_object_that_cannot_be_selected_works():
    obj, other = states.plain("Locked"), states.plain("Other")
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize()
    lock(obj)
    scenes.select(other)
    assert bpy.ops.uv.koebe_select_loop(loop=1) == {"FINISHED"}
    assert in_edit_mode() == {"Locked"} and obj.hide_select


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_a_loop_that_is_no_longer_there_is_said_and_nothing_changed(mode):
    obj, other = states.plain("Changed"), states.plain("Other")
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize()
    states.consistent([obj])
    scenes.select_faces(obj, range(len(obj.data.polygons) - 10))
    bpy.ops.mesh.delete(type="FACE")
    bpy.ops.object.mode_set(mode="OBJECT")
    states.consistent([obj, other])
    scenes.select(other)
    bpy.ops.object.mode_set(mode=mode)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="Changed: its mesh has changed since it was mapped"):
        bpy.ops.uv.koebe_select_loop(loop=0)
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_each_edited_mesh_keeps_its_own_select_mode_and_flags():
    """Blender enters Edit Mode with one mode for all meshes, and flags that suit it: a script may have set others."""
    one, other = scenes.add_panel("One"), scenes.add_panel("Other")
    for obj in (one, other):
        obj.data.uv_layers.new(name="Old")
    scenes.select(one, other)
    scenes.edit_all()
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.mesh.select_mode(type="FACE")
    mesh = bmesh.from_edit_mesh(other.data)
    mesh.select_mode = {"VERT"}
    mesh.verts.ensure_lookup_table()
    for vertex in list(mesh.verts)[3:7]:
        vertex.select_set(True)
        mesh.select_history.add(vertex)
    bmesh.update_edit_mesh(other.data)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="no UV layer"):
        bpy.ops.uv.koebe_distortion(layer="Missing")
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []
    assert bpy.ops.uv.koebe_distortion(layer="Old", kind="none") == {"FINISHED"}
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_modifiers_that_make_faces_are_told(addon):
    makes_faces, obj = addon("blender.targets").makes_faces, scenes.add_panel()
    obj.modifiers.new("Smooth", "SUBSURF")
    assert not makes_faces(obj)
    nodes = obj.modifiers.new("Nodes", "NODES")
    nodes.node_group = bpy.data.node_groups.new("Koebe UV by Attribute", "GeometryNodeTree")
    assert not makes_faces(obj)
    nodes.node_group.name = "Rocks"
    assert makes_faces(obj)
    nodes.show_viewport = False
    assert not makes_faces(obj)
