# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/teichmueller.png: a cylinder with holes, its stretched copy, and the dilatation of the map between them.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/teichmueller_picture.py
"""

import sys
from pathlib import Path

import koebe
import matplotlib.pyplot as plt
import numpy as np
import saved_figure
from matplotlib.collections import PolyCollection

ROOT = Path(__file__).resolve().parents[1]
sys.path.append(str(ROOT / "bench"))

from stretched_cylinders import pair  # noqa: E402

STRETCH = 2.0
VIEW = np.radians(20)  # from above
TURN = np.radians(-235)


def draw_cylinder(axes, mesh):
    """From the side, turned so that both holes are seen."""
    points, faces = mesh
    c, s = np.cos(TURN), np.sin(TURN)
    points = points @ np.array([[c, s, 0], [-s, c, 0], [0, 0, 1]])
    corners = points[faces]
    depth = corners[:, :, 1].mean(axis=1)
    flat = np.stack([corners[:, :, 0], corners[:, :, 2] * np.cos(VIEW) + corners[:, :, 1] * np.sin(VIEW)], axis=2)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    shade = 0.45 + 0.5 * np.abs(normal @ np.array([-0.5, -0.8, 0.3]))
    color = np.clip(shade[:, None] * np.array([0.62, 0.76, 0.92]), 0, 1)
    order = np.argsort(-depth)
    axes.add_collection(PolyCollection(flat[order], facecolors=color[order], edgecolors="0.25", linewidths=0.15))
    axes.set(xlim=(-1.6, 1.6), ylim=(-0.6, 6.4), aspect="equal")


def main():
    a, b, match = pair(3, STRETCH, 3)
    found = koebe.teichmueller(a, b, match=match)
    print(found)
    figure, axes = plt.subplots(1, 4, figsize=(9.6, 3.4), layout="constrained", width_ratios=[0.5, 1, 1, 0.5])
    draw_cylinder(axes[0], a.surface)
    draw_cylinder(axes[3], b.surface)
    dilatation = (1 + found.mu) / (1 - found.mu)
    for axis, uv in zip(axes[1:3], (a.uv, found.uv), strict=True):
        drawn = PolyCollection(
            uv[a.surface[1]], array=dilatation, cmap="viridis", clim=(1.5, 2.5), edgecolors="1", linewidths=0.1
        )
        axis.add_collection(drawn)
        axis.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), aspect="equal")
    figure.colorbar(drawn, ax=axes[2], shrink=0.7, label="dilatation")
    for axis, title in zip(axes, ("a", "a's domain", "mapped to b's", "b"), strict=True):
        axis.set_title(title, fontsize=9, pad=8)
        axis.set_axis_off()
    saved_figure.save(figure, "teichmueller.png", 96)


if __name__ == "__main__":
    main()
