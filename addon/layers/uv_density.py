# SPDX-License-Identifier: GPL-3.0-or-later
"""The texel density of a UV layer: measured, set island by island, and in the words of the scene's units.

A density is in sides of the UV square per unit of length. Times the side of a texture it is in pixels per unit.
"""

import dataclasses
from collections.abc import Sequence

import numpy as np

from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import areas, signed_areas

FOOT = 0.3048  # metres


def mean_density(surface: Surface, uv: np.ndarray) -> float:
    """The mean over the areas of the selected faces; 0 without any.

    uv  (C, 2) of the surface's corners
    """
    chosen = surface.triangle_corners[surface.selected[surface.triangle_face]]
    in_plane = signed_areas(uv.astype(np.float64), chosen)
    return _density(areas(surface.positions, surface.corner_vertex[chosen]), in_plane)


def island_density(island: Island, uv: np.ndarray) -> float:
    """As `mean_density`, of an island of UVs (C, 2); 0 for one without area."""
    return _density(island.areas, signed_areas(uv[island.some_corner()].astype(np.float64), island.triangles))


def _density(in_space: np.ndarray, in_plane: np.ndarray) -> float:
    known = np.isfinite(in_plane) & np.isfinite(in_space)
    total = float(in_space[known].sum())
    return float(np.sqrt(np.abs(in_plane[known]).sum() / total)) if total > 0.0 else 0.0


@dataclasses.dataclass(frozen=True)
class Scaled:
    """UVs (C, 2) of a layer after islands were scaled. @param changed those islands, flat islands without a density"""

    uv: np.ndarray
    changed: list[Island]
    flat: int


def with_density(islands: Sequence[Island], uv: np.ndarray, density: float) -> Scaled:
    """Scale each island about the middle of its box, so that its mean density is the one given."""
    result, changed, flat = uv.astype(np.float64), [], 0
    for island in islands:
        now = island_density(island, uv)
        if not (0.0 < now < np.inf and np.isfinite(uv[island.corners]).all()):
            flat += 1
            continue
        points = result[island.corners]
        middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
        result[island.corners] = middle + (density / now) * (points - middle)
        changed.append(island)
    return Scaled(result, changed, flat)


def in_words(density: float, pixels: int, system: str, metres: float) -> str:
    """A density for a texture of this size: px/m, px/ft, or px/unit in a scene without units.

    @param system, metres the scene's system of units, and the length of its unit
    """
    per_unit = density * pixels
    if system == "NONE":
        return f"{per_unit:.4g} px/unit"
    per_length = per_unit / metres * (FOOT if system == "IMPERIAL" else 1.0)
    text = f"{per_length:.4g} px/{'ft' if system == 'IMPERIAL' else 'm'}"
    return text if np.isclose(per_length, per_unit) else f"{text}, {per_unit:.4g} per unit"
