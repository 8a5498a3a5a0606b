# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that packs the islands of any UV layer, and does nothing else."""

from typing import Any

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import transaction
from ..jobs.pack_job import pack
from ..maps.wording import few, lines
from ..state.option_properties import option, shown_number
from ..state.run_report import forget
from .modal_run import redraw
from .polls import has_targets, native_or_error
from .tooltip import tooltip


class UV_OT_koebe_pack(bpy.types.Operator):
    """Pack the islands of the active UV layer into the UV square, as large as they have room. No island is cut, bent or
    turned over. In Edit Mode the islands of the selected faces are packed"""

    bl_idname = "uv.koebe_pack"
    bl_label = "Koebe Pack Only"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}

    layer: StringProperty(name="UV Layer", description="UV layer to pack. Without a name, the active layer")
    margin: option("margin")
    pixels: option("pixels")
    average_scale: option("average_scale")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_targets(cls, context, "Select a mesh object with UVs, in Object Mode or in Edit Mode")

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        koebe = native_or_error(self)
        if koebe is None:
            return {"CANCELLED"}
        options = {"margin": shown_number(self.margin), "pixels": self.pixels, "average_scale": self.average_scale}
        selected_only = context.mode == "EDIT_MESH"
        problems: list[str] = []
        done: list[str] = []
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                for obj in with_own_meshes(target_objects(context)):
                    with attempt(run, obj.name, problems):
                        result = pack(run, koebe, obj, self.layer, selected_only, options)
                        forget(run, context, obj.name, obj.data.uv_layers.active.name)
                        done.append(_line(obj.name, result.to_dict()))
            redraw(context)
            edit_mode.undo_all(context)
            return self._say(done, problems)

    def _say(self, done: list[str], problems: list[str]) -> set[str]:
        if not done:
            self.report({"ERROR"}, lines("Koebe UV: nothing was packed.", problems))
            return {"CANCELLED"}
        for line in done:
            self.report({"INFO"}, line)
        if problems:
            self.report({"WARNING"}, "Koebe UV: not packed. " + few(problems))
        return {"FINISHED"}


def _line(name: str, report: dict[str, Any]) -> str:
    """The result for one object."""
    overlaps = report["overlaps"]
    more = f", {overlaps} overlap or touch themselves as before" if overlaps else ""
    return (
        f"{name}: {len(report['islands'])} islands{more}, {100 * report['coverage']:.0f} % of the UV square, "
        f"margin {report['margin']:.3g} px"
    )


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_pack,))
