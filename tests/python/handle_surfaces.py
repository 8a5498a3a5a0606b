"""Surfaces with handles: two sheets over one region, sewn along its rims."""

import numpy as np
from domain_surfaces import holed_ring, on_sphere


def sewn(points, triangles, rims):
    """Two copies of a sheet, the second turned over, joined at some vertices: (V, 3) and (F, 3)."""
    n = len(points)
    other = np.arange(n) + n
    other[rims] = rims
    faces = np.concatenate([triangles, other[triangles][:, ::-1]])
    used, faces = np.unique(faces, return_inverse=True)
    return np.concatenate([points, points])[used], faces.reshape(-1, 3).astype(np.int32)


def border_of(triangles):
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    both = {tuple(edge) for edge in edges}
    return np.array(sorted({v for a, b in both if (b, a) not in both for v in (a, b)}))


def double_ring(steps, open_hole=False):
    """The double of a round annulus with a round hole: genus 2, its rims the shortest loops.

    open_hole: one more hole, that both sheets keep open. Gives vertices, triangles, and the circles (center, radius)
    of the three rims in the annulus's plane.
    """
    holes = {(5, 3): ((0.5, 0.5), 0.4)}
    if open_hole:
        holes[1, 3] = ((0.5, 0.5), 0.35)
    _, triangles, height, flat, (centers, radii) = holed_ring(steps, columns=10, rows=7, holes=holes)
    z = np.exp(2j * np.pi * (flat[:, 0] + 1j * flat[:, 1]))
    inner = np.exp(-2 * np.pi * height)
    circles = [(0j, 1.0), (0j, inner), *zip(centers, radii, strict=True)]
    rims = border_of(triangles)
    sewn_along = np.min([abs(abs(z[rims] - c) - r) / r for c, r in circles[:3]], axis=0) < 1e-6
    return *sewn(on_sphere(z / np.sqrt(inner)), triangles, rims[sewn_along]), circles[:3]


def reflection(circle):
    """a, b; c, d of conj(z) -> (a conj(z) + b) / (c conj(z) + d), the mirror image in a circle."""
    center, radius = circle
    return np.array([[center, radius**2 - abs(center) ** 2], [1.0, -np.conj(center)]])


def double_group(circles, uncut):
    """Generators, of determinant 1, of the double cut along all rims but one."""
    result = []
    for k, circle in enumerate(circles):
        if k != uncut:
            product = reflection(circles[uncut]) @ reflection(circle).conj()
            result.append(product / np.sqrt(np.linalg.det(product) + 0j))
    return result


def invariants(first, second):
    """What Moebius maps, the order and the directions of two generators do not change: squared traces."""

    def squared(matrix):
        return (np.trace(matrix) ** 2).real

    return np.array(
        sorted([squared(first), squared(second)])
        + sorted([squared(first @ second), squared(first @ np.linalg.inv(second))])
    )


def plate(rng, noise=0.0):
    """A plate with rectangular windows, sewn from two sheets of random diagonals, and perhaps with holes.

    None where the windows leave a face on the rim alone.
    """
    n, m = rng.integers(10, 20, 2)
    kept = np.ones((n, m), bool)
    for _ in range(40):
        i, j = rng.integers(3, n - 3), rng.integers(3, m - 3)
        a, b = rng.integers(2, 5, 2)
        if i + a < n - 2 and j + b < m - 2 and kept[i - 3 : i + a + 3, j - 3 : j + b + 3].all() and rng.random() < 0.3:
            kept[i : i + a, j : j + b] = False
    if kept.all():
        kept[n // 2 - 1 : n // 2 + 1, m // 2 - 1 : m // 2 + 1] = False
    faces = []
    for i, j in np.argwhere(kept):
        a, b, c, d = (m + 1) * i + j, (m + 1) * (i + 1) + j, (m + 1) * (i + 1) + j + 1, (m + 1) * i + j + 1
        faces += [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
    faces = np.array(faces)
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(m + 1.0), indexing="ij")
    rims = border_of(faces)
    if np.isin(faces, rims).all(axis=1).any():
        return None
    points = np.column_stack([x.ravel(), y.ravel(), np.zeros(x.size)])
    points[:, :2] += rng.uniform(-noise, noise, (len(points), 2))
    vertices, triangles = sewn(points, faces, rims)
    inside = np.setdiff1d(np.arange(len(vertices)), np.searchsorted(np.unique(faces), rims))
    top = inside < len(np.unique(faces))
    vertices[inside, 2] = np.where(top, 1.0, -1.0) + rng.uniform(-noise, noise, len(inside))
    vertices[:, 2] += rng.uniform(0, 0.05) * (vertices[:, 0] - n / 2) ** 2
    for _ in range(rng.integers(0, 3)):
        triangles = triangles[(triangles != rng.choice(inside)).all(axis=1)]
    used, triangles = np.unique(triangles, return_inverse=True)
    return vertices[used], triangles.reshape(-1, 3).astype(np.int32)
