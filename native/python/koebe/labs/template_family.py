"""Many surfaces with holes over one template: a circle domain to which all are fitted."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from .._progress import Run
from .._types import Floats, Ints
from ..errors import InputError, SolverError
from ..maps.result import UniformizeResult
from ..maps.uniformize import boundary_loops, uniformize
from .corresponding import LaidShapes, laid_over_mean, landmark_pairs_of
from .fit import FitResult, fit_circles, holes_of
from .transfer import Correspondence, on_one_template, transfer

_EVEN = 0.5  # of the default template: circles wide enough for images, and points as near as with conformal ones


def over_template(
    shapes: Sequence[Any],
    orders: Sequence[Ints],
    reference: int,
    template: Any,
    landmarks: Sequence[Sequence[Any]] | None,
    run: Run,
) -> LaidShapes:
    """All shapes fitted to one template, and over their mean.

    orders    of each shape its loops in the common order, the outer one first
    template  centers and radii in this order, or an object that has both; None: the reference's own, at even=0.5
    """
    for number, shape in enumerate(shapes):
        if not isinstance(shape, UniformizeResult):
            raise TypeError(f"points need results of uniformize, and shape {number} is a {type(shape).__name__}")
    if len(orders[0]) < 3 and landmarks is None:
        raise InputError("with fewer than two holes, circles say nothing of the points' angles: give landmarks")
    # Shapes that lie on the template already are taken as they are.
    base = shapes[reference]
    if template is None and all(on_one_template(base, shape) for shape in shapes):
        fits = list(shapes)
    else:
        circles = _own_template(base, orders[reference], run.part(0.0, 0.1)) if template is None else _circles(template)
        fits = []
        for number, (shape, order) in enumerate(zip(shapes, orders, strict=True)):
            part = run.part(*(0.1 + 0.5 * (number + k) / len(shapes) for k in (0, 1)))
            fits.append(_fitted(number, shape, order, circles, part))

    def correspond(number: int, part: Run) -> Correspondence:
        pairs = landmark_pairs_of(landmarks, number, reference)
        return transfer(fits[number], fits[reference], landmarks=pairs, progress=part.progress, cancel=part.cancel)

    return laid_over_mean(fits, reference, correspond, run.part(0.6, 1.0))


def _fitted(number: int, shape: Any, order: Ints, circles: tuple[Any, Any], run: Run) -> FitResult:
    """The shape's fit to the circles. Raises SolverError with the shape's number."""
    vertices, triangles = shape.surface
    rims = [np.sort(loop) for loop in boundary_loops(triangles)]
    ranks = [next(k for k, rim in enumerate(rims) if np.array_equal(rim, np.sort(shape.loops[one]))) for one in order]
    try:
        return fit_circles(vertices, triangles, *circles, ranks[1:], progress=run.progress, cancel=run.cancel)
    except SolverError as error:
        raise SolverError(f"shape {number} cannot be fitted to the template: {error}", [number], "shapes") from error


def _own_template(base: UniformizeResult, order: Ints, run: Run) -> tuple[Floats, Floats]:
    """The holes' circles of the reference's map that is half even, in the order."""
    rims = [base.loops[one] for one in order]
    even = uniformize(
        *base.surface, outer=int(rims[0][0]), even=_EVEN, loops="round", progress=run.progress, cancel=run.cancel
    )
    place = [next(k for k, loop in enumerate(even.loops) if int(rim[0]) in loop) for rim in rims[1:]]
    return even.centers[place], even.radii[place]


def _circles(template: Any) -> tuple[Floats, Floats]:
    """The holes' circles of a template as given."""
    if hasattr(template, "centers") and hasattr(template, "radii"):
        return holes_of(template.centers, template.radii)
    if not (isinstance(template, (tuple, list)) and len(template) == 2):
        raise InputError("the template must be a pair of centers and radii, or an object that has both")
    return holes_of(*template)
