# SPDX-License-Identifier: GPL-3.0-or-later
"""Rectangles with rectangular holes and marked corners, and the same stretched along a side: the stretch is extremal.

All sides run along the axes. So dz^2 is a quadratic differential that is real on all rims, with simple poles at the
corners, as a disk sees them. The affine stretch by K has |mu| = (K - 1) / (K + 1).
"""

import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "build" / "python"))

import koebe  # noqa: E402
from stretched_cylinders import FIGURES, cells_without, figures, halved  # noqa: E402

WIDE, HIGH = 18, 12  # cells
HOLES = {0: [], 1: [(3, 7, 3, 7)], 3: [(3, 7, 3, 7), (10, 14, 5, 9), (4, 9, 9, 11)]}  # cells from, to, up from, to


def rectangle(holes, finer=1, stretch=1.0):
    """Vertices, triangles and the corners."""
    wide, high = WIDE * finer, HIGH * finer
    i, j = cells_without(HOLES[holes], WIDE, HIGH, finer)
    number = np.arange((wide + 1) * (high + 1)).reshape(wide + 1, high + 1)
    corners = [number[i, j], number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]]
    faces = halved(corners, (i + j) % 2 == 1)
    x, y = np.meshgrid(np.arange(wide + 1) / finer, np.arange(high + 1) / finer, indexing="ij")
    points = np.column_stack([stretch * x.ravel(), y.ravel(), 0 * x.ravel()])
    used, numbers = np.unique(faces, return_inverse=True)
    return (
        points[used],
        numbers.reshape(-1, 3).astype(np.int32),
        np.searchsorted(used, number[[0, -1, -1, 0], [0, 0, -1, -1]]),
    )


def pair(holes, stretch, finer=1):
    """Both maps, the second one's loop for each of the first one's, and the pairs of corners."""
    points, faces, corners = rectangle(holes, finer)
    a = koebe.uniformize(points, faces, outer=0)
    b = koebe.uniformize(*rectangle(holes, finer, stretch)[:2], outer=0)
    firsts = [loop.min() for loop in b.loops]
    return a, b, [firsts.index(loop.min()) for loop in a.loops], [(int(v), int(v)) for v in corners]


ROWS = {
    f"{holes or 'no'} hole{'s' * (holes != 1)}, K = {stretch:g}, {size}": (holes, stretch, finer)
    for holes, stretch, sizes in [(0, 1.5, "m"), (0, 3.0, "m"), (1, 2.0, "m"), (3, 2.0, "cmf")]
    for finer, size in [
        ({"c": 1, "m": 2, "f": 4}[one], {"c": "coarse", "m": "medium", "f": "fine"}[one]) for one in sizes
    ]
}
HEAD = ["rectangle", *FIGURES]


def cells(row):
    """A row of the table in docs/shapes.md."""
    holes, stretch, finer = ROWS[row]
    a, b, match, corners = pair(holes, stretch, finer)
    there = koebe.teichmueller(a, b, match=match, landmarks=corners)
    back = koebe.teichmueller(b, a, match=np.argsort(match), landmarks=corners)
    return figures(a, there, back, stretch)


if __name__ == "__main__":
    for one in ROWS:
        print(one, "|", " | ".join(cells(one)), flush=True)
