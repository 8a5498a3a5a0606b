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

    def part(self, faces: np.ndarray) -> tuple["Surface", np.ndarray]:
        """The surface of some faces (P,) bool alone, all selected, with all vertices and edges; and its corners."""
        corners = np.flatnonzero(np.repeat(faces, self.face_size)).astype(np.int32)
        number = np.zeros(len(self.corner_vertex), dtype=np.int32)
        number[corners] = np.arange(len(corners), dtype=np.int32)
        triangles = faces[self.triangle_face]
        face = np.cumsum(faces, dtype=np.int32) - np.int32(1)
        return Surface(
            self.positions, self.corner_vertex[corners], self.corner_edge[corners], number[self.face_start[faces]],
            self.face_size[faces], self.seam, np.ones(np.count_nonzero(faces), dtype=bool),
            number[self.triangle_corners[triangles]], face[self.triangle_face[triangles]],
        ), corners  # fmt: skip


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


def first_and_last(edges: np.ndarray, corners: np.ndarray, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The first and the last of the corners (n,) at each of so many edges, from the edge of each; -1: none."""
    first, last = np.full((2, count), -1, dtype=np.int32)
    last[edges] = corners  # of several writes to one place the last stays
    first[edges[::-1]] = corners[::-1]
    return first, last


def across(
    corner_vertex: np.ndarray, following: np.ndarray, here: np.ndarray, there: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The corners at the start and at the end of the edges of corners `here`, in the faces of corners `there`, which
    have the same edges."""
    opposed = corner_vertex[here] != corner_vertex[there]
    return np.where(opposed, following[there], there), np.where(opposed, there, following[there])


def edge_ends(
    corner_vertex: np.ndarray, corner_edge: np.ndarray, following: np.ndarray, corners: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The edges (n,) of some corners, ascending, and the corners (n, 2) at their ends, the lower vertex first."""
    corners = corners[np.argsort(corner_edge[corners], kind="stable")]
    ends = np.stack([corners, following[corners]], axis=1)
    turned = corner_vertex[ends[:, 0]] > corner_vertex[ends[:, 1]]
    ends[turned] = ends[turned][:, ::-1]
    return corner_edge[corners], ends
