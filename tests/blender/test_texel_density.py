"""The texel density of a layer: measured, set island by island, and copied from another object."""

import bpy
import numpy as np
import pytest
import scenes
from test_pack import scattered_cube, sides

pytestmark = pytest.mark.alike


def measured():
    """The last measurement."""
    return bpy.context.window_manager.koebe_density


def middles(obj):
    """The middle (6, 2) of each face's UVs."""
    return scenes.corner_uv(obj.data, "Old").reshape(6, 4, 2).mean(axis=1)


def test_measured_of_all_of_the_selection_and_of_islands():
    """Faces of 2 x 2 units with squares of sides 1 to 6: 0.5 to 3 sides per unit."""
    obj = scattered_cube()
    assert bpy.ops.uv.koebe_measure_density() == {"FINISHED"}
    found = measured()
    assert (found.object_name, found.layer, found.islands, found.chosen) == ("Cube", "Old", 6, 0.0)
    assert found.whole == pytest.approx(np.sqrt(sum(k * k for k in range(1, 7)) / 24))
    assert (found.least, found.most) == pytest.approx((0.5, 3.0))
    scenes.select_faces(obj, [1])
    assert bpy.ops.uv.koebe_measure_density(take=True) == {"FINISHED"}
    assert measured().chosen == pytest.approx(1.0) and bpy.context.scene.koebe_uv.density == pytest.approx(2048.0)


@pytest.mark.parametrize("system, scale, expected", [
    ("METRIC", 1.0, "512 px/m"), ("METRIC", 0.01, "5.12e+04 px/m, 512 per unit"),
    ("IMPERIAL", 1.0, "156.1 px/ft, 512 per unit"), ("NONE", 1.0, "512 px/unit"),
])  # fmt: skip
def test_told_in_the_units_of_the_scene(addon, system, scale, expected):
    units = bpy.context.scene.unit_settings
    units.system, units.scale_length = system, scale
    bpy.context.scene.koebe_uv.pixels = 1024
    assert addon("state.density_report").density_words(bpy.context, 0.5) == expected


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_each_island_gets_the_density_about_its_middle_and_pins_stay(mode):
    obj = scattered_cube()
    obj.scale = (2.0, 2.0, 2.0)  # faces of 4 x 4 units
    scenes.pin(obj.data, "Old", [True] * 4 + [False] * 20)
    before, lengths = middles(obj), sides(obj)
    if mode == "EDIT":
        scenes.select_faces(obj, [0, 2, 3])
    assert bpy.ops.uv.koebe_set_density(density=256.0, pixels=1024) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    scaled = [False, True, True, True, True, True] if mode == "OBJECT" else [False, False, True, True, False, False]
    expected = np.where(scaled, 1.0, lengths[:, 0])  # 256 pixels of 1024 per unit, four units
    assert np.allclose(sides(obj), expected[:, None], atol=2e-5) and np.allclose(middles(obj), before, atol=1e-5)


def test_copied_from_the_active_object():
    source = scenes.add_cube("Source")
    layer = source.data.uv_layers.new(name="Old")
    layer.data.foreach_set("uv", np.tile([0, 0, 0.5, 0, 0.5, 0.5, 0, 0.5], 6).astype(np.float32))
    obj, bare = scattered_cube(), scenes.add_cube("Bare")
    scenes.select(source, obj)
    assert bpy.ops.uv.koebe_copy_density() == {"FINISHED"}
    assert np.allclose(sides(obj), 0.5, atol=1e-5)
    assert np.array_equal(scenes.corner_uv(source.data, "Old").max(axis=0), [0.5, 0.5])
    scenes.select(source, bare)
    with pytest.raises(RuntimeError, match="no density was set. Bare: it has no UVs"):
        bpy.ops.uv.koebe_copy_density()
    scenes.select(bare, obj)
    with pytest.raises(RuntimeError, match="no density was set. Bare: it has no UVs"):
        bpy.ops.uv.koebe_copy_density()


def test_islands_that_have_no_density_are_told():
    obj = scattered_cube()
    uv = scenes.corner_uv(obj.data, "Old")
    uv[:4], uv[4:8] = 0.25, np.nan
    obj.data.uv_layers["Old"].data.foreach_set("uv", uv.ravel())
    assert bpy.ops.uv.koebe_set_density(density=64.0, pixels=128) == {"FINISHED"}
    assert np.allclose(sides(obj)[2:], 1.0, atol=1e-5) and sides(obj)[0].max() == 0.0
    obj.data.uv_layers["Old"].data.foreach_set("uv", np.zeros(48, np.float32))
    with pytest.raises(RuntimeError, match="no density was set. Cube: . islands? without area"):
        bpy.ops.uv.koebe_set_density()


def test_packed_onto_tiles():
    obj = scattered_cube()
    assert bpy.ops.uv.koebe_pack(tiles=6, average_scale=True, margin=4, pixels=512) == {"FINISHED"}
    assert len(np.unique(np.floor(middles(obj)), axis=0)) == 6
