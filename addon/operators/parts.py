# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that cuts a surface of any kind into even parts, in the UVs alone."""

import bpy

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.parts_job import PartsJob
from ..maps.options import OptionError
from ..maps.parts import NO_CUTS, price_of
from ..maps.wording import few, lines
from ..solver.errors import NativeError
from ..state import run_report
from ..state.option_properties import PART_OPTION_NAMES, PartsProperties, part_options_of
from .modal_run import ModalRun, redraw
from .uniformize import can_map


class UV_OT_koebe_parts(ModalRun, PartsProperties, bpy.types.Operator):
    """Cut a surface of any kind, in the UVs alone, into disks and unrolled tubes with even texels: limbs, closed
    models, models with handles. Cuts along seams too; in Edit Mode takes the selected faces. The mesh itself is not
    changed, unless its cuts are to become seams"""

    bl_idname = "uv.koebe_parts"
    bl_label = "Koebe Unwrap to Parts"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_map(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in PART_OPTION_NAMES:
            row = layout.row()
            row.active = self.checker if name.startswith("checker_") else name != "evenness" or self.seams == "add"
            row.prop(self, name)

    def _job(self, context: bpy.types.Context) -> PartsJob | None:
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        try:
            price = price_of(self.evenness) if self.seams == "add" else NO_CUTS
            return PartsJob(
                target_objects(context), part_options_of(self), price, context.mode == "EDIT_MESH", refused=[],
                write_seams=self.write_seams,
            )  # fmt: skip
        except (NativeError, OptionError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None

    def _finish(self, context: bpy.types.Context, job: PartsJob) -> set[str]:
        """Write what was computed, each object wholly or not at all, and say what became of it."""
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                job.write(run)
            run_report.record_parts(run, context, job.outcomes, job.options.layer, job.refused)
            redraw(context)
            edit_mode.undo_all(context)
            return self._say(job)

    def _say(self, job: PartsJob) -> set[str]:
        failures = [outcome.problem for outcome in job.outcomes if outcome.problem]
        failures += [text for _, text in job.refused]
        if not job.mapped_any:
            self.report({"ERROR"}, lines("Koebe UV: nothing was mapped.", failures))
            return {"CANCELLED"}
        for outcome in job.outcomes:
            if outcome.mapped:
                self.report({"INFO"}, outcome.line())
            found = [warning.text for result in outcome.mapped for warning in result.warnings]
            for warning in dict.fromkeys([*found, *outcome.remarks]):
                self.report({"WARNING"}, f"{outcome.name}: {warning}")
        if failures:
            self.report({"WARNING"}, "Koebe UV: not mapped. " + few(failures))
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_parts,))
