# SPDX-License-Identifier: GPL-3.0-or-later
"""The circle nearest to some points of the plane."""

import numpy as np


def fitted_circle(points: np.ndarray) -> tuple[np.ndarray, float, float]:
    """Centre (2,) and radius of the circle nearest to points (n, 2), and their largest distance from it [Kåsa 1976]."""
    middle = points.mean(axis=0)
    arms = points - middle
    system = np.column_stack([2.0 * arms, np.ones(len(arms))])
    *shift, rest = np.linalg.lstsq(system, (arms**2).sum(axis=1), rcond=None)[0]
    center = middle + shift
    radius = float(np.sqrt(max(rest + np.dot(shift, shift), 0.0)))
    return center, radius, float(np.abs(np.linalg.norm(points - center, axis=1) - radius).max())
