# SPDX-License-Identifier: GPL-3.0-or-later
"""UV layouts side by side, coloured by texel density: grey the median, blue up to 3 times as dense, red a third."""

import matplotlib
import numpy as np
import uv_measures

matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402


def draw(surface, files, path):
    """A picture of the maps of one surface (vertices, triangles) in {title: .npz}."""
    vertices, triangles = surface
    figure, axes = pyplot.subplots(1, len(files), figsize=(2.2 * len(files), 2.5), dpi=100, squeeze=False)
    for axis, (title, file) in zip(axes[0], files.items()):
        axis.set_title(title, fontsize=7)
        axis.set_axis_off()
        axis.set_aspect("equal")
        draw_one(axis, vertices[triangles], np.load(file)["uv"].astype(float))
    figure.tight_layout(pad=0.3)
    figure.savefig(path)
    pyplot.close(figure)


def draw_one(axis, points, uv):
    with np.errstate(divide="ignore", invalid="ignore"):
        logs = np.log(np.abs(uv_measures.signed_areas(uv)) / uv_measures.triangle_areas(points))
    area = uv_measures.triangle_areas(points)
    order = np.argsort(logs)
    median = logs[order][np.searchsorted(np.cumsum(area[order]), area.sum() / 2.0)]
    shade = np.clip(np.nan_to_num((logs - median) / np.log(9.0), nan=-1.0, neginf=-1.0, posinf=1.0), -1.0, 1.0)
    axis.add_collection(PolyCollection(uv, array=shade, cmap="coolwarm_r", clim=(-1.0, 1.0), edgecolors="face",
                                       linewidths=0.15))  # fmt: skip
    low, high = uv.reshape(-1, 2).min(axis=0), uv.reshape(-1, 2).max(axis=0)
    middle, half = (low + high) / 2.0, 0.52 * max((high - low).max(), 1e-9)  # a square, so that the titles are in line
    axis.set_xlim(middle[0] - half, middle[0] + half)
    axis.set_ylim(middle[1] - half, middle[1] + half)
