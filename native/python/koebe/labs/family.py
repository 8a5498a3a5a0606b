"""Many shapes with their loops in one order, so that their modules are comparable vectors; many closed surfaces."""

import csv
import io
import math
import os
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from typing import Any, overload

import numpy as np

from .._arrays import as_indices
from .._native import _koebe
from .._options import flag, listed, whole
from .._progress import Run, Shown, Watched
from .._report_entries import Warning
from .._signatures import Rims, Unpack
from .._types import Floats, Ints, Values
from .._watched import watched
from ..errors import InputError, TopologyError
from ..io.files import whole_file
from ..maps.image import to_image
from ..maps.result import MapReport
from ..maps.sphere import SphereMap, sphere_map
from ..maps.uniformize import uniformize
from .corresponding import LaidShapes, PointFamily, checked_labels, landmark_pairs_of
from .doubtful_match import sure_match
from .shapes import conformal_module, module_error, module_names
from .sphere_family import SphereFamily, sphere_family
from .sphere_transfer import STIFFNESS, SphereOptions
from .template_family import over_template
from .transfer import on_one_template, transfer


@dataclass(frozen=True, eq=False)
class Family(PointFamily):
    """Shapes with equally many loops: their modules in one order of the loops, and corresponding points.

    All shapes are fitted to one template, when points are first asked for; then they have all that a PointFamily has.

    modules    (N, 3n - 3) float64, a row per shape; lengths in the unit disk
    columns    names of the numbers: r_1, y_2, r_2, ...
    orders     (N, n + 1) int32: each shape's loops in the common order, the outer one first. Without an order of yours
               it is the reference's own order, and a row is the shape's loop for each of the reference's
    labels     of the shapes
    errors     (N, 3n - 3) error bars of the modules (module_error), or None without them
    rims       'smooth' or 'polygonal', as asked for (conformal_module)
    margins    (N,) of the match with the reference's loops, as in LoopMatch; NaN where nothing was matched. Where
               circles leave a doubt, areas decide, and the margin is theirs
    shapes     the results, in the family's order
    reference, template, landmarks    as given to `family`
    """

    modules: Floats
    columns: list[str]
    orders: Ints
    labels: list[str]
    errors: Floats | None = None
    rims: str = "smooth"
    margins: Floats = field(default_factory=lambda: np.zeros(0))
    shapes: tuple[Any, ...] = ()
    reference: int = 0
    template: Any = None
    landmarks: Sequence[Sequence[Any]] | None = None

    def _compared(self) -> dict[str, Any]:
        return {name: value for name, value in super()._compared().items() if name != "laid"}  # made of the others

    @cached_property
    def laid(self) -> LaidShapes:  # type: ignore[override]
        """The shapes fitted to the template, and over their mean. Raises InputError or SolverError."""
        return self._laid(Run(None, None))

    def _laid(self, run: Run) -> LaidShapes:
        orders = list(self.orders)
        return over_template(self.shapes, orders, self.reference, self.template, self.landmarks, run)

    def images(self, fields: Sequence[Any], pixels: int = 256, *, labels: bool | None = None) -> Values:
        """(N, n, n) or (N, n, n, k): fields of all shapes as images of the template's disk, as in `to_image`.

        fields    of each shape its values (V_i,) or (V_i, k) at its vertices
        """
        given = listed(fields, "fields")
        if len(given) != len(self.labels):
            raise InputError(f"there are fields of {len(given)} shapes, not of {len(self.labels)}")
        pairs = zip(self.maps, given, strict=True)
        return np.array([to_image(fit, one, pixels, exact=False, labels=labels)[0] for fit, one in pairs])

    def __repr__(self) -> str:
        return f"<koebe.Family {len(self.labels)} shapes, {self.orders.shape[1]} loops>"

    def match(self, a: int, b: int) -> Ints:
        """(n + 1,) int32: shape b's loop for each of shape a's: the form of `match` in all functions."""
        one, other = (whole(shape, "a shape", 0, len(self.orders) - 1) for shape in (a, b))
        return self.orders[other][np.argsort(self.orders[one])]

    @property
    def distance_errors(self) -> Floats | None:
        """(N, N) error bars of the distances: root of the sum of both modules' squared bars; None without bars."""
        if self.errors is None:
            return None
        size = np.linalg.norm(self.errors, axis=1)
        return np.where(np.eye(len(size), dtype=bool), 0.0, np.hypot(size[:, None], size[None]))

    @property
    def distances(self) -> Floats:
        """(N, N) L2 distances of the modules: a metric, as all use one order of the loops."""
        return np.linalg.norm(self.modules[:, None] - self.modules[None], axis=2)

    def to_dataframe(self) -> Any:
        """A row per shape, named by its label: its module, and its error bars if any, as a pandas DataFrame."""
        bars = self.modules[:, :0] if self.errors is None else self.errors
        names = [] if self.errors is None else [f"{column}_error" for column in self.columns]
        table = np.column_stack([self.modules, bars])
        return import_module("pandas").DataFrame(table, index=self.labels, columns=[*self.columns, *names])

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
    template: Any
    landmarks: Sequence[Sequence[Any]] | None
    order: Sequence[int] | None
    orders: Sequence[Sequence[int]] | None
    labels: Sequence[str] | None
    rims: Rims
    error: bool


@overload
def family(results: Sequence[SphereMap], **how: "Unpack[_OfSpheres]") -> SphereFamily: ...
@overload
def family(results: Sequence[Any], **how: "Unpack[_OfDisks]") -> Family: ...
@watched()
def family(
    results: Sequence[Any],
    *,
    reference: int = 0,
    order: Sequence[int] | None = None,
    orders: Sequence[Sequence[int]] | None = None,
    labels: Sequence[str] | None = None,
    rims: Rims = "smooth",
    error: bool = False,
    template: Any = None,
    landmarks: Sequence[Sequence[Any]] | None = None,
    fields: Sequence[Any] | None = None,
    moebius: bool = False,
    bend: bool = False,
    stiffness: float = STIFFNESS,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> Family | SphereFamily:
    """Take one order of the loops for all shapes, and compute their modules in it; lay shapes over one of them.

    results     of uniformize or fit_circles, or objects with centers and radii: equally many loops each, at least two.
                Or of sphere_map. Surfaces are mapped first, in any form that uniformize takes
    reference   the shape whose loops set the order: the others' loops are matched to them (match_loops). Of matches
                that fit nearly alike, the one is taken that changes areas most evenly
    order       of the reference's loops, the outer one first (mouth, eye, eye); None: as in its result
    orders      of every shape's loops, given by you; then nothing is matched
    labels      of the shapes, such as file names; None: 0, 1, 2, ...
    rims        'smooth' or 'polygonal', as in conformal_module
    error       also compute error bars of the modules (module_error), which maps a finer mesh for each
    template    centers and radii of the holes' circles in this order, or an object with both, to which all shapes are
                fitted for their points. None: circles of the reference's map with even=0.5, and points are made when
                they are first asked for. Fits to one template stay as they are
    landmarks   of every shape its landmarks, in one order, as in transfer: they hold points, and with up to five holes
                decide which loops correspond
    fields      of results of sphere_map: of every shape its fields
    moebius, bend, stiffness    of results of sphere_map, as in transfer
    progress, cancel    as for `uniformize`
    A loop that may be matched wrongly gives a koebe.Warning ('ambiguous_match'). Each shape corresponds to the
    reference by `transfer`, and the points that correspond have a mean, distances and matrices of fields (PointFamily).
    Results of sphere_map, of closed surfaces, give a SphereFamily.
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
    >>> found.points.shape
    (2, 2309, 3)
    """
    run = Run(progress, cancel)
    given = listed(results, "results")
    if not given:
        raise InputError("there are no shapes")
    share = sum(not _is_result(shape) for shape in given) / (2.0 * len(given))  # of the time, for maps
    shapes, run = _mapped(given, run.part(0.0, share)), run.part(share, 1.0)
    spheres = [isinstance(shape, SphereMap) for shape in shapes]
    for number in range(len(shapes)):
        if spheres[number] != spheres[0]:
            raise InputError(
                f"shape {number} is a map to the {'sphere' if spheres[number] else 'disk'}, shape 0 is not: a "
                "family has results of uniformize, or of sphere_map",
                [number],
                "shapes",
            )
    if spheres[0]:
        if order is not None or orders is not None or error or rims != "smooth" or template is not None:
            raise InputError("order, orders, rims, error and template are for surfaces with holes")
        how: dict[str, Any] = {"moebius": moebius, "bend": bend, "stiffness": stiffness}
        return sphere_family(shapes, reference, labels, landmarks, fields, run, **how)
    if fields is not None or flag(moebius, "moebius") or flag(bend, "bend"):
        raise InputError("fields, moebius and bend are for results of sphere_map")
    count = len(shapes[0].radii)
    for number, shape in enumerate(shapes):
        if len(shape.radii) != count:
            raise InputError(
                f"shape {number} has {len(shape.radii)} loops, shape 0 has {count}: a family has equally many",
                [number],
                "shapes",
            )
    names = checked_labels(labels, len(shapes))
    if landmarks is not None and len(listed(landmarks, "landmarks")) != len(shapes):
        raise InputError(f"there are landmarks of {len(landmarks)} shapes, not of {len(shapes)}")
    first = whole(reference, "reference", least=0, most=len(shapes) - 1)
    margins = np.full(len(shapes), np.nan)
    later = 0.5 if template is not None or landmarks is not None else 1.0  # then comes the template
    if orders is None:
        wanted = np.arange(count, dtype=np.int32) if order is None else as_indices(order, "order", count, "loops")
        part = run.part(0.0, 0.3 * later if error else later)
        chosen: list[Ints] = []
        for number, shape in enumerate(shapes):
            part.at(number / len(shapes), "match")
            own = part.part(number / len(shapes), (number + 1) / len(shapes))
            pairs = landmark_pairs_of(landmarks, number, first)
            match, margins[number] = _match(shapes[first], shape, rims, pairs, own)
            chosen.append(match[wanted])
        _tell_of_doubt(margins, names)
    elif order is not None:
        raise InputError("give one order, or the orders of all shapes")
    elif len(orders) != len(shapes):
        raise InputError(f"there are {len(orders)} orders for {len(shapes)} shapes")
    else:
        chosen = [as_indices(each, "orders", count, "loops") for each in orders]
    modules = [
        conformal_module(shape, order=each.tolist(), rims=rims) for shape, each in zip(shapes, chosen, strict=True)
    ]
    bars: list[Floats] = []
    for shape, each in zip(shapes, chosen, strict=True) if flag(error, "error") else ():
        part = run.part(*(later * (0.3 + 0.7 * (len(bars) + k) / len(shapes)) for k in (0, 1)))
        bars.append(module_error(shape, order=each.tolist(), rims=rims, progress=part.progress, cancel=part.cancel))
    found = Family(
        np.array(modules), module_names(count), np.array(chosen), names, np.array(bars) if error else None, rims,
        margins, tuple(shapes), first, template, landmarks,
    )  # fmt: skip
    if later < 1.0:
        vars(found)["laid"] = found._laid(run.part(later, 1.0))
    run.at(1.0, "finish")
    return found


def _is_result(shape: Any) -> bool:
    return isinstance(shape, SphereMap) or (hasattr(shape, "centers") and hasattr(shape, "radii"))


def _mapped(shapes: list[Any], run: Run) -> list[Any]:
    """The shapes, surfaces among them mapped: to the disk, or closed ones to the sphere."""
    if any(isinstance(shape, MapReport) and not _is_result(shape) for shape in shapes):
        other = next(type(shape).__name__ for shape in shapes if isinstance(shape, MapReport) and not _is_result(shape))
        raise TypeError(f"family takes results of uniformize, or of sphere_map, not {other}")
    found = []
    for number, shape in enumerate(shapes):
        run.at(number / len(shapes), "map")
        if _is_result(shape):
            found.append(shape)
            continue
        try:
            found.append(uniformize(shape, cancel=run.cancel))
        except TopologyError as error:
            if error.kind != "closed":
                raise
            found.append(sphere_map(shape, cancel=run.cancel))
    return found


def _match(reference: Any, shape: Any, rims: Rims, pairs: list[Any] | None, run: Run) -> tuple[Ints, float]:
    """The shape's loop for each of the reference's, and the margin of this match; NaN if it was not searched."""
    if shape is reference or on_one_template(reference, shape):
        return np.arange(len(reference.radii), dtype=np.int32), math.nan
    if pairs is not None:
        turned = [pair[::-1] for pair in pairs]
        by_points = transfer(reference, shape, landmarks=turned, progress=run.progress, cancel=run.cancel)
        return np.array(by_points.match, np.int32), math.nan
    return sure_match(reference, shape, rims, run)


def _tell_of_doubt(margins: Floats, names: list[str]) -> None:
    """Warn of shapes whose loops may be matched wrongly."""
    unsure = np.flatnonzero(margins < _koebe.ambiguous_margin)
    if len(unsure):
        worst = int(unsure[np.argmin(margins[unsure])])
        text = (
            f"the loops of {len(unsure)} of {len(names)} shapes may be matched wrongly: of shape {names[worst]} "
            f"another match fits nearly as well (margin {margins[worst]:.2g}). Give orders, or landmarks"
        )
        warnings.warn(Warning(kind="ambiguous_match", elements=[], text=text), stacklevel=4)
