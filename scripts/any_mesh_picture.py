# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/parts.md: docs/images/any_mesh.svg, drawn by the command. NumPy alone.

A torus, a cube and a Möbius band, beside each other in one file.
"""

import subprocess
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "docs" / "images" / "any_mesh.svg"


def quads(rows, columns, row_end, column_end, turned=False):
    """Faces of a grid of rows × columns vertices; an end that is closed meets its begin, `turned` the other way up."""
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows - (not row_end)), np.arange(columns - (not column_end))))

    def number(i, j):
        j = np.where(turned & (i == rows), columns - 1 - j, j)
        return i % rows * columns + j % columns

    return np.stack([number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)], axis=1)


def torus(m=40, n=20):
    a, b = (2 * np.pi * k.ravel() for k in np.meshgrid(np.arange(m) / m, np.arange(n) / n, indexing="ij"))
    r = 1 + 0.4 * np.cos(b)
    return np.stack([r * np.cos(a), r * np.sin(a), 0.4 * np.sin(b)], axis=1), quads(m, n, True, True)


def moebius_band(m=48, n=13):
    a, b = (k.ravel() for k in np.meshgrid(2 * np.pi * np.arange(m) / m, np.linspace(-0.8, 0.8, n), indexing="ij"))
    r = 1 + b * np.cos(a / 2)
    return np.stack([r * np.cos(a), r * np.sin(a), b * np.sin(a / 2)], axis=1), quads(m, n, True, False, turned=True)


def cube(n=9):
    u, v = (k.ravel() for k in np.meshgrid(np.linspace(-0.6, 0.6, n), np.linspace(-0.6, 0.6, n), indexing="ij"))
    sides = []
    for k in range(3):
        for sign in (-1, 1):  # u, v and the way out are right-handed
            sides.append(np.roll(np.stack([np.full(n * n, 0.6 * sign), sign * u, v], axis=1), k, axis=1))
    points, same = np.unique(np.concatenate(sides).round(9), axis=0, return_inverse=True)
    faces = np.concatenate([quads(n, n, False, False) + n * n * k for k in range(6)])
    return points, same.ravel()[faces]


def main():
    lines, count = [], 0
    for k, (points, faces) in enumerate((torus(), cube(), moebius_band())):
        lines += ["v {} {} {}".format(*point) for point in points + [4.0 * k, 0.0, 0.0]]
        lines += ["f {} {} {} {}".format(*face) for face in faces + count + 1]
        count += len(points)
    with tempfile.TemporaryDirectory() as folder:
        mesh = Path(folder) / "any_mesh.obj"
        mesh.write_text("\n".join(lines) + "\n", encoding="ascii")
        command = [ROOT / "build" / "koebe", "uniformize", "--cut", mesh, Path(folder) / "out.obj", "--svg", OUT]
        subprocess.run(command, check=True)


if __name__ == "__main__":
    main()
