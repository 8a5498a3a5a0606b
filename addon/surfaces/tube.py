# SPDX-License-Identifier: GPL-3.0-or-later
"""Unrolls annuli to conformal rectangles, with a seam in the UVs only."""

import dataclasses
import heapq
from collections.abc import Sequence
from types import ModuleType

import numpy as np

from .connected_components import connected_components
from .islands import cut_into_islands
from .surface import Island, Surface, next_corners
from .triangles import as_points

# An island, its outer and inner loop, and whether it is a piece of an island that was cut beyond its seams.
Tube = tuple[Island, Sequence[np.ndarray], bool]


def unroll(koebe: ModuleType, surface: Surface, tubes: Sequence[Tube]) -> list[tuple[Island, np.ndarray] | None]:
    """Each island with two loops, cut open, and the rectangle (n, 2) that it becomes; None where that fails.

    A tube is (island, loops, is_piece), `loops` its outer and inner loop. The solver maps it to a cylinder, which is
    i log z of a round annulus: u runs around, v from loop to loop. The cut runs along a short path of edges from
    loop to loop, which ends at the back, where y is largest. A vertex on the cut gets a copy for each side. The
    rectangle is centred at 0 and lies in the unit disk.
    """
    if not tubes:
        return []
    following = next_corners(surface)
    vertex = np.empty(len(surface.corner_vertex), dtype=np.int64)
    seam, selected, opened = surface.seam.copy(), np.zeros_like(surface.selected), []
    for island, loops, is_piece in tubes:
        log = _log_of_annulus(koebe, island, loops)
        vertex[island.corners] = island.corner_vertex
        edges, first, uses = np.unique(surface.corner_edge[island.corners], return_index=True, return_counts=True)
        if is_piece:
            seam[_piece_cuts(surface, island, vertex, following)] = True
        inside = (uses == 2) & ~seam[edges]  # a cut along a boundary has no effect
        edges, corners = edges[inside], island.corners[first[inside]]
        ends = np.stack([vertex[corners], vertex[following[corners]]], axis=1)
        length = _wrapped_distance(log[ends[:, 0]], log[ends[:, 1]])
        path = edges[_cut(ends, length, loops, island.vertices[:, 1])]
        seam[path], selected[island.faces] = True, True
        opened.append((log, len(path) > 0))
    sheets = cut_into_islands(dataclasses.replace(surface, seam=seam, selected=selected))
    with_first_face = {int(sheet.faces[0]): sheet for sheet in sheets}
    result = []
    for (island, _, is_piece), (log, cut) in zip(tubes, opened, strict=True):
        sheet = with_first_face[int(island.faces[0])]
        whole = cut and len(sheet.triangles) == len(island.triangles)  # otherwise the path has cut off a piece
        if whole and is_piece:
            sheet = _turned_like(sheet, island)
        result.append((sheet, _rectangle(sheet, island, log)) if whole else None)
    return result


def _rectangle(sheet: Island, island: Island, log: np.ndarray) -> np.ndarray:
    """Points (n, 2) of the sheet in the plane of i log z, in the unit disk."""
    whole = np.empty(len(sheet.source_vertex), dtype=np.int64)  # the island's vertex for each vertex of the sheet
    whole[sheet.corner_vertex] = island.corner_vertex
    log = log[whole]
    flat = 1j * (log + 2j * np.pi * _branches(log, sheet.triangles))
    points = as_points(flat)
    low, high = points.min(axis=0), points.max(axis=0)
    return (points - 0.5 * (low + high)) / (0.5 * np.linalg.norm(high - low))


def _piece_cuts(surface: Surface, island: Island, vertex: np.ndarray, following: np.ndarray) -> np.ndarray:
    """The boundary of a piece: edges whose faces in the piece are not joined at the same vertices."""
    corners = island.corners
    ends = np.sort(np.stack([vertex[corners], vertex[following[corners]]], axis=1), axis=1)
    edge = surface.corner_edge[corners]
    order = np.argsort(edge, kind="stable")
    edge, ends = edge[order], ends[order]
    joined = np.zeros(len(surface.seam), dtype=bool)
    joined[edge[1:][(edge[1:] == edge[:-1]) & (ends[1:] == ends[:-1]).all(axis=1)]] = True
    return edge[~joined[edge]]


def _turned_like(sheet: Island, island: Island) -> Island:
    """The sheet of a piece, with its triangles turned as in the piece."""
    whole = np.empty(len(sheet.source_vertex), dtype=np.int64)
    whole[sheet.corner_vertex] = island.corner_vertex
    other = whole[sheet.triangles[:, 1]] != island.triangles[:, 1]
    triangles = sheet.triangles.copy()
    triangles[other] = triangles[other][:, [0, 2, 1]]
    return dataclasses.replace(sheet, triangles=triangles)


def _log_of_annulus(koebe: ModuleType, island: Island, loops: Sequence[np.ndarray]) -> np.ndarray:
    """log z (n,) of the round annulus |z| <= 1, from the tube's conformal cylinder: exp would lose a far end."""
    ring = koebe.ring_map(island.vertices, island.triangles, outer=int(loops[0][0]), inner=int(loops[1][0]))
    place = np.empty((len(island.vertices), 2))
    place[island.triangles.ravel()] = ring.uv.reshape(-1, 2)
    turn, depth = 2.0 * np.pi / ring.periods[0, 0] * place.T
    return -depth + 1j * turn


def _wrapped_distance(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Distance on the cylinder of logarithms."""
    step = one - two
    return np.hypot(step.real, np.remainder(step.imag + np.pi, 2.0 * np.pi) - np.pi)


def _cut(ends: np.ndarray, length: np.ndarray, loops: Sequence[np.ndarray], back: np.ndarray) -> list[int]:
    """Indices of the edges (m, 2) of the shortest path from the inner loop to the rearmost vertex of the outer loop.

    Only its ends touch the loops: along the rim, or over a chord of it, it would cut off a piece. So it ends at the
    rearmost vertex that can be reached like that, which exists on every connected surface.
    """
    outer = loops[0][np.argsort(-back[loops[0]], kind="stable")].tolist()
    came = _shortest_paths(ends, length, loops[1].tolist(), outer, len(back))
    vertex, path = next((v for v in outer if v in came), None), []
    while vertex in came:
        vertex, used = came[vertex]
        path.append(used)
    return path


def _shortest_paths(
    ends: np.ndarray, length: np.ndarray, starts: list[int], dead_ends: list[int], count: int
) -> dict[int, tuple[int, int]]:
    """Vertex and edge before each vertex on its shortest path from the nearest start [Dijkstra 1959].

    Paths end at dead ends; the search ends at the first of them.
    """
    both = np.concatenate([ends[:, 0], ends[:, 1]])
    order = np.argsort(both, kind="stable")
    first = np.searchsorted(both[order], np.arange(count + 1)).tolist()
    others = np.concatenate([ends[:, 1], ends[:, 0]])[order].tolist()
    edge = np.tile(np.arange(len(ends)), 2)[order].tolist()
    length, came, ending = length.tolist(), {}, set(dead_ends)
    best, queue = dict.fromkeys(starts, 0.0), [(0.0, vertex) for vertex in starts]
    while queue:
        distance, vertex = heapq.heappop(queue)
        if vertex == dead_ends[0]:
            break
        if distance > best[vertex] or vertex in ending:
            continue
        for i in range(first[vertex], first[vertex + 1]):
            reached = distance + length[edge[i]]
            if reached < best.get(others[i], np.inf):
                best[others[i]], came[others[i]] = reached, (vertex, edge[i])
                heapq.heappush(queue, (reached, others[i]))
    return came


def _branches(log: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Integers k (n,) that make the imaginary part of log + 2πik continuous over a surface that is cut open."""
    first, second = triangles.ravel(), np.roll(triangles, -1, axis=1).ravel()
    jump = np.rint((log[first].imag - log[second].imag) / (2.0 * np.pi)).astype(int)
    smooth = jump == 0
    part = connected_components(len(log), first[smooth], second[smooth])
    steps: dict[int, list[tuple[int, int]]] = {}
    links = np.stack([part[first[~smooth]], part[second[~smooth]], jump[~smooth]], axis=1)
    for a, b, k in np.unique(links, axis=0).tolist() if len(links) else ():
        steps.setdefault(a, []).append((b, k))
        steps.setdefault(b, []).append((a, -k))
    turns = np.zeros(len(log), dtype=int)
    reached, queue = {int(part[0]): 0}, [int(part[0])]
    while queue:
        a = queue.pop()
        for b, k in steps.get(a, ()):
            if b not in reached:
                reached[b] = reached[a] + k
                queue.append(b)
    for a, k in reached.items():
        turns[part == a] = k
    return turns
