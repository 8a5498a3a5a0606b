# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/cortex.jpg and cortex_lesions.jpg: sulcal depth and local area on the flat maps of bench/cortex.py."""

from pathlib import Path

import matplotlib
import numpy as np
import uv_measures

matplotlib.use("agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib.collections import LineCollection  # noqa: E402
from matplotlib.patheffects import withStroke  # noqa: E402

IMAGES = Path(__file__).resolve().parent.parent / "docs" / "images"
SHOWN = 1  # t of the maps that are drawn
POLES = {"frontal pole": (-11, 66, 9), "occipital pole": (-11, -103, 1), "temporal pole": (-37, 15, -35)}  # mm
RANGE = 1.0  # of log2 of the local area
INK, RED = "#222222", "#c1272d"


def upright(flat, surface):
    """In millimetres, of the surface's area, turned as FreeSurfer's map is."""
    area = uv_measures.triangle_areas(surface.vertices[surface.triangles]).sum()
    places = (flat - flat.mean(axis=0)) * np.sqrt(area / uv_measures.signed_areas(flat[surface.triangles]).sum())
    model = surface.flat - surface.flat.mean(axis=0)
    turn = np.vdot(places @ [1, 1j], model @ [1, 1j])
    turned = (places @ [1, 1j]) * turn / abs(turn)
    turned -= (turned[surface.triangles].mean(axis=1) * area_share(surface)).sum()
    return np.stack([turned.real, turned.imag], axis=1)


def area_share(surface):
    area = uv_measures.triangle_areas(surface.vertices[surface.triangles])
    return area / area.sum()


def border(triangles):
    """Border edges (E, 2)."""
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, first, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    return edges[first[count == 1]]


def local_area(surface, flat):
    """log2 of the map's area over the surface's around each vertex (V,)."""
    sums = [np.bincount(surface.triangles.ravel(), np.repeat(area, 3), minlength=len(flat)) for area in (
        uv_measures.signed_areas(flat[surface.triangles]),
        uv_measures.triangle_areas(surface.vertices[surface.triangles]),
    )]  # fmt: skip
    return np.log2(sums[0] / sums[1])


def paint(axis, surface, flat, values, half, **looks):
    image = axis.tripcolor(*flat.T, surface.triangles, values, shading="gouraud", rasterized=True, **looks)
    axis.add_collection(LineCollection(flat[border(surface.triangles)], colors=INK, linewidths=0.6))
    axis.set(xlim=(-half[0], half[0]), ylim=(-half[1], half[1]), aspect="equal")
    axis.set_axis_off()
    return image


def depth(axis, surface, flat, half, title):
    low, high = np.percentile(surface.depth, [2, 98])
    paint(axis, surface, flat, surface.depth, half, cmap="gray_r", vmin=low, vmax=high + 0.3 * (high - low))
    axis.set_title(title, fontsize=9, color=INK)


def name_poles(axis, surface, flat, words):
    """A dot at each pole, and its name if there shall be `words`."""
    for name, pole in POLES.items():
        place = flat[np.argmin(np.linalg.norm(surface.vertices - pole, axis=1))]
        axis.plot(*place, "o", color=RED, markersize=4, markeredgecolor="white", markeredgewidth=0.7)
        if words:
            side, shift = ("right", -5) if place[0] > 0.5 * flat[:, 0].max() else ("left", 5)
            axis.annotate(name, place, (shift, 3), textcoords="offset points", fontsize=8, color=RED, ha=side,
                          path_effects=[withStroke(linewidth=2, foreground="white")])  # fmt: skip


def scale_bar(axis, half):
    x, y = -half[0] * 0.97, -half[1] * 0.97
    axis.plot([x, x + 50], [y, y], color=INK, linewidth=2, solid_capstyle="butt")
    axis.annotate("50 mm", (x, y), (0, 4), textcoords="offset points", fontsize=7, color=INK)


def draw(surface, damaged, maps, holed):
    kept = {
        "conformal (E = 0)": maps["free", 0][0],
        "even (E = 0.55), free": maps["free", SHOWN][0],
        "FreeSurfer's": surface.flat,
    }
    flats = {title: upright(flat, surface) for title, flat in kept.items()}
    half = 1.04 * np.abs(np.concatenate(list(flats.values()))).max(axis=0)
    figure, axes = pyplot.subplots(2, 3, figsize=(10, 0.4 + 5.6 * half[1] / half[0]), dpi=110, layout="constrained")
    for column, (title, flat) in enumerate(flats.items()):
        depth(axes[0, column], surface, flat, half, title)
        name_poles(axes[0, column], surface, flat, column == 0)
        image = paint(axes[1, column], surface, flat, local_area(surface, flat), half,
                      cmap="RdBu_r", vmin=-RANGE, vmax=RANGE)  # fmt: skip
    scale_bar(axes[0, 0], half)
    bar = figure.colorbar(image, ax=axes[1, :], shrink=0.7, aspect=25, ticks=[-1, 0, 1])
    bar.ax.set_yticklabels(["half", "true", "twice"], fontsize=7)
    bar.set_label("area on the map", fontsize=8)
    figure.savefig(IMAGES / "cortex.jpg", pil_kwargs={"quality": 85})

    flats = {f"E = 0.55, {loops} loops": upright(holed[loops, SHOWN][0], damaged) for loops in ("free", "round")}
    half = 1.04 * np.abs(np.concatenate(list(flats.values()))).max(axis=0)
    figure, axes = pyplot.subplots(1, 2, figsize=(8, 0.4 + 4 * half[1] / half[0]), dpi=110, layout="constrained")
    for axis, (title, flat) in zip(axes, flats.items()):
        depth(axis, damaged, flat, half, title)
        name_poles(axis, damaged, flat, False)
    scale_bar(axes[0], half)
    figure.savefig(IMAGES / "cortex_lesions.jpg", pil_kwargs={"quality": 85})
