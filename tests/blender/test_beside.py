"""Selected faces fit in beside the others: at their texel density, in free room, never over them; or in place."""

import bpy
import numpy as np
import pytest
import scenes
from test_rendered_layer import covered

pytestmark = pytest.mark.alike

SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]])


def laid_out_cube(places):
    """A cube with faces of area 4, each a square (x, y, side) of the layer Koebe."""
    obj = scenes.add_cube()
    values = np.concatenate([np.array(place[:2]) + place[2] * SQUARE for place in places])
    obj.data.uv_layers.new(name="Koebe").data.foreach_set("uv", values.astype(np.float32).ravel())
    scenes.select(obj)
    return obj


def unwrapped(obj, faces, **options):
    """Unwrap these faces. The UVs (6, 4, 2) before and after."""
    before = scenes.corner_uv(obj.data, "Koebe").reshape(6, 4, 2)
    scenes.select_faces(obj, faces)
    assert bpy.ops.uv.koebe_unwrap(checker=False, **options) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    after = scenes.corner_uv(obj.data, "Koebe").reshape(6, 4, 2)
    others = [face for face in range(6) if face not in faces]
    assert np.array_equal(after[others], before[others])
    return before, after


def areas(obj):
    """Area of each face in the UVs."""
    return np.abs(scenes.signed_areas(obj.data, "Koebe")).reshape(6, 2).sum(axis=1)


def said():
    """What the report warns of, of all islands."""
    return [warning.text for entry in bpy.context.window_manager.koebe_uv.islands for warning in entry.warnings]


ROOMY = [(0.05 + 0.3 * (k % 3), 0.05 + 0.3 * (k // 3), 0.25) for k in range(6)]
TIGHT = [(0, 0, 0.5), (0.5, 0, 0.5), (0, 0.5, 0.5), (0, 0.5, 0.5), (0, 0.5, 0.5), (0, 0.5, 0.5)]
FULL = [(0, 0, 1)] * 6


@pytest.mark.parametrize("shape", ["DISK", "PARTS", "AUTO"])
def test_a_new_island_has_the_density_of_the_others_and_lies_over_none(shape):
    obj = laid_out_cube(ROOMY)
    _, after = unwrapped(obj, [1], shape=shape)
    assert areas(obj)[1] == pytest.approx(0.0625, rel=1e-3)
    assert after.min() > 0.0 and after.max() < 1.0 and covered(obj, "Koebe", 300).max() == 1
    assert said() == []


@pytest.mark.parametrize("shape", ["DISK", "PARTS"])
def test_less_room_makes_it_smaller_and_is_told(shape):
    obj = laid_out_cube(TIGHT)
    _, after = unwrapped(obj, [0, 4], shape=shape, margin=2.0)
    assert areas(obj)[[0, 4]].max() < 0.25 * 0.99
    assert after.min() >= 0.0 and after.max() <= 1.0 and covered(obj, "Koebe", 300)[160:].max() <= 1
    assert len(said()) == 1 and "free room beside the other islands takes the new ones at" in said()[0]


@pytest.mark.parametrize("shape", ["DISK", "PARTS"])
def test_without_room_it_lies_beside_the_square_and_is_told(shape):
    obj = laid_out_cube(FULL)
    _, after = unwrapped(obj, [2], shape=shape)
    assert after[2].min(axis=0)[0] >= 1.0 - 1e-6 and areas(obj)[2] == pytest.approx(1.0, rel=1e-3)
    assert said() == ["no room beside the islands of the other faces: the new ones lie to the right of the UV square"]


@pytest.mark.parametrize("shape", ["DISK", "PARTS", "AUTO"])
def test_in_place_keeps_position_size_and_turn(shape):
    obj = laid_out_cube(ROOMY)
    uv = scenes.corner_uv(obj.data, "Koebe").reshape(6, 4, 2)
    turn = np.array([[np.cos(0.5), -np.sin(0.5)], [np.sin(0.5), np.cos(0.5)]])
    uv[1] = 0.7 + 0.1 * (uv[1] - uv[1].mean(axis=0)) @ turn.T
    obj.data.uv_layers["Koebe"].data.foreach_set("uv", uv.ravel())
    before, after = unwrapped(obj, [1], shape=shape, placement="keep")
    assert np.allclose(after[1], before[1], atol=1e-5)


def test_a_density_of_ones_own_stays():
    obj = laid_out_cube(ROOMY)
    unwrapped(obj, [1], shape="PARTS", texels="number", density=128.0, pixels=1024)
    assert areas(obj)[1] == pytest.approx(0.0625, rel=1e-3)
    unwrapped(obj, [1], shape="PARTS", texels="number", density=64.0, pixels=1024)
    assert areas(obj)[1] == pytest.approx(0.0625 / 4, rel=1e-3)


def test_islands_that_lie_on_each_other_stay_so():
    obj = laid_out_cube([(0.25, 0.25, 0.5)] * 6)
    stack = covered(obj, "Koebe", 300)
    unwrapped(obj, [0, 1, 2], shape="PARTS", margin=0.0)
    now = covered(obj, "Koebe", 300)
    assert now[stack > 0].max() == 3 and now[stack == 0].max() == 1


@pytest.mark.parametrize("options", [{"tiles": 2}, {"stack": True}])
def test_what_cannot_fit_in_is_told(options):
    obj = laid_out_cube(ROOMY)
    unwrapped(obj, [1, 2], shape="PARTS", cut_hard=True, **options)
    assert any("it lies over the islands of the other faces" in text for text in said())


def test_objects_together_are_told():
    first, second = laid_out_cube(ROOMY), laid_out_cube(ROOMY)
    scenes.select(first, second)
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    for obj in (first, second):
        obj.data.polygons.foreach_set("select", [True, *[False] * 5])
    bpy.ops.object.mode_set(mode="EDIT")
    assert bpy.ops.uv.koebe_unwrap(checker=False, shape="DISK", placement="together") == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert said() == ["it lies over the islands of the other faces"] * 2


def test_a_layer_without_uvs_is_filled():
    obj = laid_out_cube([(0, 0, 0)] * 6)
    unwrapped(obj, [1], shape="PARTS")
    assert areas(obj)[1] > 0.9


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_faces_that_merge_distance_leaves_out_are_in_nobodys_way(mode):
    obj = scenes.add_object("Sliver", [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (1 + 1e-4, 0.5, 0.3), (1, 0.5, 0.3)],
                            [(0, 1, 2, 3), (1, 4, 5)])  # fmt: skip
    scenes.select(obj)
    for layer, distance in (("Own", 1e-3), ("Koebe", 0.0), ("Koebe", 1e-3)):
        if mode == "EDIT":
            scenes.select_faces(obj, [0, 1])
        options = {"layer": layer, "weld": distance, "seams": "only"}
        assert bpy.ops.uv.koebe_unwrap(checker=False, shape="PARTS", **options) == {"FINISHED"}
        bpy.ops.object.mode_set(mode="OBJECT")
    assert np.array_equal(*(scenes.corner_uv(obj.data, layer)[:4] for layer in ("Own", "Koebe")))
    assert np.ptp(scenes.corner_uv(obj.data, "Koebe")[4:]) > 0.0  # they have UVs, of the run between


@pytest.mark.parametrize("seed", range(12))
def test_random_selections_never_lie_over_the_others(seed):
    """Several times in a row, each on what the last left."""
    random = np.random.default_rng(seed)
    obj = scenes.add_panel(size=12)
    assert bpy.ops.uv.koebe_unwrap(checker=False, shape="DISK") == {"FINISHED"}
    faces = len(obj.data.polygons)
    for _ in range(3):
        before = scenes.corner_uv(obj.data, "Koebe")
        center = random.uniform(-1, 1, 2)
        place = scenes.read(obj.data.polygons, "center", np.float32, 3)[:, :2]
        chosen = np.flatnonzero(np.hypot(*(place - center).T) < random.uniform(0.4, 0.9))
        if not 0 < len(chosen) < faces:
            continue
        scenes.select_faces(obj, chosen)
        options = {"shape": str(random.choice(["DISK", "PARTS", "AUTO"])), "margin": float(random.choice([0, 4, 16]))}
        assert bpy.ops.uv.koebe_unwrap(checker=False, cut=True, pixels=512, **options) == {"FINISHED"}
        bpy.ops.object.mode_set(mode="OBJECT")
        after = scenes.corner_uv(obj.data, "Koebe")
        corners = np.concatenate([list(obj.data.polygons[face].loop_indices) for face in chosen])
        others = np.setdiff1d(np.arange(len(after)), corners)
        assert np.array_equal(after[others], before[others]) and np.isfinite(after).all()
        assert covered(obj, "Koebe", 400).max() == 1
