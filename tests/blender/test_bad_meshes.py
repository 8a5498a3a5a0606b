"""Meshes that cannot be mapped: the reason is said, nothing is changed, what is good is done."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike

FAN = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]


def torus_with_hole(around=8, along=8):
    """A torus that lacks a face: genus 1 with a boundary."""
    one, two = np.meshgrid(2 * np.pi * np.arange(around) / around, 2 * np.pi * np.arange(along) / along)
    x = (2 + np.cos(two)) * np.cos(one)
    y = (2 + np.cos(two)) * np.sin(one)
    vertices = np.stack([x, y, np.sin(two)], axis=2).reshape(-1, 3)
    at = lambda i, j: (j % along) * around + i % around  # noqa: E731
    quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(along) for i in range(around)]
    return vertices, quads[1:]


def moebius_strip(around=16):
    """A strip with half a twist."""
    vertices = []
    for i in range(around):
        a = 2 * np.pi * i / around
        for side in (-0.3, 0.3):
            r = 1 + side * np.cos(a / 2)
            vertices.append((r * np.cos(a), r * np.sin(a), side * np.sin(a / 2)))
    quads = [(2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1) for i in range(around - 1)]
    return vertices, [*quads, (2 * around - 2, 1, 0, 2 * around - 1)]


def not_a_number():
    vertices, faces = scenes.panel_arrays()
    vertices = vertices.copy()
    vertices[5, 2] = np.nan
    return vertices, faces


def collapsed(*factors):
    """The panel with its coordinates multiplied."""
    vertices, faces = scenes.panel_arrays()
    return vertices * factors, faces


def slanted():
    vertices, faces = scenes.panel_arrays()
    return vertices[:, :1] * [0.3, -0.7, 0.11], faces


BAD = {
    "closed": (lambda: ([v.co for v in scenes.add_cube().data.vertices],
                        [p.vertices for p in bpy.data.objects["Cube"].data.polygons]), "seam"),
    "genus": (torus_with_hole, "handle"),
    "nonmanifold_edge": (lambda: (FAN, [(0, 1, 2), (1, 0, 3), (0, 1, 4)]), "edge"),
    "nonorientable": (moebius_strip, "one-sided"),
    "nan": (not_a_number, "NaN|finite"),
    "a line": (lambda: collapsed(1, 0, 0), "collapsed to a line"),
    "a slanted line": (slanted, "collapsed to a line"),
    "a point": (lambda: collapsed(0, 0, 0), "collapsed"),
}  # fmt: skip


@pytest.mark.parametrize("kind", BAD)
def test_the_reason_is_said_and_nothing_is_changed(kind):
    make, words = BAD[kind]
    obj = scenes.add_object("Bad", *make())
    scenes.select(obj)
    before = scenes.mesh_state(obj.data)
    with pytest.raises(RuntimeError, match=rf"(?s)Bad: .*({words})"):
        bpy.ops.uv.koebe_uniformize(cut=False)
    assert scenes.mesh_state(obj.data) == before
    assert len(obj.data.uv_layers) == 0
    assert len(obj.material_slots) == 0
    assert "Koebe Checker" not in bpy.data.materials


@pytest.mark.parametrize("scale", [(1, 0, 0), (0, 1, 0), (0, 0, 0)])
def test_an_object_whose_scale_leaves_a_line_is_refused_and_another_done(scale):
    bad, good = scenes.add_panel("Bad"), scenes.add_panel("Good")
    bad.scale = scale
    scenes.select(bad, good)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert len(bad.data.uv_layers) == 0 and "Koebe" in good.data.uv_layers
    bad_entry, good_entry = bpy.context.window_manager.koebe_uv.islands
    assert not bad_entry.mapped and "collapsed" in bad_entry.message


def test_good_objects_are_done_beside_bad_ones():
    good, bad = scenes.add_panel("Good"), scenes.add_cube("Bad")
    scenes.select(bad, good)
    assert bpy.ops.uv.koebe_uniformize(cut=False) == {"FINISHED"}
    assert len(bad.data.uv_layers) == 0 and len(bad.material_slots) == 0
    alone = scenes.add_panel("Alone")
    bpy.ops.uv.koebe_uniformize()
    assert np.array_equal(scenes.corner_uv(good.data, "Koebe"), scenes.corner_uv(alone.data, "Koebe"))


def test_a_closed_surface_with_a_seam_is_no_longer_closed():
    obj = scenes.add_cube("Cube")
    for edge in obj.data.edges:
        if {obj.data.vertices[v].co.z for v in edge.vertices} == {1.0}:
            edge.use_seam = True
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).sum() > 0


@pytest.mark.parametrize("vertices", [[], [(0, 0, 0), (1, 0, 0)]])
def test_a_mesh_without_faces(vertices):
    scenes.select(scenes.add_object("Empty", vertices, []))
    with pytest.raises(RuntimeError, match="no mesh with faces"):
        bpy.ops.uv.koebe_uniformize()


def test_no_mesh_selected_is_no_case_for_the_operator():
    assert not bpy.ops.uv.koebe_uniformize.poll()
    obj = scenes.add_panel()
    assert bpy.ops.uv.koebe_uniformize.poll()
    obj.select_set(False)
    assert not bpy.ops.uv.koebe_uniformize.poll()


def selected(obj):
    """Vertices, edges and faces that are selected, after leaving Edit Mode."""
    bpy.ops.object.mode_set(mode="OBJECT")
    mesh = obj.data
    return tuple(
        np.flatnonzero(scenes.read(items, "select", bool)).tolist()
        for items in (mesh.vertices, mesh.edges, mesh.polygons)
    )


def test_the_crowded_edge_is_selected_in_edit_mode():
    obj = scenes.add_object("Bad", FAN, [(0, 1, 2), (1, 0, 3), (0, 1, 4)])
    scenes.select(obj)
    scenes.select_faces(obj)
    with pytest.raises(RuntimeError, match="edge"):
        bpy.ops.uv.koebe_uniformize(cut=False)
    assert bpy.context.mode == "EDIT_MESH"
    assert tuple(bpy.context.tool_settings.mesh_select_mode) == (False, True, False)
    vertices, edges, faces = selected(obj)
    assert vertices == [0, 1] and faces == []
    assert [sorted(obj.data.edges[e].vertices) for e in edges] == [[0, 1]]


def test_the_bad_island_is_selected_and_the_good_one_done():
    vertices, faces = scenes.panel_arrays()
    cube = scenes.add_cube()
    corners = np.array([v.co for v in cube.data.vertices]) + [5, 0, 0]
    together = [*faces, *[[len(vertices) + v for v in p.vertices] for p in cube.data.polygons]]
    obj = scenes.add_object("Both", np.vstack([vertices, corners]), together)
    scenes.select(obj)
    scenes.select_faces(obj)
    assert bpy.ops.uv.koebe_uniformize(cut=False) == {"FINISHED"}
    assert selected(obj)[2] == list(range(len(faces), len(faces) + 6))
    assert not scenes.corner_uv(obj.data, "Koebe")[-24:].any()
    alone = scenes.add_panel("Alone")
    bpy.ops.uv.koebe_uniformize()
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe")[:-24], scenes.corner_uv(alone.data, "Koebe"))
