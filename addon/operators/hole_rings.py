# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that selects loops of edges around holes, for retopology."""

from typing import Any

import bpy
import numpy as np
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.selection import select_only
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.moebius_job import MoebiusJob
from ..layers.hole_rings import ring_edges
from ..surfaces.offending_elements import EDGES
from .answers import refused
from .polls import OnTargets, native_or_error


class MESH_OT_koebe_loops_around_holes(OnTargets, bpy.types.Operator):
    """Select, in Edit Mode, loops of edges around the holes of the active object: eyes, mouth, armholes. The loops lie
    along circles around each hole. The UVs must have circles as holes"""

    bl_idname = "mesh.koebe_loops_around_holes"
    bl_label = "Koebe Edge Loops Around Holes"
    needs = "Select a mapped mesh object"

    hole: IntProperty(name="Hole", min=0, description="Number of the hole, as in the report. 0: all holes")
    rings: IntProperty(name="Edge Loops", default=3, min=1, soft_max=20, description="Number of loops around each hole")
    ratio: FloatProperty(
        name="Growth", default=1.3, min=1.001, soft_max=3.0,
        description="Each circle is so many times as large as the last, beginning with the hole",
    )  # fmt: skip
    layer: StringProperty(name="UV Layer", description="UV layer with the circles. Without a name, the active layer")

    def draw(self, context: bpy.types.Context) -> None:
        layout: Any = self.layout
        layout.use_property_split = True
        for name in ("hole", "rings", "ratio"):
            layout.prop(self, name)

    def execute(self, context: bpy.types.Context) -> set[str]:
        koebe = native_or_error(self)
        if koebe is None:
            return {"CANCELLED"}
        obj = target_objects(context)[0]
        try:
            edit_mode.check(context, obj)
            edges = self._edges(MoebiusJob(koebe, obj, self.layer))
            if not len(edges):
                raise TransferError(f"{obj.name}: there is no such hole, or no edge between its circles")
            with transaction() as run:
                edit_mode.enter(run, context, obj)
                select_only(run, context, [(obj, EDGES, edges.tolist())])
                edit_mode.undo_all(context)
                return {"FINISHED"}
        except TransferError as error:
            return refused(self, str(error))

    def _edges(self, job: MoebiusJob) -> np.ndarray:
        found = [
            ring_edges(job.surface, domain, number, self.rings, self.ratio)
            for domain in job.domains
            for number in range(1, len(domain.loops))
            if self.hole in (0, number)
        ]
        return np.unique(np.concatenate(found)) if found else np.zeros(0, dtype=np.int64)
