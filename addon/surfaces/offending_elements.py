# SPDX-License-Identifier: GPL-3.0-or-later
"""The elements of a mesh that an error is about."""

import numpy as np

from .errors import elements_of, kind_of
from .stored import LostAreaError
from .surface import Island, Surface

VERTICES, EDGES, FACES = "vertices", "edges", "faces"
# Kinds of errors whose elements are vertices worth showing.
SHOWN_BY_VERTICES = ("nonmanifold_vertex", "genus", "cut")


def offending_elements(surface: Surface, island: Island, error: Exception | None) -> tuple[str, np.ndarray]:
    """(VERTICES, EDGES or FACES, indices) to show for an island that could not be mapped.

    If the error names no visible element, as for a closed surface, shows the whole island.
    """
    kind, elements = kind_of(error), elements_of(error)
    not_finite = np.flatnonzero(~np.isfinite(island.vertices).all(axis=1))
    if len(not_finite):
        return VERTICES, np.unique(island.source_vertex[not_finite])
    if kind == "nonmanifold_edge":
        return EDGES, _crowded_edges(surface, island)
    if kind == LostAreaError.kind:
        return FACES, np.unique(island.triangle_face[np.asarray(elements, dtype=np.int64)])
    if kind in SHOWN_BY_VERTICES and len(elements):
        return VERTICES, island.source_vertex[np.asarray(elements)]
    return FACES, island.faces


def _crowded_edges(surface: Surface, island: Island) -> np.ndarray:
    """Edges with three or more faces of the island, except seams."""
    uses = np.bincount(surface.corner_edge[island.corners], minlength=len(surface.seam))
    return np.flatnonzero((uses > 2) & ~surface.seam)
