# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators. They gather, run and write; what is computed is in `job` and below."""

import contextlib

import bpy

from . import checker, report, results
from .job import Job
from .modal_run import ModalRun
from .modes import object_mode, target_objects
from .native import NativeError
from .options import OptionError
from .properties import UniformizeProperties, options_of
from .selection import select_offenders
from .transfer import TransferError


class UV_OT_koebe_uniformize(ModalRun, UniformizeProperties, bpy.types.Operator):
    """Unwrap surfaces with holes conformally to the unit disk: angles are kept and every hole becomes a
    perfect circle. Cuts along seams; in Edit Mode takes the selected faces. The mesh itself is not changed"""

    bl_idname = "uv.koebe_uniformize"
    bl_label = "Koebe Uniformize"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        if context.mode not in {"OBJECT", "EDIT_MESH"}:
            cls.poll_message_set("Works in Object Mode and in Edit Mode")
            return False
        if not target_objects(context):
            cls.poll_message_set("Select a mesh object")
            return False
        return True

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in UniformizeProperties.__annotations__:
            row = layout.row()
            row.active = not name.startswith("checker_") or self.checker
            row.prop(self, name)

    def _job(self, context):
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        try:
            job = Job(target_objects(context), options_of(self), selected_only=context.mode == "EDIT_MESH")
        except (NativeError, OptionError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None
        if job.options.placement == "keep":
            job.read_old_uv()
        return job

    def _finish(self, context, job):
        """Write what was computed, all or nothing, and say what became of it."""
        results.record(context, job)
        for area in context.screen.areas if context.screen else ():
            area.tag_redraw()
        failures = [report.failure_line(outcome) for outcome in job.outcomes if outcome.failed]
        if not job.mapped_any:
            select_offenders(context, job)
            self.report({"ERROR"}, "Koebe UV: nothing was mapped. " + ". ".join(failures))
            return {"CANCELLED"}
        try:
            with contextlib.nullcontext() if job.writable_in_edit_mode else object_mode(context):
                job.check_writable()
                job.write()
        except TransferError as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return {"CANCELLED"}
        for outcome in job.outcomes:
            if outcome.mapped:
                self.report({"INFO"} if outcome.converged else {"WARNING"}, report.result_line(outcome))
            for warning in dict.fromkeys(text for one in outcome.mapped for text in report.warnings(outcome.task, one)):
                self.report({"WARNING"}, f"{outcome.name}: {warning}")
        if failures:
            select_offenders(context, job)
            self.report({"WARNING"}, "Koebe UV: not mapped. " + ". ".join(failures))
        return {"FINISHED"}


class UV_OT_koebe_checker(bpy.types.Operator):
    """Put the checker on the selected objects, or take it off again and give them their materials back"""

    bl_idname = "uv.koebe_checker"
    bl_label = "Koebe Checker"
    bl_options = {"REGISTER", "UNDO"}

    layer: UniformizeProperties.__annotations__["layer"]
    checker_size: UniformizeProperties.__annotations__["checker_size"]
    checker_even: UniformizeProperties.__annotations__["checker_even"]

    @classmethod
    def poll(cls, context):
        return UV_OT_koebe_uniformize.poll.__func__(cls, context)

    def execute(self, context):
        objects = target_objects(context)
        wearing = [obj for obj in objects if checker.is_on(obj)]
        for obj in wearing:
            checker.take_off(obj)
        if not wearing:
            with object_mode(context):
                checker.dress(objects, self.layer, self.checker_size, self.checker_even)
        return {"FINISHED"}


CLASSES = (UV_OT_koebe_uniformize, UV_OT_koebe_checker)


def register():
    """Register the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Undo `register`."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
