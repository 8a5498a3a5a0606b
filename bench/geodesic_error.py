# SPDX-License-Identifier: GPL-3.0-or-later
"""How well a flat map keeps a surface's distances. Lengths are in millimetres, by pygeodesic and SciPy."""

import numpy as np

NEAR, FAR = 2.0, 40.0  # mm: the geodesic distances that count
REACH = 75.0  # mm along edges: no path as long as FAR leaves the faces within


def geodesics(surface, sources):
    """Exact distances (S, V) that cross no cut [Mitchell et al. 1987]; infinite beyond REACH along edges."""
    import pygeodesic.geodesic
    from scipy.sparse import csgraph, csr_matrix

    start, end = surface.triangles.ravel(), np.roll(surface.triangles, -1, axis=1).ravel()
    lengths = np.linalg.norm(surface.vertices[start] - surface.vertices[end], axis=1)
    count = len(surface.vertices)
    graph = csr_matrix((lengths, (start, end)), shape=(count, count))
    distances = np.full((len(sources), count), np.inf)
    for row, source in zip(distances, sources):
        near = np.isfinite(csgraph.dijkstra(graph, directed=False, indices=source, limit=REACH))
        used, triangles = np.unique(surface.triangles[near[surface.triangles].all(axis=1)], return_inverse=True)
        exact = pygeodesic.geodesic.PyGeodesicAlgorithmExact(
            surface.vertices[used], triangles.reshape(-1, 3).astype(np.int32)
        )
        row[used] = exact.geodesicDistances(np.searchsorted(used, [source]))[0]
    return distances


def distance_error(flat, sources, distances):
    """Mean of |s flat distance / geodesic distance - 1| over pairs (source, vertex), for the best scale s, and s."""
    chosen = (distances >= NEAR) & (distances <= FAR)
    apart = np.linalg.norm(flat[None] - flat[sources][:, None], axis=2)
    ratio = np.sort(apart[chosen] / distances[chosen])[::-1]
    sums = np.cumsum(ratio)  # the best s is the median of 1 / ratio with the weights ratio
    scale = 1.0 / ratio[np.searchsorted(sums, sums[-1] / 2.0)]
    return float(np.abs(scale * ratio - 1.0).mean()), float(scale)
