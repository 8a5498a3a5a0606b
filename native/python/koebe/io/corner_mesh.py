"""A mesh of another package with UVs per corner: its vertices are doubled along the cuts."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .._fields import face_angle_error_deg, log_scale, log_scale_of_corners
from .._types import Bools, Floats, Whole
from ..errors import InputError
from .mesh_copies import ANGLE_ERROR, CORNER_UV, LOG_SCALE, Fields, mesh_with_fields, mesh_with_vertices
from .meshes import is_gifti

if TYPE_CHECKING:
    from ..maps.source import Source


def mesh_with_corner_uv(source: "Source", uv: Floats, mapped: Bools, more: Mapping[str, Floats] | None = None) -> Any:
    """A copy of the source's mesh with its faces in order, and fields as in UniformizeResult.to_mesh.

    A vertex with several UVs has a copy for each of them: the first in its old place, the others after all old
    vertices. koebe_vertex is the old number of each. An unused vertex has the UVs NaN. A mesh that keeps its vertices
    (GIfTI) has koebe_corner_uv instead, and the UVs NaN at a vertex with several.

    uv       (F, 3, 2) of the corners of the source's triangles
    mapped   (F,) bool, the triangles that count in the fields
    more     further fields of the vertices
    Raises InputError for a source given as arrays, or if a polygon is cut apart.
    """
    if source.mesh is None or source.polygons is None or source.polygon is None:
        raise InputError("the surface came as arrays or as a file: there is no mesh to give back")
    count = len(source.vertices)
    # A vertex for each pair of a vertex and its UVs.
    old, triangles, uv_of = doubled(source.given_triangles, uv, count)
    points = source.vertices[old]
    error = face_angle_error_deg(points, triangles, uv_of)
    known = mapped & np.isfinite(error)
    faces = len(source.polygons.cell)
    # A polygon's angle error is the mean of its triangles'.
    with np.errstate(invalid="ignore"):
        sums = np.bincount(source.polygon[known], error[known], minlength=faces)
        of_faces = {ANGLE_ERROR: sums / np.bincount(source.polygon[known], minlength=faces)}
    of_points = {name: values[old] for name, values in (more or {}).items()}
    # GIfTI keeps its vertices: UVs go to the corners there.
    if not is_gifti(source.mesh):
        mesh = mesh_with_vertices(source.mesh, source.polygons, old, _polygon_corners(source, triangles))
        of_points = {LOG_SCALE: log_scale(points, triangles[mapped], uv_of), **of_points}
        return mesh_with_fields(mesh, source.polygons, Fields(uv_of, of_points, of_faces))
    corners = np.full((faces, 6), np.nan)
    corners[source.polygon[mapped]] = uv.reshape(-1, 6)[mapped]
    one = np.bincount(old, minlength=count) == 1
    of_points = {name: values[:count] for name, values in of_points.items()}
    scale = log_scale_of_corners(source.vertices, source.given_triangles[mapped], uv[mapped])
    fields = Fields(
        np.where(one[:, None], uv_of[:count], np.nan), {LOG_SCALE: scale, **of_points}, {**of_faces, CORNER_UV: corners}
    )
    return mesh_with_fields(source.mesh, source.polygons, fields)


def doubled(triangles: Whole, uv: Floats, count: int) -> tuple[Whole, Whole, Floats]:
    """Old numbers (n,) of the new vertices, triangles (F, 3) with new numbers, and UVs (n, 2)."""
    corners = uv.reshape(-1, 2) + 0.0  # minus zero is zero
    table = np.column_stack([triangles.reshape(-1, 1).astype(np.uint64), corners.view(np.uint64)])
    _, first, number = np.unique(table, axis=0, return_index=True, return_inverse=True)
    owner = triangles.ravel()[first]  # ascending
    is_first = np.append(True, owner[1:] != owner[:-1])
    place = np.where(is_first, owner, count + np.cumsum(~is_first) - 1)
    old = np.concatenate([np.arange(count), owner[~is_first]])
    uv_of = np.full((len(old), 2), np.nan)
    uv_of[place] = corners[first]
    return old, place[number.ravel()].reshape(-1, 3), uv_of


def _polygon_corners(source: "Source", triangles: Whole) -> Whole:
    """The new vertex (C,) at each corner of the polygons."""
    polygons, polygon = source.polygons, source.polygon
    assert polygons is not None and polygon is not None
    count = np.int64(len(source.vertices))
    key, index = np.unique(np.repeat(polygon, 3) * count + source.given_triangles.ravel(), return_index=True)
    new = triangles.ravel()
    again = index[np.searchsorted(key, np.repeat(polygon, 3) * count + source.given_triangles.ravel())]
    torn = np.unique(np.repeat(polygon, 3)[new != new[again]])
    if len(torn):
        text = f"{len(torn)} polygons are cut apart in the UVs: give the mesh as triangles"
        raise InputError(text, torn.tolist(), "faces")
    owner = np.repeat(np.arange(len(polygons.cell)), np.diff(polygons.begin)) * count + polygons.corners
    place = np.clip(np.searchsorted(key, owner), 0, len(key) - 1)
    return np.where(key[place] == owner, new[index[place]], polygons.corners)
