# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that makes a UV layer the one that renders."""

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode, rendered_layer
from ..blender.targets import attempt, check_mesh, target_objects, with_own_meshes
from ..blender.transaction import transaction
from .answers import finished, refused
from .modal_run import redraw
from .polls import OnTargets


class UV_OT_koebe_use_for_rendering(OnTargets, bpy.types.Operator):
    """Make the UV layer the one that Material Preview, renders and bakes use. The other layers stay as they are"""

    bl_idname = "uv.koebe_use_for_rendering"
    bl_label = "Koebe Use for Rendering"

    layer: StringProperty(name="UV Layer", description="UV layer that shall render. Without a name, the active layer")

    def execute(self, context: bpy.types.Context) -> set[str]:
        problems: list[str] = []
        objects = with_own_meshes(target_objects(context))
        with transaction() as run:
            for obj in objects:
                with attempt(run, obj.name, problems):
                    check_mesh(obj)
                    rendered_layer.use(run, obj, self.layer or getattr(obj.data.uv_layers.active, "name", ""))
            if len(problems) == len(objects):
                return refused(self, "", problems)
            redraw(context)
            edit_mode.undo_all(context)
            return finished(self, "not done", problems)
