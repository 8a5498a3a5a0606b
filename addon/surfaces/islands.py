# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts a surface along its seams into islands."""

import numpy as np

from .connected_components import connected_components
from .surface import Island, Surface, across, first_and_last, next_corners

# Up to so many groups a mask for each is faster than a sort.
FEW = 16


def whole_island(surface: Surface) -> Island | None:
    """The surface as its own island, array for array, or None if a part of it is not selected, it has a seam, or it
    clearly has several parts.

    This equals `cut_into_islands` if the surface is connected and no two parts of it touch in a vertex only. The solver
    checks that, so it is not checked here.
    """
    used = np.zeros(len(surface.positions), dtype=bool)
    used[surface.corner_vertex] = True
    if not (surface.selected.all() and used.all()) or surface.seam.any():
        return None
    triangles = surface.corner_vertex[surface.triangle_corners].astype(np.int32, copy=False)
    if _falls_apart(triangles, len(surface.positions)):
        return None
    return Island(
        vertices=surface.positions,
        triangles=triangles,
        triangle_face=surface.triangle_face,
        source_vertex=np.arange(len(surface.positions), dtype=np.int32),
        corners=np.arange(len(surface.corner_vertex), dtype=np.int32),
        corner_vertex=surface.corner_vertex,
        faces=np.arange(len(surface.face_size)),
    )


def _falls_apart(triangles: np.ndarray, count: int) -> bool:
    """Whether the vertices up to some number share no triangle with those after it, as in joined objects.

    This takes a few passes. Parts with mixed numbers are left to the solver.
    """
    a, b, c = triangles.T
    low, high = np.minimum(np.minimum(a, b), c), np.maximum(np.maximum(a, b), c)
    # Triangles that span the gap after each vertex: those that begin before it, less those that end before it.
    across = np.cumsum(np.bincount(low, minlength=count) - np.bincount(high, minlength=count))
    return bool((across[:-1] == 0).any())


def cut_into_islands(surface: Surface) -> list[Island]:
    """Islands of the selected faces, cut along seams, in the order of their first faces.

    Faces are neighbours if they share an edge that is not a seam. Corners are one vertex if they meet at the end of
    such an edge. So surfaces that touch in a vertex only come apart there. Edges with three or more faces stay, unless
    they are seams: the solver reports them.
    """
    corner_face = np.repeat(np.arange(len(surface.face_size), dtype=np.int32), surface.face_size)
    at: np.ndarray | slice
    if surface.selected.all():  # a slice needs no new memory, as indices would
        corners, at = np.arange(len(corner_face), dtype=np.int32), slice(None)
    else:
        corners = at = np.flatnonzero(surface.selected[corner_face]).astype(np.int32)
    here, there = _neighbours(surface, corners, surface.corner_edge[at])
    next_corner = next_corners(surface)
    start, end = across(surface.corner_vertex, next_corner, here, there)
    ends = np.append(here, next_corner[here]), np.append(start, end)
    corner_root = connected_components(len(surface.corner_vertex), *ends)
    face_root = connected_components(len(surface.face_size), corner_face[here], corner_face[there])
    return _split(surface, corners, at, corner_face, corner_root, face_root)


def put_together(surface: Surface, islands: list[Island]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The islands as one mesh, open at the seams: positions (n, 3), the vertex (C,) at each corner of the islands, and
    the surface's vertex (n,) for each vertex."""
    vertex_of_corner = np.zeros(len(surface.corner_vertex), dtype=np.int32)
    positions, sources, count = [np.zeros((0, 3))], [np.zeros(0, dtype=np.int32)], 0
    for island in islands:
        vertex_of_corner[island.corners] = island.corner_vertex + count
        positions.append(island.vertices)
        sources.append(island.source_vertex)
        count += len(island.vertices)
    return np.concatenate(positions), vertex_of_corner, np.concatenate(sources)


def _neighbours(surface: Surface, corners: np.ndarray, edges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Pairs of corners whose edges are the same edge of two faces, and not a seam."""
    first, last = first_and_last(edges, corners, len(surface.seam))
    two = first != last
    joined = two & ~surface.seam
    crowded = None
    if np.count_nonzero(last >= 0) + np.count_nonzero(two) < len(corners):  # some edge has more than two faces
        crowded = (np.bincount(edges, minlength=len(surface.seam)) > 2) & ~surface.seam
        joined &= ~crowded
    here, there = first[joined], last[joined]
    if crowded is not None:
        of_crowded = corners[crowded[edges]]
        here, there = np.append(here, first[surface.corner_edge[of_crowded]]), np.append(there, of_crowded)
    return here, there


def _split(
    surface: Surface,
    corners: np.ndarray,
    at: np.ndarray | slice,
    corner_face: np.ndarray,
    corner_root: np.ndarray,
    face_root: np.ndarray,
) -> list[Island]:
    """Split into islands. `at` takes the `corners` from an array of all corners."""
    faces = np.flatnonzero(surface.selected)
    roots, islands = corners[corner_root[at] == corners], faces[face_root[faces] == faces]
    rank_of_root = np.zeros(len(face_root), dtype=np.int32)
    rank_of_root[islands] = np.arange(len(islands), dtype=np.int32)
    island_of_face = rank_of_root[face_root]

    root_island = island_of_face[corner_face[roots]]
    root_vertex = surface.corner_vertex[roots]
    order = np.lexsort((root_vertex, root_island))  # stable: equal keys stay in the order of their roots
    roots, root_island, root_vertex = roots[order], root_island[order], root_vertex[order]
    rank = np.zeros(len(corner_root), dtype=np.int32)
    rank[roots] = np.arange(len(roots), dtype=np.int32)
    vertex_of_corner = rank[corner_root]

    count = len(islands)
    triangles = np.flatnonzero(surface.selected[surface.triangle_face])
    triangle_groups = _groups(island_of_face[surface.triangle_face[triangles]], triangles, count)
    corner_groups = _groups(island_of_face[corner_face[at]], corners, count)
    face_groups = _groups(island_of_face[faces], faces, count)
    first_vertex = np.searchsorted(root_island, np.arange(count + 1)).tolist()

    result = []
    for i in range(count):
        begin, end = first_vertex[i], first_vertex[i + 1]
        island_triangles = vertex_of_corner[surface.triangle_corners[triangle_groups[i]]]
        island_corners = vertex_of_corner[corner_groups[i]]
        island_triangles -= begin
        island_corners -= begin
        result.append(
            Island(
                vertices=surface.positions[root_vertex[begin:end]],
                triangles=island_triangles,
                triangle_face=surface.triangle_face[triangle_groups[i]],
                source_vertex=root_vertex[begin:end],
                corners=corner_groups[i],
                corner_vertex=island_corners,
                faces=face_groups[i],
            )
        )
    return result


def _groups(keys: np.ndarray, values: np.ndarray, count: int) -> list[np.ndarray]:
    """The values with key 0, with key 1, …, each in order."""
    if count == 1:
        return [values]
    if count <= FEW:
        return [values[keys == key] for key in range(count)]
    if (keys[1:] < keys[:-1]).any():  # joined objects are in order
        short = keys.astype(np.min_scalar_type(count))  # sorted in one pass
        values = values[np.argsort(short, kind="stable")]
    ends = np.cumsum(np.bincount(keys, minlength=count))
    return np.split(values, ends[:-1])
