# SPDX-License-Identifier: GPL-3.0-or-later
"""Cylinders with rectangular holes, and the same stretched along their axis: the stretch is the Teichmueller map.

The sides of the holes run along and round the cylinder, and its rims are straight. So dz^2, with z along the cylinder,
is a quadratic differential that is real on all rims, and the affine stretch by K has |mu| = (K - 1) / (K + 1).
"""

import sys
import time
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "build" / "python"))

import koebe  # noqa: E402

AROUND, ALONG, HEIGHT = 20, 12, 3.0  # cells, cells, radii
HOLES = {  # cells from, to, along from, to
    1: [],
    2: [(2, 6, 3, 6)],
    3: [(2, 6, 3, 6), (11, 14, 6, 9)],
    5: [(1, 4, 2, 4), (6, 10, 3, 5), (12, 15, 7, 10), (16, 19, 2, 6)],
}


def halved(corners, odd):
    """The triangles of quadrilaterals: four arrays of corners, and which of them have the other diagonal."""
    a, b, c, d = (np.concatenate([corner[odd], np.roll(corners, -1, 0)[k][~odd]]) for k, corner in enumerate(corners))
    return np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def cells_without(holes, wide, high, finer):
    """Places (i, j) of the cells of a grid outside of rectangular holes."""
    cells = np.ones((wide * finer, high * finer), bool)
    for a, b, c, d in holes:
        cells[a * finer : b * finer, c * finer : d * finer] = False
    return np.nonzero(cells)


def cylinder(holes, finer=1, stretch=1.0):
    """Vertices and triangles. The first vertices are those of the lower rim."""
    around, along = AROUND * finer, ALONG * finer
    i, j = cells_without(HOLES[holes], AROUND, ALONG, finer)
    number = (np.arange(around + 1) % around)[None] + around * np.arange(along + 1)[:, None]
    corners = [number[j, i], number[j, i + 1], number[j + 1, i + 1], number[j + 1, i]]
    faces = halved(corners, (i + j) % 2 == 1)
    angle = 2 * np.pi * np.arange(around) / around
    radius = np.pi / around / np.sin(np.pi / around)  # so that the girth is 2 pi
    ring = radius * np.column_stack([np.cos(angle), np.sin(angle)])
    heights = stretch * HEIGHT * np.arange(along + 1) / along
    points = np.concatenate([np.column_stack([ring, np.full(around, z)]) for z in heights])
    used, numbers = np.unique(faces, return_inverse=True)
    return points[used], numbers.reshape(-1, 3).astype(np.int32)


def mapped(holes, finer=1, stretch=1.0):
    """The conformal map with the lower rim outside, and the middles of its loops with the stretch undone."""
    points, faces = cylinder(holes, finer, stretch)
    result = koebe.uniformize(points, faces, outer=0)
    return result, np.array([points[loop].mean(axis=0) / [1, 1, stretch] for loop in result.loops])


def pair(holes, stretch, finer=1):
    """Both maps, and the second one's loop for each of the first one's."""
    (a, at), (b, there) = mapped(holes, finer), mapped(holes, finer, stretch)
    return a, b, np.linalg.norm(at[:, None] - there[None], axis=2).argmin(axis=1)


ROWS = {
    f"{holes} {'holes' if holes > 1 else 'hole'}, K = {stretch:g}, {size}": (holes, stretch, finer)
    for holes, stretch, sizes in [(1, 1.5, (2,)), (2, 2.0, (2,)), (3, 1.1, (2,)), (3, 2.0, (1, 2, 4)), (5, 1.5, (2, 4))]
    for finer, size in [(finer, {1: "coarse", 2: "medium", 4: "fine"}[finer]) for finer in sizes]
}
FIGURES = ["faces", "K", "error of K", "lower", "largest", "K backwards", "mean µ, exact", "spread"]
HEAD = ["surface", *FIGURES, "seconds"]


def cells(row):
    """A row of the table in docs/shapes.md."""
    holes, stretch, finer = ROWS[row]
    a, b, match = pair(holes, stretch, finer)
    begin = time.process_time()
    there = koebe.teichmueller(a, b, match=match)
    seconds = time.process_time() - begin
    back = koebe.teichmueller(b, a, match=np.argsort(match))
    return [*figures(a, there, back, stretch), f"{seconds:.1f}"]


def figures(a, there, back, stretch):
    """What a row says of the maps to and fro, whose K is the stretch."""
    return [
        f"{a.face_count:,}", f"{there.K:.4f}", f"{100 * abs(there.K / stretch - 1):.2f} %", f"{there.lower:.3f}",
        f"{there.largest:.3f}", f"{back.K:.4f}", f"{there.mu.mean():.4f}, {(stretch - 1) / (stretch + 1):.4f}",
        f"{there.mu.std():.4f}",
    ]  # fmt: skip


if __name__ == "__main__":
    for one in ROWS:
        print(one, "|", " | ".join(cells(one)), flush=True)
