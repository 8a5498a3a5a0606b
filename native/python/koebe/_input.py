"""The surface given to a function, as arrays, from any of the allowed kinds."""

import os
from pathlib import Path
from typing import Any

import numpy as np

from ._arrays import as_points, as_surface
from ._meshes import Polygons, is_mesh, read_mesh
from ._native import _koebe
from ._result import Source
from .errors import InputError


def surface_of(vertices: Any, triangles: Any = None, degenerate: bool = False) -> Source:
    """The surface as arrays. In place of vertices and triangles: a pair of both, a mesh file, another package's mesh.

    degenerate   faces may name a vertex twice
    """
    polygons = _polygons_in(vertices)
    if polygons is None:
        if triangles is None:
            vertices, triangles = _pair(vertices)
        return Source(*as_surface(vertices, triangles, degenerate=degenerate))
    if triangles is not None:
        raise TypeError("a mesh has its own faces: give no triangles")
    positions = as_points(np.asarray(polygons.vertices, dtype=np.float64), "vertices", 3)
    corners = polygons.corners
    if len(corners) and not 0 <= corners.min() <= corners.max() < len(positions):
        raise InputError("faces of the mesh name a vertex that does not exist")
    faces, polygon = _koebe.triangulate(positions, corners.astype(np.int32), polygons.begin.astype(np.int32))
    return Source(*as_surface(positions, faces), vertices if is_mesh(vertices) else None, polygons, polygon)


def is_surface(thing: Any) -> bool:
    """Whether this is a whole surface, not an array of vertices or of triangles."""
    return is_mesh(thing) or _is_path(thing) or _is_pair(thing)


def _polygons_in(thing: Any) -> Polygons | None:
    """The faces of a file, or of a mesh of another package."""
    if not _is_path(thing):
        return read_mesh(thing) if is_mesh(thing) else None
    path = Path(thing)
    vertices, corners, begin = _koebe.parse_mesh(path.read_bytes(), path.suffix)
    count = len(begin) - 1
    return Polygons(vertices, corners.astype(np.int64), begin.astype(np.int64), np.arange(count), count)


def _pair(thing: Any) -> tuple[Any, Any]:
    if _is_pair(thing):
        return thing[0], thing[1]
    raise InputError(
        "there are no triangles: give them too, or in place of both a pair, a mesh file, or a mesh of PyVista, "
        "trimesh, meshio or nibabel"
    )


def _is_path(thing: Any) -> bool:
    return isinstance(thing, (str, os.PathLike))


def _is_pair(thing: Any) -> bool:
    """Whether this is a pair of tables; two points are not."""
    return isinstance(thing, (tuple, list)) and len(thing) == 2 and all(_is_table(part) for part in thing)


def _is_table(thing: Any) -> bool:
    return len(getattr(thing, "shape", ())) == 2 or (
        isinstance(thing, (tuple, list)) and bool(thing) and hasattr(thing[0], "__len__")
    )


def polygons_of(given: Any, source: Source) -> np.ndarray:
    """(F,) int32: the polygons' numbers as given, or as in the mesh; empty if each triangle is by itself."""
    if given is None:
        return np.zeros(0, np.int32) if source.polygon is None else source.polygon
    numbers, count = np.asarray(given), len(source.triangles)
    if numbers.shape != (count,) or numbers.dtype.kind not in "iu":
        raise InputError(f"polygon must be ({count},) integers, not {numbers.shape} {numbers.dtype}")
    return np.unique(numbers, return_inverse=True)[1].astype(np.int32)
