"""The relax brush makes UVs more even under it, one to one, and leaves all others where they are."""

import bmesh
import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def squeezed(size=12, seams=()):
    """A sheet in Edit Mode whose UVs are squeezed to one side of each island, all faces selected."""
    obj = scenes.add_sheet(size, seams)
    assert bpy.ops.uv.koebe_parts(seams="only", checker=False) == {"FINISHED"}
    layer = obj.data.uv_layers["Koebe"]
    uv = scenes.corner_uv(obj.data, "Koebe").astype(np.float64)
    uv[:, 0] = uv[:, 0] ** 2
    layer.data.foreach_set("uv", uv.astype(np.float32).ravel())
    bpy.context.tool_settings.use_uv_select_sync = False  # from 5.0 on it is on at first
    edit()
    return obj


def edit():
    """Enter Edit Mode with all faces selected."""
    scenes.edit_all()


def uv_of(obj):
    """The UVs of all corners, whatever the mode."""
    obj.update_from_editmode()
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    bpy.ops.object.mode_set(mode="EDIT")
    return uv


def unevenness(obj, uv, corners):
    """The spread of the logarithm of the area in UVs (C, 2) over the area, of the quadrilaterals with these corners."""
    areas = np.array([face.area for face in obj.data.polygons])
    near = corners.reshape(-1, 4).any(axis=1)
    x, y = np.moveaxis(uv.reshape(-1, 4, 2).astype(np.float64), -1, 0)
    in_uv = 0.5 * ((x[:, 2] - x[:, 0]) * (y[:, 3] - y[:, 1]) - (x[:, 3] - x[:, 1]) * (y[:, 2] - y[:, 0]))
    return np.log(in_uv / areas)[near].std()


def test_a_dab_is_more_even_and_all_beside_it_stays():
    obj = squeezed()
    before = uv_of(obj)
    assert bpy.ops.uv.koebe_relax(center=(0.4, 0.5), radius=0.25) == {"FINISHED"}
    after = uv_of(obj)
    moved = (after != before).any(axis=1)
    assert moved.any() and (np.hypot(*(before[moved] - (0.4, 0.5)).T) < 0.25).all()
    assert unevenness(obj, after, moved) < 0.8 * unevenness(obj, before, moved)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()


def test_borders_pins_other_islands_and_hidden_faces_stay():
    obj = squeezed(12, (6,))
    bpy.ops.object.mode_set(mode="OBJECT")
    before = scenes.corner_uv(obj.data, "Koebe")
    vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
    pinned = vertex == 3 * 13 + 5
    scenes.pin(obj.data, "Koebe", pinned)
    for face in obj.data.polygons:
        face.hide = face.index % 12 > 8
    edit()
    place = before[vertex == 3 * 13 + 4].mean(axis=0)
    assert bpy.ops.uv.koebe_relax(center=place.tolist(), radius=2.0) == {"FINISHED"}
    after = uv_of(obj)
    moved = (after != before).any(axis=1)
    column, row = vertex // 13, vertex % 13
    assert set(np.unique(vertex[moved])) == {
        c * 13 + r for c in range(1, 6) for r in range(1, 9) if (c, r) != (3, 5)
    } and not moved[(column > 6) | (row > 8) | pinned].any()


def test_shape_keys_and_other_layers_stay():
    obj = squeezed()
    bpy.ops.object.mode_set(mode="OBJECT")
    obj.shape_key_add(name="Basis")
    key = obj.shape_key_add(name="Key")
    key.data[5].co.z += 1.0
    other = obj.data.uv_layers.new(name="Other")
    other.data.foreach_set("uv", np.full(2 * len(obj.data.loops), 0.25, np.float32))
    edit()
    assert bpy.ops.uv.koebe_relax(center=(0.4, 0.5), radius=0.25, layer="Koebe") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert obj.data.shape_keys.key_blocks["Key"].data[5].co.z == pytest.approx(key.data[5].co.z)
    assert (scenes.corner_uv(obj.data, "Other") == 0.25).all()


@pytest.mark.parametrize("prepare, center, words", [
    (lambda obj: None, (3.0, 3.0), "no island is there"),
    (lambda obj: bpy.ops.mesh.select_all(action="DESELECT"), (0.4, 0.5), "no island is there"),
    (lambda obj: bpy.ops.mesh.hide(), (0.4, 0.5), "no island is there"),
    (lambda obj: flip(obj), (0.4, 0.5), "turned over"),
    (lambda obj: obj.data.uv_layers.remove(obj.data.uv_layers[0]), (0.4, 0.5), "it has no UVs"),
])  # fmt: skip
def test_what_cannot_be_relaxed_is_told(prepare, center, words):
    obj = squeezed()
    prepare(obj)
    with pytest.raises(RuntimeError, match=words):
        bpy.ops.uv.koebe_relax(center=center, radius=0.2)


def flip(obj):
    """Mirror the UVs of the vertex in the middle over its neighbours."""
    edited = bmesh.from_edit_mesh(obj.data)
    layer = edited.loops.layers.uv.active
    near = [loop for face in edited.faces for loop in face.loops
            if np.hypot(*(np.array(loop[layer].uv) - (0.45, 0.55))) < 0.08]  # fmt: skip
    place = near[0][layer].uv.copy()
    for loop in near[0].vert.link_loops:
        loop[layer].uv = place + place.__class__((0.2, 0.0))


def test_it_is_refused_in_object_mode():
    squeezed()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert not bpy.ops.uv.koebe_relax.poll()


def test_of_several_objects_the_island_under_the_brush_is_relaxed():
    one = squeezed()
    bpy.ops.object.mode_set(mode="OBJECT")
    other = squeezed()
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(other.data, "Koebe") + np.float32([2, 0])
    other.data.uv_layers["Koebe"].data.foreach_set("uv", uv.ravel())
    scenes.select(one, other)
    edit()
    before = [uv_of(obj) for obj in (one, other)]
    bpy.ops.object.mode_set(mode="OBJECT")
    scenes.select(one, other)
    edit()
    assert bpy.ops.uv.koebe_relax(center=(2.4, 0.5), radius=0.25) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = [scenes.corner_uv(obj.data, "Koebe") for obj in (one, other)]
    assert (after[0] == before[0]).all() and (after[1] != before[1]).any()
