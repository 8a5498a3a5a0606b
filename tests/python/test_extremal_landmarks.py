"""Extremal maps that keep landmarks, and the match of least K: against affine maps, which are extremal, and laws."""

import json
import types

import koebe
import numpy as np
import pytest
from cli_support import USAGE, obj_text, succeeded
from cli_support import koebe as command
from stretched_rectangles import pair, rectangle
from uv_measures import signed_areas


def upright(faces, uv):
    return bool((signed_areas(uv[faces]) > 0).all())


def bent(holes, rng, strength=0.15):
    """The map of the rectangle, bent in space: loops keep their vertices."""
    points, faces, _ = rectangle(holes)
    return koebe.uniformize(points * (1 + strength * np.sin(points @ rng.normal(size=(3, 3)) / 8)), faces, outer=0)


def partners(a, b):
    firsts = [loop.min() for loop in b.loops]
    return [firsts.index(loop.min()) for loop in a.loops]


@pytest.mark.parametrize("holes, stretch, finer", [(0, 1.5, 1), (0, 2.0, 2), (1, 2.0, 2), (3, 1.5, 2)])
def test_a_stretched_rectangle(holes, stretch, finer):
    a, b, match, corners = pair(holes, stretch, finer)
    there = koebe.teichmueller(a, b, match=match, landmarks=corners)
    back = koebe.teichmueller(b, a, match=np.argsort(match), landmarks=corners)
    for found in (there, back):
        assert pytest.approx(stretch, rel=0.01) == found.K
        assert found.lower <= found.K <= found.largest < 1.05 * stretch and found.lower > 0.97 * stretch
        assert found.mu.mean() == pytest.approx((stretch - 1) / (stretch + 1), rel=0.08) and found.flipped == 0
    assert there.distance == pytest.approx(back.distance, rel=1e-9 if holes == 0 else 0.02)
    assert np.allclose(there.uv[[v for v, _ in corners]], b.uv[[v for _, v in corners]], atol=1e-9)
    assert upright(a.surface[1], there.uv)


def test_more_landmarks_of_the_affine_map_change_nothing():
    a, b, match, corners = pair(3, 2.0, 2)
    inner = np.setdiff1d(np.arange(len(a.uv)), np.concatenate(a.loops))[::97]
    held = koebe.teichmueller(a, b, match=match, landmarks=[*corners, *((int(v), int(v)) for v in inner)])
    assert pytest.approx(2.0, rel=0.01) == held.K and held.largest < 2.15
    assert np.allclose(held.uv[inner], b.uv[inner], atol=1e-9)


def test_quadrilaterals_are_a_metric_space():
    rng = np.random.default_rng(2)
    maps, corners = [bent(0, rng) for _ in range(4)], rectangle(0)[2]
    held = [(int(v), int(v)) for v in corners]
    d = np.array([[koebe.teichmueller(a, b, landmarks=held).distance for b in maps] for a in maps])
    assert np.allclose(d, d.T, atol=1e-9) and np.allclose(np.diag(d), 0, atol=1e-9) and d[0, 1] > 1e-3
    for i in range(4):
        assert (d[i] <= d[i, :, None] + d + 1e-9).all()  # rows j, columns k: d(i, k) <= d(i, j) + d(j, k)


def test_landmarks_raise_the_distance_and_fewer_lower_it():
    rng = np.random.default_rng(3)
    a, b = bent(1, rng), bent(1, rng)
    outer = [(int(v), int(v)) for v in a.loops[0][::9]][:5]
    match = partners(a, b)
    lowers = [koebe.teichmueller(a, b, match=match, landmarks=outer[:k]) for k in (1, 3, 5)]
    for fewer, more in zip(lowers, lowers[1:], strict=False):
        assert fewer.lower <= more.largest and fewer.distance <= 1.02 * more.distance + 1e-3


def test_the_least_match_needs_no_numbers():
    rng = np.random.default_rng(4)
    a, b = bent(3, rng), bent(3, rng)
    least = koebe.teichmueller(a, b, match="least")
    order = [0, 3, 1, 2]
    again = koebe.teichmueller(a, types.SimpleNamespace(centers=b.centers[order], radii=b.radii[order]), match="least")
    assert abs(again.K - least.K) < 1e-9 and np.array_equal(np.array(order)[again.match], least.match)
    assert koebe.teichmueller(b, a, match="least").distance == pytest.approx(least.distance, rel=0.05)


def test_refusals():
    a, b, match, corners = pair(1, 1.5)
    inner = int(np.setdiff1d(np.arange(len(a.uv)), np.concatenate(a.loops))[0])
    for wrong, words in [
        ([(corners[0][0], inner)], "beside the rim"),
        ([(int(a.loops[1][0]), corners[0][1])], "beside the rim"),
        ([corners[0], (corners[0][0], corners[1][1])], "one point"),
        ([(corners[0][0],)], "no pair"),
    ]:
        with pytest.raises(koebe.InputError, match=words) as caught:
            koebe.teichmueller(a, b, match=match, landmarks=wrong)
        assert len(caught.value.elements) > 0
    with pytest.raises(koebe.SolverError) as caught:  # the other way round
        koebe.teichmueller(
            a,
            b,
            match=match,
            landmarks=list(zip([v for v, _ in corners], [corners[k][1] for k in (0, 3, 2, 1)], strict=True)),
        )
    assert len(caught.value.elements) > 0
    with pytest.raises(koebe.InputError, match="least match has no landmarks"):
        koebe.teichmueller(a, b, match="least", landmarks=corners)
    with pytest.raises(TypeError, match="two results of uniformize"):
        koebe.teichmueller(a, types.SimpleNamespace(centers=b.centers, radii=b.radii), landmarks=corners)
    with pytest.raises((TypeError, koebe.InputError)):
        koebe.teichmueller(a, b, match="nearest")
    with pytest.raises(koebe.InputError, match="extremal needs landmarks"):
        koebe.transfer(a, b, extremal=True)
    ring = koebe.ring_map(*rectangle(1)[:2])
    with pytest.raises(koebe.InputError, match="landmarks are for results of uniformize"):
        koebe.teichmueller(ring, ring, landmarks=corners)


def test_too_many_loops_that_are_alike():
    centers = [(0, 0), *((x, y) for x in (-0.4, 0, 0.4) for y in (-0.4, 0, 0.4))]
    even = types.SimpleNamespace(centers=np.array(centers), radii=np.array([1, *[0.1] * 9]))
    points, faces, _ = rectangle(0, 2)
    cell = np.floor(2 * points[faces].mean(axis=1)[:, :2])
    holes = ((cell[:, 0] - 6) % 10 < 4) & (cell[:, 0] > 4) & ((cell[:, 1] - 3) % 7 < 3) & (cell[:, 1] > 1)
    points, faces = points[np.unique(faces[~holes])], np.unique(faces[~holes], return_inverse=True)[1].reshape(-1, 3)
    a = koebe.uniformize(points, faces, outer=0)
    assert len(a.loops) == 10
    with pytest.raises(koebe.InputError, match="too many, or too much alike"):
        koebe.teichmueller(a, even, match="least")


def test_the_command(tmp_path):
    paths = [tmp_path / name for name in ("a.obj", "b.obj", "out.obj")]
    for path, stretch in zip(paths[:2], (1.0, 1.5), strict=True):
        points, faces, corners = rectangle(3, 1, stretch)
        path.write_text(obj_text(points, faces))
    report = json.loads(command("compare", *paths[:2], "--teichmueller", "--loops", "least", "--json").stdout)
    assert report["teichmueller"]["refused"] == 0 and report["distance"] == report["teichmueller"]["distance"]
    plain = json.loads(command("compare", *paths[:2], "--teichmueller", "--json").stdout)
    assert report["distance"] <= plain["distance"]
    assert command("compare", *paths[:2], "--loops", "least").returncode == USAGE
    marks = tmp_path / "marks"
    marks.write_text("".join(f"{v} {v}\n" for v in corners))
    found = {}
    for flags in ([], ["--extremal"]):
        out = tmp_path / "report.json"
        succeeded("transfer", *paths, "--landmarks", marks, "--json", out, *flags)
        found[len(flags)] = json.loads(out.read_text())["beltrami"]["max"]
    assert found[1] < found[0]
    assert command("transfer", *paths, "--extremal").returncode == USAGE
