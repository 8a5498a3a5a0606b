"""Many shapes with their loops in one order, so that their modules are comparable vectors; many closed surfaces."""

import csv
import io
import os
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, overload

import numpy as np

from .._arrays import as_indices
from .._native import _koebe
from .._options import flag, whole
from .._progress import Progress, Run, Watched
from .._signatures import Rims, Unpack
from ..errors import InputError
from ..io.files import whole_file
from ..maps.sphere import SphereMap
from .shapes import conformal_module, match_loops, module_error, module_names
from .sphere_family import SphereFamily, sphere_family
from .sphere_transfer import STIFFNESS, SphereOptions


@dataclass(frozen=True)
class Family:
    """The modules of shapes with equally many loops, in one order of the loops.

    modules    (N, 3n - 3) float64, a row per shape; lengths in the unit disk
    columns    names of the numbers: r_1, y_2, r_2, ...
    orders     (N, n + 1) int32: each shape's loops in the common order, the outer one first. Without an order of yours
               it is the reference's own order, and a row is the shape's loop for each of the reference's
    labels     of the shapes
    errors     (N, 3n - 3) error bars of the modules (module_error), or None without them
    rims       'smooth' or 'polygonal', as asked for (conformal_module)
    """

    modules: np.ndarray
    columns: list[str]
    orders: np.ndarray
    labels: list[str]
    errors: np.ndarray | None = None
    rims: str = "smooth"

    def __repr__(self) -> str:
        return f"<koebe.Family {len(self.labels)} shapes, {self.orders.shape[1]} loops>"

    def match(self, a: int, b: int) -> np.ndarray:
        """(n + 1,) int32: shape b's loop for each of shape a's: the form of `match` in all functions."""
        return self.orders[b][np.argsort(self.orders[a])]

    @property
    def distance_errors(self) -> np.ndarray | None:
        """(N, N) error bars of the distances: root of the sum of both modules' squared bars; None without bars."""
        if self.errors is None:
            return None
        size = np.linalg.norm(self.errors, axis=1)
        return np.where(np.eye(len(size), dtype=bool), 0.0, np.hypot(size[:, None], size[None]))

    @property
    def distances(self) -> np.ndarray:
        """(N, N) L2 distances of the modules: a metric, as all use one order of the loops."""
        return np.linalg.norm(self.modules[:, None] - self.modules[None], axis=2)

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write a row per shape: its label, its module and its error bars if any (r_1_error, ...), with a head line, as
        R's read.csv and pandas read it."""
        text = io.StringIO(newline="")
        writer = csv.writer(text)
        bars = self.modules[:, :0] if self.errors is None else self.errors
        names = [] if self.errors is None else [f"{column}_error" for column in self.columns]
        writer.writerow(["label", *self.columns, *names])
        for label, *rows in zip(self.labels, self.modules, bars, strict=True):
            writer.writerow([label, *(repr(number) for row in rows for number in row.tolist())])
        with whole_file(path) as file:
            file.write(text.getvalue().encode())


class _OfSpheres(SphereOptions, total=False):
    reference: int
    labels: Sequence[str] | None
    landmarks: Sequence[Sequence[Any]] | None
    fields: Sequence[Any] | None


class _OfDisks(Watched, total=False):
    reference: int
    order: Sequence[int] | None
    orders: Sequence[Sequence[int]] | None
    labels: Sequence[str] | None
    rims: Rims
    error: bool


@overload
def family(results: Sequence[SphereMap], **how: "Unpack[_OfSpheres]") -> SphereFamily: ...
@overload
def family(results: Sequence[Any], **how: "Unpack[_OfDisks]") -> Family: ...
def family(
    results: Sequence[Any],
    *,
    reference: int = 0,
    order: Sequence[int] | None = None,
    orders: Sequence[Sequence[int]] | None = None,
    labels: Sequence[str] | None = None,
    rims: Rims = "smooth",
    error: bool = False,
    landmarks: Sequence[Sequence[Any]] | None = None,
    fields: Sequence[Any] | None = None,
    moebius: bool = False,
    bend: bool = False,
    stiffness: float = STIFFNESS,
    progress: Progress | None = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> Family | SphereFamily:
    """Take one order of the loops for all shapes, and compute their modules in it; or lay closed surfaces over one.

    results     of uniformize, or objects with centers and radii: equally many loops each, at least two
    reference   the shape whose loops set the order: the others' loops are matched to them (match_loops)
    order       of the reference's loops, the outer one first (mouth, eye, eye); None: as in its result
    orders      of every shape's loops, given by you; then nothing is matched
    labels      of the shapes, such as file names; None: 0, 1, 2, ...
    rims        'smooth' or 'polygonal', as in conformal_module
    error       also compute error bars of the modules (module_error), which maps a finer mesh for each
    landmarks, fields    of results of sphere_map: of every shape its landmarks, in one order, or its fields
    moebius, bend, stiffness    of results of sphere_map, as in transfer
    progress, cancel    as for `uniformize`
    Results of sphere_map, of closed surfaces, give a SphereFamily: each shape corresponds to the reference by
    `transfer`, and the points that correspond have a mean and distances.
    module_distance takes the best order for its two shapes, so three such distances need not obey the triangle
    inequality; the distances of a family do. Raises InputError, also for circles that are not the surface's own,
    or Cancelled.

    >>> import koebe
    >>> faces = [koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised")]
    >>> found = koebe.family(faces, labels=["face", "surprised"])
    >>> found.columns
    ['r_1', 'y_2', 'r_2', 'x_3', 'y_3', 'r_3']
    >>> found.distances.round(2)
    array([[0.  , 0.06],
           [0.06, 0.  ]])
    """
    run = Run(progress, cancel)
    shapes = list(results)
    if not shapes:
        raise InputError("there are no shapes")
    spheres = [isinstance(shape, SphereMap) for shape in shapes]
    for number, shape in enumerate(shapes):
        if spheres[number] != spheres[0]:
            raise InputError(
                f"shape {number} is a map to the {'sphere' if spheres[number] else 'disk'}, shape 0 is not: a "
                "family has results of uniformize, or of sphere_map",
                [number],
                "shapes",
            )
        if not (spheres[number] or (hasattr(shape, "centers") and hasattr(shape, "radii"))):
            raise TypeError(f"family takes results of uniformize, or of sphere_map, not {type(shape).__name__}")
    if spheres[0]:
        if order is not None or orders is not None or error or rims != "smooth":
            raise InputError("order, orders, rims and error are for surfaces with holes")
        how: dict[str, Any] = {"moebius": moebius, "bend": bend, "stiffness": stiffness}
        return sphere_family(shapes, reference, labels, landmarks, fields, run, **how)
    if landmarks is not None or fields is not None or moebius or bend:
        raise InputError("landmarks, fields, moebius and bend are for results of sphere_map")
    count = len(shapes[0].radii)
    for number, shape in enumerate(shapes):
        if len(shape.radii) != count:
            raise InputError(
                f"shape {number} has {len(shape.radii)} loops, shape 0 has {count}: a family has equally many",
                [number],
                "shapes",
            )
    if labels is not None and len(labels) != len(shapes):
        raise InputError(f"there are {len(labels)} labels for {len(shapes)} shapes")
    if orders is None:
        first = whole(reference, "reference", least=0, most=len(shapes) - 1)
        wanted = np.arange(count, dtype=np.int32) if order is None else as_indices(order, "order", count, "loops")
        part = run.part(0.0, 0.3 if error else 1.0)
        chosen: list[np.ndarray] = []
        for shape in shapes:
            part.at(len(chosen) / len(shapes), "match")
            chosen.append(_like(shapes[first], shape, wanted, rims))
    elif order is not None:
        raise InputError("give one order, or the orders of all shapes")
    elif len(orders) != len(shapes):
        raise InputError(f"there are {len(orders)} orders for {len(shapes)} shapes")
    else:
        chosen = [as_indices(each, "orders", count, "loops") for each in orders]
    modules = [
        conformal_module(shape, order=each.tolist(), rims=rims) for shape, each in zip(shapes, chosen, strict=True)
    ]
    names = [str(label) for label in (labels if labels is not None else range(len(shapes)))]
    bars: list[np.ndarray] = []
    for shape, each in zip(shapes, chosen, strict=True) if flag(error, "error") else ():
        part = run.part(*(0.3 + 0.7 * (len(bars) + k) / len(shapes) for k in (0, 1)))
        bars.append(module_error(shape, order=each.tolist(), rims=rims, progress=part.progress, cancel=part.cancel))
    run.at(1.0, "finish")
    return Family(
        np.array(modules), module_names(count), np.array(chosen), names, np.array(bars) if error else None, rims
    )


def _like(reference: Any, shape: Any, wanted: np.ndarray, rims: Rims) -> np.ndarray:
    """The shape's loops that correspond to the reference's, in the wanted order."""
    if shape is reference:
        return wanted
    return match_loops(reference, shape, rims=rims).match[wanted]
