"""Unwrap Handles: UVs of surfaces with any number of handles, as the package makes them."""

import collections
import json
import os

import bpy
import fingerprint
import numpy as np
import pytest
import scenes
from balls import add_ball, join_faces, last_run
from handles import HOLE, HOLES, THREE, add_plate, plate_arrays
from tori import add_torus, block
from wild import damaged, wild


def unwrap(**options):
    return bpy.ops.uv.koebe_schottky(**options)


def of_the_package(koebe, obj, normalization="area"):
    """The map and the UVs of the corners as the package has them, of Blender's own triangles."""
    vertices = scenes.read(obj.data.vertices, "co", np.float32, 3).astype(np.float64)
    triangles, corners = scenes.triangles(obj.data)
    polygon = scenes.read(obj.data.loop_triangles, "polygon_index", np.int32)
    result = koebe.schottky_map(vertices, triangles, normalization=normalization, polygon=polygon)
    uv = np.zeros((len(obj.data.loops), 2), np.float32)
    uv[corners] = result.uv
    assert np.array_equal(uv[corners], result.uv), "a corner of a polygon has two places"
    return uv, result


def signed_areas(uv, corners):
    a, b, c = (uv[corners[:, k]].astype(float) for k in range(3))
    return np.cross(b - a, c - a)


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
    if polygons:
        scenes.with_polygons(obj)
    before = scenes.mesh_state(obj.data)
    assert unwrap(normalization=normalization, checker=False) == {"FINISHED"}
    expected, result = of_the_package(koebe, obj, normalization)
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


def test_one_step_of_undo():
    obj = add_plate()
    bpy.ops.ed.undo_push(message="before")
    assert bpy.ops.uv.koebe_schottky("EXEC_DEFAULT", True) == {"FINISHED"}
    after = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.ed.undo()
    obj = bpy.data.objects["Plate"]
    assert len(obj.data.uv_layers) == 0 and len(obj.material_slots) == 0
    bpy.ops.ed.redo()
    obj = bpy.data.objects["Plate"]
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), after) and len(obj.material_slots) == 1


# ---------------------------------------------------------------- what has no handle, and what has too many for others

WRONG = {
    "a ball": ("schottky", add_ball, "this surface has no handle: Unwrap Handles needs one at least", "sphere"),
    "a panel": ("schottky", scenes.add_panel, "this surface has no handle", "uniformize"),
    "two in a torus tile": ("torus", add_plate, "this surface has 2 handles: a torus tile needs", "schottky parts"),
    "two in a sphere": ("sphere", add_plate, "this surface has 2 handles: a sphere has none", "schottky parts"),
    "two in a cylinder": ("ring", add_plate, "this surface has 2 handles: a cylinder has none", "schottky parts"),
}


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("wrong", WRONG)
def test_what_is_refused_is_told_and_stays_as_it_is(wrong, mode):
    kind, make, text, offer = WRONG[wrong]
    obj = make()
    scenes.select(obj)
    if mode == "EDIT":
        scenes.select_faces(obj)
    before = fingerprint.fingerprint()
    with pytest.raises(RuntimeError, match=f"Koebe UV: nothing was mapped. {obj.name}: {text}"):
        getattr(bpy.ops.uv, f"koebe_{kind}")()
    changed = fingerprint.differences(before, fingerprint.fingerprint())
    allowed = ("file: report", f"mesh {obj.data.name}: history", f"mesh {obj.data.name}: active face")
    assert [key for key in changed if key not in allowed] == []
    entry = last_run()
    assert not entry.mapped and entry.offer == offer and entry.message.startswith(text)
    assert len(obj.data.uv_layers) == 0


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


def test_several_objects_one_of_them_bad():
    good, bad = add_plate(), add_ball()
    scenes.select(good, bad)
    assert unwrap() == {"FINISHED"}
    told = {entry.object_name: entry.mapped for entry in bpy.context.window_manager.koebe_uv.islands}
    assert told == {"Plate": True, "Ball": False}
    assert len(bad.data.uv_layers) == 0 and len(bad.material_slots) == 0


def test_in_edit_mode_the_selected_faces():
    """A part of a surface with two handles that has one, and a hole."""
    obj = add_plate()
    left = [face.index for face in obj.data.polygons if face.center.x < 6.0]
    scenes.select_faces(obj, left)
    assert unwrap() == {"FINISHED"}
    assert bpy.context.mode == "EDIT_MESH"
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = scenes.corner_uv(obj.data, "Koebe")
    written = np.array([np.ptp(uv[list(face.loop_indices)], axis=0).max() > 0.0 for face in obj.data.polygons])
    assert np.flatnonzero(written).tolist() == left
    entry = last_run()
    assert entry.handles == 1 and len(entry.loops) == 1


def test_seams_divide_islands():
    """Each half has a handle, the square to itself, and a rim."""
    obj = add_plate()
    x = scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (np.abs(x[ends] - 6.0) < 0.1).all(axis=1))
    assert unwrap() == {"FINISHED"}
    entries = list(bpy.context.window_manager.koebe_uv.islands)
    assert [(entry.mapped, entry.handles, len(entry.loops)) for entry in entries] == [(True, 1, 1)] * 2


def test_cuts_and_loops_can_be_selected():
    obj = add_plate(holes=HOLES)
    unwrap()
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert bpy.ops.uv.koebe_select_cuts() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    places = collections.defaultdict(set)
    for face in obj.data.polygons:
        corners = list(face.loop_indices)
        for here, there in zip(corners, [*corners[1:], corners[0]]):
            ends = sorted((obj.data.loops[i].vertex_index, *uv[i].tolist()) for i in (here, there))
            places[obj.data.loops[here].edge_index].add(tuple(ends))
    cut = sorted(edge for edge, ends in places.items() if len(ends) > 1)
    assert len(cut) > 8 and np.flatnonzero(scenes.read(obj.data.edges, "select", bool)).tolist() == cut
    assert bpy.ops.uv.koebe_select_loop(loop=1) == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    chosen = np.flatnonzero(scenes.read(obj.data.vertices, "select", bool)).tolist()
    assert chosen in [sorted(loop) for loop in scenes.boundary_loops(obj.data)]


def new_job(addon, obj, normalization="area"):
    choice = addon("maps.domains").SCHOTTKY.choice(normalization)
    return addon("jobs.domain_job").DomainJob([obj], addon("maps.options").Options(), choice)


def test_esc_before_the_end_changes_nothing(addon):
    obj = add_plate()
    job = new_job(addon, obj)
    job.cancel_token.cancel()
    with pytest.raises(job.koebe.Cancelled):
        job.compute()
    assert len(obj.data.uv_layers) == 0
    heard = []
    job = new_job(addon, obj)
    job.compute(lambda fraction, stage: heard.append((fraction, stage)))
    shares = [fraction for fraction, _ in heard]
    assert shares == sorted(shares) and shares[-1] == 1.0
    assert {stage for _, stage in heard} <= addon("operators.modal_run").STAGES.keys()


def test_the_report_has_the_meshs_numbers(addon):
    """Of the two halves of a plate, as JSON."""
    obj = add_plate()
    x = scenes.read(obj.data.vertices, "co", np.float32, 3)[:, 0]
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (np.abs(x[ends] - 6.0) < 0.1).all(axis=1))
    job = new_job(addon, obj)
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
    points += random.normal(0, random.choice([0, 0.02, 0.1]), points.shape)
    if random.random() < 0.3:
        points, faces = damaged(random, points, faces)
    obj = scenes.add_object("Wild", points, faces)
    return join_faces(random, obj, random.choice([0.0, 0.0, 0.1, 0.3]))


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
    random = np.random.default_rng(seed)
    mapped, refused = collections.Counter(), collections.Counter()
    for _ in range(10):
        obj = wild_plate(random)
        bpy.context.view_layer.update()
        state = scenes.mesh_state(obj.data)
        job = new_job(addon, obj, str(random.choice(["area", "circles"])))
        job.compute()
        (outcome,) = job.outcomes
        for one in outcome.mapped:
            assert_is_cut_open(outcome, one)
            mapped[f"{len(one.result.handles)} handles, converged: {one.result.converged}"] += 1
        for one in outcome.failed:
            assert "nobody foresaw" not in str(one.error)
            refused[getattr(one.error, "kind", None) or f"{type(one.error).__name__}: {one.error}"] += 1
        if outcome.mapped:
            job.write()
            assert outcome.line() and json.dumps(job.entries(outcome))
        assert scenes.mesh_state(obj.data, but_layer="Koebe").items() >= {
            key: value for key, value in state.items() if key not in ("uv Koebe", "face material")
        }.items()
        bpy.data.objects.remove(obj)
    print(f"mapped {dict(mapped)}, refused {dict(refused)}")
