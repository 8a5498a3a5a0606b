# SPDX-License-Identifier: GPL-3.0-or-later
"""The outlines of a UV layout, at the ends of its islands."""

import numpy as np

from ..surfaces.surface import edge_ends


def outline(
    corner_vertex: np.ndarray, corner_edge: np.ndarray, following: np.ndarray, uv: np.ndarray
) -> np.ndarray:
    """Corners (k, 2) at the ends of the edges that have no face at the same UVs on their other side.

    corner_vertex, corner_edge  (C,) vertex of each corner, and edge from it to the next one
    following                   (C,) the next corner of its face
    uv                          (C, 2)
    """
    if not len(uv):
        return np.zeros((0, 2), dtype=np.int64)
    edge, ends = edge_ends(corner_vertex, corner_edge, following, np.arange(len(corner_edge)))
    places = uv[ends].reshape(-1, 4)
    same = (edge[1:] == edge[:-1]) & (places[1:] == places[:-1]).all(axis=1)
    inner = np.zeros(len(edge), dtype=bool)
    inner[1:] |= same
    inner[:-1] |= same
    return ends[~inner]
