# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators. They gather, run and write; what is computed is in `job` and below."""

import bpy

from . import checker, edit_mode, report, results
from .distortion import texel_density
from .errors import few, lines
from .job import Job
from .modal_run import ModalRun
from .native import NativeError
from .options import OptionError
from .properties import UniformizeProperties, options_of
from .selection import select_offenders
from .targets import reason, target_objects
from .transaction import transaction
from .transfer import TransferError, read_surface, read_uv


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
            selected_only = context.mode == "EDIT_MESH"
            job = Job(target_objects(context), options_of(self), selected_only, refused=[])
        except (NativeError, OptionError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None
        if job.options.placement == "keep":
            job.read_old_uv()
        return job

    def _finish(self, context, job):
        """Write what was computed, each object wholly or not at all, and say what became of it."""
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                job.write(run)
            results.record(run, context, job)
            selected = select_offenders(run, context, job)
            for area in context.screen.areas if context.screen else ():
                area.tag_redraw()
            edit_mode.undo_all(context)
            answer = self._say(job)
            if selected and answer == {"CANCELLED"}:  # after which Blender makes no undo step
                bpy.ops.ed.undo_push(message="Select What Is Wrong")
            return answer

    def _say(self, job):
        failures = [report.failure_line(outcome) for outcome in job.outcomes if outcome.failed or outcome.not_written]
        failures += [text for _, text in job.refused]
        if not job.mapped_any:
            self.report({"ERROR"}, lines("Koebe UV: nothing was mapped.", failures))
            return {"CANCELLED"}
        for outcome in job.outcomes:
            if outcome.mapped:
                self.report({"INFO"} if outcome.converged else {"WARNING"}, report.result_line(outcome))
            found = [one["text"] for mapped in outcome.mapped for one in report.warnings(outcome.task, mapped)]
            for warning in dict.fromkeys([*found, *outcome.remarks]):
                self.report({"WARNING"}, f"{outcome.name}: {warning}")
        if failures:
            self.report({"WARNING"}, "Koebe UV: not mapped. " + few(failures))
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
        with transaction() as run:
            objects, problems = target_objects(context), []
            wearing = [obj for obj in objects if checker.is_on(obj)]
            sizes = [self.checker_size] * len(objects)
            if not wearing and self.checker_even and len(objects) > 1:
                sizes = checker.even_sizes(self.checker_size, [self._density(obj) for obj in objects])
            materials = [None] * len(objects) if wearing else checker.materials(run, objects, self.layer, sizes)
            for obj, material in zip(wearing or objects, materials):
                with run.attempt(lambda error, name=obj.name: problems.append(reason(name, error))):
                    checker.check(obj)
                    if wearing:
                        checker.take_off(run, obj)
                    elif not checker.is_on(obj):  # it may be by now, as another object has the same mesh
                        checker.put_on(run, obj, material)
            if len(problems) == len(wearing or objects):
                run.put_back()  # the new material
                self.report({"ERROR"}, lines("Koebe UV:", problems))
                return {"CANCELLED"}
            edit_mode.undo_all(context)
            if problems:
                self.report({"WARNING"}, f"Koebe UV: left out. {few(problems)}")
            return {"FINISHED"}

    def _density(self, obj):
        """Lengths in the UVs over lengths in space; 0 where there are none, or where they cannot be read."""
        if self.layer not in obj.data.uv_layers or (obj.data.is_editmode and obj.mode != "EDIT"):
            return 0.0
        surface = read_surface(obj, selected_only=False)
        return texel_density(surface, read_uv(obj, self.layer))


CLASSES = (UV_OT_koebe_uniformize, UV_OT_koebe_checker)


def register():
    """Register the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Undo `register`."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
