"""Statistics beside scikit-bio, statsmodels and pandas."""

import koebe
import numpy as np
import pandas
import pytest
from scipy import stats
from scipy.spatial import ConvexHull
from scipy.spatial.distance import squareform
from skbio.stats.distance import DistanceMatrix, permanova, permdisp
from statsmodels.formula.api import ols
from statsmodels.stats.anova import anova_lm
from statsmodels.stats.multitest import multipletests
from statsmodels.stats.tests.test_anova import kidney_table

# The example with ties of scikit-bio's tests.
PRINTED = np.array([[0, 1, 1, 4], [1, 0, 3, 2], [1, 3, 0, 3], [4, 2, 3, 0]], float)
RANDOM = np.random.default_rng(7)
GROUPS = np.repeat(["a", "b", "c"], 10)
AGE = RANDOM.normal(size=30) + (GROUPS == "b")
POINTS = RANDOM.normal(size=(30, 5)) * np.where(GROUPS == "c", 2.5, 1.0)[:, None] + AGE[:, None]
DISTANCES = np.linalg.norm(POINTS[:, None] - POINTS, axis=2)


def test_permanova_has_the_figures_of_scikit_bio():
    for matrix, groups in ((PRINTED, ["1", "1", "2", "2"]), (DISTANCES, GROUPS)):
        said = permanova(DistanceMatrix(matrix), list(groups), permutations=999, seed=1)
        found = koebe.permutation_test(matrix, groups, permutations=999)
        assert found.statistic == pytest.approx(said["test statistic"])
        assert found.p == pytest.approx(said["p-value"], abs=0.35 if len(matrix) == 4 else 0.03)


def test_dispersion_is_that_of_scikit_bio():
    said = permdisp(DistanceMatrix(DISTANCES), list(GROUPS), permutations=199, seed=np.random.default_rng(0))
    found = koebe.dispersion_test(DISTANCES, GROUPS, permutations=199)
    assert found.statistic == pytest.approx(said["test statistic"]) and found.p == said["p-value"] < 0.05
    assert found.degrees == (2, 27) and 0.0 < found.omega_squared < found.explained < 1.0
    even = koebe.dispersion_test(np.abs(AGE[:, None] - AGE), np.tile([0, 1], 15), permutations=199)
    assert even.p > 0.05


def test_figures_are_those_that_others_print():
    """To the digits: permdisp of scikit-bio's documentation, vegan's adonis and R's anova, whose figures the tests of
    scikit-bio and statsmodels hold."""
    upper = [0.5, 0.75, 1, 0.66, 0.33, 0.25, 0.33, 0.77, 0.61, 0.1, 0.44, 0.55, 0.75, 0.88, 0.77]
    spread = koebe.dispersion_test(squareform(upper), np.repeat([1, 2], 3), permutations=9)
    assert f"{spread.statistic:.5f}" == "1.03296"
    for upper, printed in (([1, 1, 4, 3, 2, 3], "2.0"), ([1, 5, 4, 3, 2, 3], "4.4")):
        assert f"{koebe.permutation_test(squareform(upper), [1, 1, 2, 2]).statistic:.1f}" == printed
    days, duration, weight = (kidney_table[name].to_numpy() for name in ("Days", "Duration", "Weight"))
    half, (one, two) = 3 - 2 * duration, (1.0 * (weight == k) - (weight == 3) for k in (1, 2))
    squares = np.stack([half, half * one, half * two], axis=1)  # R's contr.sum, also for the interaction
    found = koebe.point_test(np.log(days + 1.0)[:, None], weight, covariates=squares, permutations=99)
    assert f"{found.statistic[0]:.5f}" == "15.80674"
    assert f"{found.explained[0]:.5f}" == f"{16.97129 / (16.97129 + 28.9892):.5f}"


def test_points_have_the_anova_of_statsmodels_and_its_corrections():
    frame = pandas.DataFrame({"y": POINTS[:, 0], "age": AGE, "group": GROUPS})
    table = anova_lm(ols("y ~ age + C(group)", frame).fit(), typ=2)
    found = koebe.point_test(POINTS, GROUPS, covariates=AGE, permutations=499)
    assert found.statistic[0] == pytest.approx(table.loc["C(group)", "F"])
    squares = table.loc[["C(group)", "Residual"], "sum_sq"]
    assert found.explained[0] == pytest.approx(squares.iloc[0] / squares.sum())
    assert found.p[0] == pytest.approx(table.loc["C(group)", "PR(>F)"], abs=0.06)
    assert found.q == pytest.approx(multipletests(found.p, method="fdr_bh")[1])
    plain = koebe.point_test(POINTS, GROUPS, permutations=99)
    expected = [stats.f_oneway(*(column[one == GROUPS] for one in "abc")).statistic for column in POINTS.T]
    assert plain.statistic == pytest.approx(expected)


def test_tables_are_dataframes():
    face, other = (koebe.uniformize(koebe.example(name)) for name in ("face", "surprised"))
    found = koebe.family([face, other], labels=["face", "surprised"])
    frame = found.to_dataframe()
    assert list(frame.index) == found.labels and list(frame.columns) == found.columns
    assert np.array_equal(frame.to_numpy(), found.modules)
    points = koebe.point_test(POINTS, GROUPS, permutations=19).to_dataframe()
    assert list(points.columns) == ["statistic", "explained", "p", "p_family", "q"] and len(points) == 5
    row = koebe.permutation_test(DISTANCES, GROUPS, permutations=19).to_dataframe()
    assert len(row) == 1 and row["degrees"][0] == "2, 27"


def test_clusters_of_points_are_neighbours_on_the_reference():
    face, other = (koebe.uniformize(koebe.example(name)) for name in ("face", "surprised"))
    edges = koebe.family([face, other]).adjacency()
    assert (edges != edges.T).nnz == 0 and edges.diagonal().sum() == 0
    assert edges.nnz == 2 * (face.vertex_count + face.face_count - 2 + len(face.loops))  # Euler: E = V + F - 2 + loops


def test_families_are_tables_and_labelled_arrays():
    ball = (points := np.random.default_rng(1).normal(size=(40, 3))) / np.linalg.norm(points, axis=1)[:, None]
    faces = ConvexHull(ball).simplices
    faces = np.where((np.linalg.det(ball[faces]) < 0)[:, None], faces[:, ::-1], faces)
    family = koebe.family([(ball, faces), (ball * [1, 1, 2], faces)], labels=["ball", "egg"])
    frame, array = family.to_dataframe(), family.to_xarray()
    assert (
        np.array_equal(frame.to_numpy(), family.distances) and list(frame.columns) == list(frame.index) == family.labels
    )
    assert np.array_equal(array.sel(shape="egg", axis="z"), family.points[1, :, 2])
    assert np.isclose(
        array.weighted(array.weight).mean("vertex").sel(shape="ball").sum(), family.weights @ family.points[0].sum(1)
    )
    disks = koebe.family([koebe.example(name) for name in ("face", "surprised")])
    assert disks.to_xarray().shape == disks.points.shape and list(disks.to_dataframe().columns) == disks.columns


@pytest.mark.parametrize("unit", [1e-200, 1e200])
def test_no_figure_depends_on_the_unit(unit):
    how = {"covariates": AGE, "permutations": 49}
    far = {"covariates": AGE * unit, "permutations": 49}
    one, other = (koebe.point_test(POINTS * scale, GROUPS, **some) for scale, some in ((1, how), (unit, far)))
    assert np.allclose(one.statistic, other.statistic, rtol=1e-6) and np.allclose(one.p, other.p)
    one, other = (koebe.permutation_test(DISTANCES * scale, GROUPS, **some) for scale, some in ((1, how), (unit, far)))
    assert one.statistic == pytest.approx(other.statistic) and one.p == other.p
    one, other = (koebe.dispersion_test(DISTANCES * scale, GROUPS, permutations=49) for scale in (1, unit))
    assert one.statistic == pytest.approx(other.statistic, rel=1e-6)
