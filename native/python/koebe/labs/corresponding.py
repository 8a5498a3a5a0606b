"""Many shapes with corresponding points: what families of closed surfaces and of surfaces with holes share."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib import import_module
from typing import Any

import numpy as np

from .._arrays import as_values
from .._comparable import Result
from .._options import listed
from .._progress import Run
from .._types import Bools, Floats, Ints, Values
from ..errors import InputError
from .sphere_alignment import nearest_rotation
from .sphere_transfer import SphereCorrespondence, vertex_areas
from .transfer import Correspondence

AnyCorrespondence = Correspondence | SphereCorrespondence


@dataclass(frozen=True, eq=False)
class LaidShapes(Result):
    """Shapes with a point of each for every vertex of a reference, as PointFamily says."""

    points: Floats
    triangles: Ints
    weights: Floats
    correspondences: list[AnyCorrespondence | None]
    maps: list[Any]


class PointFamily(Result):
    """Shapes with a point of each for every vertex of a reference, moved and turned over their mean.

    labels    of the shapes
    """

    labels: list[str]
    laid: LaidShapes

    @property
    def points(self) -> Floats:
        """(N, V, 3) the corresponding points, moved and turned to lie as near to the mean as they can, in the shapes'
        unit. Sizes are kept. NaN at vertices of the reference without a face."""
        return self.laid.points

    @property
    def mean(self) -> Floats:
        """(V, 3) the mean of the points: with the reference's triangles, the mean surface."""
        return self.points.mean(axis=0)

    @property
    def spread(self) -> Floats:
        """(V,) root mean square distance of the points from their mean, in the shapes' unit."""
        away = np.linalg.norm(self.points - self.mean, axis=2)
        size = _size(away)
        return size * np.sqrt(((away / size) ** 2).mean(axis=0))

    @property
    def triangles(self) -> Ints:
        """(F, 3) int32: the reference's triangles."""
        return self.laid.triangles

    @property
    def weights(self) -> Floats:
        """(V,) area around each of the reference's vertices, sum 1; 0 without a face."""
        return self.laid.weights

    @property
    def correspondences(self) -> list[AnyCorrespondence | None]:
        """From each shape to the reference, by `transfer`; None for the reference itself."""
        return self.laid.correspondences

    @property
    def maps(self) -> list[Any]:
        """The maps through which the points correspond: spheres, or fits to the template."""
        return self.laid.maps

    @property
    def vertices(self) -> Floats:
        """(V, 3) the mean: the family is a surface, and koebe.plot draws it."""
        return self.mean

    @property
    def _base(self) -> Any:
        """The reference's map."""
        return next(one for one, found in zip(self.maps, self.correspondences, strict=True) if found is None)

    def _drawn(self) -> Bools:
        drawn: Bools = self._base._drawn()
        return drawn

    def _picture(self) -> str:
        picture: str = self._base._picture()
        return picture

    def _layout(self) -> tuple[Floats, float]:
        layout: tuple[Floats, float] = self._base._layout()
        return layout

    @property
    def point_distances(self) -> Floats:
        """(N, N) root mean square distances of corresponding points by area, each two turned over each other: in the
        shapes' unit."""
        used, found = self.weights > 0.0, np.zeros((len(self.points),) * 2)
        size = _size(self.points)
        points, weights = self.points[:, used] / size, self.weights[used]
        for i, one in enumerate(points):
            for j in range(i):
                away = _laid_over(points[j], one, weights) - one
                found[i, j] = found[j, i] = np.sqrt(weights @ (away**2).sum(axis=1))
        return size * found

    def to_dataframe(self) -> Any:
        """A row and a column per shape, named by its label: the point_distances, as a pandas DataFrame."""
        return library("pandas").DataFrame(self.point_distances, index=self.labels, columns=self.labels)

    def to_xarray(self) -> Any:
        """The points as an xarray DataArray with the dimensions shape (by label), vertex and axis (x, y, z)."""
        coords = {"shape": self.labels, "axis": ["x", "y", "z"], "weight": ("vertex", self.weights)}
        return library("xarray").DataArray(self.points, coords, ("shape", "vertex", "axis"), "points")

    def adjacency(self) -> Any:
        """(V, V) scipy.sparse matrix: 1 for the ends of each edge of the reference. Tests of clusters take it, such as
        MNE's. Needs SciPy."""
        ends = np.concatenate([self.triangles[:, [k, k - 1]] for k in range(3)])
        both = np.unique(np.concatenate([ends, ends[:, ::-1]]), axis=0)
        count = len(self.weights)
        return import_module("scipy.sparse").csr_matrix((np.ones(len(both)), both.T), (count, count))

    def matrix(self, fields: Sequence[Any], *, labels: bool | None = None) -> Values:
        """Gather fields of all shapes at corresponding points: (N, V) subjects x points, or (N, V, k).

        fields    of each shape its values (V_i,) or (V_i, k) at its vertices, in any unit
        labels    as in Correspondence.carry. None: as labels, unless a field has floats
        Raises InputError.
        """
        given = [as_values(field, "the field") for field in listed(fields, "fields")]
        if len(given) != len(self.labels):
            raise InputError(f"there are fields of {len(given)} shapes, not of {len(self.labels)}")
        first = next(number for number, found in enumerate(self.correspondences) if found is None)
        rows: list[Floats] = []
        for number, (field, found) in enumerate(zip(given, self.correspondences, strict=True)):
            if found is None and len(field) != len(self.weights):
                raise InputError(f"the field of shape {number} has {len(field)} values, not {len(self.weights)}")
            if field.shape[1:] != given[first].shape[1:]:
                raise InputError(f"the fields have {given[first].shape[1:]} and {field.shape[1:]} columns")
            rows.append(field if found is None else found.carry(field, labels=labels))
        if all(row.dtype.kind == "f" for row in rows):
            rows[first] = np.array(rows[first])
            rows[first][self.weights == 0.0] = np.nan
        return np.array(rows)


def laid_over_mean(
    shapes: Sequence[Any], reference: int, correspond: Callable[[int, Run], AnyCorrespondence], run: Run
) -> LaidShapes:
    """All shapes over their mean.

    shapes       maps of the shapes, with vertices and triangles
    correspond   the correspondence from the shape of that number to the reference
    """
    base = shapes[reference]
    found: list[AnyCorrespondence | None] = []
    for number in range(len(shapes)):
        part = run.part(number / len(shapes), (number + 1) / len(shapes))
        found.append(None if number == reference else correspond(number, part))
    weights = vertex_areas(base)
    weights = weights / weights.sum()
    used = weights > 0.0
    points = np.array([base.vertices.astype(np.float64) if one is None else one.points for one in found])
    laid = np.where(used[None, :, None], points, np.nan)
    size = _size(laid)
    laid[:, used] = size * _over_their_mean(laid[:, used] / size, weights[used])
    return LaidShapes(laid, base.triangles, weights, found, list(shapes))


def checked_labels(labels: Sequence[Any] | None, count: int) -> list[str]:
    """The labels of so many shapes: as given, or their numbers. Raises InputError."""
    if isinstance(labels, str):
        labels = list(labels)
    given = list(range(count)) if labels is None else listed(labels, "labels")
    if len(given) != count:
        raise InputError(f"there are {len(given)} labels for {count} shapes")
    return [str(label) for label in given]


def landmark_pairs_of(landmarks: Sequence[Sequence[Any]] | None, number: int, reference: int) -> list[Any] | None:
    """The landmarks of a shape and of the reference, as `transfer` takes them. Raises InputError."""
    if landmarks is None:
        return None
    if len(landmarks[number]) != len(landmarks[reference]):
        raise InputError(f"shape {number} has {len(landmarks[number])} landmarks, not {len(landmarks[reference])}")
    return list(zip(landmarks[number], landmarks[reference], strict=True))


def _size(values: Floats) -> float:
    """The largest value's size, by which squares are kept in range; 1 for none."""
    return float(np.nanmax(np.abs(values), initial=0.0)) or 1.0


def _over_their_mean(points: Floats, weights: Floats) -> Floats:
    """Shapes (N, n, 3) moved and turned over their mean, and that in turn, until it stays [Gower 1975]."""
    mean = points[0] - weights @ points[0]
    for _ in range(100):
        points = np.array([_laid_over(shape, mean, weights) for shape in points])
        before, mean = mean, points.mean(axis=0)
        if np.abs(mean - before).max() <= 1e-12 * np.abs(mean).max():
            break
    return points


def _laid_over(shape: Floats, other: Floats, weights: Floats) -> Floats:
    """The shape (n, 3), moved and turned to lie nearest to the other."""
    middle, there = weights @ shape, weights @ other
    turn = nearest_rotation((other - there).T @ ((shape - middle) * weights[:, None]))
    return (shape - middle) @ turn.T + there


def library(name: str, package: str = "", extra: str = "statistics") -> Any:
    """A module of an extra. Raises ImportError with what to install."""
    try:
        return import_module(name)
    except ImportError:
        needed = package or name.partition(".")[0]
        raise ImportError(f'this needs {needed}: pip install "koebe[{extra}]"') from None
