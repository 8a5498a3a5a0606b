"""Extremal maps and Teichmueller distances: against affine maps, which are extremal, and laws of a metric."""

import json
import types

import koebe
import numpy as np
import pytest
from cli_support import USAGE, obj_text, perforated, succeeded, triangles_of
from cli_support import koebe as command
from stretched_cylinders import cylinder, mapped, pair
from uv_measures import signed_areas


def circles(*rows):
    """Circles as a result has them."""
    rows = [(0, 0, 1), *rows]
    return types.SimpleNamespace(centers=np.array([r[:2] for r in rows], float), radii=np.array([r[2] for r in rows]))


def upright(faces, uv):
    return signed_areas(uv[faces]) > 0


@pytest.mark.parametrize("holes, stretch", [(1, 2.0), (2, 1.5), (3, 1.1), (3, 2.0), (5, 1.5)])
def test_a_stretched_cylinder(holes, stretch):
    a, b, match = pair(holes, stretch, 2)
    there, back = koebe.teichmueller(a, b, match=match), koebe.teichmueller(b, a, match=np.argsort(match))
    exact = (stretch - 1) / (stretch + 1)
    for found in (there, back):
        assert pytest.approx(stretch, rel=0.01) == found.K
        assert found.distance == pytest.approx(np.log(found.K) / 2)
        assert found.lower <= found.K <= found.largest < 1.06 * stretch and found.lower > 0.99 * stretch
        assert found.mu.mean() == pytest.approx(exact, rel=0.05) and found.mu.std() < 0.06 * exact
        assert found.flipped == 0
    assert there.distance == pytest.approx(back.distance, rel=0.02)


def test_rims_lie_on_the_other_circles_and_no_face_turns_over():
    a, b, match = pair(3, 2.0)
    found = koebe.teichmueller(a, b, match=match)
    assert np.array_equal(found.match, match) and upright(a.surface[1], found.uv).all()
    for loop, k in zip(a.loops, match, strict=True):
        assert np.allclose(np.linalg.norm(found.uv[loop] - b.centers[k], axis=1), b.radii[k], atol=1e-9)


def coarse_plate(rng):
    """A plate of some 60 vertices with two or three holes, bent at random: its rims are far from their circles."""
    spots = [(0.3, 0.3, 0.11), (0.7, 0.35, 0.12), (0.45, 0.73, 0.1)][: rng.integers(2, 4)]
    vertices, quads = perforated(9, spots)
    return vertices + 0.15 * np.sin(4 * vertices @ rng.normal(size=(3, 3))), triangles_of(quads).astype(np.int32)


@pytest.mark.parametrize("seed", range(6))
def test_no_bound_lies_above_k_of_the_way_back(seed):
    rng = np.random.default_rng(seed)
    vertices, faces = coarse_plate(rng)
    a = koebe.uniformize(vertices, faces)
    b = koebe.uniformize(vertices * [1, rng.uniform(1.1, 2), 1], faces, outer=int(a.loops[0][0]))
    match = koebe.match_loops(a, b).match
    there, back = koebe.teichmueller(a, b, match=match), koebe.teichmueller(b, a, match=np.argsort(match))
    alone = koebe.teichmueller(a, circles(*np.column_stack([b.centers, b.radii])[1:]), match=match)
    pairs = np.triu_indices(len(match), 1)
    ratios = koebe.separations(a)[pairs] / koebe.separations(b)[np.ix_(match, match)][pairs]
    for found in (there, back, alone):
        assert pytest.approx(there.K, rel=1e-6) == found.K and found.lower == pytest.approx(there.lower, rel=1e-6)
        assert np.exp(abs(np.log(ratios)).max()) <= found.lower * (1 + 1e-9)  # no map bends a ring less
        assert found.lower <= found.K <= found.largest


def test_finer_meshes_come_nearer():
    gaps, errors = [], []
    for finer in (1, 2, 3):
        a, b, match = pair(3, 1.5, finer)
        found = koebe.teichmueller(a, b, match=match)
        gaps.append(found.largest / found.lower - 1)
        errors.append(abs(found.K / 1.5 - 1))  # of the circles too, which a coarse mesh has from itself
        assert found.largest > 1.5
    assert gaps[2] < gaps[1] < gaps[0] and gaps[2] < 0.01
    assert errors[2] < errors[1] < errors[0] and errors[2] < 0.002 and found.lower > 1.5 * 0.998


def test_conformal_images_are_at_no_distance():
    a, _ = mapped(3)
    moebius = lambda z: (z - 0.3) / (1 - 0.3 * z)  # noqa: E731
    own = koebe.teichmueller(a, a)
    assert own.distance < 1e-12 and np.allclose(own.uv, a.uv, atol=1e-8)
    ends = a.centers @ [1, 1j] + a.radii * np.exp(2j * np.pi / 3 * np.arange(3))[:, None]
    images = [koebe.fit_circle(np.column_stack([z.real, z.imag])) for z in moebius(ends).T[1:]]
    moved = circles(*[(*center, radius) for center, radius, _ in images])
    assert koebe.teichmueller(a, moved).distance < 1e-3


def test_the_triangle_inequality():
    rng = np.random.default_rng(5)
    vertices, faces = cylinder(3, 2)
    base = koebe.uniformize(vertices, faces, outer=0)
    maps = [base]
    for _ in range(2):  # the same mesh, bent: loops keep their vertices
        bent = vertices * (1 + 0.3 * np.sin(vertices @ rng.normal(size=(3, 3))))
        other = koebe.uniformize(bent, faces, outer=0)
        maps.append(other)
    firsts = [loop.min() for loop in base.loops]
    place = [[int(np.argmax([first in loop for loop in one.loops])) for first in firsts] for one in maps]
    d = np.zeros((3, 3))
    for i in range(3):
        for j in range(3):
            d[i, j] = koebe.teichmueller(maps[i], maps[j], match=np.array(place[j])[np.argsort(place[i])]).distance
    assert np.allclose(d, d.T, rtol=0.03, atol=1e-3) and d[0, 1] > 0.01
    for i, j, k in [(0, 1, 2), (1, 2, 0), (2, 0, 1)]:
        assert d[i, k] <= 1.02 * (d[i, j] + d[j, k])


def test_tori_and_rings_by_their_moduli():
    def torus(periods, steps=12):
        angle = 2 * np.pi * np.arange(steps) / steps
        u, v = np.meshgrid(angle, angle, indexing="ij")
        # Isometric in four dimensions; here a torus of revolution of known modulus.
        r = 1 / np.hypot(1, periods)
        points = np.stack([(1 + r * np.cos(v)) * np.cos(u), (1 + r * np.cos(v)) * np.sin(u), r * np.sin(v)], 2)
        number = np.arange(steps * steps).reshape(steps, steps)
        a, b = number, np.roll(number, -1, 0)
        c, d = np.roll(b, -1, 1), np.roll(a, -1, 1)
        faces = np.concatenate([np.stack([a, b, c], 2), np.stack([a, c, d], 2)]).reshape(-1, 3)
        return koebe.torus_map(points.reshape(-1, 3), faces)

    a, b = torus(1.5), torus(3.0)
    found = koebe.teichmueller(a, b)
    gap = abs(a.modulus - b.modulus) ** 2 / (2 * a.modulus.imag * b.modulus.imag)
    assert pytest.approx(np.arccosh(1 + gap) / 2) == found.distance
    assert np.allclose(found.mu, (found.K - 1) / (found.K + 1)) and found.uv is None
    rings = [koebe.ring_map(*cylinder(1, 1, stretch)) for stretch in (1.0, 2.0)]
    assert pytest.approx(2.0, rel=0.02) == koebe.teichmueller(*rings).K
    with pytest.raises(koebe.InputError, match="torus cannot be compared with a ring"):
        koebe.teichmueller(a, rings[0])
    with pytest.raises(koebe.InputError, match="further holes"):
        koebe.teichmueller(koebe.ring_map(*cylinder(2)), rings[0])
    with pytest.raises(TypeError):
        koebe.teichmueller(a, mapped(1)[0])


def test_refusals():
    a, _ = mapped(2)
    for wrong, words in [
        (circles((0, 0, 0.2)), "3 and 2 loops"),
        (circles((0, 0, 0.2), (0.1, 0, 0.2)), "meet"),
        (circles((0, 0, 0.2), (0.95, 0, 0.2)), ""),
        (circles((0, 0, 0.2), (0.5, 0, np.nan)), ""),
        (circles((0, 0, 0.2), (0.5, 0, -0.1)), ""),
        (object(), "no circles"),
    ]:
        with pytest.raises(koebe.InputError, match=words):
            koebe.teichmueller(a, wrong)
    for match in ([0, 1], [1, 0, 2], [0, 1, 1], [0, 1, 5], []):
        with pytest.raises(koebe.InputError):
            koebe.teichmueller(a, a, match=match)
    with pytest.raises(TypeError):
        koebe.teichmueller(circles((0, 0, 0.2)), a)
    tiny = circles(*[(*center, radius * 1e-8) for center, radius in zip(a.centers[1:], a.radii[1:], strict=True)])
    with pytest.raises(koebe.InputError, match="b's circle 1 has the radius") as caught:
        koebe.teichmueller(a, tiny, match=range(len(a.loops)))
    assert list(caught.value.elements) == [1]


def test_the_command(tmp_path):
    paths = [tmp_path / name for name in ("a.obj", "b.obj")]
    for path, stretch in zip(paths, (1.0, 1.5), strict=True):
        points, faces = cylinder(2, 2, stretch)
        points[points[:, 2] == 0, :2] *= 1.001  # the longest loop in both
        path.write_text(obj_text(points, faces))
    run = succeeded("compare", *paths, "--teichmueller")
    assert float(run.stdout.split()[1]) == pytest.approx(np.log(1.5) / 2, rel=0.05)
    report = json.loads(command("compare", *paths, "--teichmueller", "--json").stdout)
    found = report["teichmueller"]
    assert report["distance"] == found["distance"] == pytest.approx(np.log(found["dilatation"]) / 2)
    assert found["lower"] <= found["dilatation"] <= found["largest"] and found["flipped"] == 0
    assert command("compare", *paths, "--teichmueller", "--any-outer").returncode == USAGE
