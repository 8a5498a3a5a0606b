# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the holes of a mesh and computes patches for them; nothing is written here."""

import dataclasses
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import bmesh
import mathutils
import numpy as np

from ..surfaces.errors import KnownError
from ..surfaces.triangles import flipped_triangles
from .patch_attributes import Continued

HOLES, SELECTED, ALL = "holes", "selected", "all"
SAME_UV = 1e-5  # UV units: nearer corners of a vertex are one point of the map


class FillError(KnownError):
    """The mesh has nothing to fill, or a boundary that is not a closed loop."""


@dataclasses.dataclass
class Filling:
    """The patch of one hole: its corners, the new vertices (k, 3), the faces (t, 3), and their data.

    The faces number the n vertices of the hole first, in the corners' order, then the new ones. So do all values (n +
    k, ...); `uvs` has values for each UV layer, by name.
    """

    corners: list[bmesh.types.BMLoop]
    vertices: np.ndarray
    triangles: np.ndarray
    uvs: dict[str, np.ndarray]
    continued: Continued


def boundary_loops(mesh: bmesh.types.BMesh) -> list[list[bmesh.types.BMLoop]]:
    """Boundary loops of a bmesh: lists of the corners where the boundary edges begin, in the faces' direction."""
    ahead = [edge.link_loops[0] for edge in mesh.edges if edge.is_boundary and not edge.hide]
    open_corners, loops = set(ahead), []
    for first in ahead:
        if first not in open_corners:
            continue
        loop: list[bmesh.types.BMLoop] = []
        corner: bmesh.types.BMLoop | None = first
        while corner is not None and corner in open_corners:
            open_corners.remove(corner)
            loop.append(corner)
            corner = _next_on_boundary(corner)
        if corner is not first:
            raise FillError("a boundary is not a closed loop: use Recalculate Outside, or delete surplus faces")
        loops.append(loop)
    return loops


def _next_on_boundary(corner: bmesh.types.BMLoop) -> bmesh.types.BMLoop | None:
    """The corner of the next boundary edge, or None."""
    *_, last = _fan(corner)
    return last if last is not None and last.edge.is_boundary else None


def _fan(corner: bmesh.types.BMLoop) -> Iterator[bmesh.types.BMLoop | None]:
    """The corners at the end of a boundary edge, face by face; None at the end if the faces do not fit."""
    vertex = corner.link_loop_next.vert
    corner = corner.link_loop_next
    yield corner
    while not corner.edge.is_boundary:
        corner = corner.link_loop_radial_next
        if corner.vert is vertex or len(corner.edge.link_loops) != 2:
            yield None
            return
        corner = corner.link_loop_next
        yield corner


def chosen_loops(mesh: bmesh.types.BMesh, which: str) -> list[list[bmesh.types.BMLoop]]:
    """The loops to fill. HOLES: all but the longest of each connected part; SELECTED: loops with all edges selected."""
    loops = boundary_loops(mesh)
    if which == SELECTED:
        loops = [loop for loop in loops if all(corner.edge.select for corner in loop)]
    elif which == HOLES:
        part = _parts(loops)
        longest: dict[int, int] = {}
        length = [sum(corner.edge.calc_length() for corner in loop) for loop in loops]
        for index in range(len(loops)):
            best = longest.setdefault(part[index], index)
            if length[index] > length[best]:
                longest[part[index]] = index
        loops = [loop for index, loop in enumerate(loops) if longest[part[index]] != index]
    if not loops:
        raise FillError(
            "no boundary loop is selected" if which == SELECTED
            else "there is no hole: the only boundary is the outer one"
        )  # fmt: skip
    return loops


def _parts(loops: list[list[bmesh.types.BMLoop]]) -> list[int]:
    """The number of the mesh's connected part for each loop."""
    seen, numbers = {}, []
    for number, loop in enumerate(loops):
        first = loop[0].face
        stack = [] if first in seen else [first]
        while stack:
            face = stack.pop()
            if face in seen:
                continue
            seen[face] = number
            stack += [other for edge in face.edges for other in edge.link_faces if other not in seen]
        numbers.append(seen[first])
    return numbers


def filling(
    koebe: ModuleType, mesh: bmesh.types.BMesh, loop: list[bmesh.types.BMLoop], keys: dict[str, np.ndarray]
) -> Filling:
    """The patch for one loop. Changes nothing. `koebe` is the native package, `keys` are as for `Continued`."""
    rim = [corner.vert for corner in loop]
    if len(set(rim)) != len(rim):
        raise FillError("a hole touches itself at a vertex: split that vertex first")
    vertices, triangles = _surroundings(loop)
    if not np.ptp(vertices[: len(rim)], axis=0).max() > 0.0:  # NaN too
        raise FillError("a hole has no size: use Merge by Distance")
    try:
        filled, faces, label = koebe.fill_holes(vertices, triangles, loops=[0], fair=True)
    except koebe.KoebeError as error:
        raise FillError(f"a hole of {len(rim)} edges: {error}") from error
    added = filled[len(vertices) :]
    patch = faces[label == 0]
    patch = np.where(patch < len(rim), patch, patch - len(vertices) + len(rim))
    _check_room(mesh, rim, patch)
    positions = np.concatenate([vertices[: len(rim)], added])
    uvs = {}
    for layer in mesh.loops.layers.uv.values():
        given = _rim_uv(layer, loop)
        if given is not None:
            uvs[layer.name] = _continued_uv(koebe, positions, patch, given)
    return Filling(loop, added, patch, uvs, Continued.of(koebe, mesh, loop, positions, patch, keys))


def _check_room(mesh: bmesh.types.BMesh, rim: list[bmesh.types.BMVert], patch: np.ndarray) -> None:
    """Raise FillError if the patch would double a face, or give an edge more than two."""
    for triangle in patch[(patch < len(rim)).all(axis=1)].tolist():
        if mesh.faces.get([rim[v] for v in triangle]) is not None:
            raise FillError("a hole is only the back of one face: there is nothing to fill")
    sides = np.sort(np.concatenate([patch[:, [0, 1]], patch[:, [1, 2]], patch[:, [2, 0]]]), axis=1)
    sides, uses = np.unique(sides[(sides < len(rim)).all(axis=1)], axis=0, return_counts=True)
    for (one, two), faces in zip(sides.tolist(), uses.tolist(), strict=True):
        edge = mesh.edges.get([rim[one], rim[two]])
        if edge is not None and len(edge.link_faces) + faces > 2:
            raise FillError("a hole cannot be filled, as an edge would get three faces: subdivide around it")


def _surroundings(loop: list[bmesh.types.BMLoop]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (m, 3), the loop's first, and triangles (t, 3) of the faces up to two edges from a boundary loop.

    Only faces that share an edge are joined. Faces that meet in a vertex alone are separated, so that the loop's
    surroundings are a manifold in any mesh.
    """
    # Corners that are one vertex: union-find over the edges that faces share.
    faces = _faces_around(loop)
    corners = [corner for face in faces for corner in face.loops]
    rank = {corner: i for i, corner in enumerate(corners)}
    parent = list(range(len(corners)))

    def root(i: int) -> int:
        while parent[i] != i:
            parent[i] = parent[parent[i]]
            i = parent[i]
        return i

    for corner in corners:
        other = _across(corner)
        if other in rank:
            parent[root(rank[corner])] = root(rank[other.link_loop_next])
            parent[root(rank[corner.link_loop_next])] = root(rank[other])
    # Number them, the loop's first.
    number: dict[int, int] = {}
    positions: list[mathutils.Vector] = []
    for corner in [*loop, *corners]:
        if number.setdefault(root(rank[corner]), len(positions)) == len(positions):
            positions.append(corner.vert.co)
    triangles = []
    for face in faces:
        first, *others = (number[root(rank[corner])] for corner in face.loops)
        triangles += [(first, one, two) for one, two in zip(others, others[1:])]
    return np.array(positions, dtype=np.float64), np.array(triangles)


def _faces_around(loop: list[bmesh.types.BMLoop]) -> list[bmesh.types.BMFace]:
    """The faces that meet a boundary loop and their neighbours, as far as they are connected."""
    first = dict.fromkeys(corner.face for start in loop for corner in _fan(start))
    near = {face for one in first for vertex in one.verts for face in vertex.link_faces}
    found, stack = dict(first), list(first)
    while stack:
        for corner in stack.pop().loops:
            other = _across(corner)
            if other is not None and other.face in near and other.face not in found:
                found[other.face] = None
                stack.append(other.face)
    return list(found)


def _across(corner: bmesh.types.BMLoop) -> bmesh.types.BMLoop | None:
    """The corner on the other side of the edge, if two faces of one orientation meet there; else None."""
    other = corner.link_loop_radial_next
    return other if len(corner.edge.link_loops) == 2 and other.vert is not corner.vert else None


def _rim_uv(layer: "bmesh.types.BMLayerItem[Any]", loop: list[bmesh.types.BMLoop]) -> np.ndarray | None:
    """UVs (n, 2) of a loop's vertices; None if a seam ends at the hole."""
    begin = np.array([corner[layer].uv for corner in loop])
    end = np.array([corner.link_loop_next[layer].uv for corner in loop])
    return begin if np.abs(np.roll(end, 1, axis=0) - begin).max() <= SAME_UV else None


def _continued_uv(koebe: ModuleType, positions: np.ndarray, triangles: np.ndarray, rim_uv: np.ndarray) -> np.ndarray:
    """UVs (n + k, 2) of a patch, harmonic. If that flips faces, uses weights that flip none inside a convex rim."""
    fixed = np.arange(len(rim_uv))
    uv = koebe.harmonic_map(positions, triangles, fixed, rim_uv)
    if len(flipped_triangles(triangles, uv.astype(np.float32))):
        uv = koebe.harmonic_map(positions, triangles, fixed, rim_uv, uniform=True)
    return uv
