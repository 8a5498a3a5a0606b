"""Distortion as a colour attribute: what it says, and that it comes off without a trace."""

import bpy
import fingerprint
import numpy as np
import pytest
import scenes

NAME = "Koebe Distortion"


def add_grid(map_uv):
    """A flat grid of 4 by 4 unit squares whose UV layer "Koebe" is `map_uv` of the corners (x, y)."""
    vertices = [(x, y, 0) for y in range(5) for x in range(5)]
    faces = [(i + 5 * j, i + 1 + 5 * j, i + 6 + 5 * j, i + 5 + 5 * j) for j in range(4) for i in range(4)]
    obj = scenes.add_object("Grid", vertices, faces)
    scenes.select(obj)
    points = np.array(vertices, float)[scenes.read(obj.data.loops, "vertex_index", np.int32), :2]
    uv = np.array([map_uv(*point) for point in points], np.float32)
    obj.data.uv_layers.new(name="Koebe").data.foreach_set("uv", uv.ravel())
    return obj


def values(obj, addon, kind):
    """Distortion of each face."""
    surface = addon("blender.mesh_reading").read_surface(obj, False)
    return addon("layers.distortion").face_values(surface, scenes.corner_uv(obj.data, "Koebe"), kind)


def test_a_similarity_has_none(addon):
    obj = add_grid(lambda x, y: (0.1 * x - 0.2 * y + 3, 0.2 * x + 0.1 * y))
    assert values(obj, addon, "angle") == pytest.approx(0, abs=1e-3)
    assert values(obj, addon, "area") == pytest.approx(0, abs=1e-5)


def test_a_stretch_has_the_angle_of_its_diagonal(addon):
    """Squares become rectangles of 1 to 2: angles of 45 degrees become atan 2 and atan 1/2, right ones stay."""
    obj = add_grid(lambda x, y: (0.1 * x, 0.2 * y))
    expected = 2 * (np.degrees(np.arctan(2)) - 45) / 3
    assert values(obj, addon, "angle") == pytest.approx(expected, abs=1e-3)
    assert values(obj, addon, "area") == pytest.approx(0, abs=1e-5)


def test_area_counts_doublings_of_the_texel_density(addon):
    """Columns of density 1 and 4 in one direction: 1 and 2 in the mean of both, 0.5 doublings to each side."""
    obj = add_grid(lambda x, y: (x if x <= 2 else 2 + 4 * (x - 2), y))
    found = values(obj, addon, "area").reshape(4, 4)
    assert found[:, 3] - found[:, 0] == pytest.approx(1.0, abs=1e-6)
    assert np.sum(2 ** (2 * found)) == pytest.approx(16)  # their mean is that of the whole


def test_faces_without_uvs_are_told_apart(addon):
    obj = add_grid(lambda x, y: (max(x, 1), y))
    assert np.isnan(values(obj, addon, "angle")).tolist() == [i % 4 == 0 for i in range(16)]
    assert addon("layers.distortion_colors").colors(np.array([np.nan]), "angle")[0] == pytest.approx((0.35, 0.35, 0.35))


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("own", [False, True])
def test_on_and_off_leaves_no_trace(mode, own):
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(checker=False)
    mesh = obj.data
    if own:
        for name in ("First", "Second"):
            mesh.color_attributes.new(name, "FLOAT_COLOR", "POINT")
        mesh.color_attributes.active_color = mesh.color_attributes["First"]
    scenes.select_faces(obj)
    bpy.ops.object.mode_set(mode="OBJECT")
    before = scenes.mesh_state(mesh), [a.name for a in mesh.attributes], list(mesh.keys())
    bpy.ops.object.mode_set(mode=mode)
    for kind in ("angle", "area"):
        assert bpy.ops.uv.koebe_distortion(kind=kind) == {"FINISHED"}
        assert mesh.color_attributes.active_color.name == NAME
    bpy.ops.uv.koebe_distortion(kind="none")
    assert bpy.context.mode == ("OBJECT" if mode == "OBJECT" else "EDIT_MESH")
    bpy.ops.object.mode_set(mode="OBJECT")
    assert (scenes.mesh_state(mesh), [a.name for a in mesh.attributes], list(mesh.keys())) == before
    assert not own or mesh.color_attributes.active_color.name == "First"


def test_a_new_map_has_new_colours():
    obj = add_grid(lambda x, y: (0.1 * x, 0.2 * y))
    bpy.ops.uv.koebe_distortion(kind="angle")
    read = lambda: scenes.read(obj.data.color_attributes[NAME].data, "color", np.float32, 4).copy()  # noqa: E731
    before = read()
    bpy.ops.uv.koebe_uniformize()
    assert np.abs(read() - before).max() > 0.1


def taken_by_an_attribute(obj):
    obj.data.attributes.new(NAME, "FLOAT", "FACE")


def taken_by_a_vertex_group(obj):
    obj.vertex_groups.new(name=NAME)


def taken_by_a_uv_layer(obj):
    obj.data.uv_layers.new(name=NAME)


@pytest.mark.parametrize("take", [taken_by_an_attribute, taken_by_a_vertex_group, taken_by_a_uv_layer])
@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_a_name_that_is_taken_breaks_nothing(take, mode):
    """The colours get another name, run after run, and what has the name keeps it."""
    obj = add_grid(lambda x, y: (x, y))
    take(obj)
    bpy.ops.object.mode_set(mode=mode)
    before = fingerprint.fingerprint()
    for kind in ("angle", "area", "angle"):
        assert bpy.ops.uv.koebe_distortion(kind=kind) == {"FINISHED"}
        assert obj.data.color_attributes.active_color.name.startswith(NAME + ".")
        assert len(obj.data.color_attributes) == 1
    bpy.ops.uv.koebe_uniformize(checker=False, layer="Koebe")
    assert bpy.ops.uv.koebe_distortion(kind="none") == {"FINISHED"}
    after = fingerprint.fingerprint()
    changed = fingerprint.differences(before, after)
    allowed = ("Koebe", "report", ".uv_select")  # from 5.0 on a mesh has one UV selection for all its layers
    assert all(any(word in name for word in allowed) for name in changed), changed


def test_one_without_the_layer_is_left_out_and_the_other_coloured():
    good, bad = add_grid(lambda x, y: (x, y)), scenes.add_panel()
    scenes.select(bad)
    with pytest.raises(RuntimeError, match="Panel: it has no UV layer"):
        bpy.ops.uv.koebe_distortion()
    scenes.select(good, bad)
    assert bpy.ops.uv.koebe_distortion() == {"FINISHED"}
    assert NAME in good.data.attributes and len(bad.data.color_attributes) == 0 and not bad.data.keys()
