# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that maps: it gathers, runs and writes; what is computed is in `jobs` and below."""

import bpy

from ..blender import edit_mode
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.map_job import Job
from ..maps import wording
from ..state import run_report
from ..state.option_properties import ACCURACY_NAMES, OPTION_NAMES, UniformizeProperties, options_of
from .modal_run import redraw
from .run_operator import MapOperator
from .select_from_report import select_offenders
from .tooltip import tooltip


class UV_OT_koebe_uniformize(MapOperator, UniformizeProperties, bpy.types.Operator):
    """Unwrap surfaces conformally to the unit disk: angles are kept and every hole becomes a perfect circle. Cuts along
    seams, and where it has to; in Edit Mode takes the selected faces. The mesh is not changed"""

    bl_idname = "uv.koebe_uniformize"
    bl_label = "Koebe Uniformize"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    options_shown = tuple(sorted(OPTION_NAMES, key=lambda name: name in ACCURACY_NAMES))

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> Job:
        job = Job(target_objects(context), options_of(self), selected_only, refused=[])
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
        results = []
        for outcome in job.outcomes:
            if outcome.mapped:
                found = [one["text"] for mapped in outcome.mapped for one in wording.warnings(outcome.task, mapped)]
                said = wording.few([text for _, text in wording.notes(outcome)], "; ")
                notes = [f"{outcome.name}: {said}"] if said else []
                warnings = [f"{outcome.name}: {text}" for text in [*found, *outcome.remarks]]
                is_good = outcome.converged and not outcome.lost
                results.append((wording.result_line(outcome), is_good, notes, warnings))
        return self._tell(job, failures, results)


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_uniformize,))
