# SPDX-License-Identifier: GPL-3.0-or-later
"""Seams and cuts of a layout: edges along which UVs are cut, and seams along which a tube is unrolled."""

import numpy as np

from .surface import Island, Surface, edge_ends, next_corners


def cut_edges(surface: Surface, uv: np.ndarray, layer: np.ndarray | None = None) -> np.ndarray:
    """Whether the UVs (C, 2) of the selected faces at each edge (E,) lie apart there, or in two layers (C,)."""
    corners = np.flatnonzero(np.repeat(surface.selected, surface.face_size))
    edge, ends = edge_ends(surface.corner_vertex, surface.corner_edge, next_corners(surface), corners)
    places = uv[ends].reshape(-1, 4)
    if layer is not None:
        places = np.column_stack([places, layer[ends[:, 0]]])
    apart = (edge[1:] == edge[:-1]) & (places[1:] != places[:-1]).any(axis=1)
    cut = np.zeros(len(surface.seam), dtype=bool)
    cut[edge[1:][apart]] = True
    return cut


def inner_seams(surface: Surface) -> np.ndarray:
    """The seams (E,) with selected faces on both sides."""
    chosen = np.repeat(surface.selected, surface.face_size)
    return surface.seam & (np.bincount(surface.corner_edge[chosen], minlength=len(surface.seam)) > 1)


def tube_slits(surface: Surface, islands: list[Island]) -> np.ndarray:
    """The seams (E,) that make disks of islands that would otherwise be tubes.

    A disk has such a path if both sides of the path lie in its boundary, with other edges between them at either end.
    Of several paths the longest is taken.
    """
    found = np.zeros(len(surface.seam), dtype=bool)
    if not surface.seam.any():
        return found
    following = next_corners(surface)
    for island in islands:
        boundary = _boundary_of_disk(surface, island, following)
        paths = _paths_with_both_sides(surface.corner_edge[boundary], surface.corner_vertex[boundary])
        if paths:
            longest = max(paths, key=lambda path: _length(surface, boundary[path], following))  # noqa: B023
            found[surface.corner_edge[boundary[longest]]] = True
    return found


def _length(surface: Surface, corners: np.ndarray, following: np.ndarray) -> float:
    """Length of the edges that begin at these corners."""
    ends = surface.corner_vertex[np.stack([corners, following[corners]])]
    return float(np.linalg.norm(np.diff(surface.positions[ends], axis=0), axis=-1).sum())


def _boundary_of_disk(surface: Surface, island: Island, following: np.ndarray) -> np.ndarray:
    """The corners whose edges bound an island, in order; empty unless the island is a disk."""
    none = np.zeros(0, dtype=np.int64)
    edges = surface.corner_edge[island.corners]
    if not surface.seam[edges].any():
        return none
    _, inverse, times = np.unique(edges, return_inverse=True, return_counts=True)
    if times.max() > 2:
        return none
    on_boundary = surface.seam[edges] | (times[inverse] == 1)
    corners = island.corners[on_boundary]
    count_edges = (len(island.corners) + len(corners)) // 2
    if not len(corners) or len(island.source_vertex) - count_edges + len(island.faces) != 1:
        return none
    local = dict(zip(island.corners.tolist(), island.corner_vertex.tolist(), strict=True))
    leaving = {local[c]: c for c in corners.tolist()}
    order = [int(corners[0])]
    while len(order) <= len(corners):
        corner = leaving.get(local[int(following[order[-1]])])
        if corner is None or corner == order[0]:
            break
        order.append(corner)
    return np.array(order) if len(order) == len(leaving) == len(corners) else none


def _paths_with_both_sides(edges: np.ndarray, vertices: np.ndarray) -> list[list[int]]:
    """Places of the paths in a closed boundary that runs along them twice, in both directions.

    edges, vertices  (n,) along the boundary; a vertex is where its edge begins
    """
    n = len(edges)
    first: dict[int, int] = {}
    partner = [-1] * n
    for here, edge in enumerate(edges.tolist()):
        there = first.setdefault(edge, here)
        if there != here and vertices[there] == vertices[(here + 1) % n]:
            partner[here], partner[there] = there, here
    paths: list[list[int]] = []
    for start in range(n):
        if partner[start] < 0 or partner[start - 1] == (partner[start] + 1) % n:
            continue
        path = [start]
        while len(path) < n and partner[(path[-1] + 1) % n] == (partner[path[-1]] - 1) % n:
            path.append((path[-1] + 1) % n)
        near, far = (path[-1] + 1) % n, (partner[start] + 1) % n
        if near != partner[path[-1]] and far != start and partner[path[-1]] not in path:
            paths.append(path)
    return paths
