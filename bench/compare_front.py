# SPDX-License-Identifier: GPL-3.0-or-later
"""The front: length of cuts against distortion, over xatlas's of the same model, on each model and in the median."""

import statistics

import matplotlib

matplotlib.use("agg")
import matplotlib.patheffects as effects  # noqa: E402
from compare_tables import BESIDE_XATLAS, CUTS, done, ratio  # noqa: E402
from matplotlib import pyplot  # noqa: E402

WIDTH, HEIGHT = 8.0, 4.4  # inches of 100 pixels at the size it is read at; drawn twice as fine
BLUE, ORANGE, RED, GREEN, GREY = "#1f5fa8", "#d97706", "#c02f2f", "#2b8a3e", "#6b7280"
FRONT = ("--darts 0", "--darts 0.05", "ours, in parts", "--darts 0.5")  # joined by a line
# Name in the picture, its colour, and where it stands beside its point in the two panels.
NAMED = {
    "xatlas": ("xatlas", ORANGE, (8, -8), (8, -9)),
    "Smart UV": ("Smart UV", RED, (8, 9), (8, 8)),
    "OptCuts": ("OptCuts", GREEN, (8, 13), (8, 6)),
    "Unwrap, Angle Based": ("Angle Based", GREY, (8, -7), (8, -6)),
    "Unwrap, Conformal": ("Conformal", GREY, (8, 5), (8, -1)),
    "Unwrap, Minimum Stretch": ("Minimum Stretch", GREY, (8, 3), (8, 10)),
    "--darts 0": ("no darts", BLUE, (8, 5), (8, 6)),
    "ours, in parts": ("ours", BLUE, (-8, -4), (-8, -6)),
    "--darts 0.5": ("more darts", BLUE, (2, -17), (8, -5)),
    "--loops round": ("round loops", BLUE, (8, 5), (8, 4)),
}
CLOUDS = {"ours, in parts": BLUE, "Smart UV": RED, "OptCuts": GREEN}  # drawn model by model
PANELS = (("spread", "texel density, 95 % over 5 %", (0.7, 5.0), (0.7, 1, 1.5, 2, 3, 5)),
          ("angle", "mean angle error", (0.3, 100.0), (0.3, 1, 3, 10, 30, 100)))  # fmt: skip
RIGHT = 2.6  # of cuts; maps with longer ones stand at the border, as do all that leave the picture


def draw(rows_of, path):
    """@param rows_of model -> unwrap -> figures"""
    # A cut over a cut: models that xatlas does not cut have none.
    rows_of = {model: rows for model, rows in rows_of.items() if done(rows, "xatlas") and rows["xatlas"]["seams"] > 0.0}
    figure, axes = pyplot.subplots(1, 2, figsize=(WIDTH, HEIGHT))
    for panel, (axis, (key, title, (low, high), ticks)) in enumerate(zip(axes, PANELS)):

        def points(unwrap, key=key):
            pairs = [(rows[unwrap], rows["xatlas"]) for rows in rows_of.values() if done(rows, unwrap)]
            return [(ratio(*pair, "seams"), ratio(*pair, key)) for pair in pairs]

        axis.axhline(1.0, color=ORANGE, lw=0.8, alpha=0.6)
        axis.axvline(1.0, color=ORANGE, lw=0.8, alpha=0.6)
        most = next(most for _, figure_key, most in BESIDE_XATLAS if figure_key == key)
        axis.fill_between([-0.1, CUTS[2]], low, most, color="#d6eadb", lw=0, zorder=0)
        axis.text(0.03, low * 1.04, "goal", color="#2b6a3e", fontsize=10, va="bottom")
        for unwrap, colour in CLOUDS.items():
            seen = [(min(x, RIGHT), min(max(y, low), high)) for x, y in points(unwrap)]
            axis.plot(*zip(*seen), "o", color=colour, ms=3.2, mew=0, alpha=0.35, clip_on=False) if seen else None
        middle = {unwrap: tuple(map(statistics.median, zip(*points(unwrap))))
                  for unwrap in (*NAMED, *FRONT) if points(unwrap)}  # fmt: skip
        axis.plot(*zip(*(middle[unwrap] for unwrap in FRONT)), "-o", color=BLUE, ms=5.5, lw=2.0, zorder=5)
        for unwrap, (name, colour, *shifts) in NAMED.items():
            if unwrap in middle:
                ours = colour == BLUE
                axis.plot(*middle[unwrap], "o" if ours else "D", color=colour, ms=7 if ours else 7.5, mec="white",
                          mew=0.8, zorder=6, clip_on=False)  # fmt: skip
                axis.annotate(name, middle[unwrap], xytext=shifts[panel], textcoords="offset points", va="center",
                              ha="left" if shifts[panel][0] > 0 else "right",
                              color=colour, fontsize=9.5, weight="bold" if name == "ours" else "normal", zorder=8,
                              path_effects=[effects.withStroke(linewidth=2.5, foreground="white")])  # fmt: skip
        axis.set(xlim=(-0.1, RIGHT), ylim=(low, high), yscale="log", xlabel="length of cuts, xatlas = 1")
        axis.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
        axis.minorticks_off()
        axis.set_title(f"{title}, xatlas = 1", fontsize=11, loc="left")
        axis.spines[["top", "right"]].set_visible(False)
    figure.tight_layout(pad=0.6, w_pad=2.0)
    figure.savefig(path, dpi=200)
    pyplot.close(figure)
