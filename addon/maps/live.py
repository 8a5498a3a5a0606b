# SPDX-License-Identifier: GPL-3.0-or-later
"""Which islands a change of seams or pins concerns."""

import dataclasses

import numpy as np

from .islands import cut_into_islands
from .surface import Surface


@dataclasses.dataclass(frozen=True)
class LiveState:
    """A mesh while it is edited.

    surface  the whole mesh
    uv       (C, 2) of the layer
    pins     (C, 2) its pinned UVs, NaN at other corners
    """

    surface: Surface
    uv: np.ndarray
    pins: np.ndarray

    def is_same_mesh(self, other: "LiveState") -> bool:
        """Whether both have the same faces."""
        return np.array_equal(self.surface.corner_vertex, other.surface.corner_vertex) and np.array_equal(
            self.surface.face_start, other.surface.face_start
        )

    def concerned(self, before: "LiveState") -> np.ndarray:
        """The faces (P,) bool of all islands at which a seam or a pin has changed. @param before of the same mesh"""
        surface = self.surface
        changed = (surface.seam != before.surface.seam)[surface.corner_edge]
        changed |= ~((self.pins == before.pins) | (np.isnan(self.pins) & np.isnan(before.pins))).all(axis=1)
        found = np.zeros(len(surface.face_size), dtype=bool)
        if not changed.any():
            return found
        touched = np.add.reduceat(changed, surface.face_start) > 0
        for island in cut_into_islands(surface):
            found[island.faces] = touched[island.faces].any()
        return found
