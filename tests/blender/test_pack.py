"""Pack Only, and the edges of hard surfaces that are cut."""

import bpy
import numpy as np
import pytest
import scenes
from test_rendered_layer import covered

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


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("atlas", [False, True])
def test_several_objects_get_a_square_each_or_all_together(mode, atlas):
    objects = [scenes.add_sheet(), scenes.add_sheet(6)]
    objects[1].scale = (2, 2, 2)
    for obj in objects:
        obj.data.uv_layers.new(name="Old")
    for obj in objects:
        scenes.select(obj)
        bpy.ops.uv.koebe_parts(layer="Old", checker=False)
    scenes.select(*objects)
    bpy.ops.object.mode_set(mode=mode)
    if mode == "EDIT":
        bpy.ops.mesh.select_all(action="SELECT")
    assert bpy.ops.uv.koebe_pack(atlas=atlas, average_scale=True, margin=4, pixels=512) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    times = sum(covered(obj, "Old", 400) for obj in objects)
    assert times.max() == (1 if atlas else 2)
    areas = [np.abs(scenes.signed_areas(obj.data, "Old")).sum() for obj in objects]
    assert areas[1] / areas[0] == pytest.approx(4.0 if atlas else 1.0, rel=0.1)  # one density, as the world sees them
    uv = np.concatenate([scenes.corner_uv(obj.data, "Old") for obj in objects])
    assert uv.min() > 0 and uv.max() < 1


def test_an_object_without_uvs_is_told():
    scenes.select(scenes.add_cube())
    with pytest.raises(RuntimeError, match="nothing was packed. Cube: it has no UVs"):
        bpy.ops.uv.koebe_pack()


def test_hard_edges_are_cut():
    obj = scenes.add_cube()
    scenes.select(obj)
    parts = []
    for cut_hard in (False, True):
        assert bpy.ops.uv.koebe_parts(checker=False, cut_hard=cut_hard) == {"FINISHED"}
        parts.append(scenes.last_run().parts)
    assert parts == [2, 6]


@pytest.mark.parametrize("word, expected", [("sharp", 2), ("materials", 2), ("normals", 2), ("all", 2), ("nothing", 1)])
def test_the_mesh_cuts_where_it_parts_its_faces(word, expected):
    """A cube whose first face is sharp all round, or has a material or normals of its own."""
    obj = scenes.add_cube()
    mesh = obj.data
    if word == "normals":
        up = np.zeros((len(mesh.loops), 3), np.float32)
        up[:, 2] = 1
        up[list(mesh.polygons[0].loop_indices)] = (1, 0, 0)
        mesh.polygons.foreach_set("use_smooth", [True] * 6)
        if hasattr(mesh, "use_auto_smooth"):
            mesh.use_auto_smooth = True
        mesh.normals_split_custom_set([tuple(one) for one in up.tolist()])
    elif word in ("materials", "all", "nothing"):
        for name in "AB":
            mesh.materials.append(bpy.data.materials.new(name))
        mesh.polygons[0].material_index = 1
    else:
        for edge in mesh.edges:
            edge.use_edge_sharp = set(edge.vertices) <= set(mesh.polygons[0].vertices)
    scenes.select(obj)
    assert bpy.ops.uv.koebe_parts(checker=False, cut_at=word) == {"FINISHED"}
    assert scenes.last_run().parts >= expected
    faces = [{tuple(corner) for corner in face} for face in scenes.corner_uv(mesh, "Koebe").reshape(6, 4, 2).tolist()]
    assert faces[0].isdisjoint(set.union(*faces[1:])) is (expected == 2)


@pytest.mark.parametrize("keep", ["PINNED", "OTHERS", "BOTH"])
def test_islands_keep_their_places(keep):
    obj = scattered_cube()
    layer = obj.data.uv_layers["Old"]
    uv = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2)
    uv[0] = np.array([[0, 0], [0.5, 0], [0.5, 0.5], [0, 0.5]])
    uv[1:] = uv[0] / 4 + 5 * np.arange(1, 6)[:, None, None]
    layer.data.foreach_set("uv", uv.ravel())
    if keep != "OTHERS":
        scenes.pin(obj.data, "Old", [True] * 4 + [False] * 20)
    chosen = [0, 1, 2, 3, 4, 5] if keep == "PINNED" else [1, 2] if keep == "OTHERS" else [0, 1, 2]
    scenes.select_faces(obj, chosen)
    assert bpy.ops.uv.koebe_pack(keep_places=keep, margin=4, pixels=512, seconds=0.2) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2)
    moved = (after != uv).any(axis=(1, 2))
    assert moved.tolist() == [False, True, True, *([True] * 3 if keep == "PINNED" else [False] * 3)]
    assert np.allclose(sides(obj)[moved], 0.125, atol=1e-5)  # there is room at their size
    inside = after[moved].reshape(-1, 2)
    assert inside.min() > 0 and inside.max() < 1 and (inside.max(axis=1) > 0.5).all()


def test_locked_islands_that_leave_no_room_are_told():
    obj = scattered_cube()
    uv = scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2)
    uv[0] = np.array([[-1, -1], [2, -1], [2, 2], [-1, 2]])
    obj.data.uv_layers["Old"].data.foreach_set("uv", uv.ravel())
    scenes.select_faces(obj, [1])
    with pytest.raises(RuntimeError, match="Cube: the islands that keep their place leave no room"):
        bpy.ops.uv.koebe_pack(keep_places="OTHERS")
