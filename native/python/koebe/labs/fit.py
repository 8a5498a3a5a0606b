"""Maps to given circle domains: circles at given places, of given sizes."""

import math
from collections.abc import Mapping, Sequence
from numbers import Integral, Real
from typing import Any, TypedDict

import numpy as np

from .._arrays import as_indices, as_numbers, as_points, as_values
from .._native import _koebe
from .._options import callback, flag, listed, takes, token, vertex
from .._signatures import ShapesOptions, Unpack
from .._types import Floats, Ints
from ..errors import InputError
from ..maps.input import polygons_of, surface_of
from ..maps.result import UniformizeResult
from ..maps.source import Source, with_origin
from ..maps.uniformize import solver_options


class FitOptions(ShapesOptions, total=False):
    """Options of `fit_circles`."""

    names: Sequence[str] | None
    pins: Mapping[int, tuple[int, float]] | None
    fixed: Sequence[int]
    extremal: bool


class Distortion(TypedDict):
    """|mu| over the faces: mean and l2 (root of the mean square) by area on the surface, max, and the largest
    dilatation (1 + |mu|) / (1 - |mu|)."""

    mean: float
    max: float
    l2: float
    dilatation: float


class Fit(TypedDict):
    """The figures of a fit.

    mu          from the surface to the template
    bending     from the surface's conformal circle domain to the template: 0 if the template is that domain
    residual    largest distance of a rim's vertex from its circle, disk lengths
    path        'straight', or 'bows' if holes had to go round each other
    steps, newton_steps    of the bending
    """

    mu: Distortion
    bending: Distortion
    residual: float
    path: str
    steps: int
    newton_steps: int


class FitResult(UniformizeResult):
    """A map to a template, and its report. All fields of UniformizeResult, and:

    mu          (F,) |mu| of each face, from the surface to the template: in [0, 1), 1 for a face without area
    fit         the figures of the fit
    names       of the holes, or empty
    ranks       (L,) for each of `loops` its number in boundary_loops(triangles)

    `loops`, `centers` and `radii` are in the template's order, the outer loop first: loops[1 + k] lies on circle k.
    Shapes are compared by `conformal`, the surface's own circles in the same order. Two fits to one template correspond
    point by point: koebe.transfer takes them.
    """

    fit: Fit
    mu: Floats
    names: list[str]
    ranks: Ints

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        self._set(mu=native.mu)
        self._set(names=[loop["name"] for loop in report["loops"][1:] if "name" in loop])
        self._set(ranks=np.array([loop["rank"] for loop in report["loops"]], dtype=np.int32))

    def _arrays(self) -> dict[str, Any]:
        return {**super()._arrays(), "mu": self.mu}

    def __repr__(self) -> str:
        mu = self.fit["mu"]
        return (
            f"<koebe.FitResult {self.vertex_count} vertices, {len(self.loops)} loops, "
            f"|mu| {mu['mean']:.3g} in the mean, {mu['max']:.3g} at most, {self.flipped} flipped>"
        )


@takes(
    "shapes",
    old_names={"vertices": "mesh"},
    names=None,
    pins=None,
    fixed=(),
    extremal=False,
    progress=None,
    cancel=None,
)
def fit_circles(
    vertices: Any = None,
    triangles: Any = None,
    centers: Any = None,
    radii: Any = None,
    loops: Sequence[int] | None = None,
    **given: "Unpack[FitOptions]",
) -> FitResult:
    """Map a surface with holes to a given circle domain, one to one: circles at given places, of given sizes.

    Of all such maps, those of least angle distortion: it minimizes the sum of a_f 4 |mu_f|^2 / (1 - |mu_f|^2), a_f a
    face's area on the surface, mu_f its Beltrami coefficient from the conformal circle domain. It starts there, and the
    circles move to their places without meeting.
    vertices, triangles    as for `uniformize`; or a mesh alone in place of both, without `triangles`: a pair
                (vertices, triangles), a file, a mesh of another package
    centers     (H, 2) of the H holes' circles, in the unit disk
    radii       (H,) their radii. The unit circle may come first in both, as in a result's `centers` and `radii`
    loops       for each circle the number of its hole in boundary_loops(triangles), and the loop left over is the outer
                one; None: the outer loop is the longest, and holes go to the circles that fit them best
    names       for each circle, for the report
    pins        circle -> (vertex, angle): this vertex of its rim goes to this angle on the circle, degrees, counter-
                clockwise from the direction of x. The unit circle is -1
    fixed       circles whose rims do not turn: vertices keep their angles in the conformal domain. All others slide.
    extremal    True: the largest |mu| becomes nearly as small as it can be. Takes longer
    {options}
    mask, progress, cancel    as for `uniformize`
    Raises InputError for a template that no surface fits (circles that meet or leave the disk) or not this one,
    SolverError if no one-to-one map was found, with the circles as `elements`, and the errors of `uniformize`.

    >>> import koebe
    >>> centers, radii = [[-0.3, 0.2], [0.3, 0.2], [0, -0.4]], [0.15, 0.15, 0.1]
    >>> result = koebe.fit_circles("blend_samples/face.obj", centers, radii)
    >>> print(result.radii, result.flipped, bool(result.mu.max() < 1))
    [1.   0.15 0.15 0.1 ] 0 True
    """
    names, pins, fixed = given.pop("names"), given.pop("pins"), given.pop("fixed")
    extremal = flag(given.pop("extremal"), "extremal")
    progress, cancel = callback(given.pop("progress"), "progress"), token(given.pop("cancel"), "cancel")
    options, said = solver_options("shapes", given)
    if triangles is not None and not _are_triangles(triangles):
        if centers is None:
            centers = triangles
        else:
            centers, radii, loops = triangles, centers, loops if radii is None else radii
        triangles = None
    if centers is None or radii is None:
        raise TypeError("fit_circles needs the centers and the radii of the circles: fit_circles(mesh, centers, radii)")
    source = surface_of(vertices, triangles, mask=given.pop("mask"), weld=said["weld"])
    places, sizes = holes_of(centers, radii)
    count = len(sizes)
    ranks = [] if loops is None else as_indices(loops, "loops", max(len(source.triangles), 1), "loops").tolist()
    if loops is not None and len(ranks) != count:
        raise InputError(f"there are {len(ranks)} loops for {count} circles")
    rotates, pinned, angles = _rims(pins, fixed, count)
    pinned = [source.mapped(one) for one in pinned]
    wanted = _koebe.CircleTemplate(places, sizes, _words(names, count), ranks, rotates, pinned, angles)
    native = source.call(_koebe.fit_circles, wanted, options, extremal, progress, cancel)
    source.call(_koebe.make_polygons_convex, native, polygons_of(None, source), False, cancel)
    report = with_origin(native.report(), source, {**said, "extremal": extremal})
    return FitResult(report, native, source)


def _are_triangles(given: Any) -> bool:
    """Whether an argument is an array of triangles, not of centers of circles."""
    array = as_values(given, "triangles")
    return array.ndim == 2 and array.shape[1] == 3 and array.dtype.kind in "iu"


def holes_of(centers: Any, radii: Any) -> tuple[Floats, Floats]:
    """The circles without the unit circle."""
    sizes = as_numbers(radii, "radii")
    if not len(sizes):
        return np.zeros((0, 2)), sizes
    places = as_points(centers, "centers", 2, len(sizes))
    first = bool(sizes[0] == 1.0 and not places[0].any())
    return places[first:], sizes[first:]


def _words(names: Sequence[str] | None, count: int) -> list[str]:
    words = [] if names is None else listed(names, "names")
    if any(not isinstance(word, str) for word in words):
        raise TypeError("names must be text")
    if words and len(words) != count:
        raise InputError(f"there are {len(words)} names for {count} circles")
    return words


def _rims(
    pins: Mapping[int, tuple[int, float]] | None, fixed: Sequence[int], count: int
) -> tuple[list[bool], list[int], list[float]]:
    """For each rim, the outer one first, whether it rotates, its pinned vertex or -1, and that vertex's angle in
    radians."""
    rotates, vertices, angles = [True] * (count + 1), [-1] * (count + 1), [0.0] * (count + 1)
    for circle in listed(fixed, "fixed"):
        rotates[_place(circle, count)] = False
    if pins is not None and not isinstance(pins, Mapping):
        raise TypeError(f"pins must be a dict, not {pins!r}")
    for circle, pin in ({} if pins is None else pins).items():
        place = _place(circle, count)
        if isinstance(pin, (str, bytes)) or not hasattr(pin, "__len__") or len(pin) != 2:
            raise InputError(f"the pin of circle {circle} is no pair: a vertex and an angle", [int(circle)], "loops")
        if not rotates[place]:
            raise InputError(f"circle {circle} is fixed and has a pin", [int(circle)], "loops")
        if not isinstance(pin[1], Real) or not math.isfinite(pin[1]):
            raise InputError(f"the angle of circle {circle} is no number", [int(circle)], "loops")
        vertices[place], angles[place] = vertex(pin[0], "pins"), math.radians(pin[1])
    return rotates, vertices, angles


def _place(circle: Any, count: int) -> int:
    if not isinstance(circle, Integral) or isinstance(circle, bool):
        raise TypeError(f"a circle is a whole number, not {type(circle).__name__}")
    number = int(circle)
    if not -1 <= number < count:
        raise InputError(f"there is no circle {number}: they are -1 (the unit circle) to {count - 1}", [], "loops")
    return number + 1
