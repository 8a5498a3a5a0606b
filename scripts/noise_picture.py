# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/noise.png: the distance of two noisy shapes with its bars, a permutation test, and the test's power.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/noise_picture.py
"""

import dataclasses
import sys

import koebe
import matplotlib.pyplot as plt
import numpy as np
import saved_figure
from fit_picture import ROOT
from matplotlib.collections import PolyCollection

sys.path.append(str(ROOT / "bench"))

import noisy_shapes  # noqa: E402

LEVELS = (0.01, 0.03, 0.1, 0.2, 0.3)  # of noise, in edges
COPIES = 12  # of the two shapes, at each level
EFFECT = 0.05  # of the sample in the middle
INK, GRID = "#1b2a41", "#e3e6ea"
BLUE, RED, GREY = "#3b6ea5", "#c0504d", "#b9c3d0"


def noisy(positions, triangles, level, random):
    return positions + level * noisy_shapes.mean_edge(positions, triangles) * random.normal(size=positions.shape)


def family(shapes, triangles, first, bars=True):
    """The shapes with their loops as in the map `first`, and bars for their noise."""
    maps = [koebe.uniformize(shape, triangles, outer=int(first.loops[0][0])) for shape in shapes]
    orders = [noisy_shapes.by_vertex(one, first) for one in maps]
    found = koebe.family(maps, orders=orders)
    errors = [koebe.noise_error(one, order=order) for one, order in zip(maps, orders, strict=True)] if bars else None
    return dataclasses.replace(found, errors=None if errors is None else np.array(errors))


def draw_plate(axes, positions, triangles):
    """From above."""
    corners = positions[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    light = np.clip(0.3 + 0.7 * normal @ np.array([-0.55, 0.3, 0.78]), 0, 1)[:, None]
    color = light * np.array([0.66, 0.79, 0.94])
    axes.add_collection(PolyCollection(corners[:, :, :2], facecolors=color, edgecolors=color, linewidths=0.3))
    low, high = positions.min(axis=0), positions.max(axis=0)
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal")
    axes.set_axis_off()


def draw_bars(axes, plates):
    """Distances with bars at each level, and the shapes above them."""
    points, triangles = noisy_shapes.plate(26)
    random = np.random.default_rng(5)
    shapes = [noisy_shapes.bent(points, random) for _ in range(2)]
    first = koebe.uniformize(shapes[0], triangles)
    true = family(shapes, triangles, first, False).distances[0, 1]
    for place, level in enumerate(LEVELS):
        draw_plate(plates[place], noisy(shapes[0], triangles, level, random), triangles)
        for copy in range(COPIES):
            found = family([noisy(shape, triangles, level, random) for shape in shapes], triangles, first)
            distance, bar = found.distances[0, 1], found.distance_errors[0, 1]
            held = abs(distance - true) <= bar
            print(f"{level} {distance:.4f} +- {bar:.4f} {'' if held else 'misses'}", flush=True)
            at = place + 0.68 * (copy / (COPIES - 1) - 0.5)
            axes.errorbar(at, distance, bar, fmt="o", ms=2.6, lw=1, color=BLUE if held else RED)
    axes.axhline(true, color=INK, lw=1, ls=(0, (5, 3)), zorder=0)
    axes.annotate(f"without noise: {true:.4f}", (-0.45, true), (0, 20), textcoords="offset points", fontsize=8)
    axes.set(xlim=(-0.5, len(LEVELS) - 0.5), xticks=range(len(LEVELS)), xticklabels=LEVELS, ylim=(0, None))
    axes.set(xlabel="noise, of an edge", ylabel="distance of two shapes")


def draw_test(axes):
    """The statistics of permuted groups, and that of the true groups."""
    points, triangles = noisy_shapes.plate(20)
    groups, distances = noisy_shapes.two_groups(points, triangles, np.random.default_rng(3), EFFECT)
    given, random = koebe.permutation_test(distances["separations"], groups), np.random.default_rng(0)
    print(given, flush=True)
    drawn = [
        koebe.permutation_test(distances["separations"], random.permutation(groups), permutations=1).statistic
        for _ in range(5000)
    ]
    axes.hist(drawn, 40, color=GREY)
    axes.axvline(given.statistic, color=RED, lw=1.5)
    axes.annotate(f"true groups\np = {given.p:.3g}", (given.statistic, 0.95), (5, 0), va="top",
                  xycoords=("data", "axes fraction"), textcoords="offset points", fontsize=8, color=RED)  # fmt: skip
    axes.set_title(f"third hole {100 * EFFECT:g} % larger", fontsize=8)
    axes.set(xlabel="statistic F, of separations", ylabel="permutations of 5,000")


def draw_power(axes):
    """With Wilson's intervals of one standard error."""
    found = noisy_shapes.power()
    effects = 100 * np.array(list(found))
    for kind, color, place in (("separations", BLUE, (13, 92)), ("modules", RED, (23, 22))):
        rate, runs = np.array([(rates[kind], runs) for rates, runs in found.values()]).T
        middle = (rate + 0.5 / runs) / (1 + 1 / runs)
        half = np.sqrt(rate * (1 - rate) / runs + 0.25 / runs**2) / (1 + 1 / runs)
        axes.errorbar(effects, 100 * rate, 100 * np.abs([rate - middle + half, middle + half - rate]), fmt="o-",
                      ms=4, lw=1.4, color=color)  # fmt: skip
        axes.annotate(kind, place, color=color, fontsize=8)
    axes.axhline(5, color=INK, lw=1, ls=(0, (5, 3)), zorder=0)
    axes.annotate("5 %", (40, 5), (0, 3), textcoords="offset points", ha="right", fontsize=8)
    axes.set(xlabel="third hole larger by, %", ylabel="experiments with p ≤ 0.05, %", ylim=(0, 104))
    axes.set_title(f"{noisy_shapes.PER_GROUP} shapes in each group", fontsize=8)


def main():
    plt.rcParams.update({"font.size": 8, "text.color": INK, "axes.labelcolor": INK, "axes.edgecolor": "#8a8f98",
                         "xtick.color": INK, "ytick.color": INK, "axes.spines.top": False,
                         "axes.spines.right": False})  # fmt: skip
    figure = plt.figure(figsize=(9.6, 3.5), layout="constrained")
    left, right = figure.subfigures(1, 2, width_ratios=[1, 1])
    plates = left.add_gridspec(2, len(LEVELS), height_ratios=[1, 2.6])
    draw_bars(left.add_subplot(plates[1, :]), [left.add_subplot(plates[0, k]) for k in range(len(LEVELS))])
    test, power = right.subplots(1, 2)
    draw_test(test)
    draw_power(power)
    saved_figure.save(figure, "noise.png", 64)


if __name__ == "__main__":
    main()
