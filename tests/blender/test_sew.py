"""Sew joins islands along selected edges, one to one, where the larger island lay."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def cut_sheet(seams=(4,), seams_option="only"):
    """A sheet in islands, in Edit Mode, with the seams selected."""
    obj = scenes.add_sheet(12, seams)
    assert bpy.ops.uv.koebe_parts(seams=seams_option, checker=False) == {"FINISHED"}
    scenes.select_seams(obj)
    return obj


def corners_apart(obj):
    """How many edges have different UVs on their two sides."""
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    uv = scenes.corner_uv(obj.data, "Koebe")
    return sum(len(np.unique(uv[vertex == one], axis=0)) > 1 for one in np.unique(vertex))


def test_two_islands_become_one_where_the_larger_lay():
    obj = cut_sheet()
    bpy.ops.object.mode_set(mode="OBJECT")
    before = scenes.corner_uv(obj.data, "Koebe")
    assert corners_apart(obj) == 13
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.uv.koebe_sew() == {"FINISHED"}
    assert obj.mode == "EDIT"
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Koebe")
    assert corners_apart(obj) == 0
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()
    larger = np.repeat(np.arange(144) >= 48, 4)
    middle, size = (lambda uv: uv.mean(axis=0)), (lambda uv: np.sqrt(uv.var(axis=0).sum()))
    assert np.allclose(middle(after[larger]), middle(before[larger]), atol=1e-4)
    assert size(after[larger]) == pytest.approx(size(before[larger]), rel=1e-4)


def test_a_pin_stays_and_others_islands_too():
    obj = cut_sheet((4, 8))
    bpy.ops.object.mode_set(mode="OBJECT")
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    pinned = vertex == 168  # in the third island
    middle = vertex == 6 * 13 + 6
    scenes.pin(obj.data, "Koebe", pinned | middle)
    edges = obj.data.edges
    seams = [edge.use_seam and edge.vertices[0] // 13 == 4 for edge in edges]
    edges.foreach_set("use_seam", seams)  # the first cut alone is selected
    before = scenes.corner_uv(obj.data, "Koebe")
    scenes.select_seams(obj)
    assert bpy.ops.uv.koebe_sew() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Koebe")
    third = np.repeat(np.arange(144) >= 96, 4)
    assert np.array_equal(after[third], before[third])
    assert np.array_equal(after[middle], before[middle]) and corners_apart(obj) == 13


def test_what_cannot_be_sewn_is_told_and_stays():
    obj = scenes.add_cube()
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(checker=False)
    bpy.ops.object.mode_set(mode="OBJECT")
    before = scenes.corner_uv(obj.data, "Koebe")
    scenes.edit_all()
    with pytest.raises(RuntimeError, match="the sewn island cannot lie flat in one piece"):
        bpy.ops.uv.koebe_sew()
    bpy.ops.mesh.select_all(action="DESELECT")
    with pytest.raises(RuntimeError, match="nothing was sewn. select the edges to sew"):
        bpy.ops.uv.koebe_sew()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    assert not bpy.ops.uv.koebe_sew.poll()
