# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that cuts a surface of any kind into even parts, in the UVs alone."""

import bpy

from ..blender import edit_mode
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.parts_job import PartsJob
from ..maps import wording
from ..state import run_report
from ..state.option_properties import PART_OPTION_NAMES, PartsProperties, choice_of, written_options_of
from .modal_run import redraw
from .run_operator import MapOperator
from .tooltip import tooltip


class UV_OT_koebe_parts(MapOperator, PartsProperties, bpy.types.Operator):
    """Cut a surface of any kind into disks and unrolled tubes with even texels: limbs, closed models, handles. In the
    UVs alone: the mesh stays, but for its seams if they are to be written. In Edit Mode takes the selected faces"""

    bl_idname = "uv.koebe_parts"
    bl_label = "Koebe Unwrap to Parts"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    options_shown = PART_OPTION_NAMES

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> PartsJob:
        choice, options = choice_of("parts", self), written_options_of(self)
        return PartsJob(target_objects(context), options, choice, selected_only, refused=[])

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
        failures = [wording.failure_line(outcome) for outcome in job.outcomes if outcome.failed or outcome.not_written]
        results: list[tuple[str, bool, list[str], list[str]]] = []
        for outcome in job.outcomes:
            if outcome.mapped:
                found = [warning["text"] for warning in outcome.warnings()]
                warnings = [f"{outcome.name}: {text}" for text in [*found, *outcome.remarks]]
                results.append((outcome.line(), outcome.converged, [], warnings))
        return self._tell(job, failures, results)


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_parts,))
