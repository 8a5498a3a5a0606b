"""Several islands of an object: cut at seams, laid out without overlap, or each where it was."""

import bpy
import numpy as np
import pytest
import scenes


def add_seamed_panel(name="Panel"):
    """A panel that a ring of seams divides into a disk with holes and an annulus."""
    obj = scenes.add_panel(name)
    radius = np.hypot(*scenes.read(obj.data.vertices, "co", np.float32, 3)[:, :2].T)
    ring = np.abs(radius - 11 / 13) < 1e-3
    for edge in obj.data.edges:
        edge.use_seam = bool(ring[list(edge.vertices)].all())
    return obj


def disks(obj, layer="Koebe"):
    """Centre and radius of what each island of a seamed panel covers, the inner island first."""
    center = scenes.read(obj.data.polygons, "center", np.float32, 3)
    inside = np.hypot(center[:, 0], center[:, 1]) < 11 / 13
    corner_inside = np.repeat(inside, scenes.read(obj.data.polygons, "loop_total", np.int32))
    uv = scenes.corner_uv(obj.data, layer).astype(float)
    return [enclosing(uv[corner_inside]), enclosing(uv[~corner_inside])]


def enclosing(points):
    """Circle through the outermost points of a disk."""
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    rim = np.hypot(*(points - middle).T) > 0.97 * np.hypot(*(points - middle).T).max()
    center, radius, _ = scenes.fit_circle(points[rim])
    return np.array(center), radius


@pytest.mark.alike
def test_islands_do_not_overlap_and_keep_their_margin():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize(margin=51.2, pixels=1024)
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert uv.min() >= 0.024 and uv.max() <= 0.976
    (one, one_radius), (two, two_radius) = disks(obj)
    assert np.hypot(*(one - two)) >= one_radius + two_radius + 0.049
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()


@pytest.mark.alike
def test_the_seams_themselves_stay():
    obj = add_seamed_panel()
    before = scenes.mesh_state(obj.data)
    bpy.ops.uv.koebe_uniformize()
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before


@pytest.mark.alike
def test_islands_in_place_keep_position_size_and_rotation():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize()
    expected = scenes.corner_uv(obj.data, "Koebe") @ np.float32([[0, 0.5], [-0.5, 0]]) + np.float32([2.0, 0.25])
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", expected.astype(np.float32).ravel())
    bpy.ops.uv.koebe_uniformize(placement="keep")
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - expected).max() < 1e-5


def test_in_place_goes_by_the_active_layer_if_the_own_one_is_new_in_edit_mode_too():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize(layer="Old")
    expected = scenes.corner_uv(obj.data, "Old") * np.float32(0.5)
    obj.data.uv_layers["Old"].data.foreach_set("uv", expected.ravel())
    scenes.select_faces(obj)
    bpy.ops.uv.koebe_uniformize(placement="keep")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - expected).max() < 1e-5


@pytest.mark.alike
@pytest.mark.parametrize("empty_layer", [False, True])
def test_in_place_without_a_place_packs(empty_layer):
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize(layer="Packed")
    packed = scenes.corner_uv(obj.data, "Packed").copy()
    obj.data.uv_layers.remove(obj.data.uv_layers["Packed"])
    if empty_layer:
        obj.data.uv_layers.new(name="Koebe", do_init=False)
        obj.data.uv_layers["Koebe"].data.foreach_set("uv", np.zeros(2 * len(obj.data.loops), np.float32))
    bpy.ops.uv.koebe_uniformize(placement="keep")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), packed)


@pytest.mark.alike
def test_objects_together_share_the_square_in_proportion_to_their_size():
    one, two = scenes.add_panel("One"), scenes.add_panel("Two")
    two.scale = (2, 2, 2)
    scenes.select(one, two)
    bpy.ops.uv.koebe_uniformize(placement="together", margin=0.0)
    (a, small), (b, large) = (enclosing(scenes.corner_uv(obj.data, "Koebe").astype(float)) for obj in (one, two))
    assert large == pytest.approx(2 * small, rel=1e-4)
    assert np.hypot(*(a - b)) >= small + large - 1e-5


def test_only_selected_islands_change_and_the_others_stay_bit_for_bit():
    obj = add_seamed_panel()
    bpy.ops.uv.koebe_uniformize()
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    center = scenes.read(obj.data.polygons, "center", np.float32, 3)
    inside = np.hypot(center[:, 0], center[:, 1]) < 11 / 13
    scenes.select_faces(obj, np.flatnonzero(inside))
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.object.mode_set(mode="OBJECT")
    corner_inside = np.repeat(inside, scenes.read(obj.data.polygons, "loop_total", np.int32))
    after = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(after[~corner_inside], before[~corner_inside])
    (a, small), (b, large) = (enclosing(after[of].astype(float)) for of in (corner_inside, ~corner_inside))
    assert small == pytest.approx(enclosing(before[corner_inside].astype(float))[1], rel=1e-3)  # one texel density
    assert np.hypot(*(a - b)) >= small + large - 1e-5


@pytest.mark.alike
def test_a_seamed_tube_opens():
    """A tube cut lengthwise is a disk; the seam's vertices have two UVs each."""
    around, rings = 24, 12
    turn = 2 * np.pi * np.arange(around) / around
    vertices = [(np.cos(a), np.sin(a), 0.2 * z) for z in range(rings + 1) for a in turn]
    at = lambda i, j: j * around + i % around  # noqa: E731
    obj = scenes.add_object("Tube", vertices, [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
                                               for j in range(rings) for i in range(around)])  # fmt: skip
    for edge in obj.data.edges:
        a, b = sorted(edge.vertices)
        edge.use_seam = a % around == 0 and b - a == around
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    vertex, uv = scenes.read(obj.data.loops, "vertex_index", np.int32), scenes.corner_uv(obj.data, "Koebe")
    counts = [len(np.unique(uv[vertex == v], axis=0)) for v in range(len(vertices))]
    assert counts == [2 if v % around == 0 else 1 for v in range(len(vertices))]
    assert np.hypot(*(uv - 0.5).T).max() == pytest.approx(0.5, abs=1e-6)


@pytest.mark.alike
def test_parts_that_touch_in_a_vertex_only_are_islands():
    obj = scenes.add_object("Bow", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (-1, 0, 0), (-1, -1, 0)], [(0, 1, 2), (0, 3, 4)])
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize() == {"FINISHED"}
    assert [island.mapped for island in bpy.context.window_manager.koebe_uv.islands] == [True, True]


def test_triangles_know_their_faces_in_object_mode_and_in_edit_mode(addon):
    angles = 2.0 * np.pi * np.arange(7) / 7
    turn = np.cos(angles) + 1j * np.sin(angles)
    vertices = [*((z.real, z.imag, 0) for z in turn), *((2 * z.real, 2 * z.imag, 0) for z in turn[:3])]
    obj = scenes.add_object("Polygons", vertices, [(0, 7, 8, 1), range(7), (1, 8, 2), (8, 9, 2)])
    scenes.select(obj)
    obj.data.calc_loop_triangles()
    expected = scenes.read(obj.data.loop_triangles, "polygon_index", np.int32)
    assert expected.tolist() == [0, 0, 1, 1, 1, 1, 1, 2, 3]
    assert np.array_equal(addon("blender.mesh_reading").read_surface(obj, False).triangle_face, expected)
    bpy.ops.object.mode_set(mode="EDIT")
    assert np.array_equal(addon("blender.mesh_reading").read_surface(obj, False).triangle_face, expected)
