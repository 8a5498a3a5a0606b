"""Families of closed surfaces: their mean, and the distances between them."""

import koebe
import numpy as np
import pytest
from test_sphere_transfer import FACES, POINTS, ROUND, SPHERE, TURN, depth, potato


def waves(k):
    return [depth(ROUND)] * k


def test_turned_copies_have_the_mean_of_the_first_and_no_distance():
    shapes = [SPHERE, koebe.sphere_map(POINTS @ TURN.T + [5.0, 0.0, 1.0], FACES), koebe.sphere_map(POINTS + 3.0, FACES)]
    found = koebe.family(shapes, fields=waves(3), labels=["a", "b", "c"])
    assert found.labels == ["a", "b", "c"] and repr(found) == f"<koebe.SphereFamily 3 shapes, {len(POINTS)} points>"
    assert found.correspondences[0] is None and found.correspondences[1].similarity > 0.999
    size = np.linalg.norm(np.ptp(POINTS, axis=0))
    assert found.distances.max() < 0.01 * size and np.allclose(found.distances, found.distances.T)
    centered = POINTS - found.weights @ POINTS
    assert np.linalg.norm(found.points[0] - (found.mean), axis=1).max() < 0.02 * size
    assert np.allclose(np.linalg.norm(found.points[0], axis=1), np.linalg.norm(centered, axis=1))


def test_distances_are_those_of_known_points():
    grown = koebe.sphere_map(1.1 * POINTS, FACES)
    found = koebe.family([SPHERE, grown], landmarks=[[3, 90, 200]] * 2)
    weights = found.weights[:, None]
    expected = 0.1 * np.sqrt((weights * (POINTS - (weights * POINTS).sum(axis=0)) ** 2).sum())
    assert np.isclose(found.distances[0, 1], expected, rtol=1e-4)
    assert np.allclose(found.mean, 1.05 * found.points[0], atol=1e-3)


def test_two_populations_differ_and_a_bent_family_is_one_to_one():
    shapes = [koebe.sphere_map(potato(2, seed=seed)[0] * [1.0, 1.0, 1.0 + 0.6 * (k % 2)], potato(2)[1])
              for k, seed in enumerate((3, 3, 4, 4, 5, 5))]  # fmt: skip
    found = koebe.family(shapes, landmarks=[[0, 1, 2, 3, 4, 5]] * 6, bend=True)
    assert all(one.misses_deg.max() < 1e-6 for one in found.correspondences[1:])
    test = koebe.permutation_test(found, [0, 1] * 3)
    assert test.exact and test.explained > 0.3


def test_what_is_no_family_is_told_so():
    face = koebe.uniformize("blend_samples/face.obj")
    for shapes, options, says in (
        ([SPHERE, SPHERE], {"order": [0]}, "with holes"),
        ([SPHERE, SPHERE], {"fields": waves(1)}, "fields of 1 shapes"),
        ([SPHERE, SPHERE], {"landmarks": [[0], [0, 1]]}, "2 landmarks"),
        ([face, face], {"bend": True}, "results of sphere_map"),
    ):
        with pytest.raises(koebe.InputError, match=says):
            koebe.family(shapes, **options)
