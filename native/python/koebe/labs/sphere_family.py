"""Many closed surfaces with corresponding points, and their mean."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._options import whole
from .._progress import Run
from ..errors import InputError
from ..maps.sphere import SphereMap
from .sphere_alignment import nearest_rotation
from .sphere_transfer import SphereCorrespondence, vertex_areas
from .transfer import transfer


@dataclass(frozen=True)
class SphereFamily:
    """Closed surfaces with a point of each for every vertex of a reference, turned over their mean.

    points           (N, V, 3) the corresponding points, moved and turned to lie as near to the mean as they can; sizes
                     are kept
    mean             (V, 3) their mean, with the reference's triangles: the mean surface
    triangles        (F, 3) of the reference
    weights          (V,) area around each of the reference's vertices, sum 1; 0 without a face
    correspondences  list of SphereCorrespondence, from each shape to the reference; None for the reference itself
    labels           of the shapes
    """

    points: np.ndarray
    mean: np.ndarray
    triangles: np.ndarray
    weights: np.ndarray
    correspondences: list[SphereCorrespondence | None]
    labels: list[str]

    def __repr__(self) -> str:
        return f"<koebe.SphereFamily {len(self.labels)} shapes, {len(self.mean)} points>"

    @property
    def distances(self) -> np.ndarray:
        """(N, N) root mean square distances of corresponding points by area, each two turned over each other: in the
        shapes' unit."""
        used, found = self.weights > 0.0, np.zeros((len(self.points),) * 2)
        for i, one in enumerate(self.points):
            for j in range(i):
                away = _laid_over(self.points[j][used], one[used], self.weights[used]) - one[used]
                found[i, j] = found[j, i] = np.sqrt(self.weights[used] @ (away**2).sum(axis=1))
        return found


def sphere_family(
    shapes: Sequence[SphereMap],
    reference: int,
    labels: Sequence[str] | None,
    landmarks: Sequence[Sequence[Any]] | None,
    fields: Sequence[Any] | None,
    run: Run,
    **how: Any,
) -> SphereFamily:
    """The family, with correspondences by `transfer` from each shape to the reference.

    landmarks, fields    of every shape, in one order
    how                  moebius, bend and stiffness, as in transfer
    """
    first = whole(reference, "reference", least=0, most=len(shapes) - 1)
    for name, given in (("landmarks", landmarks), ("fields", fields), ("labels", labels)):
        if given is not None and len(given) != len(shapes):
            raise InputError(f"there are {name} of {len(given)} shapes, not of {len(shapes)}")
    base, points = shapes[first], []
    found: list[SphereCorrespondence | None] = []
    for number, shape in enumerate(shapes):
        if number == first:
            found.append(None)
            points.append(base.vertices.astype(np.float64))
            continue
        pairs = None
        if landmarks is not None:
            if len(landmarks[number]) != len(landmarks[first]):
                raise InputError(f"shape {number} has {len(landmarks[number])} landmarks, not {len(landmarks[first])}")
            pairs = list(zip(landmarks[number], landmarks[first], strict=True))
        both = None if fields is None else (fields[number], fields[first])
        part = run.part(number / len(shapes), (number + 1) / len(shapes))
        how |= {"progress": part.progress, "cancel": part.cancel}
        laid = transfer(shape, base, landmarks=pairs, fields=both, **how)
        found.append(laid)
        points.append(laid.points)
    weights = vertex_areas(base)
    weights = weights / weights.sum()
    used = weights > 0.0
    laid = np.where(used[None, :, None], np.array(points), np.nan)
    laid[:, used] = _over_their_mean(laid[:, used], weights[used])
    names = [str(label) for label in (labels if labels is not None else range(len(shapes)))]
    run.at(1.0, "finish")
    return SphereFamily(laid, laid.mean(axis=0), base.triangles, weights, found, names)


def _over_their_mean(points: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Shapes (N, n, 3) moved and turned over their mean, and that in turn, until it stays [Gower 1975]."""
    mean = points[0] - weights @ points[0]
    for _ in range(100):
        points = np.array([_laid_over(shape, mean, weights) for shape in points])
        before, mean = mean, points.mean(axis=0)
        if np.abs(mean - before).max() <= 1e-12 * np.abs(mean).max():
            break
    return points


def _laid_over(shape: np.ndarray, other: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The shape (n, 3), moved and turned to lie nearest to the other."""
    middle, there = weights @ shape, weights @ other
    turn = nearest_rotation((other - there).T @ ((shape - middle) * weights[:, None]))
    return (shape - middle) @ turn.T + there
