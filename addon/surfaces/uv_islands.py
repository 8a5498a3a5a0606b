# SPDX-License-Identifier: GPL-3.0-or-later
"""The islands of a UV layer: the regions where the UVs are continuous, with or without seams."""

import dataclasses

import numpy as np

from .islands import cut_into_islands
from .surface import Island, Surface, across, first_and_last, next_corners

# UV units: largest difference of one vertex's UVs in two faces that are not cut apart there.
SAME = 1e-5


def uv_islands(surface: Surface, uv: np.ndarray) -> list[Island]:
    """Islands of the selected faces, cut where the UVs (C, 2) of the corners at an edge differ on its two sides."""
    return cut_into_islands(dataclasses.replace(surface, seam=uv_cuts(surface, uv)))


def uv_cuts(surface: Surface, uv: np.ndarray) -> np.ndarray:
    """Which edges (E,) have different UVs (C, 2) on their two sides. Edges with more than two faces count as cut."""
    edge, following, count = surface.corner_edge, next_corners(surface), len(surface.seam)
    first, last = first_and_last(edge, np.arange(len(edge), dtype=np.int32), count)
    shared = np.flatnonzero(first != last)
    here, there = first[shared], last[shared]
    start, end = across(surface.corner_vertex, following, here, there)
    differ = _differ(uv, here, start) | _differ(uv, following[here], end)
    cuts = np.zeros(count, dtype=bool)
    cuts[shared[differ]] = True
    if np.count_nonzero(last >= 0) + len(shared) < len(edge):
        cuts |= np.bincount(edge, minlength=count) > 2
    return cuts


def _differ(uv: np.ndarray, one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Which pairs of corners have different UVs. NaN differs from all."""
    away = np.abs(uv[one] - uv[other])
    return ~(np.maximum(away[:, 0], away[:, 1]) <= SAME)


def vertex_uv(island: Island, uv: np.ndarray) -> np.ndarray:
    """UVs (n, 2), as stored, of an island's vertices, from UVs (C, 2) of the surface's corners."""
    return uv[island.some_corner()]
