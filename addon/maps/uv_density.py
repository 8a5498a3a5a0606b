# SPDX-License-Identifier: GPL-3.0-or-later
"""The texel density of a UV layer."""

import numpy as np

from .surface import Surface
from .triangles import areas, signed_areas


def mean_density(surface: Surface, uv: np.ndarray) -> float:
    """Sides of the UV square per unit of length, in the mean over the areas of the selected faces; 0 without any.

    uv  (C, 2) of the surface's corners
    """
    chosen = surface.triangle_corners[surface.selected[surface.triangle_face]]
    in_plane = np.abs(signed_areas(uv.astype(np.float64), chosen))
    in_space = areas(surface.positions, surface.corner_vertex[chosen])
    known = np.isfinite(in_plane) & np.isfinite(in_space)
    total = float(in_space[known].sum())
    return float(np.sqrt(in_plane[known].sum() / total)) if total > 0.0 else 0.0
