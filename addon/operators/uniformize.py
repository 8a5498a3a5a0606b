# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that maps: it gathers, runs and writes; what is computed is in `jobs` and below."""

import bpy

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.map_job import Job
from ..maps import wording
from ..maps.options import OptionError
from ..maps.wording import few, lines
from ..solver.errors import NativeError
from ..state import run_report
from ..state.option_properties import OPTION_NAMES, UniformizeProperties, options_of
from .modal_run import ModalRun, redraw
from .select_from_report import select_offenders


def can_map(cls: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Whether there is a mesh to work on, in a mode in which that can be done; else it says what to do."""
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        cls.poll_message_set("Works in Object Mode and in Edit Mode")
        return False
    if not target_objects(context):
        cls.poll_message_set("Select a mesh object")
        return False
    return True


class UV_OT_koebe_uniformize(ModalRun, UniformizeProperties, bpy.types.Operator):
    """Unwrap surfaces with holes conformally to the unit disk: angles are kept and every hole becomes a
    perfect circle. Cuts along seams; in Edit Mode takes the selected faces. The mesh itself is not changed"""

    bl_idname = "uv.koebe_uniformize"
    bl_label = "Koebe Uniformize"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_map(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in OPTION_NAMES:
            row = layout.row()
            row.active = not name.startswith("checker_") or self.checker
            row.prop(self, name)

    def _job(self, context: bpy.types.Context) -> Job | None:
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        try:
            selected_only = context.mode == "EDIT_MESH"
            job = Job(target_objects(context), options_of(self), selected_only, refused=[])
        except (NativeError, OptionError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None
        if job.options.placement == "keep":
            job.read_old_uv()
        return job

    def _finish(self, context: bpy.types.Context, job: Job) -> set[str]:
        """Write what was computed, each object wholly or not at all, and say what became of it."""
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                job.write(run)
            run_report.record(run, context, job.outcomes, job.options.layer, job.refused)
            selected = select_offenders(run, context, job)
            redraw(context)
            edit_mode.undo_all(context)
            answer = self._say(job)
            if selected and answer == {"CANCELLED"}:  # after which Blender makes no undo step
                bpy.ops.ed.undo_push(message="Select What Is Wrong")
            return answer

    def _say(self, job: Job) -> set[str]:
        failures = [wording.failure_line(outcome) for outcome in job.outcomes if outcome.failed or outcome.not_written]
        failures += [text for _, text in job.refused]
        if not job.mapped_any:
            self.report({"ERROR"}, lines("Koebe UV: nothing was mapped.", failures))
            return {"CANCELLED"}
        for outcome in job.outcomes:
            if outcome.mapped:
                self.report({"INFO"} if outcome.converged else {"WARNING"}, wording.result_line(outcome))
            found = [one["text"] for mapped in outcome.mapped for one in wording.warnings(outcome.task, mapped)]
            for warning in dict.fromkeys([*found, *outcome.remarks]):
                self.report({"WARNING"}, f"{outcome.name}: {warning}")
        if failures:
            self.report({"WARNING"}, "Koebe UV: not mapped. " + few(failures))
        return {"FINISHED"}


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_uniformize,))
