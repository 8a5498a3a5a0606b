"""Arrays for the native module. They are copies, so no other thread writes into them, and are checked after copying.
Arrays that are not a mesh, or that a cast would change, raise InputError.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ._native import _koebe
from ._types import Bools, Floats, Ints, Values
from .errors import InputError

_REAL = tuple(np.dtype(kind) for kind in (np.float16, np.float32, np.float64, np.longdouble))
_WHOLE = tuple(np.dtype(f"{sign}int{bits}") for bits in (8, 16, 32, 64) for sign in ("", "u"))
_EXACT = 2**53  # beyond it 64-bit floats skip whole numbers
# Half-edges, three per face, have 32-bit numbers, too.
_MOST_VERTICES = 2**31 - 2
_MOST_FACES = _MOST_VERTICES // 3


def as_surface(vertices: Any, triangles: Any, *, degenerate: bool = False) -> tuple[Floats, Ints]:
    """Positions (V, 3) float64 and faces (F, 3) int32, C order; degenerate: faces may name a vertex twice.

    Takes floats and whole numbers of any width, in any order and byte order, read-only too.
    """
    positions = as_points(vertices, "vertices", 3)
    if not len(positions):
        raise InputError("the mesh has no vertices")
    if len(positions) > _MOST_VERTICES:
        raise InputError(f"the mesh has {len(positions)} vertices; there may be {_MOST_VERTICES}")
    return positions, as_triangles(triangles, len(positions), degenerate=degenerate)


def as_triangles(triangles: Any, vertex_count: int | None = None, *, degenerate: bool = False) -> Ints:
    """(F, 3) int32, C order: different vertices of 0 .. vertex_count - 1, or any numbers without vertex_count."""
    faces = _copy(triangles, "triangles", _WHOLE, 3)
    if not len(faces):
        raise InputError("the mesh has no faces")
    if len(faces) > _MOST_FACES:
        raise InputError(f"the mesh has {len(faces)} faces; there may be {_MOST_FACES}")
    limit = _MOST_VERTICES if vertex_count is None else vertex_count
    missing: Bools = np.any((faces < 0) | (faces >= limit), axis=1)
    _refuse(missing, "faces name a vertex that does not exist (faces listed)", "faces")
    a, b, c = faces.T
    twice: Bools = (a == b) | (b == c) | (c == a)
    _refuse(twice & (not degenerate), "faces name the same vertex twice (faces listed)", "faces")
    return faces.astype(np.int32, copy=False)


def as_points(points: Any, name: str, dimension: int, count: int | None = None) -> Floats:
    """(n, dimension) float64, C order, finite; n = count, if given."""
    array = _copy(points, name, _REAL + _WHOLE, dimension)
    if count is not None and len(array) != count:
        raise InputError(f"{name} has {len(array)} rows, not {count}")
    if array.dtype.kind != "f":
        beyond: Bools = np.any((array > _EXACT) | (array < -_EXACT), axis=1)
        _refuse(beyond, f"{name} have a whole number beyond 2^53 for a coordinate", "vertices")
    array = _double(array)
    known = np.asarray(np.isfinite(array).all(axis=1))
    _refuse(~known, f"{name} have a coordinate that is NaN or infinite", "vertices")
    return array


def as_indices(indices: Any, name: str, count: int, of: str) -> Ints:
    """(n,) int32: different numbers of 0 .. count - 1, from any sequence of whole numbers, which may be empty."""
    array = np.zeros(0, np.int64) if _is_empty(indices) else _copy(indices, name, _WHOLE)
    bad = array[(array < 0) | (array >= count)]
    if len(bad):
        raise InputError(f"{name} must name numbers from 0 to {count - 1}, not {bad[0]}", bad.tolist(), of)
    found, times = np.unique(array, return_counts=True)
    if (times > 1).any():
        raise InputError(f"{name} names {found[times > 1][0]} twice", found[times > 1].tolist(), of)
    return array.astype(np.int32, copy=False)


def as_values(values: Any, name: str) -> Values:
    """Any array, own. Raises InputError for what is none, and for masked numbers."""
    if np.ma.is_masked(values):
        raise InputError(f"{name} must not be masked")
    try:
        return np.array(values)
    except (TypeError, ValueError, OverflowError, RuntimeError) as error:
        raise InputError(f"{name} cannot be made an array: {error}") from None


def as_reals(values: Any, name: str) -> Floats:
    """Any array of real numbers, own, float64. Raises InputError for words, complex numbers, dates."""
    array = as_values(values, name)
    if array.dtype.kind not in "fiub":
        raise InputError(f"{name} must be real numbers, not {array.dtype}")
    return _double(array)


def as_flags(flags: Any, name: str, count: int, means: str = "True and False") -> Bools:
    """(count,) bool, own, from bools or from 0 and 1. Raises InputError for any other array, such as numbers."""
    array = as_values(flags, name)
    known = array.dtype == bool or (array.dtype.kind in "iu" and np.isin(array, (0, 1)).all())
    if array.shape != (count,) or not known:
        raise InputError(f"{name} must be ({count},) of {means}, or of 1 and 0, not {array.shape} {array.dtype}")
    return array.astype(bool)


def as_circles(domain: Any) -> tuple[Floats, Floats]:
    """Centers (L, 2) and radii (L,) by which a shape is compared: of a result its conformal circles, else of an object
    that has both. Raises InputError if a result's circles are not the surface's own."""
    domain = getattr(domain, "conformal", domain)
    if not getattr(domain, "converged", True):
        raise InputError("the iteration has not converged, so the circles are not the surface's: allow more sweeps")
    _koebe.require_own_circles(list(getattr(domain, "own", ())))
    if not (hasattr(domain, "centers") and hasattr(domain, "radii")):
        raise InputError(f"{type(domain).__name__} has no circles: give the result of uniformize")
    radii = as_numbers(domain.radii, "radii")
    return as_points(domain.centers, "centers", 2, len(radii)), radii


def as_numbers(numbers: Any, name: str) -> Floats:
    """(n,) float64, finite. Takes whole numbers too, and an empty list."""
    array = np.zeros(0) if _is_empty(numbers) else _copy(numbers, name, _REAL + _WHOLE)
    array = _double(array)
    _refuse(~np.isfinite(array), f"numbers of {name} are NaN or infinite", "loops")
    return array


def as_loops(loops: Sequence[Sequence[int]]) -> list[Ints]:
    """Vertex lists as int32 arrays."""
    return [np.asarray(loop, dtype=np.int32) for loop in loops]


def _copy(values: Any, name: str, dtypes: tuple[np.dtype[Any], ...], columns: int | None = None) -> Values:
    """An own array of one of these types, in C order and the machine's byte order; (n, columns), or (n,)."""
    array = as_values(values, name)
    expected = "(n,)" if columns is None else f"(n, {columns})"
    if array.ndim != (1 if columns is None else 2) or array.shape[1:] not in ((), (columns,)):
        raise InputError(f"{name} must have shape {expected}, not {array.shape}")
    native = array.dtype.newbyteorder("=")
    if native not in dtypes:
        kinds = ["floats"] * (dtypes[0].kind == "f") + ["whole numbers"] * (dtypes[-1].kind == "u")
        raise InputError(f"{name} must be {' or '.join(kinds)}, not {array.dtype}")
    return array.astype(native, order="C", copy=False)


def _double(array: Values) -> Floats:
    """As float64: what is too large becomes infinite."""
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def _is_empty(values: Any) -> bool:
    """Whether this is an empty list or tuple, which has no type."""
    return isinstance(values, (list, tuple)) and not values


def _refuse(bad: Bools, message: str, of: str) -> None:
    """Raises InputError if an element is bad, with the numbers of the bad elements.

    of  what the elements are: "vertices", "faces" ...
    """
    elements = np.flatnonzero(bad)
    if elements.size:
        raise InputError(f"{elements.size} {message}", elements.tolist(), of)
