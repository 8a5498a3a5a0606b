"""Noise, its error bars, and the permutation test."""

import itertools
import sys
from pathlib import Path

import koebe
import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "surfaces"))

import noisy_shapes  # noqa: E402

POINTS, TRIANGLES = noisy_shapes.plate(20)


def surface(seed=0):
    return noisy_shapes.bent(POINTS, np.random.default_rng(seed))


@pytest.mark.parametrize("level", [0.01, 0.03, 0.1])
@pytest.mark.parametrize("unit", [1e-3, 1e3])
def test_the_noise_of_a_surface_is_found(level, unit):
    true = unit * surface()
    sigma = level * noisy_shapes.mean_edge(true, TRIANGLES)
    noisy = true + sigma * np.random.default_rng(1).normal(size=true.shape)
    assert 0.8 * sigma < koebe.vertex_noise(noisy, TRIANGLES) < 1.25 * sigma
    turn = np.linalg.qr(np.random.default_rng(2).normal(size=(3, 3)))[0]
    assert np.isclose(koebe.vertex_noise(noisy @ turn, TRIANGLES), koebe.vertex_noise(noisy, TRIANGLES), rtol=1e-9)


def test_a_smooth_surface_has_nearly_no_noise_and_a_flat_one_none():
    edge = noisy_shapes.mean_edge(surface(), TRIANGLES)
    assert koebe.vertex_noise(surface(), TRIANGLES) < 0.003 * edge
    assert koebe.vertex_noise(np.column_stack([POINTS, 0 * POINTS[:, 0]]), TRIANGLES) < 1e-12


def test_bars_hold_the_change_that_noise_makes():
    random, true, inside = np.random.default_rng(5), surface(3), []
    exact = koebe.uniformize(true, TRIANGLES)
    outer = int(exact.loops[0][0])
    for _ in range(4):
        noisy = true + 0.05 * noisy_shapes.mean_edge(true, TRIANGLES) * random.normal(size=true.shape)
        result = koebe.uniformize(noisy, TRIANGLES, outer=outer)
        order = noisy_shapes.by_vertex(result, exact)
        bars = koebe.noise_error(result, order=order, samples=12)
        error = np.abs(koebe.conformal_module(result, order=order) - koebe.conformal_module(exact))
        inside += (error <= bars).tolist()
        assert (bars < 0.2).all()
    assert np.mean(inside) > 0.8
    again = koebe.noise_error(result, order=order, samples=12)
    assert np.array_equal(bars, again) and not np.array_equal(bars, koebe.noise_error(result, samples=12, seed=1))
    assert (koebe.noise_error(result, noise=0.0, samples=2) < 1e-7).all()


def test_too_much_noise_is_an_error():
    result = koebe.uniformize(surface(), TRIANGLES)
    with pytest.raises(koebe.SolverError, match="cannot be mapped"):
        koebe.noise_error(result, noise=np.finfo(float).max, samples=2)
    for wrong in ({"noise": -1.0}, {"noise": float("nan")}, {"samples": 1}, {"seed": -1}):
        with pytest.raises(koebe.OptionError):
            koebe.noise_error(result, **wrong)
    with pytest.raises(koebe.InputError, match="20 vertices"):
        koebe.vertex_noise([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])


def distances_of(points):
    return np.linalg.norm(points[:, None] - points[None], axis=2)


def test_p_is_the_share_of_all_permutations():
    """Counted here by the definition: the groups that are at least as far apart, among all."""
    points = np.random.default_rng(4).normal(size=(9, 3)) + np.outer(np.arange(9) < 4, [1.0, 0.0, 0.0])

    def within(first):
        groups = [points[list(first)], np.delete(points, first, axis=0)]
        return sum(((group - group.mean(axis=0)) ** 2).sum() for group in groups)

    given = within((0, 1, 2, 3))
    sums = np.array([within(first) for first in itertools.combinations(range(9), 4)])
    found = koebe.permutation_test(distances_of(points), np.arange(9) >= 4)
    assert found.exact and found.permutations == len(sums)
    assert found.p == pytest.approx((sums <= given * (1 + 1e-12)).mean())
    total = ((points - points.mean(axis=0)) ** 2).sum()
    assert found.explained == pytest.approx(1 - given / total)
    assert found.statistic == pytest.approx((total - given) / (given / 7))
    random = koebe.permutation_test(distances_of(points), np.arange(9) >= 4, permutations=100)
    assert not random.exact and random.p == pytest.approx(found.p, abs=0.15)


def test_the_test_knows_no_names_order_or_unit():
    random = np.random.default_rng(6)
    points, groups = random.normal(size=(12, 2)), np.repeat(["a", "b", "c"], 4)
    distances = distances_of(points)
    found = koebe.permutation_test(distances, groups, permutations=199)
    assert koebe.permutation_test(1e6 * distances, groups, permutations=199).p == found.p
    assert koebe.permutation_test(distances, np.repeat([7, 3, 5], 4), permutations=199).statistic == pytest.approx(
        found.statistic
    )
    mixed = random.permutation(12)
    again = koebe.permutation_test(distances[np.ix_(mixed, mixed)], groups[mixed], permutations=199)
    assert again.statistic == pytest.approx(found.statistic) and again.explained == pytest.approx(found.explained)


def test_under_no_effect_p_is_even():
    """At most 5 % of the experiments have p <= 0.05, up to the chance of 400 of them."""
    random, groups = np.random.default_rng(8), np.repeat([0, 1], 5)
    found = [koebe.permutation_test(distances_of(random.normal(size=(10, 3))), groups).p for _ in range(400)]
    assert np.mean(np.array(found) <= 0.05) < 0.085 and 0.4 < np.mean(found) < 0.62


def test_a_family_is_tested_and_a_planted_effect_is_found():
    random = np.random.default_rng(9)
    shapes = [
        koebe.uniformize(noisy_shapes.bent(POINTS, random, 0.01, 0.6 * (k >= 5)), TRIANGLES) for k in range(10)
    ]
    orders = [noisy_shapes.by_vertex(shape, shapes[0]) for shape in shapes]
    found = koebe.permutation_test(koebe.family(shapes, orders=orders), [0] * 5 + [1] * 5)
    assert found.p < 0.05 and found.exact and found.explained > 0.1


@pytest.mark.parametrize(
    ("distances", "groups", "says"),
    [
        (np.ones((4, 4)), [0, 0, 1, 1], "symmetric"),
        (np.triu(np.ones((4, 4)), 1), [0, 0, 1, 1], "symmetric"),
        (np.zeros((4, 4)), [0, 0, 1, 1], "equal"),
        (distances_of(np.eye(4)), [0, 0, 0, 1], "two groups"),
        (distances_of(np.eye(4)), [0, 0, 0, 0], "two groups"),
        (distances_of(np.eye(4)), [0, 0, 1], "labels"),
        (np.full((4, 4), np.nan), [0, 0, 1, 1], "NaN"),
        (np.ones((4, 3)), [0, 0, 1, 1], "shape"),
    ],
)
def test_what_is_no_table_of_distances_is_told_so(distances, groups, says):
    with pytest.raises(koebe.InputError, match=says):
        koebe.permutation_test(distances, groups)
