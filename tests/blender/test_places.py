"""The options "center" and "point": which vertex goes to the disk's centre, and which to its right end."""

import bmesh
import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def inner_vertex(obj):
    rim = np.concatenate(scenes.boundary_loops(obj.data))
    return int(np.setdiff1d(np.arange(len(obj.data.vertices)), rim)[40])


def make_active(obj, vertex):
    scenes.edit_all()
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    mesh.select_history.clear()
    mesh.select_history.add(mesh.verts[vertex])
    bmesh.update_edit_mesh(obj.data)


def in_the_world(obj, vertex):
    return obj.matrix_world @ obj.data.vertices[vertex].co


def test_the_active_vertex_becomes_the_centre():
    obj = scenes.add_panel()
    vertex = inner_vertex(obj)
    make_active(obj, vertex)
    assert bpy.ops.uv.koebe_uniformize(center="active") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(scenes.vertex_uv(obj)[vertex], [0.5, 0.5])
    scenes.assert_circle_domain(obj)


def test_the_active_vertex_becomes_the_right_end_and_its_loop_the_rim():
    obj = scenes.add_panel()
    hole = min(scenes.boundary_loops(obj.data), key=len)
    make_active(obj, hole[2])
    assert bpy.ops.uv.koebe_uniformize(point="active") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.abs(scenes.vertex_uv(obj)[hole[2]] - [1.0, 0.5]).max() < 1e-7
    assert scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", hole))[1] == pytest.approx(0.5, abs=1e-6)


def test_the_3d_cursor_names_the_nearest_vertex_in_the_world():
    obj = scenes.add_panel()
    obj.location, obj.rotation_euler, obj.scale = (3.0, -2.0, 1.0), (0.3, 1.0, -0.4), (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    vertex = inner_vertex(obj)
    rim = max(scenes.boundary_loops(obj.data), key=len)
    bpy.context.scene.cursor.location = in_the_world(obj, vertex)
    assert bpy.ops.uv.koebe_uniformize(center="cursor") == {"FINISHED"}
    assert np.array_equal(scenes.vertex_uv(obj)[vertex], [0.5, 0.5])
    bpy.context.scene.cursor.location = in_the_world(obj, rim[5])
    assert bpy.ops.uv.koebe_uniformize(point="cursor") == {"FINISHED"}
    assert np.abs(scenes.vertex_uv(obj)[rim[5]] - [1.0, 0.5]).max() < 1e-7


def test_the_cursor_on_a_hole_finds_a_vertex_inside_for_the_centre():
    obj = scenes.add_panel()
    hole = min(scenes.boundary_loops(obj.data), key=len)
    bpy.context.scene.cursor.location = in_the_world(obj, hole[0])
    assert bpy.ops.uv.koebe_uniformize(center="cursor", point="cursor") == {"FINISHED"}
    uv = scenes.vertex_uv(obj)
    assert (np.abs(uv - 0.5).max(axis=1) == 0.0).sum() == 1
    assert np.abs(uv[hole[0]] - [1.0, 0.5]).max() < 1e-7


@pytest.mark.parametrize("option", ["center", "point"])
def test_without_an_active_vertex_it_says_so_and_nothing_changes(option):
    obj = scenes.add_panel()
    before = scenes.mesh_state(obj.data)
    with pytest.raises(RuntimeError, match="no vertex is active"):
        bpy.ops.uv.koebe_uniformize(**{option: "active"})
    assert scenes.mesh_state(obj.data) == before and len(obj.data.uv_layers) == 0


def test_a_vertex_that_cannot_be_there_is_named_and_nothing_changes():
    obj = scenes.add_panel()
    rim, inner = scenes.boundary_loops(obj.data)[0][3], inner_vertex(obj)
    for option, vertex in (("center", rim), ("point", inner)):
        make_active(obj, vertex)
        with pytest.raises(RuntimeError, match=f"vertex {vertex} cannot be the"):
            bpy.ops.uv.koebe_uniformize(**{option: "active"})
        bpy.ops.object.mode_set(mode="OBJECT")
        assert len(obj.data.uv_layers) == 0


def test_only_the_island_that_has_the_vertex_gets_it():
    vertices, faces = scenes.panel_arrays()
    vertices = np.asarray(vertices, dtype=float)
    faces = [tuple(face) for face in faces]
    count = len(vertices)
    moved = [tuple(v + count for v in face) for face in faces]
    two = scenes.add_object("Two", np.concatenate([vertices, vertices + [5.0, 0.0, 0.0]]), faces + moved)
    scenes.select(two)
    bpy.ops.uv.koebe_uniformize()
    plain = scenes.vertex_uv(two)
    vertex = inner_vertex(two)
    assert vertex < count
    make_active(two, vertex)
    bpy.ops.uv.koebe_uniformize(center="active", placement="pack")
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.vertex_uv(two)
    disk = uv[:count]
    middle = (disk.min(axis=0) + disk.max(axis=0)) / 2
    assert np.abs(uv[vertex] - middle).max() < 2e-3
    other = uv[count:]
    size, old = np.ptp(other, axis=0), np.ptp(plain[count:], axis=0)
    assert np.abs((other - other.min(axis=0)) / size - (plain[count:] - plain[count:].min(axis=0)) / old).max() < 1e-5
