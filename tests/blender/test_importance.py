"""Importance: a vertex group that weighs the balance, and the sizes of faces."""

import bpy
import numpy as np
import pytest
import scenes


def weighed(obj, chosen, weight=1.0, name="Detail"):
    """Put vertices into a group."""
    group = obj.vertex_groups.new(name=name)
    group.add([int(v) for v in chosen], weight, "REPLACE")
    return group


def left_side(obj):
    return [v.index for v in obj.data.vertices if v.co.x < -0.5]


def mapped(obj, **options):
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(checker=False, outer="longest", upright=False, **options) == {"FINISHED"}
    return scenes.corner_uv(obj.data, "Koebe")


def area_of(obj, vertices):
    """Area in the UVs of the triangles whose vertices are all among these."""
    own, _ = scenes.triangles(obj.data)
    return np.abs(scenes.signed_areas(obj.data, "Koebe"))[np.isin(own, vertices).all(axis=1)].sum()


def test_the_region_gets_more_room_and_circles_stay():
    obj = scenes.add_panel()
    chosen = left_side(obj)
    mapped(obj)
    before = area_of(obj, chosen)
    weighed(obj, chosen)
    mapped(obj, importance="Detail")
    assert area_of(obj, chosen) > 1.5 * before
    scenes.assert_circle_domain(obj)


@pytest.mark.parametrize("weight", [0.0, 0.4, 1.0])
def test_equal_weights_change_no_bit(weight):
    obj = scenes.add_panel()
    plain = mapped(obj).copy()
    weighed(obj, range(len(obj.data.vertices)), weight)
    assert np.array_equal(mapped(obj, importance="Detail"), plain)


def test_in_edit_mode_the_weights_are_the_same():
    obj = scenes.add_panel()
    weighed(obj, left_side(obj))
    plain = mapped(obj, importance="Detail").copy()
    scenes.select_faces(obj)
    bpy.ops.uv.koebe_uniformize(checker=False, outer="longest", upright=False, importance="Detail")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), plain)


def test_an_important_object_is_larger_among_several():
    one, other = scenes.add_panel("One", size=12), scenes.add_panel("Other", size=12)
    weighed(one, range(len(one.data.vertices)))
    scenes.select(one, other)
    bpy.ops.uv.koebe_uniformize(checker=False, placement="together", importance="Detail")
    sizes = [np.ptp(scenes.corner_uv(obj.data, "Koebe"), axis=0).max() for obj in (one, other)]
    assert sizes[0] == pytest.approx(4.0 * sizes[1], rel=1e-3)


def test_a_group_that_nobody_has_is_refused():
    obj = scenes.add_panel()
    scenes.select(obj)
    state = scenes.mesh_state(obj.data)
    with pytest.raises(RuntimeError, match="no object has this group"):
        bpy.ops.uv.koebe_uniformize(importance="Nothing")
    weighed(obj, left_side(obj))
    with pytest.raises(RuntimeError, match="set Balance to Area"):
        bpy.ops.uv.koebe_uniformize(importance="Detail", balance="none")
    assert scenes.mesh_state(obj.data) == state


def test_with_a_centre_and_on_a_cut_surface_it_works():
    obj = scenes.add_cube()
    weighed(obj, [0, 1])
    scenes.select(obj)
    assert bpy.ops.uv.koebe_uniformize(checker=False, importance="Detail") == {"FINISHED"}
    panel = scenes.add_panel()
    weighed(panel, left_side(panel))
    assert bpy.ops.uv.koebe_uniformize(checker=False, importance="Detail", center="cursor") == {"FINISHED"}


@pytest.mark.parametrize("operator", ["uniformize", "parts", "ring"])
def test_even_maps_have_larger_faces_where_weights_are(operator):
    obj = scenes.add_panel()
    chosen = left_side(obj)
    weighed(obj, chosen)
    scenes.select(obj)
    even = {"uniformize": {"even": 0.5, "balance": "none"}, "ring": {"even": 0.5}, "parts": {}}[operator]
    shares = []
    for group in ("", "Detail"):
        run = getattr(bpy.ops.uv, f"koebe_{operator}")
        assert run(checker=False, importance=group, **even) == {"FINISHED"}
        everything = area_of(obj, range(len(obj.data.vertices)))
        shares.append(area_of(obj, chosen) / everything)
        assert np.sign(scenes.signed_areas(obj.data, "Koebe")).min() > 0
    assert shares[1] > 1.3 * shares[0]


def test_a_cylinder_needs_even():
    obj = scenes.add_panel()
    weighed(obj, left_side(obj))
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="set Even above 0"):
        bpy.ops.uv.koebe_ring(importance="Detail")
