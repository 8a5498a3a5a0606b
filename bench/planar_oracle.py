# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of the mesh maps on planar domains, beside koebe.planar: with corners and with smooth rims.

Usage: planar_oracle.py        prints a table in Markdown
"""

import math
import time

import koebe
import numpy as np

SIZES = (32, 64, 128, 256)  # cells along a side, or round the ring
HOLES = ((1, 1, 3, 3), (5, 4, 6, 7))  # of a square of side 8: west, south, east, north


def cells(points, width, inside):
    """Triangles of the cells of a grid of points, as (V, 3), (F, 3). @param inside: of each cell's lower left corner"""
    a = np.flatnonzero(inside)
    faces = np.concatenate([np.stack([a, a + 1, a + width + 1], 1), np.stack([a, a + width + 1, a + width], 1)])
    used, faces = np.unique(faces, return_inverse=True)
    return np.column_stack([points[used], np.zeros(len(used))]), faces.reshape(-1, 3)


def plate(size):
    """A square with two rectangular holes."""
    i, j = (a.ravel() for a in np.meshgrid(np.arange(size + 1), np.arange(size + 1)))
    x, y = 8 * i / size, 8 * j / size
    inside = (i < size) & (j < size)
    for west, south, east, north in HOLES:
        inside &= ~((x >= west) & (x < east) & (y >= south) & (y < north))
    return cells(np.stack([x, y], 1), size + 1, inside)


def plate_rims():
    return [
        np.array([west + 1j * south, east + 1j * south, east + 1j * north, west + 1j * north])
        for west, south, east, north in ((0, 0, 8, 8), *HOLES)
    ]


def confocal(size):
    """The ring between two ellipses with the same foci: the image of 1.2 < |w| < 3 under w + 1 / w."""
    rounds = size
    layers = max(1, round(rounds * math.log(3 / 1.2) / (2 * math.pi)))
    radius = 1.2 * (3 / 1.2) ** (np.arange(layers + 1) / layers)
    w = np.concatenate([r * np.exp(2j * np.pi * (np.arange(rounds) + 0.5 * k) / rounds) for k, r in enumerate(radius)])
    z = w + 1 / w
    faces = []
    for k in range(layers):
        a = k * rounds + np.arange(rounds)
        b = k * rounds + (np.arange(rounds) + 1) % rounds
        faces += [np.stack([a, a + rounds, b], 1), np.stack([b, a + rounds, b + rounds], 1)]
    return np.stack([z.real, z.imag, 0 * z.real], 1), np.concatenate(faces)


def confocal_rims():
    return [{"fourier": {"lowest": -1, "coefficients": [[1 / r, 0], [0, 0], [r, 0]]}} for r in (3.0, 1.2)]


def rows():
    """For each domain and size: name, faces, error of the module with smooth and with polygonal rims, seconds."""
    for name, mesh, rims in (("plate, 12 corners", plate, plate_rims), ("ring of ellipses", confocal, confocal_rims)):
        exact = koebe.planar(rims())
        for size in SIZES:
            vertices, faces = mesh(size)
            began = time.perf_counter()
            result = koebe.uniformize(vertices, faces)
            seconds = time.perf_counter() - began
            order = matched(result, exact)
            smooth = abs(koebe.conformal_module(result, order=order) - exact.module).max()
            polygonal = abs(koebe.conformal_module(result, order=order, rims="polygonal") - exact.module).max()
            yield name, len(faces), float(smooth), float(polygonal), seconds


def matched(result, exact):
    """The result's loops in the order of the exact circles."""
    match = koebe.match_loops(exact, result)
    partner = dict(zip(match.order_a, match.order_b, strict=True))
    return [partner[k] for k in range(len(exact.radii))]


def main():
    print("| domain | faces | error, smooth rims | order | error, polygonal rims | order | seconds |")
    print("| --- " * 7 + "|")
    last = None
    for name, faces, smooth, polygonal, seconds in rows():
        orders = ["", ""]
        if last and last[0] == name:
            step = math.log(faces / last[1]) / 2  # of the edge's length
            orders = [f"{math.log(last[2] / smooth) / step:.2f}", f"{math.log(last[3] / polygonal) / step:.2f}"]
        print(f"| {name} | {faces:,} | {smooth:.1e} | {orders[0]} | {polygonal:.1e} | {orders[1]} | {seconds:.2f} |")
        last = name, faces, smooth, polygonal


if __name__ == "__main__":
    main()
