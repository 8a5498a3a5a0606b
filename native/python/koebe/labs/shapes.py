"""The shape in a surface's circles: its conformal module, and two domains compared or laid over each other.

A domain here is an object with `centers` (L, 2) and `radii` (L,), the unit circle first, or a UniformizeResult, which
counts with its `conformal` circles. A `match` of a and b is always b's loop for each of a's.
"""

import math
import warnings
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from .._arrays import as_circles, as_indices, as_numbers, as_points
from .._comparable import Result, TupleResult
from .._native import _koebe
from .._option_table import rows
from .._options import choice_of, filled, flag, whole
from .._progress import Run, Shown
from .._report_entries import Warning
from .._signatures import Rims
from .._types import Floats, Ints
from .._watched import watched
from ..errors import InputError, OptionError
from ..maps.result import UniformizeResult

_RIMS = {word: word for word in rows("module")["rims"].words}


class _OtherRims:
    """The circle domain of a result's polyhedron, or of ever finer meshes, kept with the result."""

    def __init__(self, result: UniformizeResult, rims: str, run: Run) -> None:
        self.refined: tuple[Floats, Floats]
        if rims == "polygonal":
            circles, self.refined = _koebe.polygonal_circles(mapped_surface(result), 0, run.progress, run.cancel)
        else:
            self.refined = _refined(result, run)
            circles = _koebe.extrapolated_circles(*as_circles(result), *self.refined)
        self.centers, self.radii = circles


def with_rims(domain: Any, rims: Rims, run: Run | None = None) -> Any:
    """The domain with its circles for this kind of rims."""
    if choice_of(rims, "rims", _RIMS) == "smooth" or isinstance(domain, _OtherRims):
        return domain
    if not isinstance(domain, UniformizeResult):
        raise TypeError(f"{rims} rims need a result of uniformize, not {type(domain).__name__}: circles are not enough")
    kept = vars(domain)
    if f"_{rims}" not in kept:
        kept[f"_{rims}"] = _OtherRims(domain, rims, run or Run(None, None))
    return kept[f"_{rims}"]


def canonical_order(result: Any, *, any_outer: bool = False) -> Ints:
    """An order of the loops, the outer one first, that does not depend on their numbers.

    The loops are sorted by conformal distance from the outer loop. The order jumps where two loops are alike, so
    compare shapes by module_distance of two results, or give the order yourself.
    any_outer: the outer loop is chosen, too.

    >>> import koebe
    >>> koebe.canonical_order(koebe.uniformize("blend_samples/face.obj")).tolist()  # rim, mouth, eyes
    [0, 1, 3, 2]
    """
    return np.array(_koebe.canonical_order(*as_circles(result), flag(any_outer, "any_outer")), dtype=np.int32)


def conformal_module(result: Any, *, order: Sequence[int] | str | None = None, rims: Rims = "smooth") -> Floats:
    """The conformal module of a circle domain (paper, Fig. 13): r_1, y_2, r_2, x_3, y_3, r_3, ...

    order    the loops in the wanted order, the outer one first, which may be any loop; None: as in the result;
             'canonical': by canonical_order
    rims     'smooth': the boundary loops of the mesh are samples of smooth curves, as in the map; 'polygonal': they are
             polygons. This is the module of the polyhedron itself, which certified_moduli encloses: for up to 12 loops.
             The two differ by 3.3 / N^2 of a radius for rims of N equal edges (docs/shapes.md). 'extrapolated': as
             smooth, from the map and one of four times as many faces, for smooth surfaces and rims
    The second loop is moved to the middle of the unit disk and the third's centre onto the positive y axis. Returns
    3n - 3 float64 numbers for n >= 2 holes, 1 for one hole, 0 without holes: lengths in the unit disk. They are equal
    if and only if a conformal map that keeps orientation and numbering takes one surface to the other. Raises
    InputError, also if circles are not the iteration's, as the mesh is too coarse for them.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> dict(zip(koebe.module_names(4), koebe.conformal_module(result).round(1).tolist()))
    {'r_1': 0.2, 'y_2': 0.6, 'r_2': 0.1, 'x_3': -0.4, 'y_3': 0.4, 'r_3': 0.1}
    """
    result = with_rims(result, rims)
    return _koebe.conformal_module(*as_circles(result), chosen_order(result, order))


@watched()
def module_error(
    result: UniformizeResult,
    *,
    order: Sequence[int] | str | None = None,
    rims: Rims = "smooth",
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> Floats:
    """Error bars of conformal_module(result, order=order, rims=rims), lengths in the unit disk: the effect of the mesh.

    Maps the same surface on a mesh with four times as many faces, whose new vertices lie on the smooth surface and the
    smooth rims that the mesh approximates. Each bar is twice the change of its number plus the root mean square of all
    changes. On 24 meshes of exact domains all errors lie within the bars, and half of the bars are less than 5 times
    the error (docs/labs.md). Takes about 5 times as long as the map, once for each result. With rims='polygonal' the
    bars come from the bounds of the polyhedron's capacities, with 'extrapolated' they are about the finer mesh's.
    With smooth rims a koebe.Warning ('coarse_mesh') says where polygonal ones would change a radius by more than its
    bar, by a forecast.
    progress, cancel    as for `uniformize`
    Raises InputError if circles are not the surface's own, SolverError, Cancelled.

    >>> import koebe
    >>> bars = koebe.module_error(koebe.uniformize("blend_samples/face.obj"))
    >>> bool((bars > 0).all() and (bars < 0.01).all())
    True
    """
    if not isinstance(result, UniformizeResult):
        raise TypeError(f"module_error takes a result of uniformize, not {type(result).__name__}")
    chosen = chosen_order(result, order)
    run = Run(progress, cancel)
    domain = with_rims(result, rims, run)
    module = _koebe.conformal_module(*as_circles(domain), chosen)
    refined = domain.refined if isinstance(domain, _OtherRims) else _refined(result, run)
    bars = _koebe.module_error(module, _koebe.conformal_module(*refined, chosen))
    run.at(1.0, "finish")
    if not isinstance(domain, _OtherRims):
        _tell_of_polygons(result, refined)
    return bars


def _tell_of_polygons(result: UniformizeResult, refined: tuple[Floats, Floats]) -> None:
    """Warn where polygons in place of smooth rims would change a radius by more than its bar, by a forecast."""
    change = _koebe.polygonal_changes(mapped_surface(result))
    order = np.arange(len(change), dtype=np.int32)
    module = _koebe.conformal_module(*as_circles(result), order)
    bars = _koebe.module_error(module, _koebe.conformal_module(*refined, order))
    radius = [k for k, name in enumerate(module_names(len(change))) if name.startswith("r_")]
    excess = abs(change[1:]) - bars[radius] / module[radius]
    if (excess > 0.0).any():
        loop = 1 + int(excess.argmax())
        text = (
            "the mesh is coarse at its rims: as polygons in place of smooth curves they have another module, in which "
            f"the radius of loop {loop} differs by about {100.0 * change[loop]:+.2g} %. The option rims chooses"
        )
        warnings.warn(Warning(kind="coarse_mesh", elements=[], text=text), stacklevel=4)


def _refined(result: UniformizeResult, run: Run) -> tuple[Floats, Floats]:
    """The circles of the result's loops on a finer mesh, kept with the result."""
    kept = vars(result)
    if "_refined" not in kept:
        defaults = {name: row.given for name, row in rows("uniformize").items()}
        chosen = {**defaults, "method": result.method, "engine": result.engine}
        options, _ = filled("uniformize", _koebe.UniformizeOptions(), chosen)
        kept["_refined"] = _koebe.refined_circles(mapped_surface(result), options, run.progress, run.cancel)
    return kept["_refined"]


def chosen_order(result: Any, order: Sequence[int] | str | None) -> Ints:
    """The loops in the order that the caller wants, the outer one first."""
    count = len(as_circles(result)[1])
    if isinstance(order, str):
        if order != "canonical":
            raise OptionError(f"order must be None, 'canonical' or a list of loops, not {order!r}")
        chosen = canonical_order(result)
    elif order is None:
        chosen = np.arange(count, dtype=np.int32)
    else:
        chosen = as_indices(order, "order", count, "loops")
    if len(chosen) != count:
        raise InputError(f"the order must name each of the {count} loops once")
    return chosen


def module_names(loop_count: int) -> list[str]:
    """The names of the module's numbers: ['r_1', 'y_2', 'r_2', ...].

    >>> import koebe
    >>> koebe.module_names(4)
    ['r_1', 'y_2', 'r_2', 'x_3', 'y_3', 'r_3']
    """
    return _koebe.module_names(whole(loop_count, "loop_count", least=0))


class _Orders(NamedTuple):
    order_a: Ints
    order_b: Ints
    distance: float


class LoopMatch(TupleResult, _Orders):
    """The correspondence of the loops of a and b with the least distance of their modules.

    order_a, order_b    (L,) int32: corresponding loops stand at the same place, the outer ones first
    distance            of the modules in these orders
    match               (L,) int32, b's loop for each of a's: the form of `match` in all functions
    margin              1 - distance / the distance of the next best correspondence: 0 if two fit alike, 1 if there is
                        no other. Below 0.3 the loops may be matched wrongly
    """

    margin: float = 1.0

    def _drawing(self) -> dict[str, Any]:
        return {"points": np.column_stack([self.order_a, self.order_b])}

    def __repr__(self) -> str:
        return f"<koebe.LoopMatch {len(self.match)} loops, distance {self.distance:.3g}, margin {self.margin:.2g}>"

    @property
    def match(self) -> Ints:
        """(L,) int32: b's loop for each of a's."""
        return self.order_b[np.argsort(self.order_a)]


def match_loops(a: Any, b: Any, *, any_outer: bool = False, rims: Rims = "smooth") -> LoopMatch:
    """The correspondence of the loops of two domains with the least distance of their modules.

    Returns a LoopMatch: an order of a's loops and one of b's in which corresponding loops stand at the same place,
    outer ones first, and the distance of the modules in these orders; `match` is b's loop for each of a's, and `margin`
    says how sure it is. The distance is symmetric, and 0 only for equal shapes. any_outer: the outer loop of one may
    correspond to a hole of the other.
    rims: as in conformal_module. Raises InputError for different numbers of loops.

    >>> import koebe
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> order, partners, distance = koebe.match_loops(face, other)
    >>> print(order, partners, f"{distance:.2f}")
    [0 1 2 3] [0 1 2 3] 0.06
    >>> koebe.match_loops(face, other).match.tolist()
    [0, 1, 2, 3]
    """
    a, b = with_rims(a, rims), with_rims(b, rims)
    found = _koebe.match_loops(*as_circles(a), *as_circles(b), flag(any_outer, "any_outer"))
    match = LoopMatch(np.array(found[0], dtype=np.int32), np.array(found[1], dtype=np.int32), found[2])
    match._set(margin=found[3])
    return match


def module_distance(a: Any, b: Any, *, rims: Rims = "smooth") -> float:
    """L2 distance of two conformal modules, a length in the unit disk. Two results are compared in the orders of
    match_loops. rims: of two results, as in conformal_module.

    >>> import koebe
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> print(f"{koebe.module_distance(face, other):.2f}", koebe.module_distance(face, face))
    0.06 0.0
    """
    if hasattr(a, "radii") and hasattr(b, "radii"):
        return match_loops(a, b, rims=rims).distance
    first, second = as_numbers(a, "the module"), as_numbers(b, "the module")
    if first.shape != second.shape:
        raise InputError(f"modules of shapes {first.shape} and {second.shape} cannot be compared")
    return math.dist(first, second)


def separations(result: Any) -> Floats:
    """How far the loops are apart, whatever the Moebius map: (L, L) float64, dimensionless, 0 on the diagonal.

    The separation of two loops is log(R / r) of the two concentric circles to which a Moebius map takes their circles.
    It is 2 pi times the modulus of the ring between them. All separations determine the circles up to a Moebius map or
    a reflection. Raises InputError, also if circles are not the iteration's.

    >>> import koebe
    >>> koebe.separations(koebe.uniformize("blend_samples/face.obj")).round(1)[0].tolist()  # from the rim
    [0.0, 1.9, 2.3, 2.3]
    """
    return _koebe.conformal_separations(*as_circles(result))


def separation_distance(a: Any, b: Any, *, match: Sequence[int] | None = None, any_outer: bool = False) -> float:
    """The root of the mean squared difference of two domains' separations: a metric, dimensionless.

    match      b's loop for each of a's, such as match_loops(a, b).match; None: the correspondence of least distance
    any_outer  the outer loop of one may correspond to a hole of the other
    It is symmetric, obeys the triangle inequality, depends on no order of the loops, and is 0 only for shapes that are
    equal or mirror images. The search is exact. It takes a second for 13 loops of unrelated shapes, and less for shapes
    that are alike; where it would take too long, it raises InputError: then give the match, for example by match_loops.
    Raises InputError for different numbers of loops too.

    >>> import koebe
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> print(f"{koebe.separation_distance(face, other):.2f}", koebe.separation_distance(face, face))
    0.31 0.0
    """
    if match is None:
        return float(_koebe.match_separations(*as_circles(a), *as_circles(b), flag(any_outer, "any_outer"))[1])
    partners = as_indices(match, "match", len(as_circles(b)[1]), "loops")
    return float(_koebe.separation_distance(*as_circles(a), *as_circles(b), partners))


def mapped_surface(result: UniformizeResult, shown: bool = False) -> "_koebe.MappedSurface":
    """The conformal map for the native module. shown: the map as the result shows it, such as a fit."""
    domain: Any = result if shown else result.conformal
    off = [np.sort(vertices).tolist() for vertices in domain.off_circle]
    loops = [loop.tolist() for loop in result.loops]
    circles = (result.centers, result.radii) if shown else as_circles(result)
    return _koebe.MappedSurface(*result.surface, np.nan_to_num(domain.uv), loops, off, *circles, [True] * len(loops))


class DomainAlignment(Result):
    """An automorphism of the unit disk that lays one circle domain over another: z -> turn (z - a) / (1 - conj(a) z).

    match       the target's loop for each of the source's; of transfer(a, b), b's loop for each of a's
    residual    root of the mean over the holes of squared differences of centres and radii, lengths in the disk
    largest, worst    the largest such root over the holes, and its hole
    misses      (L,) of each loop, in lengths of the disk: root of the squared differences of centre and radius
    misses_in_radii    the same in radii of the source's loop: a small miss in the disk may be large for a small hole
    converged   whether the last step could not make the residual smaller
    margin      of the match, as in LoopMatch; 1 if it was given, or found by landmarks
    """

    a: complex
    turn: complex
    match: list[int]
    residual: float
    largest: float
    worst: int
    misses: Floats
    misses_in_radii: Floats
    converged: bool
    margin: float

    def __init__(self, native: "_koebe.DomainAlignment", radii: Floats, match: list[int] | None = None) -> None:
        names = ("a", "turn", "match", "residual", "largest", "worst", "converged", "margin")
        misses = np.array(native.misses)
        self._set(**{name: getattr(native, name) for name in names}, misses=misses, misses_in_radii=misses / radii)
        if match is not None:
            self._set(match=match)

    def _drawing(self) -> dict[str, Any]:
        return {"bars": np.column_stack([0.0 * self.misses, self.misses])}

    def __repr__(self) -> str:
        return f"<koebe.DomainAlignment residual {self.residual:.3g}, holes miss by up to {self.largest:.3g}>"

    def __call__(self, points: Any) -> Floats:
        """The images (n, 2) of points (n, 2) of the target's disk."""
        z = as_points(points, "points", 2) @ [1.0, 1.0j]
        images = self.turn * (z - self.a) / (1.0 - np.conj(self.a) * z)
        return np.stack([images.real, images.imag], axis=1)


@watched(a="source", b="target")
def align_domains(a: Any, b: Any, *, match: Sequence[int] | None = None) -> DomainAlignment:
    """The automorphism of the unit disk that moves b's circles as close as possible to a's circles.

    match    b's loop for each of a's, 0 for 0, such as match_loops(a, b).match, which is the default
    With one hole the circles do not determine the rotation, and it is 0. Without holes they determine nothing, and
    the map is the identity.
    Lengths are in the unit disk.

    >>> import koebe
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> alignment = koebe.align_domains(face, other)
    >>> laid = alignment(other.uv)  # other's map laid over the face's
    >>> print(laid.shape, f"{alignment.residual:.2f}")
    (2309, 2) 0.03
    """
    on_a, on_b = as_circles(a), as_circles(b)
    chosen = np.zeros(0, np.int32) if match is None else as_indices(match, "match", len(on_b[1]), "loops")
    if match is not None and not len(chosen):
        raise InputError("the match must name each of b's loops once, the outer one first")
    return DomainAlignment(_koebe.align_domains(*on_a, *on_b, chosen), on_a[1])
