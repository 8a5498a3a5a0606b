"""Maps to the sphere from conformal to true to size."""

import koebe
import numpy as np
import pytest
from sphere_surfaces import icosphere
from test_sphere_transfer import potato


def test_areas_become_even_and_no_face_turns_over():
    points, faces, _ = potato(3)
    spread = []
    for even in (0.0, 0.3, 1.0):
        sphere = koebe.sphere_map(points * [1.0, 1.0, 4.0], faces, even=even)
        a, b, c = sphere.points[faces].transpose(1, 0, 2)
        assert np.einsum("fk,fk->f", a, np.cross(b, c)).min() > 0.0 and sphere.on_sphere["flipped"] == 0
        assert sphere.converged and sphere.even == even and np.allclose(np.linalg.norm(sphere.points, axis=1), 1.0)
        spread.append((sphere.area_distortion["log_sd"], -sphere.angle_error_deg["mean"]))
    assert spread == sorted(spread, reverse=True) and spread[0][0] > 10 * spread[2][0] and spread[2][0] < 0.2


def test_a_round_sphere_stays():
    points, faces = icosphere(8)
    even, conformal = koebe.sphere_map(points, faces, even=1.0), koebe.sphere_map(points, faces)
    assert np.abs(even.points - conformal.points).max() < 0.01 and np.abs(even.points - points).max() < 0.01


def test_caps_stay():
    even, conformal = (koebe.sphere_map("blend_samples/face.obj", even=each) for each in (1.0, 0.0))
    rim = np.concatenate([np.asarray(loop) for loop in conformal.loops])
    assert even.area_distortion["log_sd"] < conformal.area_distortion["log_sd"] and even.on_sphere["flipped"] == 0
    assert np.allclose(np.cos(even.caps[:, 3]), np.cos(conformal.caps[:, 3]))
    apart = [np.linalg.norm(one.points[rim][:, None] - one.points[rim], axis=2) for one in (even, conformal)]
    assert np.allclose(*apart, atol=1e-9)


def test_a_number_beside_the_range_is_refused():
    points, faces = icosphere(2)
    with pytest.raises(koebe.OptionError, match="even"):
        koebe.sphere_map(points, faces, even=1.5)
