"""Symmetry as an option of Koebe Unwrap to Disk."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike

HOLES = ((0.03, 0.20, 0.35, 0.65), (0.31, 0.49, 0.35, 0.65))  # left and right alike


def mask(name="Mask", height=lambda x, y: 0.4 * x * x + 0.2 * y):
    """A panel that is its own mirror image in the plane across x."""
    vertices, faces = scenes.panel_arrays(26, HOLES, height)
    return scenes.add_object(name, vertices, faces)


def entry():
    return bpy.context.window_manager.koebe_uv.islands[0]


def mirrored(obj):
    """Whether the UVs are their own mirror image about the vertical line u = 0.5, to the last bit."""
    uv = np.unique(scenes.corner_uv(obj.data, "Koebe"), axis=0)
    image = np.stack([np.float32(1.0) - uv[:, 0], uv[:, 1]], axis=1)
    return np.array_equal(uv, np.unique(image, axis=0))


def test_a_symmetric_surface_gets_exactly_symmetric_uvs():
    obj = mask()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    plain, error = scenes.corner_uv(obj.data, "Koebe").copy(), entry().angle_error
    assert not mirrored(obj)
    bpy.ops.uv.koebe_uniformize(checker=False, symmetry="auto")
    assert mirrored(obj) and "made symmetric" in entry().note and entry().flipped == 0
    assert entry().angle_error < 1.05 * error + 0.05
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - plain).max() < 0.05
    scenes.assert_circle_domain(obj, holes=2)
    for loop in entry().loops:
        vertices = np.array(eval(loop.vertices))
        points = scenes.loop_uv(obj.data, "Koebe", vertices.tolist())
        away = np.linalg.norm(points - np.array(loop.uv_center), axis=1)
        assert np.allclose(away, loop.uv_radius, atol=1e-6)


def test_what_is_not_symmetric_stays_and_it_is_said():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    plain = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.uv.koebe_uniformize(checker=False, symmetry="auto")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), plain)
    assert "not made symmetric: the mesh is not symmetric" in entry().note


def test_several_islands_and_tubes():
    one, other, panel = mask("One"), mask("Other"), scenes.add_panel("Panel")
    scenes.select(one, other, panel)
    assert bpy.ops.uv.koebe_uniformize(checker=False, symmetry="auto", placement="together") == {"FINISHED"}
    notes = [one.note for one in bpy.context.window_manager.koebe_uv.islands]
    assert ["not" in note for note in notes] == [False, False, True]
    for obj in (one, other):
        uv = np.unique(scenes.corner_uv(obj.data, "Koebe"), axis=0)
        middle = np.float32(0.5) * (uv[:, 0].min() + uv[:, 0].max())
        image = np.stack([np.float32(2.0) * middle - uv[:, 0], uv[:, 1]], axis=1)
        assert np.array_equal(uv, np.unique(image, axis=0))


def test_it_excludes_a_centre():
    obj = mask()
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="symmetry: it does not work with"):
        bpy.ops.uv.koebe_uniformize(symmetry="auto", center="cursor")


def test_the_operator_finds_nothing_left_to_do():
    obj = mask()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False, symmetry="auto")
    first = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.uv.koebe_symmetrize()
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - first).max() < 1e-6 and mirrored(obj)
