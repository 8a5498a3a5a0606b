"""Points that 32 bits turn over."""

import cmath

import numpy as np
import pytest

pytestmark = pytest.mark.alike


def fan_along_the_rim(n=60, step=2e-4):
    """A strip of triangles, each of three neighbours on the unit circle `step` apart and one inside."""
    rim = np.cos(step * np.arange(2 * n + 1)) + 1j * np.sin(step * np.arange(2 * n + 1))
    z = np.append(rim, 0.0)
    ears = [[2 * i, 2 * i + 1, 2 * i + 2] for i in range(n)]
    below = [[len(rim), 2 * i, 2 * i + 2] for i in range(n)]
    return z, np.array(ears + below)


@pytest.mark.parametrize("turn", np.linspace(0.1, 6.0, 7))
def test_thin_triangles_on_a_rim_stay_right(addon, turn):
    rounding, triangles_of = addon("surfaces.rounding"), addon("surfaces.triangles")
    z, triangles = fan_along_the_rim()
    z = 0.26 * cmath.exp(1j * turn) * z + 0.7 * (1 + 1j)
    points = np.stack([z.real, z.imag], axis=1)
    plain = points.astype(np.float32)
    assert len(triangles_of.flipped_triangles(triangles, plain)) > 0
    uv, flipped = rounding.rounded(points, triangles)
    assert uv.dtype == np.float32 and len(flipped) == 0
    assert len(triangles_of.flipped_triangles(triangles, uv)) == 0
    assert np.abs(uv - plain).max() <= rounding.REACH * np.spacing(np.float32(0.99))


def test_what_is_turned_over_before_rounding_stays(addon):
    rounding = addon("surfaces.rounding")
    points = np.array([[0.1, 0.1], [0.2, 0.9], [0.9, 0.1], [0.9, 0.9]])
    uv, flipped = rounding.rounded(points, np.array([[0, 1, 2], [2, 3, 1]]))
    assert np.array_equal(uv, points.astype(np.float32)) and flipped.tolist() == [0]
