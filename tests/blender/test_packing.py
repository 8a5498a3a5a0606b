"""Disks in the UV square: laws of `packing`."""

import cmath

import numpy as np
import pytest

pytestmark = pytest.mark.alike


@pytest.fixture
def packing(addon):
    return addon("layers.packing")


@pytest.fixture
def packed(addon, packing):
    return lambda radii, margin: packing.packed(addon("jobs.native_package").load(), radii, margin)


def test_one_disk_fills_the_square_as_the_contract_says(packed):
    (placement,) = packed([3.7], 0.02)
    points = np.random.default_rng(3).uniform(-1.0, 1.0, (1000, 2))
    assert np.array_equal(placement.apply(points), (1.0 + points) / 2.0)


def test_two_equal_disks_lie_on_the_diagonal(packed):
    first, second = packed([1.0, 1.0], 0.0)
    assert first.scale == pytest.approx(1.0 / (2.0 + np.sqrt(2.0)), rel=1e-3)  # the optimum
    assert first.scale == second.scale


def test_placement_is_a_similarity(packing):
    points = np.random.default_rng(5).uniform(-1.0, 1.0, (50, 2))
    z = points @ [1.0, 1j]
    placement = packing.Placement((0.3, 0.6), 0.2, 0.7)
    expected = 0.3 + 0.6j + 0.2 * cmath.exp(0.7j) * z
    assert np.allclose(placement.apply(points) @ [1.0, 1j], expected, atol=1e-15)


def test_points_go_back_to_where_a_similarity_took_them(packing):
    points = np.random.default_rng(6).uniform(-1.0, 1.0, (40, 2))
    for offset, scale, rotation in (((0.2, 0.9), 0.3, 2.0), ((-1.0, 4.0), 5.0, -0.1), ((0.5, 0.5), 0.01, 3.1)):
        there = packing.Placement(offset, scale, rotation)
        found = packing.fit_placement(points, there.apply(points).astype(np.float32))
        assert np.allclose(found.apply(points), there.apply(points), atol=1e-5 * scale + 1e-6)


def test_a_place_that_is_one_point_is_no_place(packing):
    points = np.random.default_rng(6).uniform(-1.0, 1.0, (40, 2))
    assert packing.fit_placement(points, np.full((40, 2), 0.3, dtype=np.float32)) is None
