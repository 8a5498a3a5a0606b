# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that compares shapes by their conformal modules."""

import bpy

from ..blender.noted_properties import note_group
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.shape_jobs import MeasureJob
from ..state.shape_report import shapes_of
from .answers import finished
from .modal_run import ModalRun, redraw
from .polls import in_object_mode


class UV_OT_koebe_compare_shapes(ModalRun, bpy.types.Operator):
    """Compare the shapes of the selected objects with the shape of the active object, by the circles of their holes. 0
    is the same shape. Nothing is changed"""

    bl_idname = "uv.koebe_compare_shapes"
    bl_label = "Koebe Compare Shapes"
    bl_options = {"REGISTER"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return in_object_mode(cls, context, 1)

    def _job(self, context: bpy.types.Context) -> MeasureJob:
        return MeasureJob(target_objects(context))

    def _finish(self, context: bpy.types.Context, job: MeasureJob) -> set[str]:
        with transaction() as run:
            shapes = shapes_of(context)
            note_group(run, shapes)
            shapes.source = job.names[0]
            shapes.module.clear()
            for name, value in job.module:
                number = shapes.module.add()
                number.name, number.value = name, value
            shapes.others.clear()
            for one in job.comparisons[1:]:
                entry = shapes.others.add()
                entry.name, entry.measured = one.name, one.distance is not None
                entry.distance = one.distance if entry.measured else 0.0
                entry.message = one.message or ("" if one.converged else "not converged")
            shapes.carried.clear()
            redraw(context)
            for one in job.comparisons[1:]:
                found = one.message if one.distance is None else f"distance {one.distance:.6g}"
                self.report({"INFO"}, f"{one.name}: {found}")
            if not job.comparisons[0].converged:
                self.report({"WARNING"}, f"{job.names[0]}: not converged")
            return finished(self, "not compared", job.failures)
