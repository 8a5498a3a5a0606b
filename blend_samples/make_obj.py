# SPDX-License-Identifier: GPL-3.0-or-later
"""Small faces as OBJ files, without Blender: face.obj and surprised.obj beside this file.

    python3 blend_samples/make_obj.py [--output FOLDER] [--cells N] [--cut DEGREES]

A regular triangular grid in the chart of face_surface is cut along an ellipse and opened at eyes and mouth, its rim
moved onto the ellipses, evened out and lifted onto the face. surprised.obj is the same mesh with another expression.
"""

import argparse
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE))

import face_expression  # noqa: E402
import face_surface  # noqa: E402

# Centre and half axes in the chart, where lengths are angles seen from within the head (radians).
OUTLINE = ((0.0, -0.14), (1.12, 1.06))
HOLES = (((0.30, 0.0), (0.16, 0.08)), ((-0.30, 0.0), (0.16, 0.08)), ((0.0, -0.60), (0.25, 0.085)))
CELLS = 52  # across the outline
SMOOTHING = 30  # rounds


def face(cells=CELLS, outline=OUTLINE):
    """The face with both eyes and the mouth open: points (V, 3) and triangles (F, 3), counterclockwise from ahead."""
    points, triangles = triangular_grid(outline, cells)
    middles = points[triangles].mean(axis=1)
    kept = level(middles, outline) < 1.0
    for hole in HOLES:
        kept &= level(middles, hole) > 1.0
    triangles = without_ears(triangles[kept])
    used, index = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], index.reshape(-1, 3)
    evened(points, triangles, outline)
    return face_surface.lift(points), triangles


def triangular_grid(outline, cells):
    """Points (V, 2) and triangles (F, 3) of a grid of equilateral triangles over an ellipse."""
    center, axes = map(np.array, outline)
    step = 2.0 * axes[0] / cells
    columns, rows = cells + 4, int(2.0 * axes[1] / (step * np.sqrt(0.75))) + 4
    i, j = (a.ravel() for a in np.meshgrid(np.arange(columns), np.arange(rows)))
    grid = np.stack([i + 0.5 * (j % 2) - columns / 2, (j - rows / 2) * np.sqrt(0.75)], axis=1) * step
    a = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    odd = (a // columns) % 2 == 1
    b, c, d = a + 1, a + columns, a + columns + 1
    lower = np.stack([a, b, np.where(odd, d, c)], axis=1)
    upper = np.where(odd[:, None], np.stack([a, d, c], axis=1), np.stack([b, d, c], axis=1))
    return grid + center, np.concatenate([lower, upper])


def level(points, ellipse):
    """1 on the ellipse, less inside."""
    center, axes = map(np.array, ellipse)
    return np.linalg.norm((points - center) / axes, axis=1)


def boundary_vertices(triangles):
    edges = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    once, count = np.unique(edges, axis=0, return_counts=True)
    return np.unique(once[count == 1])


def without_ears(triangles):
    """Without the triangles all of whose corners are on the boundary."""
    while True:
        ear = np.isin(triangles, boundary_vertices(triangles)).all(axis=1)
        if not ear.any():
            return triangles
        triangles = triangles[~ear]


def evened(points, triangles, outline):
    """Moves the rim onto the nearest ellipse and all others, round by round, to the mean of their neighbours."""
    rim = boundary_vertices(triangles)
    ellipses = (outline, *HOLES)
    nearest = np.argmin([np.abs(level(points[rim], e) - 1.0) * min(e[1]) for e in ellipses], axis=0)
    for k, (center, axes) in enumerate(ellipses):
        own = rim[nearest == k]
        points[own] = center + (points[own] - center) / level(points[own], (center, axes))[:, None]
    edges = np.unique(np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    inner = np.setdiff1d(np.arange(len(points)), rim)
    for _ in range(SMOOTHING):
        total, count = np.zeros_like(points), np.zeros(len(points))
        for a, b in (edges.T, edges.T[::-1]):
            np.add.at(total, a, points[b])
            np.add.at(count, a, 1.0)
        points[inner] = (total / count[:, None])[inner]


def write_obj(path, points, triangles, title):
    lines = [f"# {title}; made by blend_samples/make_obj.py", f"o {path.stem}"]
    lines += ["v {:.5f} {:.5f} {:.5f}".format(*p) for p in points]
    lines += ["f {} {} {}".format(*(t + 1)) for t in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, default=HERE, help="folder")
    parser.add_argument("--cells", type=int, default=CELLS, help="triangles across the face")
    parser.add_argument("--cut", type=float, default=1.0, help="size of the outline, 1 is the sample's")
    options = parser.parse_args()
    options.output.mkdir(parents=True, exist_ok=True)
    outline = (OUTLINE[0], tuple(options.cut * axis for axis in OUTLINE[1]))
    points, triangles = face(options.cells, outline)
    write_obj(options.output / "face.obj", points, triangles, "a face with eyes and mouth open")
    points = face_expression.surprised(points)
    write_obj(options.output / "surprised.obj", points, triangles, "the same face, surprised")


if __name__ == "__main__":
    main()
