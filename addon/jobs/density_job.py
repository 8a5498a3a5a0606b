# SPDX-License-Identifier: GPL-3.0-or-later
"""The texel density of a UV layer of an object: read, and set island by island."""

import dataclasses

from ..blender.transaction import Transaction
from ..layers.uv_density import mean_density, with_density
from ..maps.wording import counted
from .island_layer import IslandLayer


class DensityLayer(IslandLayer):
    """A UV layer that was read, and its texel density."""

    def density(self, chosen: bool = False) -> float:
        """The mean density of all faces, or of the selected ones: sides of the UV square per unit."""
        surface = dataclasses.replace(self.surface, selected=self.chosen) if chosen else self.surface
        return mean_density(surface, self.uv)

    def set_density(self, run: Transaction, density: float) -> str:
        """Scale each island with a selected face and no pinned UV to this density. Returns what was done.

        Raises TransferError if there is none, or if the layer cannot be written.
        """
        free, left = self.free_islands()
        made = with_density(free, self.uv, density)
        left += [f"{counted(made.flat, 'island')} without area"] * bool(made.flat)
        return self.write(run, made.changed, made.uv, "scaled", left)
