# SPDX-License-Identifier: GPL-3.0-or-later
"""A patch for a hole: triangles that match the hole's edges, on a surface that continues the one around it. No bpy.

A disk is triangulated, then the new vertices are moved to where the surface bends least: the squared Laplacian of the
position, with cotangent weights, is least in the mean [Botsch and Kobbelt 2004, section 3]. The faces around the hole
take part, so that the patch leaves the surface in its own direction and curvature.
"""

import dataclasses

import numpy as np
from mathutils.geometry import delaunay_2d_cdt

GROWTH = 1.15  # of the edges from ring to ring towards the middle (dimensionless)
ROW = 0.87  # height of an equilateral triangle over its side
SHORTEST = 1e-2  # edge of a hole's rim in the disk, of the mean one (dimensionless)
MAX_INNER = 1500  # new vertices; the equations are dense
FAIRINGS = 4  # solutions; each one takes its weights from the shape of the one before
MAX_COTANGENT = 20.0  # of the weights (dimensionless): angles down to 3 degrees count as they are
INSIDE = 1  # what `delaunay_2d_cdt` shall return: the triangles inside of the faces given


@dataclasses.dataclass(frozen=True)
class Disk:
    """A triangulated unit disk: `points` (n + k,) complex, the n of the rim first; `triangles` counter-clockwise."""

    points: np.ndarray
    triangles: np.ndarray
    rim: int


def triangulated_disk(rim):
    """A disk whose rim has points (complex, of modulus 1, counter-clockwise); edges grow towards the middle."""
    growth = GROWTH
    inner = _rings(len(rim), growth)
    while len(inner) > MAX_INNER:
        growth *= 1.1
        inner = _rings(len(rim), growth)
    points = np.concatenate([rim, inner])
    coordinates = np.stack([points.real, points.imag], axis=1).tolist()
    _, _, triangles, sources, _, _ = delaunay_2d_cdt(coordinates, [], [list(range(len(rim)))], INSIDE, 1e-9)
    source = np.array([found[0] for found in sources])
    return Disk(points, source[np.array(triangles)], len(rim))


def _rings(count, growth):
    if count == 3:
        return np.empty(0, dtype=complex)
    edge, radius, rings = 2.0 * np.pi / count, 1.0, []
    while True:
        radius -= ROW * edge
        edge *= growth
        around = round(2.0 * np.pi * max(radius, 0.0) / edge)
        if around < 5:
            return np.concatenate([*rings, [0.0]])
        rings.append(radius * np.exp(2j * np.pi * (np.arange(around) + 0.5 * (len(rings) % 2)) / around))


def rim_by_length(positions):
    """Points of the unit circle spaced as the vertices (n, 3) of a closed polygon are; doubled ones come apart."""
    length = np.linalg.norm(np.roll(positions, -1, axis=0) - positions, axis=1)
    length = np.maximum(length, SHORTEST * length.mean())
    start = np.concatenate([[0.0], np.cumsum(length)[:-1]])
    return np.exp(2j * np.pi * start / length.sum())


def harmonic(disk, values):
    """Values (n + k, ·) on the disk that are `values` (n, ·) on the rim and harmonic inside.

    With the cotangent weights of a Delaunay mesh a convex rim has an image without flips [Tutte 1963; Floater 1997].
    """
    values = np.asarray(values, dtype=np.float64)
    if len(disk.points) == disk.rim:
        return values
    flat = np.stack([disk.points.real, disk.points.imag, np.zeros(len(disk.points))], axis=1)
    laplacian, _ = _laplacian(flat, disk.triangles)
    inner = slice(disk.rim, None)
    solved = np.linalg.solve(laplacian[inner, inner], -laplacian[inner, : disk.rim] @ values)
    return np.concatenate([values, solved])


def _laplacian(positions, triangles):
    """Stiffness matrix (n, n) of the cotangent weights, and a third of the area (n,) around each vertex."""
    stiffness, area = np.zeros((len(positions),) * 2), np.zeros(len(positions))
    for k in range(3):
        a, b, c = (triangles[:, (k + i) % 3] for i in range(3))
        one, two = positions[a] - positions[c], positions[b] - positions[c]
        double = np.linalg.norm(np.cross(one, two), axis=1)
        cotangent = np.einsum("ij,ij->i", one, two) / np.maximum(double, np.finfo(float).tiny)
        weight = 0.5 * np.clip(cotangent, -MAX_COTANGENT, MAX_COTANGENT)
        for i, j, sign in ((a, a, 1), (b, b, 1), (a, b, -1), (b, a, -1)):
            np.add.at(stiffness, (i, j), sign * weight)
        np.add.at(area, c, double / 6.0)
    return stiffness, area


def faired(disk, rim, around, around_triangles):
    """Positions (k, 3) of the disk's inner vertices on a surface that bends least.

    rim (n, 3) vertices of the hole; around (m, 3) further vertices of the faces that meet it, and around_triangles
    (t, 3) these faces, with the numbers 0 … n - 1 for the rim and n … n + m - 1 for the others.
    """
    count, rim_count = len(disk.points), disk.rim
    if count == rim_count:
        return np.empty((0, 3))
    positions = np.concatenate([harmonic(disk, rim), around])
    shifted = np.where(around_triangles < rim_count, around_triangles, around_triangles + count - rim_count)
    triangles = np.concatenate([disk.triangles, shifted])
    inner = np.zeros(len(positions), dtype=bool)
    inner[rim_count:count] = True
    for _ in range(FAIRINGS):
        stiffness, area = _laplacian(positions, triangles)
        # The rows of the vertices around are left out: not all of their faces are here.
        rows = stiffness[:count] / np.sqrt(np.maximum(area[:count], np.finfo(float).tiny))[:, None]
        known, free = rows[:, ~inner] @ positions[~inner], rows[:, inner]
        positions[inner] = np.linalg.solve(free.T @ free, -free.T @ known)
    return positions[inner]
