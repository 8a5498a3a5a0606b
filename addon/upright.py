# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns an island's disk so that the surface's up is up in the UV Editor. No bpy."""

import numpy as np

from .surface import signed_areas

# Directions that may be up, in this order: the second is for surfaces that lie flat.
UP = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
# Share of the surface's area that has to agree on where up is (dimensionless); below it the next direction is tried.
AGREEMENT = 0.1
# Below this no direction is better than another (a bowl from above): rounding errors shall not decide.
NO_AGREEMENT = 1e-9


def upright_turn(island, uv):
    """The complex number of modulus 1 that turns the disk so that up points along +v as well as possible.

    On each triangle of the island the height has a gradient in the disk, given by the map `uv` (n, 2): divided by the
    map's local scale it is as long as the up direction's part in the triangle's plane. The turn brings the sum of
    these vectors, weighted with the area on the surface, to +v: that is the least squares solution.
    """
    a, b, c = (island.triangles[:, k] for k in range(3))
    z = uv @ np.array([1.0, 1j])
    in_disk = signed_areas(uv, island.triangles)
    ratio = np.divide(island.areas, in_disk, out=np.zeros_like(in_disk), where=in_disk > 0.0)
    one, two = np.sqrt(ratio) * (z[b] - z[a]), np.sqrt(ratio) * (z[a] - z[c])
    sums = []
    for up in UP:
        # Gradient, in the disk, of the height over the triangle, times the triangle's area in the disk.
        height = island.vertices @ up
        low = height[a]
        sums.append(0.5j * (np.dot(height[b] - low, two) + np.dot(height[c] - low, one)))
    total = island.areas.sum()
    best = sums[0] if abs(sums[0]) >= AGREEMENT * total else max(sums, key=abs)
    if abs(best) <= NO_AGREEMENT * total:
        return 1.0 + 0.0j
    return complex(1j * abs(best) / best)
