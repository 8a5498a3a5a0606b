# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/template_image.png: activation times of an atrium, their image over the template, and on another atrium.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/template_image_picture.py
"""

import sys
from pathlib import Path

import koebe
import matplotlib.pyplot as plt
import numpy as np
import saved_figure
from fit_picture import draw_surface
from matplotlib.colors import ListedColormap

sys.path.append(str(Path(__file__).resolve().parents[1] / "bench"))

from round_trips import MILLIMETRES, TEMPLATE, fitted  # noqa: E402

BAND, BANDS = 5, 14  # ms between isochrones, and their number
COLORS = ListedColormap(plt.get_cmap("viridis")(np.linspace(0, 1, BANDS))[:, :3])


def paint(times):
    return COLORS(np.clip(times[:, 0] / BAND, 0, BANDS - 1).astype(int))[:, :3]


def main():
    (fit, times), (other, _) = fitted("2.4"), fitted("4.7")
    image, error = koebe.to_image(fit, times, 512)
    print(f"error {error:.2g} ms, last {times.max():.0f} ms")
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6), layout="constrained")
    for axis, one, field in ((axes[0], fit, times), (axes[2], other, koebe.from_image(image, other))):
        vertices, faces = one.surface
        draw_surface(axis, vertices / MILLIMETRES, faces, field[:, None], paint)
    drawn = axes[1].imshow(
        image, cmap=COLORS, vmin=0, vmax=BAND * BANDS, extent=(-1, 1, -1, 1), interpolation="nearest"
    )
    for name, ((x, y), _) in TEMPLATE.items():
        axes[1].text(x, y, name, ha="center", va="center", fontsize=7)
    figure.colorbar(drawn, ax=axes[1], shrink=0.7, label="ms")
    titles = "edges of 2.4 mm", "the image, 512 pixels", "edges of 4.7 mm"
    for axis, title in zip(axes, titles, strict=True):
        axis.set_title(title, fontsize=9, pad=8)
        axis.set_axis_off()
    saved_figure.save(figure, "template_image.png", 64)


if __name__ == "__main__":
    main()
