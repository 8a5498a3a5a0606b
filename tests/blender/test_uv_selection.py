"""New UVs are selected, as Blender's own unwrap leaves them: else they are black in the UV Editor. All others stay."""

import bmesh
import bpy
import numpy as np
import pytest
import scenes
import states
from test_edit_mode import parts

ONE_SELECTION = hasattr(bmesh.types.BMLoop, "uv_select_vert")  # for all layers, from 5.0 on


def selected(obj, layer="Koebe"):
    """The faces whose UVs are selected, and the number of selected corners and edges of the others: in Edit Mode."""
    edited = bmesh.from_edit_mesh(obj.data)
    own, found, rest = edited.loops.layers.uv[layer], [], 0
    for face in edited.faces:
        if ONE_SELECTION:
            flags = [flag for corner in face.loops for flag in (corner.uv_select_vert, corner.uv_select_edge)]
        else:
            flags = [flag for corner in face.loops for flag in (corner[own].select, corner[own].select_edge)]
        if all(flags) and (not ONE_SELECTION or face.uv_select):
            found.append(face.index)
        else:
            rest += sum(flags)
    return found, rest


def select_in_uv(obj, faces, on=True, layer="Koebe"):
    """Select the UVs of these faces, or deselect them, in Edit Mode."""
    edited = bmesh.from_edit_mesh(obj.data)
    own = edited.loops.layers.uv[layer]
    edited.faces.ensure_lookup_table()
    for number in faces:
        face = edited.faces[number]
        for corner in face.loops:
            if ONE_SELECTION:
                corner.uv_select_vert = corner.uv_select_edge = on
            else:
                corner[own].select = corner[own].select_edge = on
        if ONE_SELECTION:
            face.uv_select = on
    bmesh.update_edit_mesh(obj.data)


def in_edit_mode(obj):
    if obj.mode != "EDIT":
        bpy.ops.object.mode_set(mode="EDIT")


@pytest.mark.parametrize("shape", ["DISK", "PARTS"])
@pytest.mark.parametrize("layer", ["new", "there"])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT", "LOCKED"])
def test_the_new_uvs_are_selected_and_no_others(mode, layer, shape):
    obj = scenes.add_panel()
    if layer == "there":
        obj.data.uv_layers.new(name="Koebe", do_init=False)
    every = range(len(obj.data.polygons))
    mapped, rest = (every, ()) if mode == "OBJECT" else parts(obj)
    if mode != "OBJECT":
        scenes.select_faces(obj, mapped)
    if mode == "LOCKED":  # then Edit Mode cannot be left for writing
        obj.hide_select = True
        obj.select_set(False)
    assert bpy.ops.uv.koebe_unwrap(shape=shape) == {"FINISHED"}
    in_edit_mode(obj)
    assert selected(obj) == ([*mapped], 0)
    bpy.ops.object.mode_set(mode="OBJECT")
    scenes.select(obj) if not obj.hide_select else setattr(bpy.context.view_layer.objects, "active", obj)
    obj.hide_select = False
    bpy.ops.object.mode_set(mode="EDIT")
    assert selected(obj) == ([*mapped], 0)  # it is kept with the mesh
    assert len(mapped) + len(rest) == len(every)


def test_an_older_selection_of_other_faces_stays():
    obj = scenes.add_panel()
    obj.data.uv_layers.new(name="Koebe", do_init=False)
    inside, outside = parts(obj)
    scenes.select_faces(obj, inside)
    select_in_uv(obj, outside[:5])
    bpy.ops.uv.koebe_unwrap()
    assert selected(obj) == (sorted([*inside, *outside[:5]]), 0)


def test_each_object_and_a_linked_duplicate():
    one, other = scenes.add_panel(), scenes.add_panel("Other", size=12)
    twin = bpy.data.objects.new("Twin", one.data)
    bpy.context.collection.objects.link(twin)
    scenes.select(one, other, twin)
    assert bpy.ops.uv.koebe_unwrap() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="EDIT")
    for obj in (one, other):
        assert selected(obj) == ([*range(len(obj.data.polygons))], 0)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_undo_brings_the_old_selection_back(mode):
    states.new_file()
    obj = scenes.add_panel()
    obj.data.uv_layers.new(name="Koebe", do_init=False)
    _, outside = parts(obj)
    scenes.select_faces(obj)
    select_in_uv(obj, outside[:5])
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.ed.undo_push(message="made")
    bpy.ops.uv.koebe_unwrap(checker=False)
    bpy.ops.ed.undo_push(message="unwrapped")
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Panel"]
    in_edit_mode(obj)
    assert selected(obj) == ([*outside[:5]], 0)
    bpy.ops.object.mode_set(mode=mode)
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Panel"]
    in_edit_mode(obj)
    assert selected(obj) == ([*range(len(obj.data.polygons))], 0)


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_a_run_that_fails_while_it_writes_selects_nothing(mode, addon, monkeypatch):
    obj = scenes.add_panel()
    obj.data.uv_layers.new(name="Koebe", do_init=False)
    if mode == "EDIT":
        scenes.select_faces(obj)

    def fail(*_):
        raise MemoryError

    monkeypatch.setattr(addon("blender.checker"), "put_on", fail)
    with pytest.raises(RuntimeError):
        bpy.ops.uv.koebe_unwrap(checker=True)
    in_edit_mode(obj)
    assert selected(obj) == ([], 0)


def test_moved_circles_keep_the_selection():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_unwrap()
    scenes.edit_all()
    select_in_uv(obj, range(5, len(obj.data.polygons)), on=False)
    assert bpy.ops.uv.koebe_moebius(center=(0.3, 0.1)) == {"FINISHED"}
    assert selected(obj) == ([0, 1, 2, 3, 4], 0)


def test_the_uvs_of_a_flat_copy_are_selected():
    scenes.add_panel()
    bpy.ops.uv.koebe_unwrap()
    assert bpy.ops.object.koebe_flat_copy() == {"FINISHED"}
    (copy,) = bpy.context.selected_objects
    bpy.ops.object.mode_set(mode="EDIT")
    assert selected(copy) == ([*range(len(copy.data.polygons))], 0)


def test_data_of_the_artist_with_a_name_of_blenders_stays():
    obj = scenes.add_panel()
    names = (".uv_select_vert",) if ONE_SELECTION else (".vs.Koebe",)
    for name in names:
        obj.data.attributes.new(name, "FLOAT", "POINT").data.foreach_set("value", np.arange(len(obj.data.vertices)))
    assert bpy.ops.uv.koebe_unwrap(checker=False) == {"FINISHED"}
    for name in names:
        values = scenes.read(obj.data.attributes[name].data, "value", np.float32)
        assert np.array_equal(values, np.arange(len(obj.data.vertices)))
