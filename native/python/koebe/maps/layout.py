"""Mirror images, disks in a square and circles through points: helpers to lay maps out."""

from numbers import Real
from typing import Any

import numpy as np

from .._arrays import as_numbers, as_points
from .._native import _koebe
from .._types import Floats, Ints
from ..errors import InputError, OptionError, SolverError
from .input import polygons_of, surface_of


def mirror_image(vertices: Any, triangles: Any = None, *, polygon: Any = None) -> Ints | None:
    """The vertex (V,) that is the mirror image of each, int32, or None if the surface is not symmetric.

    Tries planes through the middle of the surface: perpendicular to x, y and z, then perpendicular to the principal
    axes. Every polygon must have a mirror image, another polygon or itself, corner by corner, within 1e-4 of the
    bounding box's diagonal. A plane that holds most of the surface does not count. The image of an unused vertex is -1.

    polygon      (F,) integers: triangles of one number are one polygon, and their diagonals do not count

    >>> import koebe
    >>> image = koebe.mirror_image("docs/link.obj")
    >>> bool((image[image] == range(len(image))).all())  # the image of the image is the vertex itself
    True
    """
    source = surface_of(vertices, triangles)
    found = _koebe.mirror_image(source.vertices, source.triangles, polygons_of(polygon, source))
    return found if len(found) else None


MOST_IMPORTANT: float = _koebe.most_important  # texel density at importance 1 over that at 0


def pack_disks(radii: Any, margin: float = 0.02) -> tuple[Floats, Floats]:
    """Pack disks in these proportions into the unit square: centres (n, 2) and radii (n,), as large as found to fit.

    margin       between two disks, half of it at the border; less for many disks, so that they have room
    One disk fills the square. Raises InputError for radii that are not positive.

    >>> import koebe
    >>> centers, radii = koebe.pack_disks([3, 2, 1])
    >>> (radii / radii[2]).round(9)
    array([3., 2., 1.])
    """
    sizes = as_numbers(radii, "radii")
    if not isinstance(margin, Real) or isinstance(margin, bool) or not 0.0 <= margin < 0.5:
        raise OptionError(f"margin must be a number from 0 to below 0.5, not {margin!r}")
    return _koebe.pack_disks(sizes, float(margin))


def fit_circle(points: Any) -> tuple[Floats, float, float]:
    """Centre (2,) and radius of the circle of least squared distance to points (n, 2), and the largest distance.

    Points on a line, or on less than an eighth of a turn, get the circle round their mean.

    >>> import koebe
    >>> center, radius, off = koebe.fit_circle([[1, 0], [0, 1], [-1, 0]])
    >>> round(radius, 9)
    1.0
    """
    given = as_points(points, "points", 2)
    if not len(given):
        raise InputError("there are no points")
    center, radius, off = _koebe.fit_circle(given)
    if not np.isfinite([center, radius, off]).all():
        raise SolverError("the circle is beyond floating point: scale the points to about 1")
    return np.array([center.real, center.imag]), radius, off
