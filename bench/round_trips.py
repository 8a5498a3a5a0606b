# SPDX-License-Identifier: GPL-3.0-or-later
"""Activation times of an atrium on images of its template and back, and through the mesh of another atrium."""

from functools import cache

import numpy as np
from atrium_templates import TEMPLATE, koebe, surface

MILLIMETRES = 30.0  # radius of the atrium
LEVELS = {"4.7": 3, "2.4": 4, "1.2": 5}  # mean edge in mm, and how often the ball's faces were cut in four
PIXELS = (128, 256, 512, 1024)
HEAD = ["edges, pixels", "sampled: mean", "sampled: largest", "exact: mean", "exact: largest"]
ROWS = [f"{edges} mm, {pixels}" for edges in ("4.7", "2.4") for pixels in PIXELS]


@cache
def fitted(edges):
    """The atrium mapped to the picture's template, and times of a wave of 1 mm/ms from a point of the wall, in ms."""
    (vertices, faces), ranks, _, _ = surface(LEVELS[edges])
    fit = koebe.fit_circles((MILLIMETRES * vertices, faces), *zip(*TEMPLATE.values(), strict=True), ranks)
    return fit, np.linalg.norm(fit.surface[0] - MILLIMETRES * np.array([0.0, 0.9, 0.0]), axis=1)


def cells(row):
    """A row of the table in docs/fit.md: errors in mm."""
    edges, pixels = row.split(" mm, ")
    fit, times = fitted(edges)
    found = []
    for exact in (False, True):
        image, _ = koebe.to_image(fit, times, int(pixels), exact=exact)
        gaps = np.abs(koebe.from_image(image, fit) - times)
        found += [f"{gaps.mean():.3f}", f"{gaps.max():.2f}"]
    return found


def through_a_mesh(edges, others):
    """Mean and largest error in mm of times that are carried to the vertices of another atrium and back."""
    (a, times), (b, _) = fitted(edges), fitted(others)
    gaps = np.abs(koebe.transfer(b, a).carry(koebe.transfer(a, b).carry(times)) - times)
    return f"{gaps.mean():.2f} {gaps.max():.2f}"


if __name__ == "__main__":
    for one in ROWS:
        print(one, "|", " | ".join(cells(one)), flush=True)
    for one, other in (("4.7", "2.4"), ("2.4", "4.7"), ("2.4", "1.2"), ("4.7", "1.2")):
        print(one, "through", other, through_a_mesh(one, other), flush=True)
