"""Many closed surfaces with corresponding points, through their maps to the sphere."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from .._options import whole
from .._progress import Run
from .._types import Floats
from ..errors import InputError
from ..maps.sphere import SphereMap
from .corresponding import LaidShapes, PointFamily, checked_labels, laid_over_mean, landmark_pairs_of
from .sphere_transfer import SphereCorrespondence
from .transfer import transfer


@dataclass(frozen=True, eq=False)
class SphereFamily(PointFamily):
    """Closed surfaces with a point of each for every vertex of a reference: all that a PointFamily has.

    labels    of the shapes
    laid      the shapes over their mean
    """

    labels: list[str]
    laid: LaidShapes

    def __repr__(self) -> str:
        return f"<koebe.SphereFamily {len(self.labels)} shapes, {len(self.mean)} points>"

    @property
    def distances(self) -> Floats:
        """(N, N) the point_distances, in the shapes' unit."""
        return self.point_distances


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
    base = whole(reference, "reference", least=0, most=len(shapes) - 1)
    for name, given in (("landmarks", landmarks), ("fields", fields)):
        if given is not None and len(given) != len(shapes):
            raise InputError(f"there are {name} of {len(given)} shapes, not of {len(shapes)}")
    names = checked_labels(labels, len(shapes))

    def correspond(number: int, part: Run) -> SphereCorrespondence:
        pairs = landmark_pairs_of(landmarks, number, base)
        both = None if fields is None else (fields[number], fields[base])
        watched: dict[str, Any] = {**how, "progress": part.progress, "cancel": part.cancel}
        return transfer(shapes[number], shapes[base], landmarks=pairs, fields=both, **watched)

    laid = laid_over_mean(shapes, base, correspond, run)
    run.at(1.0, "finish")
    return SphereFamily(names, laid)
