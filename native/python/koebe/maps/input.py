"""The surface given to a function, as arrays, from any of the allowed kinds."""

import os
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .._arrays import as_flags, as_points, as_surface, as_values
from .._native import _koebe
from .._options import path_of
from .._types import Floats, Ints
from ..errors import InputError
from ..io.formats import is_foreign_surface, read_surface
from ..io.meshes import Polygons, can_give_back, is_mesh, plain, read_mesh
from .source import Source


def surface_of(
    vertices: Any, triangles: Any = None, degenerate: bool = False, mask: Any = None, weld: float | None = None
) -> Source:
    """The surface as arrays. In place of vertices and triangles: a pair of both, a mesh file, another package's mesh.

    degenerate   faces may name a vertex twice
    mask         (V,) bool: faces with a vertex where it is True are left out; the vertices keep their numbers
    weld         distance of vertices that are joined: triangles name the first of them
    """
    source = _whole_surface(vertices, triangles, degenerate)
    if weld is not None:
        source = _welded(source, weld, degenerate)
    return source if mask is None else _masked(source, mask)


def _welded(source: Source, distance: float, degenerate: bool) -> Source:
    """The surface with joined vertices. Unless triangles may be degenerate, those that become so are left out."""
    first = _koebe.weld(source.vertices, distance)
    welded = replace(source, triangles=first[source.triangles], first=first, filed=source.triangles)
    a, b, c = welded.triangles.T
    kept = np.flatnonzero((a != b) & (b != c) & (c != a)).astype(np.int32)
    if not len(kept):
        raise InputError(f"all faces collapse if vertices within {distance:g} are joined")
    return welded if degenerate or len(kept) == len(a) else _restricted(welded, kept)


def _restricted(source: Source, kept: Ints) -> Source:
    """The surface with only these of its triangles."""

    def rows(array: Ints | None) -> Ints | None:
        return None if array is None else array[kept]

    return replace(
        source, triangles=source.triangles[kept], polygon=rows(source.polygon), filed=rows(source.filed),
        kept=source.source_face[kept],
    )  # fmt: skip


def _masked(source: Source, mask: Any) -> Source:
    out = as_flags(mask, "the mask", len(source.vertices), "True (left out) and False")
    dropped = out[source.given_triangles].any(axis=1)
    if source.polygon is not None:  # a polygon is one face
        dropped = np.isin(source.polygon, source.polygon[dropped])
    if dropped.all():
        raise InputError("the mask leaves out all faces")
    return replace(_restricted(source, np.flatnonzero(~dropped).astype(np.int32)), mask=out)


def points_at_vertices(points: Any, name: str, source: Source) -> Floats:
    """(V, 2) float64, finite. Where a vertex has no face, its point is not looked at, and becomes 0."""
    given = as_values(points, name)
    if given.shape == (len(source.vertices), 2) and given.dtype.kind == "f":
        given[~source.used] = 0.0
    return as_points(given, name, 2, len(source.vertices))


def _whole_surface(vertices: Any, triangles: Any, degenerate: bool) -> Source:
    if _is_path(vertices):
        path_of(vertices, "vertices")
    if _is_path(vertices) and is_foreign_surface(vertices):
        vertices = read_surface(vertices)
    if is_mesh(vertices):
        vertices = plain(vertices)
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
    return Source(*as_surface(positions, faces), vertices if can_give_back(vertices) else None, polygons, polygon)


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
        "there are no triangles: give them too, or in place of both a pair, a mesh file, a mesh of PyVista, VTK, "
        "trimesh, meshio, nilearn or nibabel, or any object with vertices and faces"
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


def polygons_of(given: Any, source: Source) -> Ints:
    """(F,) int32: the polygons' numbers as given, or as in the mesh; empty if each triangle is by itself."""
    if given is None:
        return np.zeros(0, np.int32) if source.polygon is None else source.polygon
    numbers, count = as_values(given, "polygon"), len(source.triangles)
    if source.kept is not None and numbers.ndim and len(numbers) > source.kept[-1]:  # of all faces
        numbers = numbers[source.kept]
    if numbers.shape != (count,) or numbers.dtype.kind not in "iu":
        raise InputError(f"polygon must be ({count},) integers, not {numbers.shape} {numbers.dtype}")
    return np.unique(numbers, return_inverse=True)[1].astype(np.int32)
