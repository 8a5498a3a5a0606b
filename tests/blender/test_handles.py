"""Unwrap Pretzel: UVs of surfaces with any number of handles, as the package makes them."""

import json
import os

import bpy
import numpy as np
import pytest
import scenes
from balls import join_faces
from handles import HOLE, HOLES, THREE, add_plate, plate_arrays
from scenes import last_run
from tori import add_torus, block
from wild import add_wild, map_or_refuse_many, wild


def unwrap(**options):
    return bpy.ops.uv.koebe_schottky(**options)


def signed_areas(uv, corners):
    a, b, c = (uv[corners[:, k]].astype(float) for k in range(3))
    (x, y), (z, w) = (b - a).T, (c - a).T
    return x * w - y * z


CASES = {
    "a ring": (lambda: add_torus(), "area"),
    "a ring with a hole": (lambda: add_torus(holes=block(3, 4)), "circles"),
    "closed": (lambda: add_plate(), "area"),
    "holes": (lambda: add_plate(holes=HOLES), "area"),
    "a hole, circles": (lambda: add_plate(holes=HOLE), "circles"),
    "three": (lambda: add_plate(windows=THREE, holes=HOLE), "area"),
}


@pytest.mark.alike
@pytest.mark.parametrize("polygons", [False, True], ids=["quads", "polygons"])
@pytest.mark.parametrize("case", CASES)
def test_it_is_what_the_package_makes_of_it(koebe, case, polygons):
    make, normalization = CASES[case]
    obj = make()
    scenes.with_polygons(obj, polygons)
    before = scenes.mesh_state(obj.data)
    assert unwrap(normalization=normalization, checker=False) == {"FINISHED"}
    expected, result, _ = scenes.of_the_package(obj, koebe.schottky_map, normalization=normalization)
    if normalization == "area":  # equal circles may have no room, then the report says so
        assert result.converged and result.flipped == result.below_resolution <= (case == "three")
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(uv, expected) and uv.min() >= 0 and uv.max() <= 1
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    down = np.flatnonzero(signed_areas(uv, scenes.triangles(obj.data)[1]) <= 0)
    assert np.array_equal(down, result.flipped_faces)
    entry = last_run()
    assert entry.mapped and entry.converged == result.converged and entry.domain == "schottky"
    assert entry.flipped == result.flipped and entry.density > 1
    assert entry.handles == len(result.handles) == {"a ring": 1, "a ring with a hole": 1, "three": 3}.get(case, 2)
    assert entry.by_circles == result.by_circles and entry.sweeps == result.sweeps
    assert entry.angle_error == pytest.approx(result.angle_error_stored_deg["mean"], rel=1e-6)
    assert {frozenset(json.loads(loop.vertices)) for loop in entry.loops} == {
        frozenset(loop) for loop in scenes.boundary_loops(obj.data)
    }


@pytest.mark.alike
def test_the_normalization_is_another_map():
    """Of a surface whose even map has no room for equal circles."""
    obj = add_plate(windows=((4, 2), (5, 5)), holes=block(2, 0, 3), n=8, m=10, triangles=True)
    found = []
    for normalization in ("area", "circles"):
        unwrap(normalization=normalization)
        found.append(scenes.corner_uv(obj.data, "Koebe").copy())
    assert np.abs(found[0] - found[1]).max() > 0.01


def test_the_circles_that_are_drawn_are_those_of_the_uvs():
    obj = add_plate(holes=HOLES)
    unwrap()
    uv, vertex = scenes.corner_uv(obj.data, "Koebe"), scenes.read(obj.data.loops, "vertex_index", np.int32)
    loops = last_run().loops
    assert [loop.name for loop in loops] == ["Rim", "1"]
    for loop in loops:
        at = uv[np.isin(vertex, json.loads(loop.vertices))]
        assert loop.uv_radius > 0
        assert np.abs(np.hypot(*(at - loop.uv_center[:]).T) - loop.uv_radius).max() < 1e-5


def test_the_checker_is_plain():
    """No Möbius map is a symmetry of a checker."""
    obj = add_plate()
    for call in (unwrap, bpy.ops.uv.koebe_checker, bpy.ops.uv.koebe_checker):
        assert call(checker_size=20.0) == {"FINISHED"}
        if call is not unwrap and not len(obj.material_slots):
            continue  # it was taken off
        nodes = obj.material_slots[0].material.node_tree.nodes
        assert nodes["Fine"].inputs["Scale"].default_value == 20.0 and "Across" not in nodes


# ---------------------------------------------------------------- what cannot be cut, seams


def test_handles_that_cannot_be_cut_are_shown(addon, koebe, monkeypatch):
    """As what they are, not as a surface that must have none; vertices that only the solver knows are left out."""
    obj = add_plate()
    scenes.select_faces(obj)
    found = koebe.TopologyError("the handles cannot be cut along edges")
    found.kind, found.elements = "genus", [3, 7, 10**6]

    def refuse(*arguments, **options):
        raise found

    monkeypatch.setattr(addon("jobs.native_package").load(), "schottky_map", refuse)
    with pytest.raises(RuntimeError, match="Plate: the handles cannot be cut along edges"):
        unwrap()
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.flatnonzero(scenes.read(obj.data.vertices, "select", bool)).tolist() == [3, 7]
    assert len(obj.data.uv_layers) == 0 and last_run().offer == ""


def test_seams_divide_islands():
    """Each half has a handle, the square to itself, and a rim."""
    obj = add_plate()
    x = scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (np.abs(x[ends] - 6.0) < 0.1).all(axis=1))
    assert unwrap() == {"FINISHED"}
    entries = list(bpy.context.window_manager.koebe_uv.islands)
    assert [(entry.mapped, entry.handles, len(entry.loops)) for entry in entries] == [(True, 1, 1)] * 2


def test_the_report_has_the_meshs_numbers(addon):
    """Of the two halves of a plate, as JSON."""
    obj = add_plate()
    x = scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (np.abs(x[ends] - 6.0) < 0.1).all(axis=1))
    job = scenes.domain_job(addon, obj, addon("maps.domain_table").SCHOTTKY.choice())
    job.compute()
    job.write()
    (outcome,) = job.outcomes
    entries = job.entries(outcome)
    json.dumps(entries)
    assert [entry["domain"] for entry in entries] == ["schottky"] * 2
    assert {entry["options"]["normalization"] for entry in entries} == {"area"}
    sides = set()
    for entry in entries:
        (handle,), (loop,) = entry["handles"], entry["loops"]
        assert np.abs(x[loop["vertices"]] - 6.0).max() < 0.1
        side = set(np.sign(x[handle["cut"]] - 6.0).tolist()) - {0.0}
        assert len(handle["cut"]) > 2 and len(side) == 1
        sides |= side
    assert sides == {-1.0, 1.0}
    assert "2 fundamental domains, 2 handles, 2 holes, cut along " in job.line(outcome)


# ---------------------------------------------------------------- whatever comes


def wild_plate(random):
    """A plate of any size with windows and holes, of polygons of all sizes, bent, noisy and damaged; or anything."""
    if random.random() < 0.2:
        return wild(random)
    size, m = int(random.integers(1, 4)), int(random.integers(7, 11))
    count = int(random.integers(1, 4))
    windows = [((size + 2) * k + 2, int(random.integers(2, m - size - 1))) for k in range(count)]
    n = (size + 2) * count + 2 + int(random.integers(0, 3))
    holes = {(int(random.integers(n)), int(random.integers(m))) for _ in range(random.integers(0, 4))}
    points, faces = plate_arrays(windows, holes, size, n, m, bent=random.uniform(0, 0.1))
    return join_faces(random, add_wild(random, points, faces, 0.1, 0.3), random.choice([0.0, 0.0, 0.1, 0.3]))


def assert_is_cut_open(outcome, one):
    """Every triangle is upright that is not named, all lie in the square, and no place is covered twice."""
    surface, result, island = outcome.task.surface, one.result, one.island
    uv = np.full((len(surface.corner_vertex), 2), np.nan)
    uv[one.corners] = one.uv
    assert np.isfinite(one.uv).all() and one.uv.min() >= 0 and one.uv.max() <= 1
    inside = np.isin(surface.triangle_face, island.faces)
    corners = surface.triangle_corners[inside]
    assert np.array_equal(uv[corners], result.uv)
    areas = signed_areas(uv, corners)
    turned = np.zeros(len(areas), bool)
    turned[result.turned] = True
    down = np.flatnonzero(np.where(turned, -areas, areas) <= 0)
    assert np.array_equal(down, np.sort(one.flipped))
    if result.converged:
        assert np.abs(areas).sum() / 2 <= np.pi / 4 + 1e-6


@pytest.mark.alike
@pytest.mark.parametrize("seed", range(int(os.environ.get("KOEBE_RANDOM_RUNS", "8"))))
def test_wild_surfaces_are_cut_open_or_refused(addon, seed):
    map_or_refuse_many(addon, seed, 10, wild_plate, lambda random, domains: [
        domains.SCHOTTKY.choice(str(random.choice(["area", "circles"])))], assert_is_cut_open)  # fmt: skip
