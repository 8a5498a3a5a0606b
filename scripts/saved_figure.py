# SPDX-License-Identifier: GPL-3.0-or-later
"""Figures of matplotlib as small PNG files in docs/images/."""

from pathlib import Path

import matplotlib
from PIL import Image

matplotlib.use("agg")

IMAGES = Path(__file__).resolve().parents[1] / "docs" / "images"


def save(figure, name, colors=48, dpi=100):
    """Writes the figure with a palette of so many colours."""
    path = IMAGES / name
    figure.savefig(path, dpi=dpi)
    Image.open(path).convert("RGB").quantize(colors).save(path, optimize=True)
