"""Landmarks of a correspondence: exact, one to one, as little distorted as can be, or a typed error."""

import json
import warnings

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, perforated, succeeded, triangles_of
from cli_support import koebe as command

HOLES = ((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))


def mapped(n, holes=HOLES, flat=False):
    vertices, quads = perforated(n, holes)
    vertices[:, 2] *= not flat
    return koebe.uniformize(vertices, triangles_of(quads).astype(np.int32))


def inside(result):
    return np.setdiff1d(np.arange(result.vertex_count), np.concatenate(result.loops))


A, B = mapped(32), mapped(24)
OTHER = mapped(12, ((0.32, 0.33, 0.1), (0.68, 0.3, 0.12), (0.5, 0.7, 0.12)))
SMALL = mapped(14)
A_VERTICES = A.surface[0]
SMALL_VERTICES, SMALL_FACES = SMALL.surface


def test_where_the_conformal_map_sends_them_landmarks_bend_nothing():
    plain = koebe.transfer(A, B)
    chosen = inside(B)[::37]
    held = koebe.transfer(A, B, landmarks=[(plain.points[v], int(v)) for v in chosen])
    assert held.flipped == 0 and held.beltrami["mean"] < 1e-3 and held.beltrami["max"] < 0.02
    assert np.allclose(held.points, plain.points, atol=1e-3)
    itself = koebe.transfer(A, A, landmarks=[(int(v), int(v)) for v in inside(A)[::50]])
    assert itself.beltrami["max"] < 1e-9 and np.allclose(itself.points, A_VERTICES, atol=1e-6)


def test_what_an_automorphism_can_do_bends_nothing():
    disk, ring = mapped(16, ()), mapped(24, HOLES[:1])
    rng = np.random.default_rng(1)
    rim, hole = ([v for v in r.loops[k].tolist() if v not in r.off_circle[k]] for r, k in ((disk, 0), (ring, 1)))
    middle = [int(v) for v in inside(disk) if np.linalg.norm(disk.uv[v]) < 0.8]
    pairs = [[tuple(int(v) for v in rng.choice(middle, 2))] for _ in range(8)]
    pairs += [[pair, (rim[3], rim[8])] for (pair,) in pairs[:3]]  # and a point of the rim
    pairs += [[(rim[i], rim[j]) for i, j in ((3, 5), (20, 19), (40, 44))]]
    for landmarks in pairs:
        bent = koebe.transfer(disk, disk, landmarks=landmarks)
        assert bent.beltrami["mean"] < 1e-9 and bent.flipped == 0, landmarks
        for on_a, on_b in landmarks:
            assert np.linalg.norm(bent.points[on_b] - disk.surface[0][on_a]) < 1e-9
    assert koebe.transfer(ring, ring, landmarks=[(hole[0], hole[7])]).beltrami["mean"] < 1e-9


@pytest.mark.parametrize("stretch", [2.0, 0.4])
def test_landmarks_tell_which_holes_correspond(stretch):
    vertices, faces = SMALL_VERTICES, SMALL_FACES
    wide = koebe.uniformize(vertices * [stretch, 1.0, 1.0], faces)
    chosen = [int(v) for v in inside(SMALL)[::40]]
    assert koebe.transfer(SMALL, wide).alignment.match != [0, 1, 2, 3]  # the nearest module takes one for another
    bent = koebe.transfer(SMALL, wide, landmarks=[(v, v) for v in chosen])
    assert bent.alignment.match == [0, 1, 2, 3] and bent.flipped == 0
    assert np.allclose(bent.points[chosen], vertices[chosen], atol=1e-9)


def test_holes_of_other_sizes_are_fitted():
    # Harmonic steps alone turn faces over from the small hole to the large one.
    wide, narrow = (mapped(24, holes, flat=True) for holes in (((0.5, 0.5, 0.45),), ((0.5, 0.5, 0.05),)))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for a, b in ((narrow, wide), (wide, narrow)):
            places = koebe.transfer(a, b)
            assert places.fitted and places.flipped == 0 and koebe.distortion(*a.surface, places.uv)["flipped"] == 0
        assert not koebe.transfer(narrow, wide, fit=False).fitted


def moved(points, by=0.03):
    """A diffeomorphism of the square that leaves its rim, and nearly the holes, where they are."""
    x, y = points[:, 0], points[:, 1]
    weight = np.sin(np.pi * x) ** 2 * np.sin(np.pi * y) ** 2
    for *middle, radius in HOLES:
        weight = weight * (1.0 - np.exp(-(((np.hypot(x - middle[0], y - middle[1]) - radius) / 0.1) ** 2)))
    return points + by * weight[:, None] * [1.0, -1.0, 0.0]


def test_landmarks_moved_by_a_diffeomorphism_lie_exactly_and_turn_no_face_over():
    a, b = mapped(32, flat=True), mapped(24, flat=True)
    expected = moved(b.surface[0], 0.08)
    chosen = inside(b)[::5]
    plain = koebe.transfer(a, b)
    bent = koebe.transfer(a, b, landmarks=[(expected[v], int(v)) for v in chosen])
    assert np.linalg.norm(bent.points[chosen] - expected[chosen], axis=1).max() < 1e-9
    assert bent.flipped == 0 and 0.01 < bent.beltrami["mean"] < 0.1 and bent.beltrami["max"] < 0.9
    errors = [np.linalg.norm(places.points - expected, axis=1).mean() for places in (plain, bent)]
    assert errors[1] < 0.4 * errors[0]  # the others follow


def test_the_distortion_does_not_gather_at_a_landmark_on_finer_meshes():
    # With the second power of |mu| the mean would fall with the mesh width, and the spike at the landmark rise.
    means = []
    for n in (16, 64):
        a = mapped(n, HOLES[2:], flat=True)
        vertices = a.surface[0]

        def nearest(x, y, vertices=vertices):
            return int(np.argmin(np.hypot(vertices[:, 0] - x, vertices[:, 1] - y)))

        bent = koebe.transfer(a, a, landmarks=[(nearest(0.25, 0.25), nearest(0.375, 0.25)), (nearest(0.75, 0.25),) * 2])
        means.append(bent.beltrami["mean"])
    assert means[1] > 0.75 * means[0]


def test_landmarks_at_rims_slide_along_them():
    a = mapped(32, flat=True)
    loop = a.loops[1]
    pairs = [(int(loop[2]), int(loop[3])), (int(loop[10]), int(loop[10]))]
    bent = koebe.transfer(a, a, landmarks=pairs)
    for on_a, on_b in pairs:
        assert np.allclose(bent.points[on_b], a.surface[0][on_a], atol=1e-9)
    for rim, off, center, radius in zip(a.loops, a.off_circle, a.centers, a.radii, strict=True):
        on = np.setdiff1d(rim, off)
        assert np.allclose(np.linalg.norm(bent.uv[on] - center, axis=1), radius, atol=1e-9)
    assert bent.flipped == 0 and bent.beltrami["max"] > 0.01


RIM, HOLE = int(A.loops[0][0]), int(A.loops[1][0])
ON_EDGE = 0.5 * (A_VERTICES[A.loops[1][0]] + A_VERTICES[A.loops[1][1]])
FIRST, SECOND = (int(v) for v in inside(A)[[40, 300]])


@pytest.mark.parametrize(
    ("landmarks", "says", "named"),
    [
        ([(FIRST, FIRST), (FIRST, SECOND)], "at one point", [0, 1]),
        ([(FIRST, FIRST), (SECOND, FIRST)], "at one point", [0, 1]),
        ([(FIRST, RIM)], "on a rim of one surface", [0]),
        ([(SECOND, SECOND), (RIM, FIRST)], "on a rim of one surface", [1]),
        ([(RIM, HOLE)], "on a rim of one surface", [0]),
        ([(FIRST, FIRST), (ON_EDGE, HOLE)], "must be vertices", [1]),
        ([(FIRST, (5.0, 5.0, 5.0))], "farther from the surface", [0]),
        ([(FIRST, FIRST), ((0.3, 0.3, 0.1), FIRST)], "farther from the surface", [1]),
        ([(FIRST, 99999)], "belongs to no face", [0]),
        ([(FIRST, FIRST), 3], "no pair", [1]),
        ([(FIRST, (1.0, 2.0))], "neither a vertex nor a point", [0]),
    ],
)
def test_what_excludes_itself_is_told_by_number(landmarks, says, named):
    with pytest.raises(koebe.InputError, match=says) as caught:
        koebe.transfer(A, A, landmarks=landmarks)
    assert (caught.value.elements, caught.value.of) == (named, "landmarks")


def test_the_extremal_map_has_a_smaller_largest_mu_and_a_nearly_constant_one():
    rng = np.random.default_rng(8)
    plain = koebe.transfer(SMALL, OTHER)
    for count in (1, 3, 6):
        chosen = rng.choice(inside(OTHER), count, replace=False)
        pairs = [(plain.points[v] + [*rng.uniform(-0.04, 0.04, 2), 0.0], int(v)) for v in chosen]
        usual, extremal = (koebe.transfer(SMALL, OTHER, landmarks=pairs, extremal=on) for on in (False, True))
        assert extremal.flipped == 0 and extremal.beltrami["max"] < 0.9 * usual.beltrami["max"]
        assert extremal.beltrami["mean"] > 0.5 * extremal.beltrami["max"]
        assert np.allclose(extremal.points[chosen], usual.points[chosen], atol=1e-6)


def test_landmarks_named_twice_count_once():
    once = koebe.transfer(A, A, landmarks=[(FIRST, FIRST)])
    assert np.array_equal(once.points, koebe.transfer(A, A, landmarks=[(FIRST, FIRST)] * 2).points)
    assert np.array_equal(koebe.transfer(A, B).points, koebe.transfer(A, B, landmarks=[]).points)


def hostile(kind, rng, plain):
    """Landmarks (on SMALL, on OTHER), some of which cannot be."""
    whole = OTHER.surface[1][np.isin(OTHER.surface[1], inside(OTHER)).all(axis=1)]
    corners = whole[rng.integers(len(whole))]
    chosen = rng.choice(inside(OTHER), rng.integers(1, 9), replace=False)

    def anywhere():
        sharp = rng.random() < 0.3  # beside a vertex
        weights = np.array([1.0 - 1e-7, 5e-8, 5e-8]) if sharp else rng.dirichlet([1.0, 1.0, 1.0])
        return weights @ SMALL_VERTICES[SMALL_FACES[rng.integers(len(SMALL_FACES))]]

    return {
        "anywhere": lambda: [(anywhere(), int(v)) for v in chosen],
        "near": lambda: [(plain.points[v] + [*0.01 * rng.standard_normal(2), 0.0], int(v)) for v in chosen],
        "swapped": lambda: [(plain.points[corners[1 - k]], int(corners[k])) for k in (0, 1)],
        "turned": lambda: [(plain.points[corners[k - 1]], int(corners[k])) for k in range(3)],
        "equal": lambda: [(anywhere(), int(chosen[0])), (anywhere(), int(chosen[-1]))],
        "vertices": lambda: [(int(rng.integers(SMALL.vertex_count)), int(v)) for v in chosen],
        "one": lambda: [(int(rng.choice(inside(SMALL))), int(chosen[0]))],
        "far": lambda: [(rng.standard_normal(3) * 10 ** rng.uniform(-3, 3), int(v)) for v in chosen],
    }[kind]()


@pytest.mark.parametrize("kind", ["anywhere", "near", "swapped", "turned", "equal", "vertices", "one", "far"])
def test_any_landmarks_are_exact_and_one_to_one_or_named_in_an_error(kind):
    rng, plain = np.random.default_rng(len(kind)), koebe.transfer(SMALL, OTHER)
    done = 0
    for _ in range(12):
        landmarks = hostile(kind, rng, plain)
        try:
            places = koebe.transfer(SMALL, OTHER, landmarks=landmarks)
        except (koebe.InputError, koebe.SolverError) as error:
            assert error.of == "landmarks" and set(error.elements) <= set(range(len(landmarks))) and error.elements
            continue
        done += 1
        assert np.isfinite(places.points).all() and places.flipped == 0 and places.beltrami["max"] < 1.0
        for on_a, on_b in landmarks:
            wanted = SMALL_VERTICES[on_a] if isinstance(on_a, int) else on_a
            found, tolerance = places.points[on_b], 1e-9 if isinstance(on_a, int) else 0.03
            assert np.linalg.norm(found - wanted) < tolerance  # points given beside the surface lie nearest to it
    assert done >= {"near": 4, "swapped": 6, "turned": 4, "one": 1}.get(kind, 0)


def test_the_command_takes_landmarks_from_a_file(tmp_path):
    (tmp_path / "a.obj").write_text(obj_text(*A.surface))
    (tmp_path / "b.obj").write_text(obj_text(*OTHER.surface))
    plain = koebe.transfer(OTHER, A)
    on_a, on_b = [int(v) for v in inside(A)[[100, 500]]], [int(v) for v in inside(OTHER)[[20, 60]]]
    on_b[0] = int(np.argmin(np.linalg.norm(OTHER.surface[0] - plain.points[on_a[0]], axis=1)))
    point = plain.points[on_a[1]]
    where = [" ".join(map(repr, map(float, place))) for place in (A_VERTICES[on_a[1]], point)]
    (tmp_path / "pairs.txt").write_text(f"# a head line\n{on_a[0]}, {on_b[0]}\n\n{where[0]}\t{where[1]}\n")
    files = [tmp_path / name for name in ("a.obj", "b.obj", "out.obj")]
    done = succeeded("transfer", *files, "--landmarks", tmp_path / "pairs.txt", "--json", tmp_path / "out.json")
    assert "|mu|" in done.stdout
    lines = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
    points = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    assert np.allclose(points[on_a[0]], OTHER.surface[0][on_b[0]], atol=1e-8)
    expected = koebe.transfer(OTHER, A, landmarks=[(on_b[0], on_a[0]), (point, on_a[1])])
    assert np.allclose(points, expected.points, atol=1e-6)
    report = json.loads((tmp_path / "out.json").read_text())
    assert report["landmarks"] == 2 and report["flipped"] == 0
    assert np.isclose(report["beltrami"]["max"], expected.beltrami["max"], rtol=1e-4)


@pytest.mark.parametrize(
    ("text", "code", "says"),
    [
        ("1 2 3\n", CANNOT_BE_MAPPED, "line 1"),
        ("40 40\n40 x\n", CANNOT_BE_MAPPED, "line 2"),
        ("-1 3\n", CANNOT_BE_MAPPED, "line 1"),
        ("# nothing\n", CANNOT_BE_MAPPED, "no landmark"),
        ("40 40\n40 300\n", CANNOT_BE_MAPPED, "landmarks 0, 1 [0 1]"),
        (None, CANNOT_BE_MAPPED, "cannot read"),
    ],
)
def test_a_file_of_something_else(tmp_path, text, code, says):
    (tmp_path / "a.obj").write_text(obj_text(*A.surface))
    if text is not None:
        (tmp_path / "pairs.txt").write_text(text)
    before = sorted(path.name for path in tmp_path.iterdir())
    files = (tmp_path / "a.obj", tmp_path / "a.obj", tmp_path / "out.obj")
    done = command("transfer", *files, "--landmarks", tmp_path / "pairs.txt")
    assert done.returncode == code and says in done.stderr
    assert sorted(path.name for path in tmp_path.iterdir()) == before
    assert command("transfer", *files, "--landmarks").returncode == USAGE
