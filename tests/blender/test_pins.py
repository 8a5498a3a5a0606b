"""Unwrap to Parts joins pinned UVs: they stay to the last bit, and their islands follow, one to one."""

import bpy
import numpy as np
import pytest
import scenes
from test_rendered_layer import covered

pytestmark = pytest.mark.alike


def put(obj, places):
    """Pin vertices of the layer Koebe at these places. Corners (n,) that are pinned."""
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    uv = scenes.corner_uv(obj.data, "Koebe")
    for one, place in places.items():
        uv[vertex == one] = place
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", uv.astype(np.float32).ravel())
    corners = np.flatnonzero(np.isin(vertex, list(places)))
    scenes.pin(obj.data, "Koebe", np.isin(vertex, list(places)))
    return corners


def said():
    return [entry.message for entry in bpy.context.window_manager.koebe_uv.islands]


@pytest.mark.parametrize("shape", ["PARTS", "AUTO"])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("count", [1, 2, 4])
def test_pins_stay_to_the_last_bit_and_the_map_joins_them(shape, mode, count):
    obj = scenes.add_sheet()
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}
    places = {0: (0.1, 0.1), 168: (0.8, 0.7), 84: (0.6, 0.25), 12: (0.05, 0.7)}
    pinned = put(obj, dict(list(places.items())[:count]))
    before = scenes.corner_uv(obj.data, "Koebe")
    scenes.edit_all(mode)
    assert bpy.ops.uv.koebe_unwrap(shape=shape, checker=False) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(after[pinned], before[pinned]) and not np.array_equal(after, before)
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    assert entry.mapped and entry.flipped == 0
    assert (entry.angle_error > 2.0) == (count == 4)  # the figure of the map as it is, bent


def test_islands_without_pins_go_beside_those_with_pins():
    obj = scenes.add_sheet(seams=(4, 8))
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}
    pinned = put(obj, {0: (0.3, 0.3), 12: (0.3, 0.7)})
    before = scenes.corner_uv(obj.data, "Koebe")
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}
    after = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(after[pinned], before[pinned])
    assert covered(obj, "Koebe", 400).max() == 1
    areas = np.abs(scenes.signed_areas(obj.data, "Koebe")).reshape(3, -1).sum(axis=1)
    assert areas.max() < 1.3 * areas.min()  # one texel density


def test_islands_that_are_pinned_over_each_other_are_told():
    obj = scenes.add_sheet(seams=(6,))
    bpy.ops.uv.koebe_parts(seams="only")
    put(obj, {0: (0.2, 0.2), 12: (0.2, 0.7), 156: (0.5, 0.2), 168: (0.5, 0.7)})
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}
    over = covered(obj, "Koebe", 300).max() > 1
    assert over == ("islands with pins lie over each other" in said()[0])
    assert over
    put(obj, {0: (0.2, 0.2), 12: (0.2, 0.3), 156: (0.9, 0.9), 168: (0.9, 0.8)})
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}
    assert covered(obj, "Koebe", 300).max() == 1 and said() == [""]


def test_pins_that_no_map_can_have_are_named_and_nothing_changes():
    obj = scenes.add_sheet()
    bpy.ops.uv.koebe_parts(seams="only")
    a, b, c, d = obj.data.polygons[40].vertices
    put(obj, {a: (0.2, 0.2), b: (0.2, 0.4), c: (0.4, 0.4), d: (0.4, 0.2)})  # the wrong way round
    before = scenes.corner_uv(obj.data, "Koebe")
    with pytest.raises(RuntimeError, match="pins turn faces over: unpin or move the UVs of vertices"):
        bpy.ops.uv.koebe_parts(seams="only")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    with pytest.raises(RuntimeError, match="pinned UVs cannot be kept on several tiles"):
        bpy.ops.uv.koebe_parts(tiles=2)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)


def test_two_pins_of_one_vertex_need_a_cut():
    obj = scenes.add_sheet(seams=(6,))
    bpy.ops.uv.koebe_parts(seams="only")
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    scenes.pin(obj.data, "Koebe", vertex == 80)
    assert bpy.ops.uv.koebe_parts(seams="only") == {"FINISHED"}  # a pin on each side of the seam
    obj.data.edges.foreach_set("use_seam", [False] * len(obj.data.edges))
    with pytest.raises(RuntimeError, match="vertex 80 is pinned at two places, and no cut parts them"):
        bpy.ops.uv.koebe_parts(seams="only")


def placed(count):
    """A mapped panel, and so many of its vertices pinned where they were after a turn, at half the size."""
    obj = scenes.add_panel()
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    uv, vertex = scenes.vertex_uv(obj), [3, 200, 400][:count]
    turned = 0.3 + 0.5 * (uv[vertex] - 0.5) @ np.array([[0.6, 0.8], [-0.8, 0.6]])
    return obj, put(obj, dict(zip(vertex, turned.tolist(), strict=True)))


@pytest.mark.parametrize("shape", ["DISK", ""])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("count", [1, 2])
def test_a_disk_moves_and_turns_to_two_pins_and_its_circles_stay(shape, mode, count):
    obj, pinned = placed(count)
    before = scenes.corner_uv(obj.data, "Koebe")
    scenes.edit_all(mode)
    call = bpy.ops.uv.koebe_unwrap if shape else bpy.ops.uv.koebe_uniformize
    assert call(checker=False, **({"shape": shape} if shape else {})) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(after[pinned], before[pinned]) and not np.array_equal(after, before)
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()
    for loop in scenes.boundary_loops(obj.data):
        _, radius, off = scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", loop))
        assert off < 1e-4 * radius


def test_a_disk_with_three_pins_offers_parts_and_nothing_changes():
    obj, _ = placed(3)
    before = scenes.corner_uv(obj.data, "Koebe")
    with pytest.raises(RuntimeError, match="3 UVs are pinned: vertices 3, 200, 400. With round holes two can be kept"):
        bpy.ops.uv.koebe_uniformize()
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    assert bpy.context.window_manager.koebe_uv.islands[0].offer == "parts"
    for options in ({"placement": "together"}, {"symmetry": "auto"}):
        with pytest.raises(RuntimeError, match="pinned UVs cannot be kept with Placement: Together"):
            bpy.ops.uv.koebe_uniformize(**options)


def test_disks_without_pins_go_beside_those_with_pins():
    obj = scenes.add_sheet(seams=(4, 8))
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    pinned = put(obj, {0: (0.3, 0.3), 12: (0.3, 0.7)})
    before = scenes.corner_uv(obj.data, "Koebe")
    assert bpy.ops.uv.koebe_uniformize(checker=False) == {"FINISHED"}
    after = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(after[pinned], before[pinned])
    assert covered(obj, "Koebe", 400).max() == 1
