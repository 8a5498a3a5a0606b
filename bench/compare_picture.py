# SPDX-License-Identifier: GPL-3.0-or-later
"""UV layouts in rows of three, so that a phone shows them, coloured by texel density: grey the median, blue up to 3
times as dense, red a third. A map in one piece stands as the model does."""

import matplotlib
import numpy as np
import uv_measures

matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

COLUMNS = 3
IN_ONE_PIECE = ("Unwrap", "ours, one map")  # how their titles begin


def draw(surface, files, path):
    """A picture of the maps of one surface (vertices, triangles) in {title: .npz}."""
    points = surface[0][surface[1]]
    rows = -(-len(files) // COLUMNS)
    size = (2.4 * COLUMNS, 2.6 * rows)
    figure, axes = pyplot.subplots(rows, COLUMNS, figsize=size, dpi=100, squeeze=False, layout="constrained")
    for axis in axes.ravel():
        axis.set_axis_off()
        axis.set_aspect("equal")
    for axis, (title, file) in zip(axes.ravel(), files.items()):
        axis.set_title(title.removeprefix("Unwrap, "), fontsize=11)
        uv = np.load(file)["uv"].astype(float)
        draw_one(axis, points, upright(points, uv) if title.startswith(IN_ONE_PIECE) else uv)
    figure.savefig(path, pil_kwargs={"quality": 85})
    pyplot.close(figure)


def upright(points, uv):
    """The UVs turned, so that z grows upwards in the mean over the surface."""
    sides, rise = uv[:, 1:] - uv[:, :1], points[:, 1:, 2] - points[:, :1, 2]
    whole = np.abs(np.linalg.det(sides)) > 1e-14
    slope = np.linalg.solve(sides[whole], rise[whole][..., None])[..., 0]
    length = np.linalg.norm(slope, axis=1)
    weight = uv_measures.triangle_areas(points)[whole] / np.maximum(length, 1e-300)
    x, y = (slope * weight[:, None]).sum(axis=0)
    return uv @ (np.array([[y, x], [-x, y]]) / max(np.hypot(x, y), 1e-300))


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
