# SPDX-License-Identifier: GPL-3.0-or-later
"""A UV layer of an object, read to move or scale its islands, and written."""

import dataclasses
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh, check_readable
from ..blender.transaction import Transaction
from ..maps.wording import counted
from ..surfaces.surface import Island, Surface
from ..surfaces.uv_islands import uv_islands


@dataclasses.dataclass(frozen=True)
class IslandLayer:
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
    def of(cls, obj: MeshObject, layer: str, selected_only: bool) -> Any:
        """The layer of that name, or the active one. Raises TransferError."""
        check_readable(obj)
        layer = mesh_reading.layer_named(obj, layer)
        surface = mesh_reading.read_surface(obj, selected_only)
        whole = dataclasses.replace(surface, selected=np.ones_like(surface.selected))
        return cls(obj, layer, whole, surface.selected, mesh_reading.read_layer(obj, layer))

    def islands(self) -> list[Island]:
        """All islands of the layer."""
        return uv_islands(self.surface, self.uv)

    def free_islands(self) -> tuple[list[Island], list[str]]:
        """The islands with a selected face and no pinned UV, and in words those that their pins keep."""
        check_mesh(self.obj)
        islands = [island for island in self.islands() if self.chosen[island.faces].any()]
        pins = mesh_reading.pinned_corners(self.obj, self.name)
        free = [island for island in islands if not pins[island.corners].any()]
        pinned = len(islands) - len(free)
        return free, [f"{counted(pinned, 'island')} with pinned UVs"] * (pinned > 0)

    def write(self, run: Transaction, changed: list[Island], uv: np.ndarray, done: str, left: list[str]) -> str:
        """Write the UVs (C, 2) of the islands that have changed. Returns what was done.

        done  to the islands, in a word. @param left in words what stays

        Raises TransferError if nothing has changed, or if the layer cannot be written.
        """
        if not changed:
            raise TransferError(f"{self.obj.name}: {' and '.join(left) or 'no face is selected'}")
        corners = np.sort(np.concatenate([island.corners for island in changed]))
        plan = map_writing.plan(Target.of(self.obj), self.name, self.surface, corners, uv[corners])
        map_writing.write(run, plan, select=False)
        stay = f", {' and '.join(left)} stay" if left else ""
        return f"{self.obj.name}: {counted(len(changed), 'island')} {done}{stay}"
