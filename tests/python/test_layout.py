"""Disks in a square and circles through points: laws. Mirror images: test_mirror.py."""

import koebe
import numpy as np
import pytest


@pytest.mark.parametrize("count", [2, 3, 5, 7, 9, 16, 17, 24, 25, 60])
@pytest.mark.parametrize("margin", [0.0, 0.02, 0.4])
def test_disks_keep_their_proportions_their_distance_and_to_the_square(count, margin):
    sizes = np.random.default_rng(count).uniform(0.2, 3.0, count)
    centers, radii = koebe.pack_disks(sizes, margin)
    kept = min(margin, 0.5 / count)
    assert radii / sizes == pytest.approx(np.full(count, radii[0] / sizes[0]), rel=1e-12)
    first, second = np.triu_indices(count, 1)
    distance = np.linalg.norm(centers[first] - centers[second], axis=1)
    assert (distance - radii[first] - radii[second] >= kept - 1e-9).all()
    assert (np.minimum(centers, 1.0 - centers) - radii[:, None] >= kept / 2 - 1e-9).all()
    if margin < 0.1:
        assert np.pi * (radii**2).sum() > 0.4  # and it wastes no more than this


@pytest.mark.parametrize("count", [12, 14, 16])
def test_small_disks_nest_beside_a_large_one(count):
    _, radii = koebe.pack_disks([3.0] + [1.0] * (count - 1), 0.0)
    assert np.pi * (radii**2).sum() > 0.65  # of the square; 0.71 to 0.77 were found


def test_cut_maps_lie_as_their_disks_are_packed():
    """Two tetrahedra, one twice as large: their disks have the places that pack_disks gives."""
    tetrahedron = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]])
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    result = koebe.uniformize(np.concatenate([tetrahedron, 5 + 2 * tetrahedron]), np.concatenate([faces, faces + 4]),
                              cut=True)  # fmt: skip
    centers, radii = koebe.pack_disks([1.0, 2.0], 8 / 2048)
    found = sorted((piece["place"]["radius"], *piece["place"]["center"]) for piece in result.pieces)
    assert np.allclose(found, np.column_stack([radii, centers]), atol=1e-9)


@pytest.mark.parametrize("radii, margin, told", [
    ([1.0, 0.0], 0.02, "disks to pack need"), ([1.0, np.nan], 0.02, "radii are NaN"),
    ([[1.0]], 0.02, r"radii must have shape \(n,\)"), ([1.0, 1.0], 0.5, "margin must be a number from 0 to below 0.5"),
])  # fmt: skip
def test_what_is_no_disk_is_refused(radii, margin, told):
    with pytest.raises(koebe.InputError, match=told):
        koebe.pack_disks(radii, margin)


def test_points_of_a_circle_have_that_circle_however_they_are_spaced():
    angles = np.sort(np.random.default_rng(2).uniform(0.0, 2.0 * np.pi, 30)) ** 1.2
    points = np.array([3.0, -7.0]) + 0.25 * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    center, radius, off = koebe.fit_circle(points)
    assert center == pytest.approx([3.0, -7.0], abs=1e-12) and radius == pytest.approx(0.25) and off < 1e-13
    points[0] += 0.01 * (points[0] - center) / radius  # one is off
    assert 0.005 < koebe.fit_circle(points)[2] < 0.01
