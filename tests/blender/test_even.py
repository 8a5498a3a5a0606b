"""The dial Even: from maps that keep angles to maps that keep sizes, holes round or free."""

import json

import bpy
import numpy as np
import pytest
import scenes
from runs import operator
from tori import torus_arrays


def report():
    (entry,) = bpy.context.window_manager.koebe_uv.islands
    return entry


def density_spread(obj):
    """Texel density (a length over a length) at 95 % of the area over that at 5 %."""
    vertices, _ = scenes.triangles(obj.data)
    corners = scenes.read(obj.data.vertices, "co", np.float32, 3).astype(float)[vertices]
    area = 0.5 * np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    density = np.sqrt(np.abs(scenes.signed_areas(obj.data, "Koebe")) / area)
    order = np.argsort(density)
    share = np.cumsum(area[order]) / area.sum()
    return density[order][np.searchsorted(share, 0.95)] / density[order][np.searchsorted(share, 0.05)]


def add_tube():
    """A bent tube, wide at one end, with a hole in its side."""
    around, rings = 24, 16
    turn = 2.0 * np.pi * np.arange(around) / around
    points = [((0.5 + 0.1 * k) * np.cos(a), (0.5 + 0.1 * k) * np.sin(a), 0.3 * k) for k in range(rings) for a in turn]
    at = lambda k, i: k * around + i % around  # noqa: E731
    faces = [
        (at(k, i), at(k, i + 1), at(k + 1, i + 1), at(k + 1, i))
        for k in range(rings - 1) for i in range(around) if not (6 <= k < 9 and 3 <= i < 6)
    ]  # fmt: skip
    return scenes.add_object("Tube", points, faces)


MODELS = {
    "uniformize": lambda: scenes.add_panel(height=lambda x, y: 1.5 * np.exp(-3.0 * (x * x + y * y))),
    "ring": add_tube,
    "torus": lambda: scenes.add_object("Torus", *torus_arrays(24, 16)),
    "parts": lambda: scenes.add_panel(height=lambda x, y: 1.5 * np.exp(-3.0 * (x * x + y * y))),
}
OF_PARTS = {"keep_angles": False, "evenness": 0.0, "darts": 0.0}  # the same cuts at each place of the dial


@pytest.mark.alike
@pytest.mark.parametrize("kind", MODELS)
def test_a_higher_even_makes_texels_more_even_and_bends_angles(kind):
    obj = MODELS[kind]()
    scenes.select(obj)
    own = OF_PARTS if kind == "parts" else {}
    spread, errors = [], []
    for even in (0.0, 0.3, 1.0):
        assert operator(f"uv.koebe_{kind}")(even=even, **own) == {"FINISHED"}
        spread.append(density_spread(obj))
        errors.append(report().angle_error)
        assert report().even == pytest.approx(even) and report().flipped == 0
    assert spread[0] > 1.02 * spread[1] > 1.02**2 * spread[2] and errors[0] < errors[1] < errors[2]


@pytest.mark.alike
def test_the_circles_of_the_report_are_those_of_the_even_map_and_free_loops_have_none():
    obj = MODELS["uniformize"]()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(even=0.5)
    for loop in report().loops:
        points = scenes.loop_uv(obj.data, "Koebe", json.loads(loop.vertices))
        away = np.linalg.norm(points - np.array(loop.uv_center), axis=1)
        assert np.abs(away - loop.uv_radius).max() < scenes.CIRCLE_TOLERANCE
    bpy.ops.uv.koebe_uniformize(even=0.5, loops="free")
    assert [loop.uv_radius for loop in report().loops] == [0.0] * 4
    assert max(scenes.fit_circle(scenes.loop_uv(obj.data, "Koebe", json.loads(loop.vertices)))[2]
               for loop in report().loops) > 1e-3  # fmt: skip
    bpy.ops.uv.koebe_uniformize(loops="free")
    assert report().loops[1].uv_radius > 0.0, "a conformal map has circles"


@pytest.mark.alike
def test_parts_keep_their_angles_without_being_asked():
    obj = MODELS["parts"]()
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(evenness=0.0, keep_angles=False, even=0.0)
    conformal = report().angle_error
    bpy.ops.uv.koebe_parts(evenness=0.0, even=1.0)
    assert report().angle_error <= conformal + 1e-4 and report().even < 1.0


@pytest.mark.parametrize(
    "options", [{"symmetry": "auto"}, {"center": "cursor"}], ids=lambda options: next(iter(options))
)
def test_what_a_centre_and_symmetry_exclude_is_refused(options):
    obj = MODELS["uniformize"]()
    scenes.select(obj)
    with pytest.raises(RuntimeError, match="even: it does not work with"):
        bpy.ops.uv.koebe_uniformize(even=0.5, **options)
    assert not obj.data.uv_layers


def test_slits_are_refused():
    scenes.select(add_tube())
    with pytest.raises(RuntimeError, match="even: it does not work with slits.*set Holes to Circles"):
        bpy.ops.uv.koebe_ring(even=0.5, holes="radial")


@pytest.mark.alike
def test_an_unrolled_tube_stays_conformal_and_the_report_says_so():
    around = 24
    turn = 2.0 * np.pi * np.arange(around) / around
    points = [((1 + 0.2 * k) * np.cos(a), (1 + 0.2 * k) * np.sin(a), 0.2 * k) for k in range(8) for a in turn]
    faces = [(k * around + i, k * around + (i + 1) % around, (k + 1) * around + (i + 1) % around, (k + 1) * around + i)
             for k in range(7) for i in range(around)]  # fmt: skip
    scenes.select(scenes.add_object("Funnel", points, faces))
    bpy.ops.uv.koebe_uniformize(tube="unroll", even=0.5)
    assert report().even == 0.0 and "Unwrap to Cylinder" in report().note


def test_a_sequence_is_mapped_without_it():
    obj = MODELS["uniformize"]()
    obj.shape_key_add(name="Basis")
    obj.shape_key_add(name="Up").data[0].co.z += 0.1
    scenes.select(obj)
    bpy.context.scene.koebe_uv.even = 0.5
    assert bpy.ops.uv.koebe_sequence(source="SHAPE_KEYS") == {"FINISHED"}


def test_one_undo_step():
    import states

    states.new_file()
    scenes.select(MODELS["uniformize"]())
    bpy.ops.ed.undo_push(message="made")
    bpy.ops.uv.koebe_uniformize()
    bpy.ops.ed.undo_push(message="conformal")
    before = scenes.corner_uv(bpy.context.object.data, "Koebe")
    bpy.ops.uv.koebe_uniformize(even=0.5)
    bpy.ops.ed.undo_push(message="even")
    assert (scenes.corner_uv(bpy.context.object.data, "Koebe") != before).any()
    bpy.ops.ed.undo()
    assert (scenes.corner_uv(bpy.context.object.data, "Koebe") == before).all()
