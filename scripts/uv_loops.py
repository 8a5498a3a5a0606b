# SPDX-License-Identifier: GPL-3.0-or-later
"""The boundary loops of a UV map, and the circles that fit them, as arrays."""

import numpy as np


def read_uv_mesh(mesh, layer):
    """The mesh cut open along its UV seams: vertex (n,) and UV (n, 2) of each point, the points of the corners, and
    the number of corners of each face."""
    vertex = np.empty(len(mesh.loops), np.int32)
    mesh.loops.foreach_get("vertex_index", vertex)
    uv = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers[layer].data.foreach_get("uv", uv)
    sizes = np.empty(len(mesh.polygons), np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    rows = np.column_stack([vertex, uv.astype(float).reshape(-1, 2)])
    points, corners = np.unique(rows, axis=0, return_inverse=True)
    return points[:, 0].astype(int), points[:, 1:], corners.reshape(-1), sizes


def boundary_loops(corners, sizes):
    """The closed loops of edges that only one face uses, as lists of points."""
    ends = np.cumsum(sizes)
    following = np.arange(len(corners)) + 1
    following[ends - 1] = ends - sizes
    directed = set(zip(corners.tolist(), corners[following].tolist()))
    after = {a: b for a, b in directed if (b, a) not in directed}
    loops = []
    while after:
        first, at = after.popitem()
        loop = [first]
        while at != first:
            loop.append(at)
            at = after.pop(at)
        loops.append(loop)
    return sorted(loops, key=min)


def fitted_circle(points):
    """Center and radius of the circle that fits plane points best in the algebraic sense [Kasa 1976]."""
    system = np.column_stack([2 * points, np.ones(len(points))])
    x, y, c = np.linalg.lstsq(system, (points**2).sum(axis=1), rcond=None)[0]
    return np.array([x, y]), float(np.sqrt(c + x * x + y * y))
