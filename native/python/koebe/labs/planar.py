"""Circle domains of planar domains with smooth or polygonal rims, to ten digits."""

import json
import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .._arrays import as_values
from .._comparable import Result
from .._native import _koebe
from .._option_table import rows
from .._options import callback, filled, path_of, token
from .._progress import Shown
from .._types import Floats, Ints
from .._watched import watched
from ..errors import FileError, InputError


@dataclass(frozen=True, eq=False, repr=False)
class PlanarMap(Result):
    """A conformal map of a planar domain to a circle domain. Call it with (N, 2) places to get their images.

    centers       (L, 2) float64: circles in the position of conformal_module, the unit circle first
    radii         (L,) float64
    rims          (L,) int32: the number of each circle's rim in the input, the outer rim first
    module        the numbers of conformal_module, in this order of the rims
    module_errors how far each may be off: its change from the next coarser resolution, at least the largest residual
    error         the same for all circles, a length in the unit disk
    residuals     (L,) the greatest distance of each rim's image from its circle, between the samples as well
    converged     whether `error`, and `slit_error`, are at most the tolerance
    slits         None, or (L,) pairs of complex numbers: the ends of each rim's slit, equal for a circle round 0
    slit_error    how far an end may be off, of the greatest distance of one from 0
    sweeps, levels, unknowns    of the iteration at the finest resolution; resolutions; size of the largest system
    """

    centers: Floats
    radii: Floats
    rims: Ints
    module: Floats
    module_errors: Floats
    error: float
    residuals: Floats
    converged: bool
    sweeps: int
    levels: int
    unknowns: int
    slits: Floats | None
    slit_error: float
    _native: Any
    _given: tuple[str, bool, dict[str, Any]]

    def __call__(self, points: Any) -> Floats:
        """(N, 2) images of places of the domain, rims included. Raises InputError for places off it."""
        return self._native.image(_places(points))

    def slit_images(self, points: Any) -> Floats:
        """(N, 2) images of places in the slit domain. Raises InputError for places off the domain, or without slits."""
        return self._native.slit_image(_places(points))

    def inverse(self, points: Any) -> Floats:
        """(N, 2) places whose images these are. Raises InputError for points off the circle domain, SolverError."""
        return self._native.preimage(_places(points))

    def __repr__(self) -> str:
        return f"<koebe.PlanarMap {len(self.radii)} rims, error {self.error:.2g}, {self.sweeps} sweeps>"

    def _drawing(self) -> dict[str, Any]:
        return {"circles": (self.centers, self.radii)}

    def _state(self) -> dict[str, Any]:
        return dict(zip(("text", "is_svg", "given"), self._given, strict=True))

    @classmethod
    def _made(cls, state: Mapping[str, Any]) -> "PlanarMap":
        return _mapped(**state)

    def __reduce__(self) -> tuple[Any, ...]:
        return _mapped, self._given  # the same again: formulas of thousands of poles are longer than their rims

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict."""
        return self._native.report()


def _places(points: Any) -> Floats:
    array = as_values(points, "points")
    if array.dtype.kind == "c":
        array = np.stack([array.real, array.imag], axis=-1)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "fiu":
        raise InputError(f"points must be (N, 2) real or (N,) complex numbers, not {array.shape} {array.dtype}")
    array = array.astype(np.float64)
    if not np.isfinite(array).all():
        raise InputError("points must be finite")
    return array


def _described(rims: Any) -> tuple[str, bool]:
    """The rims as a text, and whether it is SVG."""
    if isinstance(rims, (str, os.PathLike)):
        path = Path(path_of(rims, "rims"))
        try:
            return path.read_text("utf-8"), path.suffix.lower() == ".svg"
        except (OSError, UnicodeDecodeError) as error:
            raise FileError(f"cannot read {path}: {error}") from None
    if not isinstance(rims, Iterable) or isinstance(rims, Mapping):
        raise TypeError(f"rims must be a file's name or a list of rims, not {type(rims).__name__}")
    listed = [dict(rim) if isinstance(rim, Mapping) else {"points": _places(rim).tolist()} for rim in rims]
    try:
        return json.dumps({"rims": listed}, default=_plain), False
    except (TypeError, ValueError) as error:
        raise InputError(f"a rim has an entry that is not a number: {error}") from None


def _plain(value: Any) -> Any:
    """NumPy's arrays and numbers as lists and numbers."""
    array = np.asarray(value)
    if array.dtype.kind == "c":
        array = np.stack([array.real, array.imag], axis=-1)
    if array.dtype.kind not in "fiu":
        raise TypeError(repr(value))
    return array.tolist()


def _mapped(text: str, is_svg: bool, given: dict[str, Any], progress: Any = None, cancel: Any = None) -> PlanarMap:
    # A pole is a complex number or a pair.
    pole = given["pole"]
    options, _ = filled("planar", _koebe.PlanarOptions(), given)
    if pole is not None:
        place = as_values(pole, "pole")
        is_number = not place.ndim and place.dtype.kind in "fiuc"
        options.pole = complex(*_places(place.reshape(1).astype(complex) if is_number else place[None])[0])
    native = _koebe.planar_map(text, is_svg, options, progress, token(cancel, "cancel"))
    # Native lists as arrays, in the order of PlanarMap's fields.
    centers, radii = native.circles
    order, residuals = np.array(native.order, np.int32), np.array(native.residuals)
    module, errors = native.module, native.module_errors
    slits = np.array(native.slits) if native.slits else None
    counts = native.converged, native.sweeps, native.levels, native.unknowns
    return PlanarMap(
        centers,
        radii,
        order,
        module,
        errors,
        native.error,
        residuals,
        *counts,
        slits,
        native.slit_error,
        native,
        (text, is_svg, given),
    )


@watched()
def planar(
    rims: Any,
    *,
    tolerance: float = rows("planar")["tolerance"].default,
    max_sweeps: int = rows("planar")["max_sweeps"].default,
    slits: str = rows("planar")["slits"].default,
    slit_angle: float = rows("planar")["slit_angle"].default,
    pole: Any = None,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> PlanarMap:
    """Map a planar domain with holes to a circle domain, to ten digits, corners included.

    rims         an outer rim and holes, in any order and direction: a list, or the name of a JSON or SVG file. A rim
                 is an (N, 2) or complex array with the corners of a polygon, or a dict as in the file
                 (docs/shapes.md), for example {"circle": {"center": [0, 0], "radius": 1}}
    tolerance    add poles until no circle changes by more than this, a length in the unit disk
    max_sweeps   stop each resolution after this many sweeps over all rims
    slits        "parallel", "circular" or "radial": also map to that slit domain. In the last two the outer rim becomes
                 the unit circle, and the rim of circle 1 a circle round 0
    slit_angle   direction of parallel slits, degrees from the x axis
    pole         a place (x, y) of the domain, or a complex number: parallel slits have 1 / (z - pole) there
    progress, cancel    as for `uniformize`
    The rims must not meet. Each rim in turn is mapped to a circle by a rational function with poles near its corners.
    Raises InputError for rims that meet, lie outside the outer one or are no curves, SolverError for rims that are too
    near each other to be resolved (`elements`: their numbers), FileError, Cancelled.

    >>> import koebe
    >>> square = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    >>> ring = koebe.planar([[(2 * x, 2 * y) for x, y in square], square])
    >>> print(f"{ring.module[0]:.10f}", ring.error < 1e-10)
    0.5412107610 True
    """
    run = callback(progress, "progress"), token(cancel, "cancel")
    given = {"tolerance": tolerance, "max_sweeps": max_sweeps, "slits": slits, "slit_angle": slit_angle, "pole": pole}
    return _mapped(*_described(rims), given, *run)
