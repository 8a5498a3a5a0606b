"""`mesh.koebe_fill_holes`: real faces on a surface that goes on, selected, with UVs."""

import bmesh
import bpy
import numpy as np
import pytest
import scenes


def points(obj):
    """Vertices of the mesh."""
    return scenes.read(obj.data.vertices, "co", np.float32, 3).astype(float)


def uses(obj):
    """Number of faces at each edge."""
    return np.bincount(scenes.read(obj.data.loops, "edge_index", np.int32), minlength=len(obj.data.edges))


def consistent(obj):
    """Whether no two faces run along an edge in the same direction."""
    directed = [(a, b) for p in obj.data.polygons for a, b in zip(p.vertices, [*p.vertices[1:], p.vertices[0]])]
    return len(set(directed)) == len(directed)


def add_sphere(opening=0.8, size=48):
    """A sphere of radius 1 of quads, open at its top and more widely at its bottom."""
    turn, rings = 2 * np.pi * np.arange(size) / size, size // 2
    vertices = [
        (np.sin(p) * np.cos(a), np.sin(p) * np.sin(a), np.cos(p))
        for p in np.linspace(opening, 2.0, rings + 1)
        for a in turn
    ]
    at = lambda i, j: i * size + j % size  # noqa: E731
    faces = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for i in range(rings) for j in range(size)]
    obj = scenes.add_object("Sphere", vertices, faces)
    scenes.select(obj)
    return obj


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_holes_are_filled_and_the_outer_loop_stays_open(mode):
    obj = scenes.add_panel()
    old = points(obj), len(obj.data.polygons)
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.mesh.koebe_fill_holes() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [len(loop) for loop in scenes.boundary_loops(obj.data)] == [52]
    assert uses(obj).max() == 2 and uses(obj).min() == 1 and consistent(obj)
    assert np.array_equal(points(obj)[: len(old[0])], old[0])
    chosen = np.flatnonzero(scenes.read(obj.data.polygons, "select", bool))
    assert chosen.tolist() == list(range(old[1], len(obj.data.polygons)))
    assert not obj.data.validate()


def test_a_plane_is_continued_as_a_plane():
    obj = scenes.add_panel(height=lambda x, y: 0.3 * x - 0.2 * y)
    bpy.ops.mesh.koebe_fill_holes()
    x, y, z = points(obj).T
    assert z == pytest.approx(0.3 * x - 0.2 * y, abs=1e-5)


def test_a_spheres_curvature_is_continued():
    """The cap over the opening is 1 - cos 0.8 = 0.3 high; a flat lid would miss it all."""
    obj = add_sphere()
    old = len(obj.data.vertices)
    bpy.ops.mesh.koebe_fill_holes()
    added = points(obj)[old:]
    assert len(added) > 50
    assert np.abs(np.linalg.norm(added, axis=1) - 1).max() < 0.03
    assert added[:, 2].max() == pytest.approx(1, abs=0.03)


def test_edges_match_those_around():
    obj = add_sphere()
    old = len(obj.data.polygons)
    bpy.ops.mesh.koebe_fill_holes()
    rim = 2 * np.sin(0.8) * np.sin(np.pi / 48)
    shape = [obj.data.polygons[i] for i in range(old, len(obj.data.polygons))]
    length = [np.linalg.norm(np.subtract(*points(obj)[list(e)])) for p in shape for e in p.edge_keys]
    assert 0.3 * rim < min(length) and max(length) < 4 * rim


def test_uvs_go_on_into_the_circles():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(upright=False)
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    circles = [scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", loop)) for loop in scenes.boundary_loops(obj.data)]
    old = len(obj.data.polygons)
    bpy.ops.mesh.koebe_fill_holes()
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(uv[: len(before)], before)
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()
    assert len(obj.data.polygons) > old
    holes = [circle for circle in circles if circle[1] < 0.49]
    inside = [np.hypot(*(uv[len(before):] - center).T) < radius + 1e-5 for center, radius, _ in holes]
    assert np.any(inside, axis=0).all() and len(holes) == 3
    total = scenes.signed_areas(obj.data, "Koebe").sum()
    assert total == pytest.approx(0.25 * np.pi, rel=5e-3)  # the whole disk


def test_only_the_selected_loop():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.uv.koebe_select_loop(loop=2)
    bpy.ops.mesh.koebe_fill_holes(which="selected")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert len(scenes.boundary_loops(obj.data)) == 3


def test_all_closes_it():
    obj = scenes.add_panel()
    bpy.ops.mesh.koebe_fill_holes(which="all")
    assert (uses(obj) == 2).all() and consistent(obj)


def test_small_holes():
    """Loops of three and of four edges."""
    obj = scenes.add_panel(holes=())
    mesh = bmesh.new()
    mesh.from_mesh(obj.data)
    mesh.faces.ensure_lookup_table()
    bmesh.ops.delete(mesh, geom=[mesh.faces[0], mesh.faces[200]], context="FACES")
    mesh.to_mesh(obj.data)
    bpy.ops.mesh.koebe_fill_holes()
    assert [len(loop) for loop in scenes.boundary_loops(obj.data)] == [52] and consistent(obj)


def test_material_and_shading_are_those_beside():
    obj = scenes.add_panel()
    for name in ("A", "B"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.polygons.foreach_set("material_index", np.ones(len(obj.data.polygons), np.int32))
    obj.data.polygons.foreach_set("use_smooth", np.ones(len(obj.data.polygons), bool))
    bpy.ops.mesh.koebe_fill_holes()
    assert set(scenes.read(obj.data.polygons, "material_index", np.int32)) == {1}
    assert scenes.read(obj.data.polygons, "use_smooth", bool).all()


def test_doubled_vertices_on_the_rim_are_joined_all_the_same():
    obj = scenes.add_panel()
    loop = min(scenes.boundary_loops(obj.data), key=len)
    obj.data.vertices[loop[1]].co = obj.data.vertices[loop[0]].co
    bpy.ops.mesh.koebe_fill_holes()
    assert [len(loop) for loop in scenes.boundary_loops(obj.data)] == [52] and consistent(obj)
    assert np.isfinite(points(obj)).all()


def test_a_hole_without_extent_is_said_and_nothing_is_changed():
    obj = scenes.add_panel()
    loop = min(scenes.boundary_loops(obj.data), key=len)
    for v in loop:
        obj.data.vertices[v].co = obj.data.vertices[loop[0]].co
    before = scenes.mesh_state(obj.data)
    with pytest.raises(RuntimeError, match="a hole has no size"):
        bpy.ops.mesh.koebe_fill_holes()
    assert scenes.mesh_state(obj.data) == before


@pytest.mark.parametrize("which, reason", [("holes", "no hole"), ("selected", "no boundary loop is selected")])
def test_nothing_to_fill_says_so(which, reason):
    scenes.add_panel(holes=())
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match=reason):
        bpy.ops.mesh.koebe_fill_holes(which=which)
