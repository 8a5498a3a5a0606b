# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/fit.png: an atrium made here, its conformal circle domain, and its map to a template.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/fit_picture.py
"""

import sys
from pathlib import Path

import koebe
import matplotlib.pyplot as plt
import numpy as np
import saved_figure
from koebe._plot import _in_pieces
from matplotlib.collections import PolyCollection

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "bench"))

from atrium_templates import TEMPLATE, atrium  # noqa: E402

SQUARE = 0.12  # of the checker, in the disk
INK = np.array([[0.93, 0.95, 0.98], [0.25, 0.45, 0.65]])


def squares(uv):
    dark = np.floor((uv + 3) / SQUARE).astype(int).sum(axis=1) % 2
    return INK[dark]


def draw_surface(axes, vertices, faces, values, paint=squares):
    """The surface from behind, in the colours that `paint` gives to values (n, k) between those of the vertices."""
    pieces = _in_pieces(np.concatenate([vertices, values], axis=1)[faces], 4)
    corners = pieces[:, :, :3]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    order = np.argsort(corners[:, :, 1].mean(axis=1))  # seen from +y, the back of the atrium
    shade = (0.55 + 0.45 * np.abs(normal @ np.array([-0.3, 0.8, 0.52])))[:, None]
    color = np.clip(paint(pieces[:, :, 3:].mean(axis=1)) * shade, 0, 1)[order]
    flat = corners[order][:, :, [0, 2]] * np.array([-1, 1])
    axes.add_collection(PolyCollection(flat, facecolors=color, edgecolors=color, linewidths=0.2))
    axes.set(xlim=(-2.4, 2.4), ylim=(-2.0, 2.2), aspect="equal")


def draw_domain(axes, faces, uv, names, centers):
    pieces = _in_pieces(uv[faces], 4)
    color = squares(pieces.mean(axis=1))
    axes.add_collection(PolyCollection(pieces, facecolors=color, edgecolors=color, linewidths=0.2))
    for name, (x, y) in zip(names, centers, strict=True):
        axes.text(x, y, name, ha="center", va="center", fontsize=7)
    axes.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), aspect="equal")


def main():
    vertices, faces, rims = atrium()
    loops = koebe.boundary_loops(faces)
    names = list(TEMPLATE)
    ranks = [next(k for k, loop in enumerate(loops) if rims[i][0] in loop) for i in range(len(names))]
    centers, radii = zip(*TEMPLATE.values(), strict=True)
    fit = koebe.fit_circles((vertices, faces), centers, radii, ranks, names=names)
    conformal = koebe.uniformize(vertices, faces, outer=int(fit.loops[0][0]))
    own = [next(k for k, loop in enumerate(conformal.loops) if rims[i][0] in loop) for i in range(len(names))]
    print(fit, fit.fit, [f"{conformal.radii[k]:.3g}" for k in own])
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6), layout="constrained")
    draw_surface(axes[0], vertices, faces, fit.uv)
    draw_domain(axes[1], faces, conformal.uv, names, conformal.centers[own])
    draw_domain(axes[2], faces, fit.uv, names, fit.centers[1:])
    for axis, title in zip(axes, ("the surface", "its conformal circles", "the template"), strict=True):
        axis.set_title(title, fontsize=9, pad=8)
        axis.set_axis_off()
    saved_figure.save(figure, "fit.png")


if __name__ == "__main__":
    main()
