"""The error of the polyhedron itself: the first variation of circle domains, and finer meshes on its flat faces."""

from pathlib import Path

import koebe
import numpy as np
import polyhedron_error
import pytest
import table_surfaces
from polyhedron_error import FIVE_CIRCLES, SAMPLES

ROOT = Path(__file__).resolve().parents[2]


needs_mesher = pytest.mark.skipif(not table_surfaces.MESHER.exists(), reason="build/bench/planar_mesher is not built")
TURN = np.exp(2j * np.pi * np.arange(SAMPLES) / SAMPLES)


def error_after(inward):
    """Of the inversive distances, which no automorphism of the disk changes."""
    return polyhedron_error.relative(polyhedron_error.first_variation(FIVE_CIRCLES, inward), FIVE_CIRCLES)


def test_rims_that_stay_circles_move_as_they_are_told():
    told = 1e-3 * np.array([[0.0, 0.0], [2.0 + 1.0j, -3.0], [-1.0j, 0.0], [0.0, 4.0], [1.0, 1.0]])
    inward = [-(np.real(a * np.conj(TURN)) + b.real) for a, b in told]
    moved = [(c + a, r + b.real) for (c, r), (a, b) in zip(FIVE_CIRCLES, told)]
    expected = polyhedron_error.relative(moved, FIVE_CIRCLES)
    assert abs(expected).max() > 0.02
    assert abs(error_after(inward) - expected).max() < 0.02 * abs(expected).max()  # of second order


def test_conformal_moves_and_short_waves_do_not_count():
    field = [1e-3 * (1.0 + 0.4j) * (c + r * TURN) ** 2 for c, r in FIVE_CIRCLES]
    assert abs(error_after([-np.real(f * np.conj(TURN)) for f in field])).max() < 1e-6
    wave = [np.zeros(SAMPLES) for _ in FIVE_CIRCLES]
    wave[1] = 1e-3 * np.real(TURN**12)
    assert abs(error_after(wave)).max() < 1e-6


@needs_mesher
@pytest.mark.parametrize("lift", polyhedron_error.LIFTS)
def test_flat_faces_have_the_error_of_their_chords_and_the_map_has_less(lift):
    errors = polyhedron_error.refined_errors(koebe, lift, FIVE_CIRCLES, faces=4000, cuts=2)
    predicted = polyhedron_error.predicted_errors(lift, FIVE_CIRCLES, faces=4000)
    limit = polyhedron_error.polyhedron_limit(errors)
    assert abs(limit - predicted).max() < 0.1 * abs(predicted).max()
    assert 20 * abs(errors[0]).max() < abs(limit).max()
    assert 10 * abs(errors[0]).max() < abs(errors[1]).max()  # finer rims alone
