"""Whether groups of shapes differ: by their distances, in their spread, and point by point."""

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._arrays import as_points, as_values
from .._comparable import Result
from .._options import flag, whole
from .._types import Floats, Values, Whole
from ..errors import InputError
from .corresponding import library
from .family import Family
from .sphere_family import SphereFamily

_AT_ONCE = 4_000_000  # numbers of a piece of the permuted designs


@dataclass(frozen=True, eq=False, repr=False)
class PermutationTest(Result):
    """Whether groups of shapes differ.

    p            the probability of a difference like this or a greater one if the groups were drawn from one population
    statistic    Anderson's pseudo-F: the mean square between the groups over the mean square within. Of
                 dispersion_test F of the distances from the groups' centres
    explained    R^2: share of the sum of squares that lies between the groups, from 0 to 1
    omega_squared    the same without the share that chance explains; of covariates' rest (partial). May be below 0
    permutations the groups that were compared with the given ones
    exact        whether they are all that there are
    degrees      of freedom: of the groups, and of the rest
    """

    p: float
    statistic: float
    explained: float
    permutations: int
    exact: bool
    omega_squared: float = math.nan
    degrees: tuple[int, int] = (0, 0)

    def __repr__(self) -> str:
        kind = "all" if self.exact else "random"
        return (
            f"<koebe.PermutationTest p {self.p:.3g}, F {self.statistic:.3g}, {self.permutations} {kind} permutations>"
        )

    def _drawing(self) -> dict[str, Any]:
        return {"bars": [(0.0, self.explained), (0.0, 1.0 - self.explained)]}

    def to_dataframe(self) -> Any:
        """A row with the figures, as a pandas DataFrame (the extra `statistics`)."""
        return library("pandas").DataFrame([{**vars(self), "degrees": f"{self.degrees[0]}, {self.degrees[1]}"}])


@dataclass(frozen=True, eq=False)
class PointTest(Result):
    """Where groups differ: figures of each point, NaN where a value is missing or all are equal.

    statistic    (V,) F of the linear model with the groups over the one without
    explained    (V,) partial R^2: share of the sum of squares, without the covariates', that the groups explain
    p            (V,) of each point by itself, by permutations
    p_family     (V,) the same, corrected for all points: by the largest F of each permutation [Westfall & Young 1993]
    permutations    that were drawn
    degrees      of freedom: of the groups, and of the rest
    """

    statistic: Floats
    explained: Floats
    p: Floats
    p_family: Floats
    permutations: int
    degrees: tuple[int, int]

    def __repr__(self) -> str:
        return (
            f"<koebe.PointTest {len(self.p)} points, {int((self.p_family <= 0.05).sum())} with p_family <= 0.05, "
            f"{self.permutations} permutations>"
        )

    def _drawing(self) -> dict[str, Any]:
        return {"values": self.p}

    @property
    def q(self) -> Floats:
        """(V,) p corrected to control the false discovery rate [Benjamini & Hochberg 1995], by SciPy."""
        known = np.isfinite(self.p)
        found = np.full(len(self.p), np.nan)
        if known.any():
            found[known] = library("scipy.stats").false_discovery_control(self.p[known])
        return found

    def to_dataframe(self) -> Any:
        """A row for each point, as a pandas DataFrame (the extra `statistics`)."""
        names = ("statistic", "explained", "p", "p_family")
        return library("pandas").DataFrame({**{name: getattr(self, name) for name in names}, "q": self.q})


def permutation_test(
    distances: Any,
    groups: Any,
    *,
    covariates: Any = None,
    strata: Any = None,
    numeric: bool = False,
    permutations: int = 9999,
    seed: int = 0,
) -> PermutationTest:
    """Test whether two or more groups of shapes differ, by their distances alone (PERMANOVA) [Anderson 2001].

    distances     (N, N) symmetric, such as the distances of a `family`, or of separation_distance for all pairs; or the
                  Family or SphereFamily itself
    groups        (N,) the group of each shape: any labels
    covariates    (N,) or (N, k) numbers whose effect is taken out first [McArdle & Anderson 2001]: the rest is permuted
                  [Freedman & Lane 1983]
    strata        (N,) labels of blocks, such as sites or pairs: permutations stay within them
    numeric       True: `groups` are numbers (N,) or (N, k), whose linear effect is tested
    permutations  of the labels, at random; if two groups have no more than these, and there are neither covariates nor
                  strata, all are taken
    seed          of the random numbers: the same seed gives the same p
    Without covariates the false-positive rate at level p is at most p, whatever the distances; with them nearly so.
    Groups with one mean but unlike spread are called different, too, if their sizes differ: see dispersion_test.
    docs/shapes.md has the power on a made population. Raises InputError.

    >>> import koebe, numpy as np
    >>> places = np.concatenate([np.arange(6.0), 4 + np.arange(6.0)])
    >>> found = koebe.permutation_test(abs(places[:, None] - places), [0] * 6 + [1] * 6)
    >>> found.p < 0.05, found.exact
    (True, True)
    """
    squares = _distances(distances) ** 2
    count = len(squares)
    design = _Design(count, groups, covariates, strata, numeric)
    # Gower's matrix of inner products about the mean, and what the covariates leave of it.
    rest = design.without_covariates(design.without_covariates(-0.5 * squares).T)
    total, whole_sum = float(np.trace(rest)), squares.sum() / (2.0 * count)
    if total <= 1e-12 * whole_sum or whole_sum == 0.0:
        raise InputError("all shapes are equal" if whole_sum == 0.0 else "the covariates explain all distances")

    def shares(basis: Floats) -> Floats:
        """Of bases (n, N, k) the sums of squares in them."""
        flat = basis.transpose(1, 0, 2).reshape(count, -1)
        return np.einsum("is,is->s", flat, rest @ flat).reshape(len(basis), -1).sum(axis=1)

    def share(order: Whole) -> Floats:
        """What the groups explain of what the covariates do not, for permutations (n, N)."""
        of_covariates = shares(design.before[order]) if design.before.shape[1] > 1 else 0.0
        return shares(design.effect[order]) / (total - of_covariates)

    tries, exact = design.tries(whole(permutations, "permutations", least=1), seed)
    given = float(share(np.arange(count)[None])[0])
    found = np.concatenate([share(part) for part in tries])
    as_far = int((found >= given - 1e-12).sum())
    p = as_far / len(found) if exact else (1 + as_far) / (1 + len(found))
    between, within = given * total / design.degrees[0], (1.0 - given) * total / design.degrees[1]
    statistic = between / within if within > 1e-15 * total else math.inf
    omega = design.degrees[0] * (between - within) / (total + within)
    return PermutationTest(p, statistic, given * total / whole_sum, len(found), exact, omega, design.degrees)


def dispersion_test(distances: Any, groups: Any, *, permutations: int = 9999, seed: int = 0) -> PermutationTest:
    """Test whether groups of shapes are unlike in their spread (PERMDISP) [Anderson 2006], by scikit-bio.

    distances, groups    as in permutation_test, which may find groups different by their spread alone
    permutations, seed   of the residuals, at random
    The statistic is F of the distances from each group's spatial median. Needs scikit-bio (the extra `statistics`).
    Raises InputError.

    >>> import koebe, numpy as np
    >>> places = np.concatenate([np.linspace(0, 1, 8), np.linspace(0, 9, 8)])
    >>> koebe.dispersion_test(abs(places[:, None] - places), [0] * 8 + [1] * 8, permutations=199).p < 0.05
    True
    """
    matrix = _distances(distances)
    design = _Design(len(matrix), groups, None, None, False)
    skbio = library("skbio.stats.distance", "scikit-bio")
    count = whole(permutations, "permutations", least=1)
    labels = [str(label) for label in np.unique(np.asarray(groups), return_inverse=True)[1]]
    said = skbio.permdisp(
        skbio.DistanceMatrix(0.5 * (matrix + matrix.T)), labels, permutations=count, dimensions=len(matrix),
        seed=np.random.default_rng(whole(seed, "seed", least=0)),
    )  # fmt: skip
    statistic, (k, n) = float(said["test statistic"]), design.degrees
    explained = k * statistic / (k * statistic + n)
    omega = k * (statistic - 1.0) / (k * statistic + n + 1.0)
    return PermutationTest(float(said["p-value"]), statistic, explained, count, False, omega, design.degrees)


def point_test(
    matrix: Any,
    groups: Any,
    *,
    covariates: Any = None,
    strata: Any = None,
    numeric: bool = False,
    permutations: int = 999,
    seed: int = 0,
) -> PointTest:
    """Test at each point whether a field differs between groups, corrected for the number of points.

    matrix    (N, V) subjects x points, such as PointFamily.matrix. Columns with a NaN have no test
    groups, covariates, strata, numeric, seed    as in permutation_test
    permutations    at random, the same for all points
    A linear model at each point: F of the groups beside the covariates. Tests of clusters and TFCE are MNE's: its
    functions take the matrix, and PointFamily.adjacency. Raises InputError.

    >>> import koebe, numpy as np
    >>> matrix = np.random.default_rng(1).normal(size=(12, 50))
    >>> matrix[6:, 7] += 5.0
    >>> found = koebe.point_test(matrix, [0] * 6 + [1] * 6)
    >>> np.flatnonzero(found.p_family <= 0.05).tolist()
    [7]
    """
    values = as_values(matrix, "the matrix")
    if values.dtype.kind not in "fiub":
        raise InputError(f"the matrix must have numbers, not {values.dtype}")
    values = values.astype(np.float64)
    if values.ndim != 2 or not len(values):
        raise InputError(f"the matrix must be (N, V), subjects x points, not {values.shape}")
    design = _Design(len(values), groups, covariates, strata, numeric)
    known = np.asarray(np.isfinite(values).all(axis=0))
    values = values / np.where(known, _sizes(values), 1.0)  # no figure depends on the unit
    rest = design.without_covariates(values[:, known])
    total = (rest**2).sum(axis=0)
    varies = total > 1e-12 * (values[:, known] ** 2).sum(axis=0)
    known[known], rest, total = varies, rest[:, varies], total[varies]
    ratio = design.degrees[1] / design.degrees[0]

    def statistics(order: Whole) -> Floats:
        """(points,) F for a permutation (N,)."""
        between = ((design.effect[order].T @ rest) ** 2).sum(axis=0)
        of_covariates = ((design.before[order].T @ rest) ** 2).sum(axis=0)
        within = np.maximum(total - of_covariates - between, 1e-15 * total)
        return ratio * between / within

    given = statistics(np.arange(len(values)))
    least = given * (1.0 - 1e-9)
    as_far, as_far_anywhere = np.ones(len(given)), np.ones(len(given))
    tries, _ = design.tries(whole(permutations, "permutations", least=1), seed, every=False)
    for part in tries:
        for order in part:
            found = statistics(order)
            as_far += found >= least
            as_far_anywhere += found.max(initial=0.0) >= least
    explained = given / (given + ratio)

    def placed(column: Floats) -> Floats:
        """(V,) with NaN where there is no test."""
        row = np.full(len(known), np.nan)
        row[known] = column
        return row

    p, p_family = as_far / (1 + permutations), as_far_anywhere / (1 + permutations)
    return PointTest(placed(given), placed(explained), placed(p), placed(p_family), permutations, design.degrees)


class _Design:
    """The linear model of groups and covariates.

    before    (N, k) orthonormal basis of the mean and the covariates
    effect    (N, q) orthonormal basis of what the groups add
    degrees   of freedom: q, and those of the rest
    """

    def __init__(self, count: int, groups: Any, covariates: Any, strata: Any, numeric: bool) -> None:
        self.member: Whole | None = None
        if flag(numeric, "numeric"):
            columns = _columns(groups, "groups", count)
        else:
            labels = _labels(groups, "groups", count)
            _, self.member, sizes = np.unique(labels, return_inverse=True, return_counts=True)
            if len(sizes) < 2 or sizes.min() < 2:
                raise InputError("there must be two groups at least, of two shapes each")
            columns = np.eye(len(sizes))[self.member]
        mean = np.ones((count, 1))
        others = [] if covariates is None else [_columns(covariates, "covariates", count)]
        self.before = _basis(_scaled(np.column_stack([mean, *others])))
        self.effect = _basis(self.without_covariates(_scaled(columns)))
        self.plain = covariates is None and strata is None
        blocks = np.zeros(count) if strata is None else _labels(strata, "strata", count)
        self.strata = np.unique(blocks, return_inverse=True)[1]
        self.degrees = self.effect.shape[1], count - self.before.shape[1] - self.effect.shape[1]
        if self.degrees[0] < 1:
            raise InputError("the covariates say all that the groups say")
        if self.degrees[1] < 1:
            raise InputError(f"there are too few shapes ({count}) for so many groups and covariates")

    def without_covariates(self, values: Floats) -> Floats:
        """Columns (N, k) without their part in `before`."""
        return values - self.before @ (self.before.T @ values)

    def tries(self, permutations: int, seed: int, every: bool = True) -> tuple[Iterator[Whole], bool]:
        """Permutations (n, N): all different ones of two groups if there are few, or random ones within the strata."""
        count = len(self.strata)
        if every and self.plain and self.member is not None and self.degrees[0] == 1:
            first = np.flatnonzero(self.member == 0)
            if math.comb(count, len(first)) <= permutations:
                return _all_of_two(self.member, first), True
        random = np.random.default_rng(whole(seed, "seed", least=0))
        blocks = [np.flatnonzero(self.strata == one) for one in range(int(self.strata.max()) + 1)]
        if all(len(block) == 1 for block in blocks):
            raise InputError("each stratum has one shape: nothing can be permuted")

        def random_ones(size: int) -> Whole:
            order = np.tile(np.arange(count), (size, 1))
            for block in blocks:
                order[:, block] = random.permuted(order[:, block], axis=1)
            return order

        piece = max(1, _AT_ONCE // (count * (self.before.shape[1] + self.effect.shape[1])))
        sizes = [min(piece, permutations - begin) for begin in range(0, permutations, piece)]
        return map(random_ones, sizes), False


def _all_of_two(member: Whole, first: Whole) -> Iterator[Whole]:
    """For each choice of the first group's members one permutation that makes it, (n, N) in pieces."""
    count, second = len(member), np.flatnonzero(member == 1)
    choices = itertools.combinations(range(count), len(first))
    while piece := list(itertools.islice(choices, 1000)):
        order = np.empty((len(piece), count), np.int64)
        for row, chosen in zip(order, piece, strict=True):
            inside = np.zeros(count, bool)
            inside[list(chosen)] = True
            row[inside], row[~inside] = first, second
        yield order


def _distances(given: Any) -> Floats:
    """(N, N) of a family, or as given; the largest is 1, as no figure depends on the unit. Raises InputError."""
    matrix = given.distances if isinstance(given, (Family, SphereFamily)) else given
    matrix = as_values(matrix, "distances")
    matrix = as_points(matrix, "distances", len(matrix) if matrix.ndim else 0)
    if not np.allclose(matrix, matrix.T, rtol=1e-9, atol=0.0) or matrix.diagonal().any() or (matrix < 0.0).any():
        raise InputError("the distances must be a symmetric matrix without negative numbers, 0 on the diagonal")
    return matrix / (matrix.max(initial=0.0) or 1.0)


def _labels(given: Any, name: str, count: int) -> Values:
    labels = as_values(given, f"the {name}")
    if labels.shape != (count,):
        raise InputError(f"the {name} must be ({count},) labels, one for each shape, not {labels.shape}")
    return labels


def _columns(given: Any, name: str, count: int) -> Floats:
    """(N, k) finite numbers. Raises InputError."""
    table = as_values(given, f"the {name}")
    if table.dtype.kind not in "fiub":
        raise InputError(f"the {name} must be numbers; of labels make columns of 0 and 1")
    table = table.astype(np.float64)
    table = table.reshape(-1, 1) if table.ndim == 1 else table
    if table.ndim != 2 or len(table) != count or not np.isfinite(table).all():
        raise InputError(f"the {name} must be ({count},) or ({count}, k) finite numbers, not {np.shape(given)}")
    return table


def _sizes(columns: Floats) -> Floats:
    """(k,) the largest sizes in columns, 1 for none."""
    sizes = np.abs(columns).max(axis=0, initial=0.0)
    return np.where(sizes > 0.0, sizes, 1.0)


def _scaled(columns: Floats) -> Floats:
    """Columns (N, k) of length 1, or 0."""
    columns = columns / _sizes(columns)
    lengths = np.linalg.norm(columns, axis=0)
    return columns / np.where(lengths > 0.0, lengths, 1.0)


def _basis(columns: Floats) -> Floats:
    """(N, k) orthonormal basis of the span of columns whose length was 1."""
    u, values, _ = np.linalg.svd(columns, full_matrices=False)
    return u[:, values > 1e-10]
