# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that maps them to tiles of flat tori or cylinders: which faces are meant."""

import dataclasses

import numpy as np

from ..blender import mesh_reading
from ..blender.mesh_object import MeshObject
from ..maps.domain_outcomes import islands_to_map
from ..maps.options import Options, TileChoice
from ..maps.outcomes import Progress, Task
from ..maps.surface import Surface
from ..maps.tiles import TileOutcome, map_tiles
from .domain_job import DomainJob


class TileJob(DomainJob):
    """Maps to tiles."""

    choice: TileChoice

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: TileChoice,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        self._picked: dict[str, np.ndarray] = {}  # by object: vertices (V,) that tell which loops are the rims
        super().__init__(objects, options, choice, selected_only, refused)

    def _surface(self, obj: MeshObject, selected_only: bool) -> Surface:
        """The surface, in Edit Mode of the selected faces. Where vertices tell which loops are the rims, because that
        is asked for or no face is selected, it is all of the islands that have such vertices."""
        surface = super()._surface(obj, selected_only)
        if self.choice.domain != "ring" or not selected_only:
            return surface
        picked = mesh_reading.selected_vertices(obj)
        self._picked[obj.name] = picked
        if self.choice.rims != "selected" and surface.selected.any():
            return surface
        shown = dataclasses.replace(surface, selected=mesh_reading.shown_faces(obj))
        selected = np.zeros_like(surface.selected)
        for island in islands_to_map(shown):
            if picked[island.source_vertex].any():
                selected[island.faces] = True
        return dataclasses.replace(surface, selected=selected)

    def _map(self, task: Task, progress: Progress | None) -> TileOutcome:
        return map_tiles(self.koebe, task, self.choice, self._picked.get(task.name), progress, self.cancel_token)
