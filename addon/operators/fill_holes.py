# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that fills holes."""

from types import ModuleType

import bpy

from ..blender import hole_filling
from ..blender.filled_mesh import FillPlan
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import Transaction, transaction
from ..maps.wording import counted, few
from .answers import refused
from .polls import OnTargets, native_or_error


class MESH_OT_koebe_fill_holes(OnTargets, bpy.types.Operator):
    """Fill holes with real faces that continue the surface. The new faces are selected. Their UVs lie inside the circle
    of the hole. This changes the mesh"""

    bl_idname = "mesh.koebe_fill_holes"
    bl_label = "Koebe Fill Holes"
    needs = "Select a mesh object"

    which: bpy.props.EnumProperty(
        name="Boundaries",
        items=[
            (hole_filling.HOLES, "Holes", "All boundaries except the longest boundary of each connected part"),
            (hole_filling.SELECTED, "Selected", "The boundary loops whose edges are all selected"),
            (hole_filling.ALL, "All", "All boundaries. The surface becomes closed"),
        ],
        default=hole_filling.HOLES,
        description="Boundary loops to fill",
    )

    def execute(self, context: bpy.types.Context) -> set[str]:
        koebe = native_or_error(self)
        if koebe is None:
            return {"CANCELLED"}
        plans: list[FillPlan] = []
        with transaction() as run:
            try:
                return self._fill(run, context, koebe, plans)
            finally:
                for plan in plans:
                    plan.free()

    def _fill(self, run: Transaction, context: bpy.types.Context, koebe: ModuleType, plans: list[FillPlan]) -> set[str]:
        problems: list[str] = []
        holes, faces = 0, 0
        for obj in with_own_meshes(target_objects(context)):
            with attempt(run, obj.name, problems):
                plans.append(FillPlan(koebe, obj, self.which))
        for plan in plans:
            with attempt(run, plan.obj.name, problems):
                plan.write(run, context)
                holes, faces = holes + len(plan.fillings), faces + plan.faces
        if not holes:
            return refused(self, "nothing was filled.", problems)
        text = f"Koebe UV: {counted(holes, 'hole')} filled with {faces} faces"
        self.report({"WARNING" if problems else "INFO"}, f"{text}. {few(problems)}" if problems else text)
        return {"FINISHED"}
