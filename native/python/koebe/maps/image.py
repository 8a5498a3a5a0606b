"""Fields as images of the domain: from the vertices to the pixels, and back."""

from typing import Any

import numpy as np

from .._arrays import as_values
from .._native import _koebe
from .._options import flag, whole
from .._types import Bools, Floats, Values, Whole
from ..errors import InputError
from .carry import carried
from .result import UniformizeResult

_MOST_PIXELS = 8192  # along a side
_STEPS = 30  # of conjugate gradients. More would bend pixels far away for vertices that share a pixel
_NEAR = 1e-9  # of the first difference: read back exactly


def to_image(
    result: UniformizeResult, field: Any, pixels: int = 512, *, exact: bool = True, labels: bool | None = None
) -> tuple[Values, float]:
    """An image of a field over the unit disk, and the error with which from_image reads it back at the vertices.

    All maps to one template have images whose pixels correspond: images can be averaged and compared.
    field     (V,) or (V, k) at the vertices, linear in each face, in any unit. Whole numbers, booleans and words are
              labels: no mean is taken
    pixels    n, along a side. The image covers [-1, 1]^2, row 0 above, column 0 on the left
    exact     True: pixels are moved by the least squares that make from_image give the field back at the vertices.
              False: each pixel has the value at its centre
    labels    as in Correspondence.carry
    Returns the image (n, n) or (n, n, k), and the largest error at a vertex, in the field's unit. For labels, that is
    the share of the vertices with another label. Pixels have values in the circle domain, on faces between an arc and
    its chord, and in a strip of a pixel around them. Others have NaN, or as labels the value of Correspondence.carry
    for nothing. With exact=True the error is 0, up to rounding, if pixels are smaller than the distances of vertices in
    the disk.
    Raises InputError.

    >>> import koebe
    >>> face = koebe.uniformize("blend_samples/face.obj")
    >>> heights = face.surface[0][:, 1]
    >>> image, error = koebe.to_image(face, heights, 256)
    >>> print(image.shape, error < 1e-6, bool(abs(koebe.from_image(image, face) - heights).max() < 1e-6))
    (256, 256) True True
    """
    _require_disk(result)
    side, exact = whole(pixels, "pixels", 2, _MOST_PIXELS), flag(exact, "exact")
    covered, faces, weights = _pixels(result, side)
    triangles, count = result.surface[1], result.vertex_count
    values = carried(field, triangles, faces, weights, count, labels)
    outside = carried(field, triangles, np.full(1, -1, np.int32), np.full((1, 3), np.nan), count, labels)
    flat = np.repeat(outside, side * side, axis=0)
    flat[covered] = values
    image, given = flat.reshape(side, side, *flat.shape[1:]), as_values(field, "the field")
    if _as_labels(given, labels):
        used = _used(result)
        return image, float(np.mean(from_image(image, result, labels=labels)[used] != given[used]))
    columns = flat.reshape(side * side, -1).T.copy()
    wanted = given.astype(np.float64).reshape(count, -1).T
    stencil = _stencil(result, side)
    errors = [_fitted(column, *stencil, goal, exact) for column, goal in zip(columns, wanted, strict=True)]
    return columns.T.reshape(image.shape), max(errors, default=0.0)


def from_image(image: Any, result: UniformizeResult, *, labels: bool | None = None) -> Values:
    """The values (V,) or (V, k) at the vertices of an image (n, n) or (n, n, k) over the unit disk, as of to_image.

    Values are bilinear between the centres of pixels, NaN beside a pixel that is NaN, and NaN for a vertex without a
    face.
    labels    True: a vertex takes the label of its pixel, or of pixel (0, 0), which lies outside the disk, if it has no
              face. None: so unless the image has floats
    Raises InputError.

    >>> import koebe
    >>> face, other = (koebe.fit_circles(f"blend_samples/{name}.obj", [(0, 0.3), (0.4, -0.3), (-0.4, -0.3)], [0.2] * 3)
    ...                for name in ("face", "surprised"))
    >>> image, error = koebe.to_image(face, face.surface[0][:, 1])
    >>> koebe.from_image(image, other).shape  # heights of the first face at the vertices of the second
    (2309,)
    """
    _require_disk(result)
    values = as_values(image, "the image")
    if values.ndim not in (2, 3) or values.shape[0] != values.shape[1] or len(values) < 2:
        raise InputError(f"the image has the shape {values.shape}, not (n, n) or (n, n, k)")
    if values.dtype.kind not in "fiubU" or values.dtype.kind == "U" and labels is False:
        raise InputError(f"the image must have numbers, or words as labels, not {values.dtype}")
    side, used = len(values), _used(result)
    flat = values.reshape(side * side, *values.shape[2:])
    if _as_labels(values, labels):
        column, row = np.clip(np.floor(_places(result.uv[used], side) + 0.5), 0, side - 1).astype(np.int64)
        found = np.repeat(flat[:1], result.vertex_count, axis=0)
        found[used] = flat[row * side + column]
        return found
    vertices, numbers, weights = _stencil(result, side)
    found = np.full((result.vertex_count, *values.shape[2:]), np.nan)
    found[vertices] = np.einsum("vk,vk...->v...", weights, flat[numbers].astype(np.float64))
    return found


def _require_disk(result: Any) -> None:
    if not isinstance(result, UniformizeResult):
        raise TypeError(f"images are of results of uniformize and fit_circles, not of {type(result).__name__}")


def _as_labels(values: Floats, labels: bool | None) -> bool:
    return values.dtype.kind != "f" if labels is None else flag(labels, "labels")


def _used(result: UniformizeResult) -> Bools:
    return np.asarray(np.isfinite(result.uv).all(axis=1))


def _places(uv: Floats, side: int) -> Floats:
    """(2, n) column and row of points of the disk, in pixels: whole numbers at the pixels' centres."""
    return 0.5 * side * (1.0 + uv.T * np.array([[1.0], [-1.0]])) - 0.5


def _pixels(result: UniformizeResult, side: int) -> tuple[Whole, Whole, Floats]:
    """The pixels (n,) in the circle domain, on faces, and in a strip around both, with their faces and weights."""
    steps = (np.arange(side) + 0.5) * (2.0 / side) - 1.0
    x, y = np.tile(steps, side), np.repeat(-steps, side)
    strip = 3.0 / side  # a pixel and a half: the four pixels beside a point lie within sqrt(2)
    in_domain, tried = (np.hypot(x, y) <= 1.0 + strip for _ in range(2))
    for loop, center, radius in zip(result.loops[1:], result.centers[1:], result.radii[1:], strict=True):
        rim = result.uv[loop]
        apothem = np.linalg.norm(0.5 * (rim + np.roll(rim, 1, axis=0)) - center, axis=1).min()
        away = np.hypot(x - center[0], y - center[1])
        in_domain &= away >= radius - strip
        tried &= away >= min(radius, apothem) - strip
    _, numbers, _ = _stencil(result, side)  # loops of free shape
    in_domain[numbers.ravel()] = tried[numbers.ravel()] = True
    pixels = np.flatnonzero(tried)
    centers = np.column_stack([x[pixels], y[pixels]])
    faces, weights, off = _koebe.places_in_domain(np.nan_to_num(result.uv), result.surface[1], centers)
    kept = in_domain[pixels] | (off <= strip)
    return pixels[kept], faces[kept], weights[kept]


def _stencil(result: UniformizeResult, side: int) -> tuple[Whole, Whole, Floats]:
    """The vertices (n,) that have a place, the four pixels (n, 4) beside each, and their weights."""
    vertices = np.flatnonzero(_used(result))
    places = np.clip(_places(result.uv[vertices], side), 0.0, side - 1.0)
    first = np.minimum(places.astype(np.int64), side - 2)
    (column, row), (right, down) = first, places - first
    numbers = np.stack([row * side + column + k for k in (0, 1, side, side + 1)], axis=1)
    left, up = 1.0 - right, 1.0 - down
    return vertices, numbers, np.stack([up * left, up * right, down * left, down * right], axis=1)


def _fitted(image: Floats, vertices: Whole, numbers: Whole, weights: Floats, wanted: Floats, exact: bool) -> float:
    """Moves pixels by the least squares that give the wanted values at the vertices, by conjugate gradients.

    image    (n n,), changed    wanted    (V,)    Returns the largest error that is left.
    """
    with np.errstate(invalid="ignore"):
        missing = wanted[vertices] - (weights * image[numbers]).sum(axis=1)
    known = np.isfinite(missing)
    numbers, weights, missing = numbers[known], weights[known], missing[known]
    if not len(missing):
        return 0.0

    def spread(values: Floats) -> Floats:
        return np.asarray(np.bincount(numbers.ravel(), (weights * values[:, None]).ravel(), len(image)), np.float64)

    goal = _NEAR * np.abs(missing).max()
    slope = spread(missing)
    way, size = slope, slope @ slope
    for _ in range(_STEPS if exact else 0):
        if np.abs(missing).max() <= goal or not size > 0.0:
            break
        change = (weights * way[numbers]).sum(axis=1)
        step = size / (change @ change)
        image += step * way
        missing = missing - step * change
        slope = spread(missing)
        way, size = slope + (slope @ slope) / size * way, slope @ slope
    return float(np.abs(missing).max())
