"""Pack Only, and the edges of hard surfaces that are cut."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def scattered_cube():
    """A cube with six squares of sides 1 to 6 far away as its UVs, and a second layer."""
    obj = scenes.add_cube()
    for name in ("Old", "Other"):
        obj.data.uv_layers.new(name=name)
    square = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    values = np.concatenate([square * (k + 1) + 10 * k for k in range(6)])
    obj.data.uv_layers["Old"].data.foreach_set("uv", values.ravel())
    obj.data.uv_layers.active = obj.data.uv_layers["Old"]
    scenes.select(obj)
    return obj


def sides(obj):
    """The sides (6, 4) of the faces in the UVs."""
    uv = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2).astype(float)
    return np.linalg.norm(np.roll(uv, -1, axis=1) - uv, axis=2)


@pytest.mark.parametrize("average", [False, True])
def test_islands_of_the_active_layer_are_packed_and_keep_their_shapes(average):
    obj = scattered_cube()
    other = scenes.corner_uv(obj.data, "Other")
    assert bpy.ops.uv.koebe_pack(margin=4, pixels=512, average_scale=average) == {"FINISHED"}
    uv, lengths = scenes.corner_uv(obj.data, "Old"), sides(obj)
    assert uv.min() > 1 / 512 and uv.max() < 1 - 1 / 512
    wanted = np.ones(6) if average else np.arange(1, 7)
    assert np.ptp(lengths / wanted[:, None]) < 1e-5 and (lengths ** 2).sum() / 4 > 0.6
    assert np.array_equal(scenes.corner_uv(obj.data, "Other"), other) and obj.data.uv_layers.active.name == "Old"


def test_in_edit_mode_only_the_selected_faces_are_packed():
    obj = scattered_cube()
    before = scenes.corner_uv(obj.data, "Old")
    scenes.select_faces(obj, [1, 2])
    assert bpy.ops.uv.koebe_pack() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Old")
    moved = (after != before).any(axis=1).reshape(6, 4).any(axis=1)
    assert moved.tolist() == [False, True, True, False, False, False] and sides(obj)[2, 0] > 0.5


def test_an_object_without_uvs_is_told():
    scenes.select(scenes.add_cube())
    with pytest.raises(RuntimeError, match="nothing was packed. Cube: it has no UVs"):
        bpy.ops.uv.koebe_pack()


def test_hard_and_sharp_edges_are_cut():
    obj = scenes.add_cube()
    scenes.select(obj)
    parts = []
    for options in ({}, {"cut_hard": True}, {"cut_at": "sharp"}):
        for edge in obj.data.edges:  # round one face
            edge.use_edge_sharp = set(edge.vertices) <= set(obj.data.polygons[0].vertices)
        assert bpy.ops.uv.koebe_parts(checker=False, **options) == {"FINISHED"}
        parts.append(scenes.last_run().parts)
    assert parts == [1, 6, 2]
