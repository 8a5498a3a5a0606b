"""Noise, its error bars, and the permutation test."""

import itertools

import koebe
import noisy_shapes
import numpy as np
import pytest

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


def design(seed=3, count=24):
    """Three groups, an age that differs between them, and numbers that depend on both."""
    random = np.random.default_rng(seed)
    groups = np.repeat(["a", "b", "c"], count // 3)
    age = random.normal(size=count) + 1.5 * (groups == "b")
    return groups, age, age + 0.7 * (groups == "c") + random.normal(size=count)


def f_of_least_squares(y, before, after):
    """F of the columns that the second design has more, by residuals of least squares."""
    rest = [((y - x @ np.linalg.lstsq(x, y, rcond=None)[0]) ** 2).sum() for x in (before, after)]
    degrees = after.shape[1] - before.shape[1], len(y) - after.shape[1]
    return (rest[0] - rest[1]) / degrees[0] / (rest[1] / degrees[1]), degrees


def test_distances_of_numbers_give_the_f_of_the_linear_model():
    groups, age, y = design()
    ones, dummies = np.ones((24, 1)), (groups[:, None] == ["b", "c"]).astype(float)
    for covariates, before in ((None, ones), (1e6 * age + 2000, np.column_stack([ones, age]))):
        f, degrees = f_of_least_squares(y, before, np.column_stack([before, dummies]))
        found = koebe.permutation_test(abs(y[:, None] - y), groups, covariates=covariates, permutations=99)
        assert found.statistic == pytest.approx(f) and found.degrees == degrees
        after = np.column_stack([before, dummies])
        squares = [((y - x @ np.linalg.lstsq(x, y, rcond=None)[0]) ** 2).sum() for x in (ones, before, after)]
        assert found.explained == pytest.approx((squares[1] - squares[2]) / squares[0])
        points = koebe.point_test(np.column_stack([y, 3 * y + 1]), groups, covariates=covariates, permutations=99)
        assert points.statistic == pytest.approx([f, f]) and points.degrees == degrees
    f, degrees = f_of_least_squares(y, ones, np.column_stack([ones, age]))
    found = koebe.permutation_test(abs(y[:, None] - y), age, numeric=True, permutations=99)
    assert found.statistic == pytest.approx(f) and found.degrees == degrees == (1, 22)
    assert found.explained == pytest.approx(np.corrcoef(y, age)[0, 1] ** 2)
    assert found.omega_squared < found.explained


def test_a_covariate_that_makes_the_groups_differ_is_taken_out():
    """Groups differ by age alone: without the covariate the test finds it, with it p is even."""
    with_age, without = [], []
    for seed in range(60):
        random = np.random.default_rng(seed)
        groups = np.repeat([0, 1], 8)
        age = random.normal(size=16) + 2.0 * groups
        y = np.column_stack([age, random.normal(size=(16, 2))]) + 0.3 * random.normal(size=(16, 3))
        distances = distances_of(y)
        without.append(koebe.permutation_test(distances, groups, permutations=199).p)
        with_age.append(koebe.permutation_test(distances, groups, covariates=age, permutations=199).p)
    assert np.mean(np.array(without) <= 0.05) > 0.7
    assert np.mean(np.array(with_age) <= 0.05) < 0.15 and 0.35 < np.mean(with_age) < 0.65


def test_permutations_stay_in_their_strata():
    """Pairs that differ by a site's effect, far larger than the groups': only within pairs the groups' shows."""
    random = np.random.default_rng(4)
    sites, groups = np.repeat(np.arange(12), 2), np.tile([0, 1], 12)
    y = np.column_stack([10.0 * random.normal(size=12)[sites] + groups, 0 * sites]) + 0.3 * random.normal(size=(24, 2))
    assert koebe.permutation_test(distances_of(y), groups, permutations=499).p > 0.2
    assert koebe.permutation_test(distances_of(y), groups, strata=sites, permutations=499).p < 0.02
    assert koebe.point_test(y, groups, strata=sites, permutations=499).p[0] < 0.02
    with pytest.raises(koebe.InputError, match="each stratum has one"):
        koebe.permutation_test(distances_of(y), groups, strata=np.arange(24))


def test_the_largest_f_of_all_points_holds_the_family():
    random, groups = np.random.default_rng(5), np.repeat([0, 1], 7)
    false = 0
    for _ in range(60):
        matrix = random.normal(size=(14, 40))
        found = koebe.point_test(matrix, groups, permutations=99)
        assert (found.p_family >= found.p).all() and (found.p >= 0.01).all()
        false += bool((found.p_family <= 0.05).any())
    assert false <= 8  # 3 expected
    matrix[:, 3] = np.nan
    matrix[:, 4] = 7.0
    found = koebe.point_test(matrix, groups, permutations=99)
    assert np.isnan(found.p[[3, 4]]).all() and np.isfinite(found.statistic).sum() == 38


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"covariates": np.arange(5)}, "covariates must be"),
        ({"covariates": ["a"] * 6}, "columns of 0 and 1"),
        ({"covariates": [0, 0, 0, 1, 1, 1]}, "say all that the groups say"),
        ({"covariates": np.arange(6)[:, None] ** np.arange(1, 5)}, "too few shapes"),
        ({"strata": [0, 1]}, "strata must be"),
        ({"numeric": True, "groups": [0, 1, 2, np.nan, 1, 2]}, "finite numbers"),
    ],
)
def test_what_is_no_design_is_told_so(options, says):
    options = {"groups": [0, 0, 0, 1, 1, 1], **options}
    for act in (koebe.permutation_test, koebe.point_test):
        values = distances_of(np.random.default_rng(1).normal(size=(6, 2)))
        with pytest.raises(koebe.InputError, match=says):
            act(values, **options)
