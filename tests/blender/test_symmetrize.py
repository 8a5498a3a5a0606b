"""Maps of mirror-symmetric surfaces made exactly symmetric."""

from pathlib import Path

import bpy
import fingerprint
import numpy as np
import pytest
import runs
import scenes
import states
from test_moebius import assert_report_is_true, report, uv_of

pytestmark = pytest.mark.alike


def by_place(obj):
    """Positions (C, 3) and UVs (C, 2) of the corners."""
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    return scenes.read(obj.data.vertices, "co", np.float32, 3)[vertex], uv_of(obj).astype(np.float64)


def assert_symmetric(obj):
    """Whether the corners on either side of x = 0 have UVs on either side of u = 0.5, to the last bit."""
    place, uv = by_place(obj)
    known = {tuple(np.round(p, 3)): tuple(w) for p, w in zip(place.tolist(), uv.tolist())}
    for (x, y, z), (u, v) in known.items():
        assert known[(-x if x else x, y, z)] == (1.0 - u, v)


def test_a_symmetric_panel_gets_symmetric_uvs():
    obj = runs.even()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    with pytest.raises((AssertionError, KeyError)):
        assert_symmetric(obj)
    assert bpy.ops.uv.koebe_symmetrize() == {"FINISHED"}
    assert_symmetric(obj)
    scenes.assert_circle_domain(obj)
    assert_report_is_true(obj)
    assert report().moved == "made symmetric" and report().flipped == 0


def test_in_edit_mode_with_one_object_that_is_not_symmetric():
    runs.symmetric_in_edit_mode()
    other = bpy.data.objects["Layered"]
    before = uv_of(other)
    assert bpy.ops.uv.koebe_symmetrize() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    assert np.array_equal(uv_of(other), before)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert_symmetric(bpy.data.objects["Even"])


def test_what_is_not_symmetric_stays_and_the_reason_is_said():
    scenes.select(states.plain())
    bpy.ops.uv.koebe_uniformize(checker=False)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match="nothing was made symmetric. Plain: the mesh is not symmetric"):
        bpy.ops.uv.koebe_symmetrize()
    assert fingerprint.differences(before, fingerprint.fingerprint()) == []


def test_suzanne_and_the_samples():
    """Of the samples the mask is symmetric."""
    path = Path(__file__).resolve().parents[2] / "blend_samples" / "suzanne_mask.blend"
    bpy.ops.wm.open_mainfile(filepath=str(path))
    obj = next(one for one in bpy.data.objects if one.type == "MESH")
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    angle = report().angle_error
    assert bpy.ops.uv.koebe_symmetrize() == {"FINISHED"}
    assert report().flipped == 0 and report().angle_error <= angle + 0.02
