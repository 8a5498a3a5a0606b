# SPDX-License-Identifier: GPL-3.0-or-later
"""Triangle meshes on a curved surface made even, the boundary held: edges flip until they are Delaunay, vertices move
to the weighted centroids of their stars [Du, Faber, Gunzburger 1999]. NumPy alone, reruns are bit-identical."""

import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parent.parent / "blend_samples"))

from triangle_edges import (  # noqa: E402
    area_vectors,
    corners,
    edge_keys,
    excess_angles,
    flip,
    inner_edges,
    largest_of_neighbours,
)  # fmt: skip

GRADATION = 0.25  # by how much the edge length changes per unit of distance from the boundary


def boundary_vertices(triangles):
    edges = np.sort(corners(triangles), axis=1)
    once, count = np.unique(edges, axis=0, return_counts=True)
    return np.unique(once[count == 1])


def angles(points, triangles):
    """Of all corners (F, 3), in degrees."""
    found = []
    for k in range(3):
        p, q, r = (points[triangles[:, (k + i) % 3]] for i in range(3))
        cosine = np.sum((q - p) * (r - p), axis=1) / (np.linalg.norm(q - p, axis=1) * np.linalg.norm(r - p, axis=1))
        found.append(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))
    return np.stack(found, axis=1)


# ---------------------------------------------------------------- flips


def flipped_to_delaunay(points, triangles, limit=60):
    """Inner edges flipped, independent ones at a time, until the two angles that face each sum to at most pi. No edge
    comes to join two boundary vertices: it would cut off an ear."""
    triangles = triangles.copy()
    on_rim = np.zeros(len(points), bool)
    on_rim[boundary_vertices(triangles)] = True
    for _ in range(limit):
        flips = _flips(points, triangles, on_rim)
        if not len(flips[0]):
            break
        flip(triangles, *flips)
    return triangles


def _flips(points, triangles, on_rim):
    """Edges a-b to flip, no two with a triangle in common: left and right triangle, ends, apexes."""
    count = len(triangles)
    left, right, a, b, c, d = inner_edges(triangles, len(points))
    excess = excess_angles(points, a, b, c, d)
    key = edge_keys(*corners(triangles).T, len(points))
    new_key = edge_keys(c, d, len(points))
    before = area_vectors(points, np.stack([a, b, c], axis=1)) + area_vectors(points, np.stack([b, a, d], axis=1))
    folds = np.min(
        [np.sum(before * area_vectors(points, np.stack(t, axis=1)), axis=1) for t in ((a, d, c), (d, b, c))], axis=0
    )
    excess[(folds <= 0) | np.isin(new_key, key) | (on_rim[c] & on_rim[d])] = 0.0
    chosen = np.flatnonzero(largest_of_neighbours(excess, left, right, count))
    # Equal excesses side by side: the first of them. And of two flips to one new edge, the first.
    owner = np.full(count, -1)
    owner[right[chosen][::-1]] = chosen[::-1]
    owner_left = np.full(count, -1)
    owner_left[left[chosen][::-1]] = chosen[::-1]
    alone = (owner_left[left[chosen]] == chosen) & (owner[right[chosen]] == chosen)
    alone &= np.isin(owner[left[chosen]], [-1]) & np.isin(owner_left[right[chosen]], [-1])
    chosen = chosen[alone]
    _, once = np.unique(new_key[chosen], return_index=True)
    chosen = chosen[once]
    return [x[chosen] for x in (left, right, a, b, c, d)]


# ---------------------------------------------------------------- fewer vertices


def fewer(points, triangles, count):
    """Without `count` inner vertices, spread over the mesh: each is drawn into a neighbour, and two faces go."""
    around = [set() for _ in points]
    for a, b in corners(triangles).tolist():
        around[a].add(b)
        around[b].add(a)
    taken = set(boundary_vertices(triangles).tolist())
    # The fractional parts of the golden ratio's multiples visit the mesh evenly.
    order = np.argsort((np.arange(len(points)) * 0.6180339887498949) % 1.0, kind="stable")
    into = np.arange(len(points))
    left = count
    for v in order.tolist():
        if left == 0:
            break
        star = around[v] | {v}
        if taken & star:
            continue
        near = sorted(around[v], key=lambda u: (np.linalg.norm(points[u] - points[v]), u))
        target = next((u for u in near if len(around[u] & around[v]) == 2), None)
        if target is None:
            continue
        into[v] = target
        taken |= star.union(*(around[u] for u in star))
        left -= 1
    if left:
        raise ValueError("too few inner vertices to take away")
    triangles = into[triangles]
    whole = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    used, index = np.unique(triangles[whole], return_inverse=True)
    return points[used], index.reshape(-1, 3)


# ---------------------------------------------------------------- sizes and relaxation


def wanted_lengths(points, triangles):
    """The edge length wanted at each vertex: on the boundary the mean of its two boundary edges, and from there by
    GRADATION towards the length that the number of faces allows inside."""
    edges = np.sort(corners(triangles), axis=1)
    once, count = np.unique(edges, axis=0, return_counts=True)
    rim_edges = once[count == 1]
    rim, index = np.unique(rim_edges, return_inverse=True)
    length = np.linalg.norm(points[rim_edges[:, 0]] - points[rim_edges[:, 1]], axis=1)
    rim_length = np.bincount(index.reshape(-1), np.repeat(length, 2)) / 2
    area = np.linalg.norm(area_vectors(points, triangles), axis=1).sum()
    inside = np.sqrt(4.0 * area / (np.sqrt(3.0) * len(triangles)))
    wanted = np.empty(len(points))
    for start in range(0, len(points), 4096):
        part = points[start : start + 4096]
        square = (part**2).sum(axis=1)[:, None] + (points[rim] ** 2).sum(axis=1) - 2.0 * part @ points[rim].T
        nearest = square.argmin(axis=1)
        away = np.sqrt(np.maximum(square[np.arange(len(part)), nearest], 0.0))
        own, change = rim_length[nearest], GRADATION * away
        wanted[start : start + 4096] = np.where(
            own > inside, np.maximum(own - change, inside), np.minimum(own + change, inside)
        )
    return wanted


def relaxed(points, triangles, project, rounds):
    """Every inner vertex moved to the centroid of its star, the triangles weighted so that the lengths become those
    wanted; flips in between. Every fourth round, and after the last, `project` brings them back to the surface."""
    rim = boundary_vertices(triangles)
    for number in range(1, rounds + 1):
        if number % 8 == 1:
            wanted = wanted_lengths(points, triangles)
        centers = points[triangles].mean(axis=1)
        size = wanted[triangles].mean(axis=1)
        weight = np.linalg.norm(area_vectors(points, triangles), axis=1) / size**4
        total = sum(np.bincount(triangles[:, k], weight, len(points)) for k in range(3))
        moved = np.stack(
            [
                sum(np.bincount(triangles[:, k], weight * centers[:, axis], len(points)) for k in range(3)) / total
                for axis in range(3)
            ],
            axis=1,
        )
        fixed, points = points[rim], project(moved) if number % 4 == 0 or number == rounds else moved
        points[rim] = fixed
        triangles = flipped_to_delaunay(points, triangles)
    return points, triangles
