"""Unwrap to Torus Tile, Unwrap to Cylinder: UVs whose copies continue them, to the last bit."""

import math
import os

import bpy
import numpy as np
import pytest
import scenes
from scenes import last_run
from tori import (
    GRID,
    add_torus,
    add_tube,
    assert_ring,
    assert_torus,
    block,
    grid_points,
    polygon_areas,
    shifts,
    torus_arrays,
    tube_arrays,
)
from wild import add_wild, map_or_refuse_many, wild


def torus(**options):
    return bpy.ops.uv.koebe_torus(**options)


def ring(**options):
    return bpy.ops.uv.koebe_ring(**options)


def add(kind, holes=()):
    return (add_torus if kind == "torus" else add_tube)(holes=holes)


def unwrap(kind, **options):
    return getattr(bpy.ops.uv, f"koebe_{kind}")(**options)


HOLES = (*block(2, 3), *block(9, 7, 3))


@pytest.mark.alike
@pytest.mark.parametrize("holes", [(), HOLES], ids=["closed", "holes"])
@pytest.mark.parametrize("polygons", [False, True], ids=["quads", "polygons"])
def test_a_torus_is_what_the_package_makes_of_it(koebe, holes, polygons):
    obj = scenes.with_polygons(add_torus(holes=holes), polygons)
    before = scenes.mesh_state(obj.data)
    assert torus(checker=False) == {"FINISHED"}
    expected, tile, _ = scenes.of_the_package(obj, koebe.torus_map)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected)
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    found = assert_torus(obj)
    steps = np.rint(tile.periods * GRID).astype(int)
    for shift in found:
        lifts = np.linalg.solve(steps.T.astype(float), np.array(shift, float))
        assert (np.rint(lifts).astype(int) @ steps == shift).all()
    entry = last_run()
    assert entry.mapped and entry.converged and entry.flipped == 0 and entry.domain == "torus"
    assert entry.angle_error == pytest.approx(tile.angle_error_stored_deg["mean"], rel=1e-6)
    assert complex(entry.modulus.replace(" i", "j").replace(" ", "")) == pytest.approx(tile.modulus, abs=1e-3)
    assert len(entry.loops) == len(scenes.boundary_loops(obj.data))


@pytest.mark.alike
@pytest.mark.parametrize("how", ["circles", "concentric", "radial"])
@pytest.mark.parametrize("polygons", [False, True], ids=["quads", "polygons"])
def test_a_cylinder_is_what_the_package_makes_of_it(koebe, how, polygons):
    obj = scenes.with_polygons(add_tube(holes=HOLES), polygons)
    before = scenes.mesh_state(obj.data)
    assert ring(holes=how, checker=False) == {"FINISHED"}
    loops = sorted(scenes.boundary_loops(obj.data), key=len)[-2:]
    heights = [np.mean([obj.data.vertices[v].co.z for v in loop]) for loop in loops]
    low, high = (loops[k][0] for k in np.argsort(heights))
    expected, tile, _ = scenes.of_the_package(obj, koebe.ring_map, outer=low, inner=high, holes=how)
    assert tile.converged
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected)
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    assert assert_ring(obj) == round(tile.periods[0, 0] * GRID)
    entry = last_run()
    assert entry.mapped and entry.domain == "ring" and entry.modulus == f"{tile.modulus.imag:.3f} i"
    assert [loop.name for loop in entry.loops] == ["Rim", "Rim 2", "1", "2"]


@pytest.mark.alike
def test_the_lower_rim_is_below():
    obj = add_tube()
    for turned in (False, True):
        obj.rotation_euler.x = np.pi * turned
        assert ring() == {"FINISHED"}
        uv = scenes.corner_uv(obj.data, "Koebe")
        heights = np.array([(obj.matrix_world @ obj.data.vertices[loop.vertex_index].co).z for loop in obj.data.loops])
        assert np.corrcoef(uv[:, 1], heights)[0, 1] > 0.9


@pytest.mark.alike
@pytest.mark.parametrize("fit", ["inside", "period", "square"])
@pytest.mark.parametrize("holes", [(), HOLES], ids=["whole", "holes"])
@pytest.mark.parametrize("kind", ["torus", "ring"])
def test_periods_are_exact_however_it_fits(kind, holes, fit):
    obj = add(kind, holes)
    assert unwrap(kind, fit=fit) == {"FINISHED"}
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert uv.min() == 0.0
    if fit == "inside":
        assert uv.max() <= 1.0
        return
    found = (assert_torus if kind == "torus" else assert_ring)(obj)
    if kind == "ring":
        assert found == GRID and (fit == "period" or uv[:, 1].max() == 1.0)
        return
    one = int(GRID)
    if fit == "square":
        assert all(x % one == 0 == y % one for x, y in found)
    along = [x for x, y in found if y == 0 and x]
    assert math.gcd(*along) == one


@pytest.mark.alike
@pytest.mark.parametrize("fit", ["inside", "period", "square"])
def test_only_the_unit_square_is_not_conformal(fit):
    obj = add_torus()
    torus()
    conformal = last_run().angle_error
    torus(fit=fit)
    error = last_run().angle_error
    assert error == pytest.approx(conformal, rel=1e-4) if fit != "square" else error > conformal + 4.0
    assert obj.data.uv_layers.active.name == "Koebe"


# ---------------------------------------------------------------- the checker


def assert_runs_over_the_cuts(obj):
    """After every shift the checker of squares and the coarse one of 4 are the same."""
    matrix = scenes.checker_pattern(obj)
    found = shifts(obj, grid_points(obj)) - {(0, 0)}
    assert found
    for shift in found:
        coarse = matrix @ np.array(shift) / GRID / 4.0
        assert np.abs(coarse - np.rint(coarse)).max() < 1e-4 and np.rint(coarse).sum() % 2 == 0
    values = np.linalg.svd(matrix, compute_uv=False)
    return values[0] / values[1], math.sqrt(values[0] * values[1])


@pytest.mark.parametrize("fit", ["inside", "period", "square"])
@pytest.mark.parametrize("kind", ["torus", "ring"])
def test_the_checker_runs_over_the_cut(kind, fit):
    obj = add(kind)
    assert unwrap(kind, fit=fit) == {"FINISHED"}
    stretch, size = assert_runs_over_the_cuts(obj)
    assert stretch < 1.12 and 32 / 1.5 < size < 32 * 1.5
    if kind == "ring" or fit == "square":
        assert stretch == 1.0
    before = scenes.checker_pattern(obj)
    bpy.ops.uv.koebe_checker()
    assert len(obj.material_slots) == 0
    bpy.ops.uv.koebe_checker()
    assert np.allclose(scenes.checker_pattern(obj), before, rtol=1e-6)


def test_a_checker_of_a_tile_is_no_other_objects():
    """Materials of one pattern are shared, others are not."""
    one, two, panel = add_torus("One"), add_torus("Two"), scenes.add_panel()
    scenes.select(one, two, panel)
    assert torus() == {"FINISHED"}
    bpy.ops.uv.koebe_checker()
    scenes.select(panel)
    bpy.ops.uv.koebe_uniformize()
    scenes.select(one, two)
    bpy.ops.uv.koebe_checker()
    worn = [obj.material_slots[0].material for obj in (one, two, panel)]
    assert worn[0] == worn[1] != worn[2] and "Across" not in worn[2].node_tree.nodes
    assert_runs_over_the_cuts(one)


def test_a_shared_mesh_counts_once():
    obj = add_torus()
    other = bpy.data.objects.new("Other", obj.data)
    bpy.context.collection.objects.link(other)
    scenes.select(obj, other)
    assert torus() == {"FINISHED"}
    assert len(bpy.context.window_manager.koebe_uv.islands) == 1
    assert_torus(other)


def test_uneven_texels_are_told():
    """A tube with a finger, at the end of which a texel is a thousandth as long."""
    add_tube(finger=70)
    assert ring() == {"FINISHED"}
    assert last_run().uneven
    assert unwrap_even() == {"FINISHED"} and not last_run().uneven


def test_a_cylinder_of_one_row_of_faces_is_not_warned_about_its_disk():
    """As a disk its angles are far off, as a cylinder they are not."""
    bpy.ops.mesh.primitive_cylinder_add(end_fill_type="NOTHING")
    assert ring() == {"FINISHED"}
    assert last_run().angle_error < 1.0 and not last_run().message and not list(last_run().warnings)


def unwrap_even():
    add_torus("Even")
    return torus()


# ---------------------------------------------------------------- seams, islands, selections


def test_a_seam_that_divides_nothing_is_no_cut():
    """As those by which a torus was unwrapped before."""
    obj = add_torus()
    torus(checker=False)
    expected = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.uv.koebe_select_cuts()
    bpy.ops.mesh.mark_seam(clear=False)
    bpy.ops.object.mode_set(mode="OBJECT")
    assert sum(edge.use_seam for edge in obj.data.edges) > 20
    assert torus(checker=False) == {"FINISHED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected)


def test_seams_divide_islands():
    """A tube with a loop of seams half way up is two cylinders, each of which has the square for itself."""
    obj = add_tube()
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    level = np.array([round(v) for v in np.arange(len(obj.data.vertices)) % 13])  # 13 to a column
    obj.data.edges.foreach_set("use_seam", (level[ends] == 6).all(axis=1))
    assert ring() == {"FINISHED"}
    entries = list(bpy.context.window_manager.koebe_uv.islands)
    assert [entry.mapped for entry in entries] == [True, True]
    lower = np.array([max(level[v] for v in face.vertices) <= 6 for face in obj.data.polygons])
    points = grid_points(obj)
    areas = polygon_areas(obj, points)
    for half in (lower, ~lower):
        corners = [i for face in np.flatnonzero(half) for i in obj.data.polygons[face].loop_indices]
        assert areas[half].min() > 0 and points[corners].max() > 0.99 * GRID and points[corners].min() == 0


def test_two_tori_in_one_object():
    vertices, faces = torus_arrays()
    count = len(vertices)
    both = [*faces, *([v + count for v in face] for face in faces)]
    obj = scenes.add_object("Links", np.concatenate([vertices, vertices + (9, 0, 0)]), both)
    scenes.select(obj)
    assert torus() == {"FINISHED"}
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.allclose(uv[: len(uv) // 2], uv[len(uv) // 2 :], atol=1e-4) and np.ptp(uv) > 0.9
    assert_runs_over_the_cuts(obj)
    assert not any("periods" in entry.message for entry in bpy.context.window_manager.koebe_uv.islands)


def test_two_tori_of_other_periods_are_told():
    vertices, faces = torus_arrays()
    count = len(vertices)
    both = [*faces, *([v + count for v in face] for face in faces)]
    thick = vertices * (1, 1, 2) + (9, 0, 0)
    scenes.select(scenes.add_object("Links", np.concatenate([vertices, thick]), both))
    assert torus() == {"FINISHED"}
    assert all("differ in size" in entry.message for entry in bpy.context.window_manager.koebe_uv.islands)


def pick(obj, vertices):
    """Edit Mode with only these vertices selected."""
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (True, False, False)
    bpy.ops.mesh.select_all(action="DESELECT")
    bpy.ops.object.mode_set(mode="OBJECT")
    for v in vertices:
        obj.data.vertices[v].select = True
    bpy.ops.object.mode_set(mode="EDIT")


@pytest.mark.parametrize("rims", ["auto", "selected"])
def test_the_rims_are_the_loops_that_the_selection_touches(rims):
    obj = add_tube(holes=HOLES)
    loops = sorted(map(sorted, scenes.boundary_loops(obj.data)), key=len)
    for two in ((loops[0], loops[3]), (loops[0], loops[1])):
        pick(obj, [loop[0] for loop in two])
        assert ring(rims=rims) == {"FINISHED"}
        found = [sorted(map(int, loop.vertices.strip("[]").split(","))) for loop in last_run().loops[:2]]
        assert sorted(found) == sorted(two)
        bpy.ops.object.mode_set(mode="OBJECT")
        assert_ring(obj)


def test_rims_that_are_not_two_are_an_error():
    obj = add_tube(holes=HOLES)
    loops = scenes.boundary_loops(obj.data)
    for count, words in ((1, "1 loop:"), (3, "3 loops:")):
        pick(obj, [loop[0] for loop in loops[:count]])
        with pytest.raises(RuntimeError, match=f"selected vertices are on {words}"):
            ring(rims="selected")
        bpy.ops.object.mode_set(mode="OBJECT")
    with pytest.raises(RuntimeError, match="selected vertices are on 0 loops"):
        ring(rims="selected")
    assert len(obj.data.uv_layers) == 0
    pick(obj, [])
    with pytest.raises(RuntimeError, match="no faces are selected"):
        ring()


def test_circles_of_the_report_lie_on_the_holes():
    obj = add_torus(holes=HOLES)
    for fit in ("inside", "period"):
        torus(fit=fit)
        points = scenes.corner_uv(obj.data, "Koebe").astype(float)
        vertex = scenes.read(obj.data.loops, "vertex_index", np.int32)
        for loop in last_run().loops:
            assert loop.uv_radius > 0.01
            on_loop = points[np.isin(vertex, [int(v) for v in loop.vertices.strip("[]").split(",")])]
            off = np.abs(np.hypot(*(on_loop - loop.uv_center[:]).T) - loop.uv_radius)
            assert np.sort(off)[len(off) // 2] < 1e-5  # those of another copy are farther


def test_a_mirrored_object_and_pins_are_told():
    obj = add_torus()
    obj.scale.x = -1.0
    torus()
    assert "negative" in last_run().message
    assert_torus(obj)


def test_uvs_are_stored_as_they_were_written(tmp_path):
    obj = add_torus(holes=HOLES)
    torus()
    expected = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "tile.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "tile.blend"))
    obj = bpy.data.objects["Torus"]
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected)
    assert_torus(obj)


def test_what_is_chosen_in_the_panel_is_kept_and_reset():
    settings = bpy.context.scene.koebe_uv
    settings.fit, settings.holes, settings.rims = "square", "radial", "selected"
    bpy.ops.uv.koebe_reset()
    assert (settings.fit, settings.holes, settings.rims) == ("inside", "circles", "auto")


@pytest.mark.alike
def test_tube_arrays_are_what_the_tests_think():
    assert len(tube_arrays()[1]) == 16 * 12 and len(torus_arrays()[0]) == 16 * 12


# ---------------------------------------------------------------- whatever comes


def wild_surface(random):
    """A torus or a tube of any size with holes, bent, stretched and damaged, of polygons; or just anything."""
    kind = random.integers(4)
    if kind == 3:
        return wild(random)
    holes = {block_face for _ in range(random.integers(0, 4))
             for block_face in block(*random.integers(0, 9, 2).tolist(), int(random.integers(1, 4)))}  # fmt: skip
    n, m = random.integers(3, 14, 2).tolist()
    points, faces = (torus_arrays if kind else tube_arrays)(n, m, holes if len(holes) < n * m else ())
    points = points * np.exp(random.normal(0, random.choice([0, 0.5, 1.5]), 3))
    return add_wild(random, points, faces, 0.2, 0.5)


def assert_is_a_tile(outcome, one):
    """UVs on a grid, the sides of each edge of the island apart by whole periods, and no face of an island that is
    promised to be one to one turned over."""
    surface, tile, choice = outcome.task.surface, one.tile, outcome.choice
    uv = np.full((len(surface.corner_vertex), 2), np.nan)
    uv[one.corners] = one.uv
    steps = one.uv.astype(np.float64) / tile.grid
    assert np.isfinite(one.uv).all() and (steps == np.rint(steps)).all() and one.uv.min() >= 0.0
    assert choice.fit != "inside" or one.uv.max() <= 1.0
    periods = np.rint(tile.periods / tile.grid).astype(np.int64)
    sides = {}
    for face in one.island.faces:
        first, size = surface.face_start[face], surface.face_size[face]
        for k in range(size):
            corners = (first + k, first + (k + 1) % size)
            places = {int(surface.corner_vertex[c]): np.rint(uv[c] / tile.grid).astype(np.int64) for c in corners}
            sides.setdefault(int(surface.corner_edge[first + k]), []).append(places)
    for edge, both in sides.items():
        if len(both) != 2 or len(both[0]) != 2 or surface.seam[edge]:
            continue
        apart = {tuple((both[0][v] - both[1][v]).tolist()) for v in both[0]}
        assert len(apart) == 1, "the ends of an edge are not moved alike"
        shift = np.array(apart.pop())
        lifts = np.rint(np.linalg.lstsq(periods.T.astype(float), shift.astype(float), rcond=None)[0]).astype(np.int64)
        assert (lifts @ periods == shift).all()
    if one.result.converged and choice.fit == "inside":
        assert len(one.flipped) == one.result.below_resolution
    assert set(one.result.flipped_faces) == set(one.flipped) or choice.fit != "inside"


def tile_choices(random, domains):
    fit = str(random.choice(["inside", "period", "square"]))
    holes = str(random.choice(["circles", "concentric", "radial"]))
    return domains.TORUS.choice(fit=fit), domains.RING.choice(fit=fit, holes=holes)


@pytest.mark.alike
@pytest.mark.parametrize("seed", range(int(os.environ.get("KOEBE_RANDOM_RUNS", "12"))))
def test_wild_surfaces_become_tiles_or_are_refused(addon, seed):
    map_or_refuse_many(addon, seed, 6, wild_surface, tile_choices, assert_is_a_tile)
