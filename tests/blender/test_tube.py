"""Tubes as annuli and unrolled: a conformal rectangle with a wrap seam in the UVs only."""

from pathlib import Path

import bpy
import numpy as np
import pytest
import scenes

SAMPLES = Path(__file__).resolve().parents[2] / "blend_samples"
AROUND = 32


def add_tube(name="Tube", rings=24, height=3.0, radius=lambda z: 1.0, tilt=0.0):
    """A tube of quads around Z, its vertices ring by ring; `tilt` shears the rings along it."""
    turn = 2 * np.pi * np.arange(AROUND) / AROUND
    vertices = []
    for z in np.linspace(0, height, rings + 1):
        vertices += [(radius(z) * np.sin(a), radius(z) * np.cos(a), z + tilt * np.sin(a)) for a in turn]
    at = lambda i, j: j * AROUND + i % AROUND  # noqa: E731
    faces = [(at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)) for j in range(rings) for i in range(AROUND)]
    obj = scenes.add_object(name, vertices, faces)
    scenes.select(obj)
    return obj


def uvs_of_vertices(obj):
    """The different UVs of each vertex."""
    vertex, uv = scenes.read(obj.data.loops, "vertex_index", np.int32), scenes.corner_uv(obj.data, "Koebe")
    return [np.unique(uv[vertex == v], axis=0) for v in range(len(obj.data.vertices))]


@pytest.mark.alike
def test_a_cylinder_unrolls_to_its_own_rectangle():
    """Around 2π to 3: the longer side fills the square, up is up, rings are level."""
    obj = add_tube()
    assert bpy.ops.uv.koebe_uniformize(tube="unroll") == {"FINISHED"}
    uv = scenes.corner_uv(obj.data, "Koebe")
    width, height = np.ptp(uv, axis=0)
    assert width == pytest.approx(1.0, abs=1e-6) and height == pytest.approx(3 / (2 * np.pi), rel=5e-3)
    assert uv.min() >= 0 and uv.max() <= 1
    for v, found in enumerate(uvs_of_vertices(obj)):
        assert found[:, 1] == pytest.approx(0.5 + height * (obj.data.vertices[v].co.z / 3 - 0.5), abs=2e-3)
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()


@pytest.mark.alike
def test_a_long_tube_is_warned_of_as_a_ring_and_not_as_a_rectangle():
    """A ring ends at e^-40, far below what 32 bits tell."""
    add_tube(radius=lambda z: 0.075, rings=200)
    for tube, warned in (("annulus", True), ("unroll", False)):
        bpy.ops.uv.koebe_uniformize(tube=tube)
        (entry,) = bpy.context.window_manager.koebe_uv.islands
        assert ("resolution" in entry.message) == (entry.flipped > 0) == warned


@pytest.mark.alike
@pytest.mark.parametrize("balance", ["none", "area"])
def test_the_cut_is_one_path_and_its_sides_are_a_turn_apart(balance):
    obj = add_tube(radius=lambda z: 1 + 0.4 * np.sin(2 * z), tilt=0.3)
    bpy.ops.uv.koebe_uniformize(tube="unroll", balance=balance)
    uvs = uvs_of_vertices(obj)
    assert (scenes.signed_areas(obj.data, "Koebe") > 0).all()
    cut = {v for v, found in enumerate(uvs) if len(found) == 2}
    assert max(len(found) for found in uvs) == 2 and len(cut) >= 25
    ends = [v for v in cut if v < AROUND or v >= 24 * AROUND]
    assert len(ends) == 2 and all(obj.data.vertices[v].co.y > 0.5 for v in ends if v < AROUND)
    gaps = np.array([uvs[v][1] - uvs[v][0] for v in cut])
    assert np.abs(gaps - gaps[0]).max() < 1e-6 and abs(gaps[0][1]) < 1e-6
    along = sum(1 for edge in obj.data.edges if set(edge.vertices) <= cut)
    assert along == len(cut) - 1  # a path
    assert not any(edge.use_seam for edge in obj.data.edges)


@pytest.mark.alike
def test_borders_are_straight_and_level():
    obj = add_tube(radius=lambda z: 1 + 0.4 * np.sin(2 * z), tilt=0.3)
    bpy.ops.uv.koebe_uniformize(tube="unroll")
    uvs = uvs_of_vertices(obj)
    for border in (range(AROUND), range(24 * AROUND, 25 * AROUND)):
        assert np.ptp(np.concatenate([uvs[v] for v in border])[:, 1]) < 1e-6


@pytest.mark.alike
def test_the_angle_error_stays():
    add_tube(rings=60, height=4, radius=lambda z: 1 + 0.3 * np.sin(2 * z))
    bpy.ops.uv.koebe_uniformize()
    (ring,) = bpy.context.window_manager.koebe_uv.islands
    before = ring.angle_error
    bpy.ops.uv.koebe_uniformize(tube="unroll")
    (sheet,) = bpy.context.window_manager.koebe_uv.islands
    assert 0 < sheet.angle_error < 1.2 * before


@pytest.mark.alike
def test_a_long_tube_keeps_its_texels():
    """exp(-2π·4) of the rim would be left of the inner circle of an annulus."""
    obj = add_tube(rings=200, height=8 * np.pi)
    bpy.ops.uv.koebe_uniformize(tube="unroll")
    areas = scenes.signed_areas(obj.data, "Koebe")
    assert areas.min() > 0 and areas.max() < 1.1 * areas.min()


@pytest.mark.alike
@pytest.mark.parametrize("shape", ["DISK", "RING"])
def test_a_tube_of_a_hundred_girths_has_no_flips(shape):
    obj = add_tube(rings=400, height=200 * np.pi)
    operator = bpy.ops.uv.koebe_uniformize if shape == "DISK" else bpy.ops.uv.koebe_ring
    assert operator(**({"tube": "unroll"} if shape == "DISK" else {})) == {"FINISHED"}
    areas = scenes.signed_areas(obj.data, "Koebe")
    assert areas.min() > 0 and areas.max() < 1.1 * areas.min()


@pytest.mark.alike
def test_other_islands_are_disks_all_the_same():
    obj = scenes.add_panel()
    bpy.ops.uv.koebe_uniformize(tube="unroll")
    scenes.assert_circle_domain(obj)


def test_selected_faces_unroll_and_the_others_stay():
    obj = add_tube()
    obj.data.uv_layers.new(name="Koebe", do_init=False)
    scenes.select_faces(obj, range(8 * AROUND))
    bpy.ops.uv.koebe_uniformize(tube="unroll")
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.ptp(uv[: 4 * 8 * AROUND], axis=0) == pytest.approx([1.0, 1 / (2 * np.pi)], rel=2e-2)
    assert not uv[4 * 8 * AROUND :].any()



# ---------------------------------------------------------------- ears and chords


def add_tube_with_ear(triangles):
    """A tube whose upper rim carries an ear of that many triangles, at its very back."""
    obj = add_tube()
    vertices = [tuple(v.co) for v in obj.data.vertices]
    faces = [tuple(p.vertices) for p in obj.data.polygons]
    rim = 24 * AROUND  # its first vertex is the rearmost one
    chord = (rim, rim + AROUND - 1)
    for number in range(triangles):
        vertices.append((0.05 * number, 1.5 + number, 3.2))
        faces.append((*chord, len(vertices) - 1))
        chord = (chord[0], len(vertices) - 1)
    bpy.data.objects.remove(obj)
    obj = scenes.add_object("Eared", vertices, faces)
    scenes.select(obj)
    return obj


@pytest.mark.alike
@pytest.mark.parametrize("triangles", [1, 2, 3])
def test_an_ear_on_the_rim_is_no_end_for_the_cut(triangles):
    obj, healthy = add_tube_with_ear(triangles), scenes.add_panel("Healthy")
    scenes.select(obj, healthy)
    assert bpy.ops.uv.koebe_uniformize(tube="unroll") == {"FINISHED"}
    scenes.assert_circle_domain(healthy)
    told = {entry.object_name: entry for entry in bpy.context.window_manager.koebe_uv.islands}
    assert told["Eared"].mapped, told["Eared"].message
    uvs = uvs_of_vertices(obj)
    cut = [v for v, found in enumerate(uvs) if len(found) == 2]
    assert max(map(len, uvs)) == 2 and len(cut) == 25  # straight down, from loop to loop
    assert max(cut) < 25 * AROUND  # none of the ear's


@pytest.mark.alike
@pytest.mark.parametrize("name", ["face_surprised", "perforated_panel"])
def test_any_part_of_a_sample_unrolls_or_says_why(name):
    """Random selections have ears, chords and points where they touch; a healthy object beside them is mapped."""
    bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{name}.blend"))
    obj, random = next(obj for obj in bpy.data.objects if obj.type == "MESH"), np.random.default_rng(5)
    healthy = scenes.add_panel("Healthy", size=12)
    center = scenes.read(obj.data.polygons, "center", np.float32, 3)
    unrolled = 0
    for _ in range(12):
        around = center[random.integers(len(center))]
        distance = np.linalg.norm(center - around, axis=1)
        least = np.quantile(distance, random.uniform(0.005, 0.05))
        most = least * random.uniform(1.5, 4.0)
        bpy.ops.object.mode_set(mode="OBJECT")
        scenes.select(healthy, obj)
        healthy.data.polygons.foreach_set("select", np.ones(len(healthy.data.polygons), bool))
        scenes.select_faces(obj, np.flatnonzero((distance >= least) & (distance <= most)))
        bpy.ops.uv.koebe_uniformize(tube="unroll", checker=False)
        entries = list(bpy.context.window_manager.koebe_uv.islands)
        assert [entry.mapped for entry in entries if entry.object_name == "Healthy"] == [True]
        for entry in entries:
            assert entry.mapped or "an unexpected error" not in entry.message, entry.message
            unrolled += entry.mapped and len(entry.loops) == 2 and entry.loops[1].uv_radius == 0
    assert unrolled > 3
