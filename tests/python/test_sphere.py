"""Maps to the sphere: against exact solutions, in exact arithmetic, and under random damage."""

import json
from fractions import Fraction

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_rows, same_as_package, succeeded, write_obj
from cli_support import koebe as run
from domain_surfaces import damaged, holed_ring, holed_torus, renumbered
from sphere_surfaces import (
    areas_around,
    best_turned,
    cap_through,
    from_spheroid_map,
    icosphere,
    in_plane,
    inversive,
    led_back,
    moved_sphere,
    spheroid_map,
)
from uv_measures import signed_areas

HOLES = {(1, 0): ((0.5, 0.5), 0.3), (3, 1): ((0.5, 0.6), 0.25)}


def exact_sign(a, b, c):
    """The sign of det(a, b, c) in exact arithmetic."""
    a, b, c = ([Fraction(float(x)) for x in p] for p in (a, b, c))
    det = sum(a[i] * (b[(i + 1) % 3] * c[(i + 2) % 3] - b[(i + 2) % 3] * c[(i + 1) % 3]) for i in range(3))
    return (det > 0) - (det < 0)


def signs(points, faces):
    """The sign of each face: doubles where they tell, exact where they do not."""
    corners = points[faces]
    det = np.linalg.det(corners)
    sign = np.sign(det).astype(int)
    for f in np.flatnonzero(np.abs(det) < 1e-14):
        sign[f] = exact_sign(*corners[f])
    return sign


def solid_angles(a, b, c):
    det = np.einsum("ij,ij->i", a, np.cross(b - a, c - a))
    dots = np.einsum("ij,ij->i", a, b) + np.einsum("ij,ij->i", b, c) + np.einsum("ij,ij->i", c, a)
    return 2 * np.arctan2(det, 1 + dots)


def in_one_orientation(sphere, triangles):
    faces = triangles.copy()
    faces[sphere.turned] = faces[sphere.turned][:, [0, 2, 1]]
    return faces


def assert_sphere(sphere, triangles):
    """Finite; upright in exact arithmetic as the report says; caps round; covered once if converged."""
    faces = in_one_orientation(sphere, triangles)
    assert np.isfinite(sphere.points).all() and np.isfinite(sphere.uv).all() and np.isfinite(sphere.caps).all()
    assert np.abs(np.linalg.norm(sphere.points, axis=1) - 1).max() < 1e-12
    turned_over = np.flatnonzero(signs(sphere.points, faces) <= 0)
    assert len(turned_over) == sphere.on_sphere["flipped"]
    for loop, cap in zip(sphere.loops, sphere.caps, strict=True):
        on = np.setdiff1d(loop["vertices"], loop["off_circle"])
        assert np.abs(sphere.points[on] @ cap[:3] - np.cos(cap[3])).max(initial=0) < 1e-14
        assert abs(np.linalg.norm(cap[:3]) - 1) < 1e-12 and 0 <= cap[3] <= np.pi
    stored = sphere.uv.astype(np.float32).astype(float)
    assert np.array_equal(stored, sphere.uv)
    areas = signed_areas(stored)
    areas[sphere.turned] *= -1
    assert np.array_equal(np.flatnonzero(areas <= 0), sphere.layout["flipped"])
    assert sphere.layout["flipped"] == sphere.flipped_faces.tolist() and len(sphere.flipped_faces) == sphere.flipped
    if not sphere.converged:
        assert sphere.warnings
        return
    assert sphere.on_sphere["flipped"] == sphere.on_sphere["below_resolution"]
    covered = solid_angles(*sphere.points[faces].transpose(1, 0, 2)).sum()
    for loop in sphere.loops:  # signed, round any point: a multiple of 4 pi apart
        ring = sphere.points[loop["vertices"]]
        ahead = np.roll(ring, -1, axis=0)
        covered += solid_angles(np.broadcast_to(ring[0], ring.shape), ahead, ring).sum()
    assert abs(covered / (4 * np.pi) - round(covered / (4 * np.pi))) < 1e-6
    if not sphere.loops:
        assert round(covered / (4 * np.pi)) == 1


def spheroid_error(frequency, height):
    vertices, triangles = icosphere(frequency)
    vertices = vertices * [1, 1, height]
    sphere = koebe.sphere_map(vertices, triangles)
    assert sphere.converged and not sphere.on_sphere["flipped"]
    assert_sphere(sphere, triangles)
    expected = spheroid_map(vertices, height)
    weights = areas_around(vertices, triangles)
    assert np.linalg.norm(weights @ sphere.points) / weights.sum() < 1e-12
    return np.abs(best_turned(sphere.points, expected, weights) - expected).max()


@pytest.mark.parametrize("height", [0.5, 2.0], ids=["oblate", "prolate"])
@pytest.mark.slow
def test_a_spheroid_is_mapped_with_second_order(height):
    """The isometric latitude; the points' mean is 0 as by symmetry that of the exact map."""
    errors = [spheroid_error(frequency, height) for frequency in (7, 14, 28, 56)]
    assert errors[0] < 5e-3 and errors[0] / errors[3] > 40
    assert errors[1] / errors[2] > 3.5 and errors[2] / errors[3] > 3.5


def test_a_sphere_pushed_by_a_moebius_map_comes_back():
    """What is left is a Moebius map: cross ratios of points stay; and balanced it is the sphere again."""
    points, triangles = icosphere(20)
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    points = points @ (turn * np.sign(np.linalg.det(turn)))  # no vertex at the pole
    sphere = koebe.sphere_map(moved_sphere(points, 0.4 - 0.2j), triangles)
    assert sphere.converged and not sphere.on_sphere["flipped"]
    w, z = in_plane(points), in_plane(sphere.points)
    chosen = np.random.default_rng(1).integers(0, len(points), (500, 4))
    chosen = chosen[[len(set(four)) == 4 for four in chosen.tolist()]]
    ratios = []
    for at in (w, z):
        a, b, c, d = at[chosen].T
        ratios.append((a - c) * (b - d) / ((b - c) * (a - d)))
    assert np.median(np.abs(ratios[1] / ratios[0] - 1)) < 5e-3


def holed_error(steps, height):
    vertices, triangles, _, _, _ = holed_ring(steps, holes=HOLES)
    moved = moved_sphere(vertices, 0.3 + 0.2j)
    sphere = koebe.sphere_map(from_spheroid_map(moved, height), triangles)
    assert sphere.converged and not sphere.on_sphere["flipped"] and len(sphere.caps) == 4
    assert_sphere(sphere, triangles)
    expected = [cap_through(moved[loop["vertices"]], moved) for loop in sphere.loops]
    return max(abs(inversive(sphere.caps[i], sphere.caps[j]) / inversive(expected[i], expected[j]) - 1)
               for i in range(4) for j in range(i))  # fmt: skip


def test_round_holes_of_a_spheroid_become_their_caps_with_second_order():
    """Four round holes of the sphere, carried to a spheroid by the exact conformal map, where they are not round."""
    errors = [holed_error(steps, 2.0) for steps in (12, 24, 48)]
    assert errors[0] < 1e-2
    assert errors[0] / errors[1] > 3.5 and errors[1] / errors[2] > 3.5


@pytest.mark.parametrize("kind", ["closed", "holed"])
def test_the_map_turns_with_the_surface_and_knows_no_scale_and_no_numbers(kind):
    vertices, triangles = icosphere(12) if kind == "closed" else holed_ring(8, holes=HOLES)[:2]
    vertices = vertices * [1.0, 0.7, 1.6] + 0.1 * np.sin(3 * vertices[:, [1, 2, 0]] + [0.4, 1.1, 0.2])
    first = koebe.sphere_map(vertices, triangles)
    moved, faces, number, turn = renumbered(vertices, triangles)
    other = koebe.sphere_map(moved + 3.0, faces)
    assert first.converged and other.converged
    assert np.abs(other.points[number] - first.points @ turn.T).max() < 2e-5
    assert np.abs(np.sort(first.caps[:, 3]) - np.sort(other.caps[:, 3])).max(initial=0) < 1e-5


@pytest.mark.parametrize("kind", ["closed", "holed"])
def test_the_map_is_balanced(kind):
    """The mean over the area of log(area on the surface / area on the sphere) has its least value, whichever way one
    moves; its gradient is the mean of the points."""
    vertices, triangles = icosphere(10) if kind == "closed" else holed_ring(8, holes=HOLES)[:2]
    vertices = vertices * [1.0, 0.7, 1.6] + [0.2, 0.1, 0] * vertices[:, 2:] ** 2
    sphere = koebe.sphere_map(vertices, triangles)
    weights = areas_around(vertices, triangles)
    assert np.linalg.norm(weights @ sphere.points) / weights.sum() < 1e-9
    assert sphere.mean_point < 1e-9
    for seed in range(20):
        step = np.random.default_rng(seed).normal(size=3)
        step *= 0.3 / np.linalg.norm(step)
        # log of the area's growth under the Moebius map of the ball that brings `step` to the centre
        growth = 2 * np.log((1 - step @ step) / ((sphere.points - step) ** 2).sum(axis=1))
        assert -(weights @ growth) > 0


def test_any_number_of_threads_gives_the_same_bits():
    vertices, triangles = icosphere(72)  # more than 50,000 vertices: the matrices are factored in pieces
    vertices = vertices * [1.0, 0.8, 1.3]
    one, three = (koebe.sphere_map(vertices, triangles, threads=threads) for threads in (1, 3))
    assert one.converged and np.array_equal(one.points, three.points) and np.array_equal(one.uv, three.uv)
    assert min(one.seconds[stage] for stage in ("topology", "metric", "factor", "iterate", "finish")) > 0


TETRAHEDRON = np.array([(1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1)], float)
TETRAHEDRON_FACES = np.array([(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)], np.int32)


def test_the_smallest_closed_surface_is_mapped():
    sphere = koebe.sphere_map(TETRAHEDRON, TETRAHEDRON_FACES)
    assert sphere.converged and not sphere.on_sphere["flipped"]
    assert_sphere(sphere, TETRAHEDRON_FACES)
    assert np.abs(sphere.points - TETRAHEDRON / np.sqrt(3)).max() < 1e-4
    for seed in range(4):
        vertices = TETRAHEDRON + np.random.default_rng(seed).normal(0, 0.4, (4, 3))
        sphere = koebe.sphere_map(vertices, TETRAHEDRON_FACES)
        assert_sphere(sphere, TETRAHEDRON_FACES)
        assert sphere.converged


def test_one_and_two_triangles_are_mapped():
    """A balanced triangle is a hemisphere, which no triangle with arcs as sides is: it is drawn together."""
    square = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0.2), (0, 1, 0)], float)
    for faces in ([(0, 1, 2)], [(0, 1, 2), (0, 2, 3)]):
        faces = np.array(faces, np.int32)
        sphere = koebe.sphere_map(square[: faces.max() + 1], faces, most_lost=1)
        assert_sphere(sphere, faces)
        assert sphere.converged and not sphere.on_sphere["flipped"] and len(sphere.caps) == 1


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
def test_the_layout_is_the_sphere(layout):
    """Corners lead back to their points, up to the pattern's own symmetry, but for few moved faces; both sides of every
    edge agree."""
    vertices, triangles = icosphere(14)
    sphere = koebe.sphere_map(vertices * [1, 1, 1.5], triangles, layout=layout)
    layout_report = sphere.layout
    assert layout_report["kind"] == layout and layout_report["crossing"]
    assert sphere.converged and not layout_report["torn"] and not layout_report["flipped"]
    still = np.ones(len(triangles), bool)
    still[layout_report["moved"]] = False
    assert still.mean() > 0.9
    uv = sphere.uv
    points = sphere.points[triangles]
    if layout == "equirectangular":
        assert uv.min() >= 0 and uv[..., 0].max() < 2 and uv[..., 1].max() <= 1
        longitude, latitude = 2 * np.pi * uv[..., 0] - np.pi, np.pi * uv[..., 1] - np.pi / 2
        back = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude),
                         np.sin(latitude)], axis=-1)  # fmt: skip
        assert np.abs(back - points)[still].max() < 2e-6
        beyond = (uv[..., 0] >= 1).any(axis=1)
    else:
        assert uv.min() >= -1 and uv.max() <= 2
        beyond = ((uv < 0) | (uv > 1)).any(axis=(1, 2))
        at = 2 * uv - 1
        for axis in (0, 1):  # the half turns round the middles of the sides, as far as it needs them
            for side in (1, -1):
                over = side * at[..., axis] > 1
                middle = np.zeros(2)
                middle[axis] = side
                at[over] = 2 * middle - at[over]
        z = 1 - np.abs(at).sum(axis=-1)
        lower = z < 0
        x = np.where(lower, np.copysign(1 - np.abs(at[..., 1]), at[..., 0]), at[..., 0])
        y = np.where(lower, np.copysign(1 - np.abs(at[..., 0]), at[..., 1]), at[..., 1])
        back = np.stack([x, y, z], axis=-1)
        back /= np.linalg.norm(back, axis=-1, keepdims=True)
        assert np.abs(back - points)[still].max() < 2e-6
    assert set(np.flatnonzero(beyond)) <= set(layout_report["crossing"])
    sides = {}
    for f, face in enumerate(triangles):
        for k in range(3):
            sides[face[k], face[(k + 1) % 3]] = uv[f, k], uv[f, (k + 1) % 3]
    joined = 0
    for (a, b), (start, end) in sides.items():
        other_end, other_start = sides[b, a]
        if layout == "equirectangular" and {start[1], end[1]} & {0.0, 1.0}:  # at a pole u has no meaning
            continue
        joined += 1
        if layout == "equirectangular":
            assert np.array_equal(end - start, other_end - other_start)
            assert (start - other_start)[0] in (-1, 0, 1) and (start - other_start)[1] == 0
        else:  # the same, or turned by half a turn
            same = np.array_equal(end - start, other_end - other_start)
            assert same or np.array_equal(end - start, other_start - other_end)
            shift = start - other_start if same else start + other_start
            assert np.array_equal(shift, np.rint(shift))
    assert joined > 0.98 * len(sides)


def bumpy_ball(random):
    """A smooth blob of a random mesh, turned and renumbered at random."""
    vertices, triangles = icosphere(int(random.integers(2, 12)))
    if random.random() < 0.5:  # rings of longitude, with many faces round two vertices
        count, rings = int(random.integers(5, 24)), int(random.integers(3, 14))
        angle, height = 2 * np.pi * np.arange(count) / count, np.pi * np.arange(1, rings + 1) / (rings + 1)
        ring = np.stack([np.outer(np.sin(height), np.cos(angle)), np.outer(np.sin(height), np.sin(angle)),
                         np.outer(np.cos(height), np.ones(count))], axis=-1).reshape(-1, 3)  # fmt: skip
        vertices = np.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
        i, j = (n.ravel() for n in np.meshgrid(np.arange(count), np.arange(rings - 1)))
        a, b = j * count + i, j * count + (i + 1) % count
        k, after = np.arange(count), (np.arange(count) + 1) % count
        last = (rings - 1) * count
        triangles = np.concatenate([
            np.stack([a, a + count, b + count], axis=1), np.stack([a, b + count, b], axis=1),
            np.stack([np.full(count, rings * count), k, after], axis=1),
            np.stack([np.full(count, rings * count + 1), last + after, last + k], axis=1)])  # fmt: skip
    size = np.ones(len(vertices))
    for _ in range(random.integers(1, 6)):
        size += random.uniform(0.05, 0.2) * np.sin(vertices @ random.normal(size=3) * 2 + random.uniform(0, 6))
    moved, faces, _, _ = renumbered(vertices * np.maximum(size, 0.4)[:, None], triangles, int(random.integers(1 << 30)))
    return moved, faces


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
@pytest.mark.parametrize("seed", range(24))
def test_no_face_of_a_blob_is_flipped_in_the_layout(layout, seed):
    """However it is turned; and each place of the UVs is covered at most once."""
    random = np.random.default_rng(seed)
    vertices, triangles = bumpy_ball(random)
    sphere = koebe.sphere_map(vertices, triangles, layout=layout)
    assert_sphere(sphere, triangles)
    assert sphere.converged and not sphere.flipped and not sphere.layout["torn"]
    a, b = (sphere.uv[:, k] - sphere.uv[:, 0] for k in (1, 2))
    areas = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    if layout == "octahedral":  # the pattern fills the square
        assert abs(areas.sum() / 2 - 1) < 1e-9
        return
    places = random.random((100, 2))
    covered = np.zeros(100, int)
    for turn in (0, 1):
        d = places[None] + [turn, 0] - sphere.uv[:, :1]
        s = (d[..., 0] * b[:, None, 1] - d[..., 1] * b[:, None, 0]) / areas[:, None]
        t = (a[:, None, 0] * d[..., 1] - a[:, None, 1] * d[..., 0]) / areas[:, None]
        covered += ((s > 1e-9) & (t > 1e-9) & (s + t < 1 - 1e-9)).sum(axis=0)
    assert covered.max() == 1


def joined_at_random(random, triangles, most):
    """(F,) numbers of polygons: trees of up to `most` triangles, no vertex inside."""
    sides = {}
    for f, face in enumerate(triangles.tolist()):
        for k in range(3):
            sides.setdefault(frozenset((face[k], face[(k + 1) % 3])), []).append(f)
    polygon = np.full(len(triangles), -1)
    for seed in random.permutation(len(triangles)):
        if polygon[seed] >= 0:
            continue
        polygon[seed], size, vertices, ring = seed, 1, set(triangles[seed].tolist()), [int(seed)]
        while size < most and ring:
            f = ring.pop(0)
            face = triangles[f].tolist()
            for k in range(3):
                for g in sides[frozenset((face[k], face[(k + 1) % 3]))]:
                    new = set(triangles[g].tolist()) - vertices
                    if polygon[g] < 0 and len(new) == 1 and size < most:  # a new vertex: a tree
                        polygon[g], size = seed, size + 1
                        vertices |= new
                        ring.append(g)
    return polygon


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
@pytest.mark.parametrize("seed", range(12))
def test_polygons_are_whole_in_the_layout(layout, seed):
    """Each corner of a polygon has one place, which is its point; none is torn but round the layout's few points."""
    random = np.random.default_rng(seed)
    vertices, triangles = icosphere(int(random.integers(2, 12)))
    if seed % 3:
        vertices = vertices @ np.linalg.qr(random.normal(size=(3, 3)))[0]
        triangles = triangles[:, ::-1].copy() if np.linalg.det(vertices[triangles[0]]) < 0 else triangles
    vertices = vertices * [1, 1.2, 1.5]
    if seed % 2:
        triangles = np.delete(triangles, random.choice(len(triangles), 3, replace=False), 0)
    polygon = joined_at_random(random, triangles, int(random.choice([2, 3, 8])))
    single = koebe.sphere_map(vertices, triangles, layout=layout)
    sphere = koebe.sphere_map(vertices, triangles, layout=layout, polygon=polygon)
    assert np.array_equal(single.points, sphere.points)
    stored = sphere.uv.astype(np.float32).astype(float)
    assert np.array_equal(stored, sphere.uv)
    torn = np.isin(polygon, polygon[sphere.layout["torn"] + sphere.layout["moved"]])
    places = {}
    for f in range(len(triangles)):
        for k in range(3):
            places.setdefault((polygon[f], triangles[f, k]), set()).add(tuple(sphere.uv[f, k].tolist()))
    assert all(len(found) == 1 for found in places.values())
    assert any(len({tuple(p) for f in np.flatnonzero(polygon == one) for p in single.uv[f][triangles[f] == v]}) > 1
               for one, v in places) or len(triangles) < 100  # fmt: skip
    points = sphere.points[triangles[~torn]].reshape(-1, 3)
    pole = np.hypot(points[:, 0], points[:, 1]) == 0.0
    assert np.abs(led_back(sphere.uv[~torn].reshape(-1, 2), layout) - points)[~pole].max() < 3e-6
    low, high = ((0, 0), (2, 1)) if layout == "equirectangular" else ((-2, -2), (2, 2))
    assert (sphere.uv >= low).all() and (sphere.uv <= high).all()
    assert sphere.converged == (not sphere.layout["flipped"] and not sphere.layout["torn"])


def test_a_vertex_at_a_pole_has_a_place():
    vertices, triangles = icosphere(1)
    sphere = koebe.sphere_map(vertices @ np.array([[0, 0, 1], [1, 0, 0], [0, 1, 0]]), triangles)
    assert np.isfinite(sphere.uv).all()


def random_surface(random):
    if random.random() < 0.5:
        vertices, triangles = icosphere(int(random.integers(1, 10)))
        return vertices, triangles
    holes = {}
    for _ in range(random.integers(0, 5)):
        radius = random.uniform(0.08, 0.4)
        holes[int(random.integers(0, 4)), int(random.integers(0, 2))] = (
            tuple(random.uniform(radius + 0.05, 0.95 - radius, 2)), radius)  # fmt: skip
    return holed_ring(int(random.integers(3, 9)), holes=holes)[:2]


@pytest.mark.parametrize("seed", range(24))
def test_random_surfaces_are_mapped_or_refused(seed):
    random = np.random.default_rng(seed)
    vertices, triangles = damaged(random, *random_surface(random), noise=0.05)
    if random.random() < 0.1:  # a long limb
        vertices[:, 0] += np.clip(vertices[:, 0] - 0.6, 0, 1) * random.uniform(5, 80)
    before = vertices.copy(), triangles.copy()
    layout = ["equirectangular", "octahedral"][seed % 2]
    try:
        assert_sphere(koebe.sphere_map(vertices, triangles, layout=layout), triangles)
    except koebe.KoebeError as error:
        assert str(error)
    assert np.array_equal(vertices, before[0], equal_nan=True) and np.array_equal(triangles, before[1])


def test_a_point_that_is_off_is_seen():
    vertices, triangles = icosphere(6)
    sphere = koebe.sphere_map(vertices, triangles)
    assert_sphere(sphere, triangles)
    vars(sphere)["points"] = sphere.points.copy()
    a, b, c = sphere.points[triangles[7]]
    far = 3 * (b + c) / 2 - 2 * a  # beyond the opposite side
    sphere.points[triangles[7, 0]] = far / np.linalg.norm(far)
    with pytest.raises(AssertionError):
        assert_sphere(sphere, triangles)


def test_what_has_no_map_to_the_sphere_is_refused():
    with pytest.raises(koebe.TopologyError, match="handles") as caught:
        koebe.sphere_map(*holed_torus(3)[:2])
    assert caught.value.kind == "genus"
    vertices, triangles = icosphere(2)
    both = np.concatenate([triangles, triangles + len(vertices)])
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.sphere_map(np.concatenate([vertices, vertices + 3]), both)
    assert caught.value.kind == "disconnected"
    fin = np.concatenate([triangles, [[triangles[0, 0], triangles[0, 1], len(vertices)]]]).astype(np.int32)
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.sphere_map(np.concatenate([vertices, [[2, 2, 2]]]), fin)
    assert caught.value.kind == "nonmanifold_edge"
    broken = vertices.copy()
    broken[3] = np.nan
    with pytest.raises(koebe.InputError):
        koebe.sphere_map(broken, triangles)
    with pytest.raises(koebe.InputError):
        koebe.sphere_map(0 * vertices, triangles)
    with pytest.raises(koebe.OptionError):
        koebe.sphere_map(vertices, triangles, layout="mercator")
    with pytest.raises(koebe.OptionError):
        koebe.sphere_map(vertices, triangles, tolerance=-1)


@pytest.mark.slow
def test_a_needle_too_long_for_doubles_says_so():
    vertices, triangles = icosphere(18)
    sphere = koebe.sphere_map(vertices * [1, 1, 300], triangles)
    assert_sphere(sphere, triangles)
    assert "below_resolution" in {warning.kind for warning in sphere.warnings}


def test_a_coarse_surface_that_would_be_turned_over_is_opened_at_a_vertex():
    vertices, triangles = icosphere(4)
    vertices = vertices + np.random.default_rng(3).normal(0, 0.03, vertices.shape)
    vertices[:, 0] += 60 * np.clip(vertices[:, 0] - 0.6, 0, 1)
    sphere = koebe.sphere_map(vertices, triangles, most_lost=1)
    assert_sphere(sphere, triangles)
    assert sphere.converged and not sphere.on_sphere["flipped"]
    assert "opened at a vertex" in " ".join(warning.text for warning in sphere.warnings)


@pytest.mark.parametrize("layout", ["equirectangular", "octahedral"])
def test_the_command_says_what_python_says(layout, tmp_path):
    surface = icosphere(6) if layout == "octahedral" else holed_ring(5, holes=HOLES)[:2]
    write_obj(tmp_path / "in.obj", *surface)
    words = ("sphere", "in.obj", "out.obj", "--layout", layout, "--json", "out.json", "--svg", "out.svg", "--sphere")
    assert "0 flipped" in succeeded(*words, "sphere.obj", cwd=tmp_path).stdout
    sphere = koebe.sphere_map(*surface, layout=layout)
    assert same_as_package(json.loads((tmp_path / "out.json").read_text()), sphere)
    assert np.isin(np.unique(sphere.uv.reshape(-1, 2), axis=0), obj_rows(tmp_path / "out.obj", "vt")).all()
    assert np.allclose(obj_rows(tmp_path / "out.obj", "v"), surface[0])
    assert np.abs(obj_rows(tmp_path / "sphere.obj", "v") - sphere.points).max() < 1e-9
    assert (tmp_path / "out.svg").read_text().startswith("<svg")
    write_obj(tmp_path / "torus.obj", *holed_torus(3)[:2])
    refused = run("sphere", "torus.obj", "no.obj", "--sphere", "no2.obj", cwd=tmp_path)
    assert refused.returncode == CANNOT_BE_MAPPED and "TopologyError" in refused.stderr
    assert not (tmp_path / "no.obj").exists() and not (tmp_path / "no2.obj").exists()
    assert run(*words, "sphere.stl", cwd=tmp_path).returncode == USAGE
