"""Arrays as the native module takes them; matching ones are passed without a copy and none is modified."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from .errors import InputError


def as_vertices(vertices: Any) -> np.ndarray:
    """(V, 3) float64, C order. Takes float32 or float64 in any order, read-only too."""
    array = np.asarray(vertices)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"vertices must have shape (V, 3), not {array.shape}")
    if array.dtype not in (np.float32, np.float64):
        raise InputError(f"vertices must be float32 or float64, not {array.dtype}")
    return np.ascontiguousarray(array, dtype=np.float64)


def as_triangles(triangles: Any) -> np.ndarray:
    """(F, 3) int32, C order. Takes int32 or int64 in any order, read-only too."""
    array = np.asarray(triangles)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"triangles must have shape (F, 3), not {array.shape}")
    if array.dtype not in (np.int32, np.int64):
        raise InputError(f"triangles must be int32 or int64, not {array.dtype}")
    if array.dtype == np.int64:
        limits = np.iinfo(np.int32)
        bad = np.flatnonzero(((array < limits.min) | (array > limits.max)).any(axis=1))
        if bad.size:
            error = InputError(f"{bad.size} faces name a vertex that does not exist (faces listed)")
            error.elements = bad.tolist()
            raise error
    return np.ascontiguousarray(array, dtype=np.int32)


def as_planar(points: Any) -> np.ndarray:
    """(V, 2) float64, C order."""
    array = np.asarray(points)
    if array.ndim != 2 or array.shape[1] != 2 or array.dtype not in (np.float32, np.float64):
        raise InputError(f"uv must be float with shape (V, 2), not {array.dtype} {array.shape}")
    return np.ascontiguousarray(array, dtype=np.float64)


def as_loops(loops: Sequence[Sequence[int]]) -> list[np.ndarray]:
    """Vertex lists as int32 arrays."""
    return [np.asarray(loop, dtype=np.int32) for loop in loops]
