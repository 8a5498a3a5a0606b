# SPDX-License-Identifier: GPL-3.0-or-later
"""The texel density of a UV layer of an object: read, and set island by island."""

import dataclasses

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh, check_readable
from ..blender.transaction import Transaction
from ..maps.surface import Island, Surface
from ..maps.uv_density import mean_density, with_density
from ..maps.uv_islands import uv_islands
from ..maps.wording import counted


@dataclasses.dataclass(frozen=True)
class DensityLayer:
    """A UV layer that was read.

    surface  the whole mesh
    chosen   (P,) the selected faces; all of them outside of Edit Mode
    uv       (C, 2)
    """

    obj: MeshObject
    name: str
    surface: Surface
    chosen: np.ndarray
    uv: np.ndarray

    @classmethod
    def of(cls, obj: MeshObject, layer: str, selected_only: bool) -> "DensityLayer":
        """The layer of that name, or the active one. Raises TransferError."""
        check_readable(obj)
        layer = layer or getattr(obj.data.uv_layers.active, "name", "")
        if layer not in obj.data.uv_layers:
            raise TransferError(f"{obj.name}: it has no UV layer {layer!r}" if layer else f"{obj.name}: it has no UVs")
        surface = mesh_reading.read_surface(obj, selected_only)
        whole = dataclasses.replace(surface, selected=np.ones_like(surface.selected))
        return cls(obj, layer, whole, surface.selected, mesh_reading.read_layer(obj, layer))

    def density(self, chosen: bool = False) -> float:
        """The mean density of all faces, or of the selected ones: sides of the UV square per unit."""
        surface = dataclasses.replace(self.surface, selected=self.chosen) if chosen else self.surface
        return mean_density(surface, self.uv)

    def islands(self) -> list[Island]:
        """All islands of the layer."""
        return uv_islands(self.surface, self.uv)

    def set_density(self, run: Transaction, density: float) -> str:
        """Scale each island with a selected face and no pinned UV to this density. Returns what was done.

        Raises TransferError if there is none, or if the layer cannot be written.
        """
        check_mesh(self.obj)
        islands = [island for island in self.islands() if self.chosen[island.faces].any()]
        pins = mesh_reading.pinned_corners(self.obj, self.name)
        free = [island for island in islands if not pins[island.corners].any()]
        made = with_density(free, self.uv, density)
        left = [f"{counted(len(islands) - len(free), 'island')} with pinned UVs"] * (len(free) < len(islands))
        left += [f"{counted(made.flat, 'island')} without area"] * bool(made.flat)
        if not made.changed:
            raise TransferError(f"{self.obj.name}: {' and '.join(left) or 'no face is selected'}")
        corners = np.sort(np.concatenate([island.corners for island in made.changed]))
        plan = map_writing.plan(Target.of(self.obj), self.name, self.surface, corners, made.uv[corners])
        map_writing.write(run, plan, select=False)
        stay = f", {' and '.join(left)} stay" if left else ""
        return f"{self.obj.name}: {counted(len(made.changed), 'island')} scaled{stay}"
