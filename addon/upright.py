# SPDX-License-Identifier: GPL-3.0-or-later
"""Turns an island's disk so that the surface's up is up in the UV Editor. No bpy."""

import numpy as np

# Directions that may be up, in this order: the second is for surfaces that lie flat.
UP = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
# Share of the surface's area that has to agree on where up is (dimensionless); below it the next direction is tried.
AGREEMENT = 0.1
# Below this no direction is better than another (a bowl from above): rounding errors shall not decide.
NO_AGREEMENT = 1e-9


def upright_turn(vertices, triangles, uv):
    """The complex number of modulus 1 that turns the disk so that up points along +v as well as possible.

    On each triangle (m, 3) of `vertices` (n, 3) the height has a gradient in the disk, given by the map `uv` (n, 2):
    divided by the map's local scale it is as long as the up direction's part in the triangle's plane. The turn brings
    the sum of these vectors, weighted with the area on the surface, to +v: that is the least squares solution.
    """
    z = uv @ np.array([1.0, 1j])
    a, b, c = (np.take(z, triangles[:, k]) for k in range(3))
    pa, pb, pc = (vertices[triangles[:, k]] for k in range(3))
    one, two = pb - pa, pc - pa
    in_space = 0.5 * np.sqrt(
        (one[:, 1] * two[:, 2] - one[:, 2] * two[:, 1]) ** 2
        + (one[:, 2] * two[:, 0] - one[:, 0] * two[:, 2]) ** 2
        + (one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0]) ** 2
    )
    in_disk = 0.5 * np.imag(np.conj(b - a) * (c - a))
    weight = np.sqrt(np.divide(in_space, in_disk, out=np.zeros_like(in_space), where=in_disk > 0.0))
    # Gradient, in the disk, of the height over the triangle, times the triangle's area in the disk.
    sums = [np.sum(weight * 0.5j * ((one @ up) * (a - c) + (two @ up) * (b - a))) for up in UP]
    best = sums[0] if abs(sums[0]) >= AGREEMENT * in_space.sum() else max(sums, key=abs)
    if abs(best) <= NO_AGREEMENT * in_space.sum():
        return 1.0 + 0.0j
    return complex(1j * abs(best) / best)
