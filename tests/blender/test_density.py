"""Texel density of parts: by number, like another layer, and what does not fit."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def density(obj, layer="Koebe"):
    """Sides of the UV square per unit of length, in the mean."""
    in_plane = np.abs(scenes.signed_areas(obj.data, layer)).sum()
    return np.sqrt(in_plane / scenes.read(obj.data.polygons, "area", np.float32).sum())


def test_by_number_and_by_texture_size():
    obj = scenes.add_panel()
    scenes.select(obj)
    run = {"checker": False, "texels": "number", "density": 64.0, "darts": 0.0}
    assert bpy.ops.uv.koebe_parts(pixels=1024, **run) == {"FINISHED"}
    assert density(obj) == pytest.approx(64.0 / 1024, rel=0.05)  # the median is not the mean
    first = density(obj)
    assert bpy.ops.uv.koebe_parts(pixels=2048, **run) == {"FINISHED"}
    assert density(obj) == pytest.approx(0.5 * first, rel=1e-3)


def test_like_another_layer():
    small, large = scenes.add_panel("Small", size=12), scenes.add_panel("Large", size=12)
    for obj, side in ((small, 0.3), (large, 0.2)):
        layer = obj.data.uv_layers.new(name="Old")
        uv = np.array([obj.data.vertices[corner.vertex_index].co[:2] for corner in obj.data.loops], np.float32)
        layer.data.foreach_set("uv", (side * uv / np.abs(uv).max()).ravel())
        scenes.select(obj)
        assert bpy.ops.uv.koebe_parts(checker=False, texels="layer", like="Old", darts=0.0) == {"FINISHED"}
        assert density(obj) == pytest.approx(density(obj, "Old"), rel=0.05)


def test_what_does_not_fit_is_said_and_nothing_is_written():
    obj = scenes.add_panel()
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="does not fit into the square: at most"):
        bpy.ops.uv.koebe_parts(checker=False, texels="number", density=1e5)
    assert not obj.data.uv_layers
    with pytest.raises(RuntimeError, match="it has no UVs whose density the parts could get"):
        bpy.ops.uv.koebe_parts(checker=False, texels="layer")
    with pytest.raises(RuntimeError, match="it has no UV layer 'None' whose density"):
        bpy.ops.uv.koebe_parts(checker=False, texels="layer", like="None")
    assert not obj.data.uv_layers
