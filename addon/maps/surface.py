# SPDX-License-Identifier: GPL-3.0-or-later
"""Polygon surfaces as arrays, and the islands that they are cut into.

Words: a *corner* is one vertex of one face (Blender calls it a loop; here a loop is a boundary loop).
"""

import dataclasses
import functools

import numpy as np

from .triangles import areas


@dataclasses.dataclass(frozen=True)
class Surface:
    """A polygon mesh: V vertices, E edges, P faces, C corners, T triangles.

    positions        (V, 3) float, world space without translation
    corner_vertex    (C,) vertex of each corner, the corners of a face in a row and in its order
    corner_edge      (C,) edge from each corner to the next one of its face
    face_start       (P,) first corner of each face
    face_size        (P,) number of corners of each face
    seam             (E,) bool, edges to cut along
    selected         (P,) bool, faces to map
    triangle_corners (T, 3) corners of each triangle of the triangulated faces
    triangle_face    (T,) face of each triangle
    """

    positions: np.ndarray
    corner_vertex: np.ndarray
    corner_edge: np.ndarray
    face_start: np.ndarray
    face_size: np.ndarray
    seam: np.ndarray
    selected: np.ndarray
    triangle_corners: np.ndarray
    triangle_face: np.ndarray


@dataclasses.dataclass(frozen=True)
class Island:
    """A connected piece of a surface without seams inside: n vertices, t triangles, c corners.

    A vertex on a cut has a copy for every side of the cut. Vertices keep the order of the surface, so that an uncut
    surface is its own island, array for array.

    vertices      (n, 3) positions
    triangles     (t, 3) int32, indices into `vertices`
    triangle_face (t,) face of the surface
    source_vertex (n,) vertex of the surface
    corners       (c,) corners of the surface
    corner_vertex (c,) vertex of the island at each of `corners`
    faces         faces of the surface
    """

    vertices: np.ndarray
    triangles: np.ndarray
    triangle_face: np.ndarray
    source_vertex: np.ndarray
    corners: np.ndarray
    corner_vertex: np.ndarray
    faces: np.ndarray

    @functools.cached_property
    def areas(self) -> np.ndarray:
        """Area (t,) of each triangle."""
        return areas(self.vertices, self.triangles)

    def some_corner(self) -> np.ndarray:
        """One corner (n,) of the surface for each vertex."""
        corner = np.empty(len(self.source_vertex), dtype=np.int32)
        corner[self.corner_vertex] = self.corners
        return corner


@dataclasses.dataclass(frozen=True)
class Numbers:
    """The solver's triangles (t,) and vertices (n,) in the surface's numbers."""

    triangle_face: np.ndarray
    source_vertex: np.ndarray


def next_corners(surface: Surface) -> np.ndarray:
    """The corner (C,) that follows each corner in its face."""
    following = np.arange(1, len(surface.corner_vertex) + 1, dtype=np.int32)
    following[surface.face_start + surface.face_size - 1] = surface.face_start
    return following
