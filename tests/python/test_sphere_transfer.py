"""Closed surfaces laid over each other through their spheres."""

import copy
import warnings

import koebe
import numpy as np
import pytest
from koebe.labs import sphere_alignment as alignment
from koebe.labs import sphere_transfer as inner


def potato(rounds, seed=3):
    """A closed, bumpy surface of 20 * 4^rounds triangles, stretched and without symmetry."""
    t = (1 + 5**0.5) / 2
    points = np.array([(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t),
                       (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)])  # fmt: skip
    faces = np.array([(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2),
                      (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5),
                      (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)])  # fmt: skip
    points = points / np.linalg.norm(points, axis=1)[:, None]
    for _ in range(rounds):
        ends = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
        edges, number = np.unique(ends, axis=0, return_inverse=True)
        middle = points[edges].mean(axis=1)
        a, b, c = (number.reshape(-1, 3) + len(points)).T
        points = np.concatenate([points, middle / np.linalg.norm(middle, axis=1)[:, None]])
        x, y, z = faces.T
        faces = np.concatenate([np.stack(f, 1) for f in ((x, a, c), (a, y, b), (c, b, z), (a, b, c))])
    waves = np.random.default_rng(seed).normal(size=(5, 3)) * 2.5
    height = 1 + 0.08 * np.sin(points @ waves.T + np.arange(5)).sum(axis=1)
    return points * height[:, None] * [1.0, 1.2, 1.4], faces, points


POINTS, FACES, ROUND = potato(3)
FINE = potato(4)
SPHERE = koebe.sphere_map(POINTS, FACES)
TURN = alignment._rotations(np.array([[0.5, -0.1, 0.7, 0.5]]) / np.linalg.norm([0.5, -0.1, 0.7, 0.5]))[0]


def depth(directions):
    """A field without symmetry."""
    waves = np.random.default_rng(11).normal(size=(6, 3)) * 2.0
    return np.cos(directions @ waves.T + np.arange(6)).sum(axis=1)


def moved(result, matrix):
    other = copy.copy(result)
    vars(other)["points"] = alignment.applied(matrix, result.points)
    return other


def test_a_surface_corresponds_to_itself():
    places = koebe.transfer(SPHERE, SPHERE)
    assert np.allclose(places.points, POINTS, atol=1e-9)
    assert (places.weights >= 0).all() and np.allclose(places.weights.sum(axis=1), 1.0)
    assert np.array_equal(places.carry(np.arange(len(POINTS))), np.arange(len(POINTS)))
    assert np.allclose(koebe.transfer(SPHERE, SPHERE, POINTS[:, 0]), POINTS[:, 0])
    assert repr(places) == f"<koebe.SphereCorrespondence {len(POINTS)} points, turned by 0 deg>"
    assert "1 landmarks miss" in repr(koebe.transfer(SPHERE, SPHERE, landmarks=[(0, 0)]))


def test_a_point_lies_in_the_triangle_that_is_found():
    random = np.random.default_rng(2)
    places = random.normal(size=(4000, 3))
    places /= np.linalg.norm(places, axis=1)[:, None]
    for result in (SPHERE, moved(SPHERE, alignment._near_identity(np.array([0.3, 0.2, 0.1, 1.4, -0.8, 0.5])))):
        faces, weights = inner._Located(result.points, result.triangles).at(places)
        there = np.einsum("nk,nkc->nc", weights, result.points[FACES[faces]])
        assert np.allclose(there / np.linalg.norm(there, axis=1)[:, None], places, atol=1e-9)


@pytest.mark.slow
def test_a_finer_mesh_of_the_surface_corresponds_point_by_point():
    fine = koebe.sphere_map(*FINE[:2])
    places = koebe.transfer(SPHERE, fine, fields=(depth(ROUND), depth(FINE[2])))
    size = np.linalg.norm(np.ptp(POINTS, axis=0))
    away = np.linalg.norm(places.points - FINE[0], axis=1) / size
    assert np.median(away) < 0.01 and away.max() < 0.04 and places.similarity > 0.99


def test_landmarks_turn_a_turned_surface_back():
    turned = koebe.sphere_map(POINTS @ TURN.T, FACES)
    spun = moved(turned, alignment._turned(alignment._rotations(np.array([[0.1, 0.9, -0.3, 0.2]]) / np.sqrt(0.95))[0]))
    places = koebe.transfer(SPHERE, spun, landmarks=[(5, 5), (100, 100), (tuple(POINTS[222]), 222)])
    assert places.misses_deg.max() < 1e-4 and np.isclose(places.alignment[0, 0], 1.0)
    assert np.allclose(places.points, POINTS, atol=1e-4)


def test_landmarks_find_a_moebius_map():
    matrix = alignment._near_identity(np.array([0.4, -0.7, 0.2, 0.5, 0.3, -0.4]))
    other = moved(SPHERE, matrix)
    pairs = [(k, k) for k in (3, 90, 200, 400)]
    rigid = koebe.transfer(SPHERE, other, landmarks=pairs)
    places = koebe.transfer(SPHERE, other, landmarks=pairs, moebius=True)
    assert rigid.misses_deg.max() > 5 and places.misses_deg.max() < 1e-5
    assert np.allclose(places.alignment @ matrix, np.eye(4), atol=1e-7)
    assert np.allclose(places.points, POINTS, atol=1e-6)
    assert np.allclose(places(other.points), SPHERE.points, atol=1e-7)
    form = np.diag([-1.0, 1, 1, 1])
    assert np.allclose(places.alignment.T @ form @ places.alignment, form, atol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("boost", [0.0, 0.35])
def test_a_field_finds_the_turn_and_the_moebius_map(boost):
    matrix = alignment._near_identity(np.array([0.0, 0, 0, boost, -boost / 2, 0])) @ alignment._turned(TURN)
    other = moved(SPHERE, matrix)
    places = koebe.transfer(SPHERE, other, fields=(depth(ROUND), depth(ROUND)), moebius=bool(boost))
    away = np.degrees(np.arccos(np.clip((places(other.points) * SPHERE.points).sum(axis=1), -1, 1)))
    assert places.similarity > 0.999 and away.max() < 1.0


def test_what_cannot_be_laid_over_is_told_so():
    face = koebe.uniformize("blend_samples/face.obj")
    with pytest.raises(koebe.InputError, match="holes"):
        koebe.transfer(SPHERE, koebe.sphere_map("blend_samples/face.obj"))
    with pytest.raises(TypeError, match="not SphereMap"):
        koebe.transfer(face, SPHERE)
    with pytest.raises(koebe.InputError, match="two results of sphere_map"):
        koebe.transfer(face, face, moebius=True)
    for options, says in (
        ({"landmarks": [(0, 0)], "moebius": True}, "three landmarks"),
        ({"landmarks": [(0, 10**6)]}, "no vertex"),
        ({"landmarks": [(0, (1.0, np.nan, 2.0))]}, "neither"),
        ({"landmarks": [(0,)]}, "no pair"),
        ({"landmarks": [(0, 0)], "fields": (ROUND[:, 0], ROUND[:, 0])}, "not both"),
        ({"fields": (ROUND[:, 0], ROUND[1:, 0])}, "field of b"),
        ({"fields": (ROUND[:, 0], np.full(len(ROUND), np.nan))}, "no values"),
        ({"fields": 3}, "pair"),
        ({"match": [0]}, "holes"),
    ):
        with pytest.raises(koebe.InputError, match=says):
            koebe.transfer(SPHERE, SPHERE, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        koebe.transfer(SPHERE, SPHERE, landmarks=[(0, 0)])
