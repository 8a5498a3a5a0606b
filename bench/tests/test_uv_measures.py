"""The figures of bench/compare.py on maps whose figures are known."""


import numpy as np
import pytest
import uv_measures

N = 20

pytestmark = pytest.mark.slow


@pytest.fixture
def sheet():
    """A flat unit square: vertices, triangles, and its own coordinates as UVs of the corners."""
    x, y = np.meshgrid(np.linspace(0.0, 1.0, N + 1), np.linspace(0.0, 1.0, N + 1), indexing="ij")
    vertices = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1)
    at = np.arange(x.size).reshape(N + 1, N + 1)
    a, b, c, d = at[:-1, :-1].ravel(), at[1:, :-1].ravel(), at[1:, 1:].ravel(), at[:-1, 1:].ravel()
    triangles = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    return vertices, triangles, vertices[triangles][:, :, :2].copy()


def measured(vertices, triangles, uv):
    return uv_measures.measure(vertices, triangles, uv)


def test_the_identity_is_perfect(sheet):
    facts = measured(*sheet)
    assert facts["islands"] == 1 and facts["seams"] == 0.0 and facts["flips"] == facts["lost"] == 0
    assert facts["spread"] == pytest.approx(1.0, abs=1e-4) and facts["even"] == pytest.approx(1.0)
    assert facts["angle"] < 1e-3 and facts["overlap"] < 1e-3


def test_a_mirrored_map_has_no_flips(sheet):
    vertices, triangles, uv = sheet
    assert measured(vertices, triangles, uv * [-1.0, 1.0])["flips"] == 0


def test_a_stretched_map_has_the_angles_of_stretched_triangles(sheet):
    vertices, triangles, uv = sheet
    facts = measured(vertices, triangles, uv * [1.0, 3.0])
    one = np.degrees(np.arctan(3.0))  # of a right triangle with sides 1 and 3: 45 and 45 degrees before
    assert facts["angle"] == pytest.approx(2.0 * (one - 45.0) / 3.0, abs=1e-3)
    assert facts["spread"] == pytest.approx(1.0, abs=1e-4)


def test_halves_moved_apart_are_two_islands_and_the_seam_is_the_cut(sheet):
    vertices, triangles, uv = sheet
    uv[uv.mean(axis=1)[:, 0] > 0.5] += [1.0, 0.0]
    facts = measured(vertices, triangles, uv)
    assert facts["islands"] == 2 and facts["seams"] == pytest.approx(1.0) and facts["overlap"] < 1e-3


def test_coverage_is_the_share_of_the_texture(sheet):
    vertices, triangles, uv = sheet
    assert measured(vertices, triangles, uv)["coverage"] == pytest.approx(1.0, abs=2e-3)
    assert uv_measures.measure(vertices, triangles, uv / 2.0, texture=0.5)["coverage"] == pytest.approx(0.5, abs=1e-3)


def test_halves_on_one_another_overlap(sheet):
    vertices, triangles, uv = sheet
    uv[uv.mean(axis=1)[:, 0] > 0.5] -= [0.5, 0.0]
    facts = measured(vertices, triangles, uv)
    assert facts["overlap"] == pytest.approx(1.0, abs=1e-2) and facts["coverage"] == pytest.approx(0.5, abs=2e-3)


def test_one_corner_drawn_across_flips_its_faces(sheet):
    vertices, triangles, uv = sheet
    middle = len(vertices) // 2
    uv[triangles == middle] = uv[triangles == middle] + [1.5 / N, 0.0]
    facts = measured(vertices, triangles, uv)
    assert facts["flips"] == 2 and facts["overlap"] > 0.0


def test_a_shrunk_half_spreads_the_density(sheet):
    vertices, triangles, uv = sheet
    far = uv.mean(axis=1)[:, 0] > 0.5
    uv[far] = uv[far] * 0.25 + [2.0, 0.0]
    facts = measured(vertices, triangles, uv)
    assert facts["spread"] == pytest.approx(4.0, rel=1e-3) and facts["even"] == pytest.approx(0.5, abs=1e-6)


def test_a_face_without_area_is_lost_and_has_no_flip(sheet):
    vertices, triangles, uv = sheet
    uv[7] = uv[7, 0]
    facts = measured(vertices, triangles, uv)
    assert facts["lost"] == 1 and facts["flips"] == 0
