"""Unwrap to Sphere: UVs of the sphere's two layouts, which their pattern continues over the cuts to the last bit."""

import json
import os

import bpy
import numpy as np
import pytest
import scenes
from balls import LAYOUTS, add_ball, are_continued, ball_arrays, join_faces, led_back, sides_of_edges
from scenes import last_run
from test_handles import signed_areas
from tori import add_torus
from wild import add_wild, map_or_refuse_many, wild

HOLES = ((1, 2), (2, 2), (9, 5), (9, 6), (10, 5))


def sphere(**options):
    return bpy.ops.uv.koebe_sphere(**options)


@pytest.mark.alike
@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("holes", [(), HOLES], ids=["closed", "holes"])
@pytest.mark.parametrize("polygons", [False, True], ids=["quads", "polygons"])
def test_a_ball_is_what_the_package_makes_of_it(koebe, holes, polygons, layout):
    obj = add_ball(holes=holes)
    scenes.with_polygons(obj, polygons)
    before = scenes.mesh_state(obj.data)
    assert sphere(layout=layout, checker=False) == {"FINISHED"}
    expected, ball, polygon = scenes.of_the_package(obj, koebe.sphere_map, layout=layout)
    assert ball.converged
    uv = scenes.corner_uv(obj.data, "Koebe")
    assert np.array_equal(uv, expected)
    assert scenes.mesh_state(obj.data, but_layer="Koebe") == before
    torn = np.unique(polygon[ball.layout["torn"]])
    entry = last_run()
    assert entry.mapped and entry.converged and entry.domain == "sphere" and entry.layout == layout
    assert json.loads(entry.torn_faces) == torn.tolist()
    assert json.loads(entry.moved_faces) == np.unique(polygon[ball.layout["moved"]]).tolist()
    assert not len(torn) and entry.flipped == ball.flipped == 0
    assert entry.angle_error == pytest.approx(ball.angle_error_stored_deg["mean"], rel=1e-6)
    down = signed_areas(uv, scenes.triangles(obj.data)[1]) <= 0.0
    assert np.array_equal(np.flatnonzero(down), ball.flipped_faces)
    assert 1.0 <= entry.density < 10.0
    assert [loop.radius for loop in entry.loops] == pytest.approx(ball.caps[:, 3].tolist(), rel=1e-6)
    assert len(entry.loops) == len(scenes.boundary_loops(obj.data))
    whole = np.ones(len(uv), bool)
    for face in np.unique(polygon[ball.layout["moved"]]).tolist():
        whole[list(obj.data.polygons[face].loop_indices)] = False
    points = ball.points[scenes.read(obj.data.loops, "vertex_index", np.int32)]
    assert np.abs(led_back(uv[whole], layout) - points[whole]).max() < 3e-6
    ends, faces = sides_of_edges(obj.data, uv)
    assert are_continued(ends, layout).all()


@pytest.mark.alike
@pytest.mark.parametrize("layout", LAYOUTS)
def test_a_face_without_three_corners_apart_is_no_obstacle(layout):
    """The smallest closed surfaces: a cube, and a tetrahedron."""
    cube = scenes.add_cube()
    tetrahedron = scenes.add_object("Tetrahedron", [(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)],
                                    [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])  # fmt: skip
    scenes.select(cube, tetrahedron)
    assert sphere(layout=layout, most_lost=1.0) == {"FINISHED"}  # of the cube one of four longitudes is left out
    entries = list(bpy.context.window_manager.koebe_uv.islands)
    fine = layout == "equirectangular"  # the tetrahedron is too coarse for the octahedron
    assert [entry.mapped and entry.converged for entry in entries] == [True, fine]


@pytest.mark.alike
@pytest.mark.parametrize("holes", [(), HOLES], ids=["closed", "holes"])
def test_an_even_sphere_is_what_the_package_makes_of_it(koebe, holes):
    obj = add_ball(holes=holes)
    assert sphere(checker=False) == {"FINISHED"}
    before = last_run().density
    assert sphere(checker=False, even=0.75) == {"FINISHED"}
    expected, ball, _ = scenes.of_the_package(obj, koebe.sphere_map, even=0.75)
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), expected)
    assert last_run().even == ball.even == 0.75 and last_run().density < before


def test_the_uvs_of_a_sphere_cannot_be_dragged():
    add_ball()
    settings = bpy.context.scene.koebe_uv
    settings.shape = "SPHERE"
    assert sphere(checker=False) == {"FINISHED"} and not bpy.ops.uv.koebe_even.poll()
    settings.shape = "DISK"
    assert bpy.ops.uv.koebe_even.poll()


# ---------------------------------------------------------------- the checker


def colors(matrix, uv):
    """What the checker of squares, and the coarse one of 4, show at UVs (n, 2)."""
    at = uv @ matrix.T
    return np.stack([np.floor(at).sum(axis=1) % 2, np.floor(at / 4).sum(axis=1) % 2], axis=1)


@pytest.mark.alike
@pytest.mark.parametrize("size", [8.0, 20.0, 32.0, 50.0])
@pytest.mark.parametrize("layout", LAYOUTS)
@pytest.mark.parametrize("holes", [(), HOLES, ((0, -1), (0, 9))], ids=["closed", "holes", "poles"])
def test_the_checker_runs_over_the_cuts(holes, layout, size):
    """Both sides of a cut show the same, close to the edge too, squares coarse and fine."""
    upright = (0.0, 0.0) if holes and holes[0][1] == -1 else None
    obj = add_ball(holes=holes, turn=upright)
    assert sphere(layout=layout, checker_size=size) == {"FINISHED"}
    matrix, uv = scenes.checker_pattern(obj), scenes.corner_uv(obj.data, "Koebe").astype(float)
    torn = json.loads(last_run().torn_faces)
    ends, faces = sides_of_edges(obj.data, uv)
    cut = (ends[:, :, 0] != ends[:, :, 1]).any(axis=(1, 2)) & ~np.isin(faces, torn).any(axis=1)
    if layout == "equirectangular":  # faces at a pole are moved to be upright, each by itself
        cut &= ~np.isin(ends[..., 1], (0.0, 1.0)).any(axis=(1, 2))
    assert cut.sum() > 3
    share = np.random.default_rng(1).uniform(0.05, 0.95, (200, 1, 1, 1))
    here, there = (share * ends[cut, 0] + (1 - share) * ends[cut, 1]).reshape(-1, 2, 2).transpose(1, 0, 2)
    step = here @ matrix.T
    far = (np.abs(step / 1.0 - np.rint(step)) > 1e-4).all(axis=1)  # on no square's side
    assert far.sum() > 100 and np.array_equal(colors(matrix, here)[far], colors(matrix, there)[far])
    values = np.diag(matrix)
    assert (np.diag(values) == matrix).all() and size / 1.6 < values[0] < 1.6 * size and values[0] % 8 == 0
    assert values[1] == (values[0] / 2 if layout == "equirectangular" else values[0])
    before = scenes.checker_pattern(obj)
    bpy.ops.uv.koebe_checker()
    assert len(obj.material_slots) == 0
    bpy.ops.uv.koebe_checker(checker_size=size)
    assert np.allclose(scenes.checker_pattern(obj), before, rtol=1e-6)


def test_a_cylinder_keeps_its_own_checker():
    """With the period 1 its cuts are those of longitudes."""
    obj = add_ball(holes=((0, -1), (0, 9)))
    assert bpy.ops.uv.koebe_ring(fit="period") == {"FINISHED"}
    matrix = scenes.checker_pattern(obj)
    assert matrix[0, 0] == matrix[1, 1]


# ---------------------------------------------------------------- the sphere itself


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_the_sphere_is_added_beside_its_source(koebe, mode):
    obj = add_ball(holes=HOLES)
    obj.location = (1.0, 2.0, 3.0)
    for name in ("Skin", "Cloth"):
        obj.data.materials.append(bpy.data.materials.new(name))
    obj.data.polygons.foreach_set("material_index", np.arange(len(obj.data.polygons)) % 2)
    if mode == "EDIT":
        scenes.select_faces(obj)
    assert sphere(add_sphere=True, checker=False) == {"FINISHED"}
    if mode == "EDIT":
        assert bpy.context.mode == "EDIT_MESH"
        bpy.ops.object.mode_set(mode="OBJECT")
    added = bpy.data.objects["Ball Sphere"]
    _, ball, _ = scenes.of_the_package(obj, koebe.sphere_map)
    corners = [scenes.read(one.data.loops, "vertex_index", np.int32) for one in (obj, added)]
    places = scenes.read(added.data.vertices, "co", np.float32, 3)
    obj.data.calc_loop_triangles()
    radius = np.sqrt(sum(triangle.area for triangle in obj.data.loop_triangles) / (4 * np.pi))
    expected = radius * (ball.points + [1, 0, 0])
    assert np.abs(places[corners[1]] - expected[corners[0]]).max() < 1e-5 * radius
    assert np.array_equal(scenes.corner_uv(added.data, "Koebe"), scenes.corner_uv(obj.data, "Koebe"))
    assert [material.name for material in added.data.materials] == ["Skin", "Cloth"]
    for name in ("material_index", "loop_total"):
        both = [scenes.read(one.data.polygons, name, np.int32).tolist() for one in (obj, added)]
        assert both[0] == both[1]
    assert not added.data.validate()
    assert added.location.x > max(v.co.x for v in obj.data.vertices) + 1.0 and added.location.yz[:] == (2.0, 3.0)
    outward = [face.normal.dot(face.center - type(face.center)((radius, 0, 0))) for face in added.data.polygons]
    assert min(outward) > 0


def test_each_island_has_a_sphere_of_its_own():
    obj = add_ball()
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (ends % 10 == 4).all(axis=1))
    assert sphere(add_sphere=True, checker=False) == {"FINISHED"}
    added = bpy.data.objects["Ball Sphere"]
    assert len(added.data.polygons) == len(obj.data.polygons)
    assert len(added.data.vertices) == len(obj.data.vertices) + 16
    assert len(scenes.boundary_loops(added.data)) == 2


def test_nothing_is_added_where_nothing_is_mapped():
    add_torus()
    with pytest.raises(RuntimeError, match="a sphere has no handle"):
        sphere(add_sphere=True)
    assert [obj.name for obj in bpy.data.objects] == ["Torus"] and len(bpy.data.meshes) == 1


def test_seams_divide_islands_and_others_do_not():
    """A ring of seams makes two spheres of a ball; a path of seams none."""
    obj = add_ball()
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    level = ends % 10  # 10 to a column
    path = ((ends // 10) == 3).all(axis=1)
    obj.data.edges.foreach_set("use_seam", path)
    assert path.sum() > 5 and sphere() == {"FINISHED"}
    assert len(last_run().loops) == 0
    obj.data.edges.foreach_set("use_seam", path | (level == 4).all(axis=1))
    assert sphere() == {"FINISHED"}
    entries = list(bpy.context.window_manager.koebe_uv.islands)
    assert [(entry.mapped, len(entry.loops)) for entry in entries] == [(True, 1), (True, 1)]


def test_torn_faces_can_be_selected():
    obj = add_ball(holes=HOLES)
    sphere()
    torn = [3, 5]
    last_run().torn_faces = json.dumps(torn)  # this ball has none
    assert bpy.ops.uv.koebe_select_torn() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert np.flatnonzero(scenes.read(obj.data.polygons, "select", bool)).tolist() == torn


def test_the_report_has_the_meshs_numbers(addon):
    """Of a ball in two islands, as JSON."""
    obj = add_ball()
    ends = scenes.read(obj.data.edges, "vertices", np.int32, 2)
    obj.data.edges.foreach_set("use_seam", (ends % 10 == 4).all(axis=1))
    job = scenes.domain_job(addon, obj, addon("maps.domain_table").SPHERE.choice(layout="octahedral"))
    job.compute()
    job.write()
    (outcome,) = job.outcomes
    entries = job.entries(outcome)
    json.dumps(entries)
    assert [entry["domain"] for entry in entries] == ["sphere", "sphere"]
    assert {v % 10 for entry in entries for loop in entry["loops"] for v in loop["vertices"]} == {4}
    crossing = [set(entry["layout"]["crossing"]) for entry in entries]
    assert crossing[0] and crossing[1] and not crossing[0] & crossing[1]
    uv = scenes.corner_uv(obj.data, "Koebe")
    beyond = {face.index for face in obj.data.polygons
              if uv[list(face.loop_indices)].min() < 0 or uv[list(face.loop_indices)].max() > 1}  # fmt: skip
    assert beyond <= crossing[0] | crossing[1]
    assert "2 spheres, 2 holes, " in job.line(outcome)


# ---------------------------------------------------------------- whatever comes


def wild_ball(random):
    """A ball of any size, closed or with holes, of polygons of all sizes, bent, stretched and damaged; or anything."""
    if random.random() < 0.2:
        return wild(random)
    n, m = int(random.integers(3, 14)), int(random.integers(2, 10))
    holes = {(int(random.integers(n)), int(random.integers(-1, m))) for _ in range(random.integers(0, 5))}
    points, faces = ball_arrays(n, m, holes, tuple(random.uniform(0, 6, 2)), np.exp(random.normal(0, 0.5, 3)))
    return join_faces(random, add_wild(random, points, faces, 0.1, 0.3), random.choice([0.0, 0.2, 0.8]))


def assert_is_a_layout(outcome, one):
    """Corners at their points, and both sides of edges the same in the continued pattern, but for torn faces."""
    surface, result, layout = outcome.task.surface, one.result, outcome.choice.layout
    uv = np.full((len(surface.corner_vertex), 2), np.nan)
    uv[one.corners] = one.uv
    assert np.isfinite(one.uv).all() and one.uv.min() >= -2 and one.uv.max() <= 2
    vertex = np.zeros(len(surface.corner_vertex), int)
    vertex[one.island.corners] = one.island.corner_vertex
    torn = set(one.torn_faces.tolist())
    moved = torn | set(one.island.triangle_face[np.array(result.layout["moved"], int)].tolist())
    whole = [c for face in one.island.faces if face not in moved
             for c in range(surface.face_start[face], surface.face_start[face] + surface.face_size[face])]  # fmt: skip
    points = result.points[vertex[whole]]
    pole = np.hypot(points[:, 0], points[:, 1]) < 1e-3
    assert np.abs(led_back(uv[whole], layout) - points)[~pole].max(initial=0) < 3e-6
    sides = {}
    for face in one.island.faces:
        if face in torn:
            continue
        first, size = surface.face_start[face], surface.face_size[face]
        for k in range(size):
            c, d = first + k, first + (k + 1) % size
            places = {int(vertex[c]): uv[c], int(vertex[d]): uv[d]}
            sides.setdefault(frozenset(places), []).append(places)
    both = [[[a[v], b[v]] for v in a] for a, b in (pair for pair in sides.values() if len(pair) == 2)]
    if both:
        assert are_continued(np.array(both, float), layout).all()
    assert not (result.converged and torn)


@pytest.mark.alike
@pytest.mark.parametrize("seed", range(int(os.environ.get("KOEBE_RANDOM_RUNS", "12"))))
def test_wild_surfaces_become_spheres_or_are_refused(addon, seed):
    map_or_refuse_many(addon, seed, 10, wild_ball, lambda random, domains: [
        domains.SPHERE.choice(layout=str(random.choice(LAYOUTS)))], assert_is_a_layout)  # fmt: skip
