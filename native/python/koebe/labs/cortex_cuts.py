"""Where a cortex is cut to lie flat: by a flat map of another brain on a common sphere, or where cuts pay most.

A cut is a path of vertices that are left out, as FreeSurfer's patches have it: each vertex keeps one place.
"""

import heapq
from collections.abc import Iterable
from typing import Any

import numpy as np

from .._fields import areas
from .._native import _koebe
from .._types import Bools, Floats, Whole
from ..errors import InputError
from ..maps.parts import parts

_COARSE = 6000  # faces of the surface on which cuts are sought
ONE_PART = 1.0  # a price at which no disk is parted
_THICK = 2  # rings of vertices: what is thicker is a wall, no cut


class Graph:
    """The edges of a surface."""

    def __init__(self, points: Floats, triangles: Whole) -> None:
        edges = np.unique(np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1), axis=0)
        ends = np.concatenate([edges, edges[:, ::-1]])
        self.points, self.ends = points, ends[np.argsort(ends[:, 0], kind="stable")]
        self.begin = np.searchsorted(self.ends[:, 0], np.arange(len(points) + 1))

    def around(self, inside: Bools, rings: int = 1) -> Bools:
        """(V,) bool: these vertices and those within so many edges."""
        for _ in range(rings):
            inside = inside.copy()
            inside[self.ends[inside[self.ends[:, 0]], 1]] = True
        return inside

    def core(self, inside: Bools, rings: int) -> Bools:
        """(V,) bool: the vertices all of whose neighbours within so many edges are inside."""
        return ~self.around(~inside, rings)

    def path(self, start: int, goal: Bools, target: Floats | None = None) -> list[int]:
        """The shortest path of edges from a vertex to the nearest with goal[vertex]; target is the place of one goal.
        Empty if there is none."""
        best, before, queue = {start: 0.0}, {start: start}, [(0.0, start)]
        while queue:
            _, here = heapq.heappop(queue)
            if goal[here]:
                found = [here]
                while before[found[-1]] != found[-1]:
                    found.append(before[found[-1]])
                return found
            near = self.ends[self.begin[here] : self.begin[here + 1], 1]
            steps = np.linalg.norm(self.points[near] - self.points[here], axis=1)
            ahead = 0.0 * steps if target is None else np.linalg.norm(self.points[near] - target, axis=1)
            for there, step, rest in zip(near.tolist(), steps.tolist(), ahead.tolist(), strict=True):
                length = best[here] + step
                if length < best.get(there, np.inf):
                    best[there], before[there] = length, here
                    heapq.heappush(queue, (length + rest, there))
        return []

    def paths(self, links: Iterable[tuple[int, int]]) -> Bools:
        """(V,) bool: the vertices on shortest paths between pairs."""
        found, goal = np.zeros(len(self.points), bool), np.zeros(len(self.points), bool)
        for a, b in links:
            goal[b] = True
            found[self.path(a, goal, self.points[b])] = True
            goal[b] = False
        return found


def cheapest_cuts(points: Floats, triangles: Whole, wall: Bools, darts: float, cancel: Any) -> Bools:
    """(V,) bool: cuts from the rims into the cortex, where they lower the distortion most [the darts of `parts`]. They
    are sought on a coarse surface, whose vertices are the fine one's, and carried along shortest paths."""
    kept = triangles[~wall[triangles].any(axis=1)]
    fine, faces = np.unique(kept, return_inverse=True)
    faces, places, used = faces.reshape(-1, 3).astype(np.int32), points[fine], fine
    if len(faces) > _COARSE:
        places, faces, vertex = _koebe.coarse_surface(places, faces, _COARSE, cancel)
        fine = used[vertex]
    made = parts(places, faces, price=ONE_PART, darts=darts, cancel=cancel)
    return Graph(points, triangles).paths(fine[_opened_edges(faces, made.uv)].tolist())


def _opened_edges(triangles: Whole, uv: Floats) -> Whole:
    """(E, 2) inner edges whose two faces lie apart in the map."""
    ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    turned = triangles[:, [0, 1, 2]] > triangles[:, [1, 2, 0]]
    places = np.where(turned[:, :, None, None], uv[:, [[1, 0], [2, 1], [0, 2]]], uv[:, [[0, 1], [1, 2], [2, 0]]])
    places = places.reshape(-1, 2, 2)
    order = np.lexsort(ends.T)
    pair = order[:-1][(ends[order[:-1]] == ends[order[1:]]).all(axis=1)]
    other = order[1:][(ends[order[:-1]] == ends[order[1:]]).all(axis=1)]
    opened: Whole = ends[pair[(places[pair] != places[other]).any(axis=(1, 2))]]
    return opened


def template_cuts(
    sphere: Floats, triangles: Whole, wall: Bools, template: Floats, faces: Whole,
    kept: Bools,
) -> Bools:  # fmt: skip
    """(V,) bool: the cuts of a template's flat map on this surface, through spheres that are registered to one another.

    sphere, triangles   (V, 3) and (F, 3) of this surface
    wall                (V,) bool: what is left out of this surface
    template, faces     the template's sphere
    kept                (F',) bool: its faces that are in the flat map
    Each cut ends in the wall, to which it is continued.
    """
    own, there = (points / np.linalg.norm(points, axis=1, keepdims=True) for points in (sphere, template))
    graph, other = Graph(own, triangles), Graph(there, faces)
    out = np.ones(len(there), bool)
    out[faces[kept]] = False
    thick = other.around(other.core(out, _THICK), _THICK + 1) & out
    thin = out & ~thick
    links = other.ends[(out[other.ends].all(axis=1)) & thin[other.ends].any(axis=1)]
    links = links[links[:, 0] < links[:, 1]]
    strips, joints = _strips(faces, kept, out)
    number = np.full(len(faces), -1)
    number[strips] = len(there) + np.arange(len(strips))
    centres = there[faces[strips]].mean(axis=1)
    joined = np.array([[number[a] if a >= 0 else ~a, number[b] if b >= 0 else ~b] for a, b in joints], int)
    links = np.concatenate([links, joined.reshape(-1, 2)])
    if not len(links):
        raise InputError("the flat map has no cuts beside the wall")
    named, ends = np.unique(links, return_inverse=True)
    ends = ends.reshape(-1, 2)
    image = _nearest(own, np.concatenate([there, centres])[named])
    cuts = graph.paths(image[ends].tolist())
    at_wall = np.zeros(len(there) + len(strips), bool)
    at_wall[: len(there)] = thick
    for vertex in np.unique(image[at_wall[named]]).tolist():
        cuts[graph.path(vertex, wall)] = True
    return cuts & ~wall


def _strips(faces: Whole, kept: Bools, out: Bools) -> tuple[Whole, list[tuple[int, int]]]:
    """Faces that are cut out between vertices that stay, and their links: pairs of faces, or of a face and ~vertex."""
    strips = np.flatnonzero(~kept & ~out[faces].any(axis=1))
    inside = np.zeros(len(faces), bool)
    inside[strips] = True
    sides: dict[tuple[int, int], int] = {}
    joints: list[tuple[int, int]] = []
    for face in np.flatnonzero(~kept).tolist():
        corners = faces[face].tolist()
        for a, b in ((0, 1), (1, 2), (2, 0)):
            edge = (min(corners[a], corners[b]), max(corners[a], corners[b]))
            across = sides.setdefault(edge, face)
            if across == face or not (inside[face] or inside[across]):
                continue
            ends = [one if inside[one] else ~next(v for v in faces[one].tolist() if out[v]) for one in (across, face)]
            joints.append((ends[0], ends[1]))
    return strips, joints


def _nearest(points: Floats, places: Floats) -> Whole:
    """(N,) of unit vectors: the vertex with the least angle."""
    single = points.astype(np.float32).T
    blocks = np.array_split(places.astype(np.float32), len(places) // 256 + 1)
    return np.concatenate([(block @ single).argmax(axis=1) for block in blocks])


def largest_piece(points: Floats, triangles: Whole, out: Bools) -> Bools:
    """(V,) bool: what is left out so that the rest is one piece, in which no two fans of faces share only a vertex."""
    while True:
        faces = triangles[~out[triangles].any(axis=1)]
        if not len(faces):
            raise InputError("nothing of the cortex is left")
        piece = _pieces(faces, len(points))
        area = np.bincount(piece, np.abs(areas(points[faces])))
        stays = faces[piece == area.argmax()]
        left = np.ones(len(points), bool)
        left[stays] = False
        pinched = _pinched(stays, len(points))
        if not pinched.any():
            return left
        out = left | pinched


def _pieces(faces: Whole, count: int) -> Whole:
    """(F,) numbers of pieces that are connected across edges."""
    keys = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1) @ [count, 1]
    order = np.argsort(keys, kind="stable")
    same = keys[order[:-1]] == keys[order[1:]]
    a, b = order[:-1][same] // 3, order[1:][same] // 3
    label = np.arange(len(faces))
    while True:
        low = np.minimum(label[a], label[b])
        before = label.copy()
        np.minimum.at(label, label[a], low)
        np.minimum.at(label, label[b], low)
        label = label[label[label]]
        if np.array_equal(before, label):
            return np.unique(label, return_inverse=True)[1]


def _pinched(faces: Whole, count: int) -> Bools:
    """(V,) bool: vertices with more than two border edges."""
    edges = np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    ends, times = np.unique(edges, axis=0, return_counts=True)
    found: Bools = np.bincount(ends[times == 1].ravel(), minlength=count) > 2
    return found
