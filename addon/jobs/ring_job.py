# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that maps them to cylinders. It chooses the faces to map."""

import dataclasses

import numpy as np

from ..blender import mesh_reading
from ..blender.mesh_object import MeshObject
from ..maps.domain_outcomes import islands_to_map
from ..maps.outcomes import Task
from ..surfaces.surface import Surface
from .domain_job import DomainJob


class RingJob(DomainJob):
    """Maps to cylinders. In Edit Mode selected vertices can choose the rims."""

    def _surface(self, obj: MeshObject) -> Surface:
        """The surface, in Edit Mode of the selected faces. If selected vertices choose the rims, because that is an
        option or no face is selected, it is the whole of the islands with such vertices."""
        surface = super()._surface(obj)
        if not self.selected_only or (self.choice.rims != "selected" and surface.selected.any()):
            return surface
        picked = mesh_reading.selected_vertices(obj)
        shown = dataclasses.replace(surface, selected=mesh_reading.shown_faces(obj))
        selected = np.zeros_like(surface.selected)
        for island in islands_to_map(shown):
            if picked[island.source_vertex].any():
                selected[island.faces] = True
        return dataclasses.replace(surface, selected=selected)

    def _task(self, obj: MeshObject, surface: Surface) -> Task:
        picked = mesh_reading.selected_vertices(obj) if self.selected_only else None
        return dataclasses.replace(super()._task(obj, surface), picked=picked)
