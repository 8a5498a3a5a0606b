# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/labs_landmarks.png: one face carried onto another, with the holes fitted and with landmarks.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/landmark_picture.py
"""

from pathlib import Path

import koebe
import matplotlib.pyplot as plt
import meshio
import numpy as np
import saved_figure
from koebe._plot import _in_pieces
from matplotlib.collections import PolyCollection

ROOT = Path(__file__).resolve().parents[1]
PLACES = [(0.0, -0.386), (0.0, 0.33), (0.0, -1.0), (-0.35, -0.45), (0.35, -0.45), (0.3, 0.45), (-0.3, 0.45)]  # x and z
SQUARE = 0.1  # of the checker, in the faces' unit


def draw(axes, result, carried, title):
    """The face from the front, in squares of the places (V, 2) that it has got."""
    vertices, triangles = result.surface
    front = vertices[:, [0, 2]]
    pieces = _in_pieces(np.concatenate([vertices, carried], axis=1)[triangles], 5)
    pieces = pieces[np.argsort(-pieces[:, :, 1].mean(axis=1))]  # from behind to the front
    dark = np.floor(pieces[:, :, 3:].mean(axis=1) / SQUARE).astype(int).sum(axis=1) % 2
    color = np.array([[0.93, 0.95, 0.98], [0.25, 0.45, 0.65]])[dark]
    axes.add_collection(PolyCollection(pieces[:, :, [0, 2]], facecolors=color, edgecolors=color, linewidths=0.2))
    axes.set(xlim=(front[:, 0].min(), front[:, 0].max()), ylim=(front[:, 1].min(), front[:, 1].max()), aspect="equal")
    axes.set_title(title, fontsize=9)
    axes.set_axis_off()


def main():
    neutral, surprised = (koebe.uniformize(meshio.read(ROOT / f"blend_samples/{n}.obj")) for n in ("face", "surprised"))
    vertices = neutral.surface[0]
    marks = [int(np.argmin(np.hypot(*(vertices[:, [0, 2]] - place).T))) for place in PLACES]
    figure, axes = plt.subplots(1, 3, figsize=(8.4, 4.6), layout="constrained")
    draw(axes[0], neutral, vertices[:, [0, 2]], "neutral")
    axes[0].plot(*vertices[marks][:, [0, 2]].T, "o", color="#d1495b", markersize=4)
    there = surprised.surface[0][marks][:, [0, 2]]
    for axis, landmarks, title in ((axes[1], [], "holes fitted"), (axes[2], marks, f"{len(marks)} landmarks")):
        places = koebe.transfer(neutral, surprised, landmarks=[(v, v) for v in landmarks])
        draw(axis, surprised, places.points[:, [0, 2]], f"{title}: |µ| {places.beltrami['mean']:.3f}")
        back = koebe.transfer(surprised, neutral, landmarks=[(v, v) for v in landmarks]).points[marks][:, [0, 2]]
        axis.plot(*there.T, "o", markerfacecolor="none", color="#222222", markersize=7)
        axis.plot(*back.T, "o", color="#d1495b", markersize=3)
    saved_figure.save(figure, "labs_landmarks.png", 256, 90)


if __name__ == "__main__":
    main()
