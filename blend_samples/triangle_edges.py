# SPDX-License-Identifier: GPL-3.0-or-later
"""Edges, areas and angles of triangle meshes as arrays. NumPy alone."""

import numpy as np


def corners(triangles):
    """Directed edges (3F, 2): all first ones of the triangles, then all second ones, then all third ones."""
    return np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])


def area_vectors(points, triangles):
    p, q, r = (points[triangles[:, k]] for k in range(3))
    return np.cross(q - p, r - p) / 2


def cotangents(points, apex, a, b):
    """Of the angles at `apex` between `a` and `b`."""
    u, v = points[a] - points[apex], points[b] - points[apex]
    return np.sum(u * v, axis=1) / np.maximum(np.linalg.norm(np.cross(u, v), axis=1), 1e-300)


def edge_keys(a, b, count):
    """A number for each undirected edge of a mesh with this many vertices."""
    return np.minimum(a, b).astype(np.int64) * count + np.maximum(a, b)


def inner_edges(triangles, count):
    """Edges a-b between two triangles: left and right triangle, ends a and b, apexes c and d."""
    edges = corners(triangles)
    key = edge_keys(*edges.T, count)
    order = np.argsort(key, kind="stable")
    twins = np.flatnonzero(key[order][1:] == key[order][:-1])
    first, second = order[twins], order[twins + 1]
    apex = np.concatenate([triangles[:, (k + 2) % 3] for k in range(3)])
    a, b = edges[first].T
    return first % len(triangles), second % len(triangles), a, b, apex[first], apex[second]


def excess_angles(points, a, b, c, d):
    """Of each edge a-b with the apexes c and d: positive if the two angles that face it sum to more than pi."""
    return -cotangents(points, c, a, b) - cotangents(points, d, a, b)


def largest_of_neighbours(excess, left, right, count):
    """Whether an edge's excess is the largest of all edges of its two triangles, of `count`."""
    worst = np.zeros(count)
    np.maximum.at(worst, left, excess)
    np.maximum.at(worst, right, excess)
    return (excess > 1e-9) & (excess == worst[left]) & (excess == worst[right])


def flip(triangles, left, right, a, b, c, d):
    """Flip the edges a-b to c-d in place."""
    triangles[left] = np.stack([a, d, c], axis=1)
    triangles[right] = np.stack([d, b, c], axis=1)
