# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns an island's disk so that the surface's up is up in the UV Editor."""

import numpy as np

from .surface import Island
from .triangles import as_complex, blocks, spanned_areas

# Axes that may be up, in this order, Z and Y: the second is for surfaces that lie flat.
UP = [2, 1]
# Share of the surface's area that must agree on up (dimensionless); below it the next direction is tried.
AGREEMENT = 0.1
# Below this no direction is better than another (a bowl from above): rounding errors must not decide.
NO_AGREEMENT = 1e-9


def upright_turn(island: Island, uv: np.ndarray) -> complex:
    """The complex number of modulus 1 that turns the disk so that up points along +v as well as possible.

    On each triangle of the island the height has a gradient in the disk, given by the map `uv` (n, 2). Divided by the
    map's local scale it is as long as the part of the up direction in the triangle's plane. The turn brings the sum of
    these vectors, weighted with the area on the surface, to +v: the least squares solution.
    """
    z = as_complex(uv)
    sums, total = np.zeros(len(UP), dtype=complex), 0.0
    for part in blocks(len(island.triangles)):
        corners = island.triangles[part].T
        a, b, c = (z.take(corner) for corner in corners)
        one, two = b - a, a - c
        a, b, c = (island.vertices.take(corner, axis=0) for corner in corners)
        in_space, in_disk = spanned_areas(b - a, c - a), -0.5 * (np.conj(one) * two).imag
        ratio = np.sqrt(np.divide(in_space, in_disk, out=np.zeros_like(in_disk), where=in_disk > 0.0))
        # Gradients, in the disk, of the heights over each triangle, times the triangle's area in the disk. (Without
        # matrix products: NumPy would hand them to threads, which wait for each other on a busy processor.)
        first, second = (b - a)[:, UP].T, (c - a)[:, UP].T
        sums += 0.5j * (ratio * (two * first + one * second)).sum(axis=1)
        total += in_space.sum()
    best = sums[0] if abs(sums[0]) >= AGREEMENT * total else max(sums, key=abs)
    if abs(best) <= NO_AGREEMENT * total:
        return 1.0 + 0.0j
    return complex(1j * abs(best) / best)
