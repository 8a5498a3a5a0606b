"""Plates with windows, closed and with holes: surfaces with any number of handles, of quadrilaterals."""

import numpy as np
import scenes

TWO = ((3, 3), (7, 3))
THREE = (*TWO, (11, 3))
HOLE = ((1, 1), (1, 2), (2, 1), (2, 2))
HOLES = (*HOLE, (8, 4), (9, 4))


def plate_arrays(windows=TWO, holes=(), size=1, n=None, m=7, bent=0.05):
    """Two sheets of n by m quadrilaterals, sewn at their rims, with square windows from the cells `windows` on, each of
    which is a handle; the upper one without the faces `holes`."""
    n = n or 4 * len(windows) + 3
    kept = np.ones((n, m), bool)
    for i, j in windows:
        kept[i : i + size, j : j + size] = False
    at = lambda i, j: i * (m + 1) + j  # noqa: E731
    cells = [tuple(cell) for cell in np.argwhere(kept).tolist()]
    quads = {(i, j): [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i, j in cells}
    around = np.zeros((n + 2, m + 2), int)
    around[1:-1, 1:-1] = kept
    inside = (around[1:, 1:] + around[:-1, 1:] + around[1:, :-1] + around[:-1, :-1] == 4).ravel()
    lower = np.arange(inside.size) + inside * inside.size
    x, y = (one.ravel().astype(float) for one in np.meshgrid(np.arange(n + 1), np.arange(m + 1), indexing="ij"))
    # Both sheets have three vertices of a corner's face: the diagonal between two of them must be in none.
    corner = ((x == 0) | (x == n)) & ((y == 0) | (y == m))
    x, y = x + 0.6 * corner * np.sign(n - 2 * x), y + 0.6 * corner * np.sign(m - 2 * y)
    height = bent * (x - n / 2) ** 2 + 0.1 * np.sin(y + 0.3 * x)
    upper_points = np.stack([x, y + 0.2 * np.sin(x), height + 0.7 * inside], axis=1)
    points = np.concatenate([upper_points, upper_points - (0, 0, 1.4)])
    faces = [quad for cell, quad in quads.items() if cell not in holes]
    faces += [lower[quad][::-1].tolist() for quad in quads.values()]
    used, number = np.unique(np.concatenate(faces), return_inverse=True)
    return points[used], number.reshape(-1, 4).tolist()


def add_plate(name="Plate", triangles=False, **options):
    points, faces = plate_arrays(**options)
    if triangles:
        faces = [[a, *pair] for a, b, c, d in faces for pair in ((b, c), (c, d))]
    obj = scenes.add_object(name, points, faces)
    scenes.select(obj)
    return obj
