# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that brings a pattern onto surfaces: holes or a relief, as a new object."""

import os
from typing import Any

import bpy

from ..blender.curve_drawing import curve_drawing
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.selection import select_objects
from ..blender.targets import target_objects
from ..blender.transaction import Transaction, transaction
from ..jobs.lift_job import LiftJob
from ..maps.lifting import LiftOutcome
from ..maps.wording import lines
from ..state import run_report
from ..state.lift_properties import SHOWN, LiftProperties, draw_lift_options, lift_choice_of
from ..state.option_properties import settings_of
from .answers import finished, refused
from .modal_run import ModalRun, redraw
from .polls import OnTargets


class OBJECT_OT_koebe_lift(OnTargets, LiftProperties, ModalRun, bpy.types.Operator):
    """Copy the selected surfaces with a flat pattern on them: holes, a relief, a closed solid. Circles stay circles, as
    the map keeps angles. The copy is a new object, and the original is hidden"""

    bl_idname = "object.koebe_lift"
    bl_label = "Koebe Patterned Copy"
    needs, modes = "Select a mesh object, in Object Mode", ("OBJECT",)

    area: bpy.props.FloatProperty(default=0.0, options={"HIDDEN", "SKIP_SAVE"})

    def draw(self, context: bpy.types.Context) -> None:
        layout: Any = self.layout
        layout.use_property_split = True
        layout.use_property_decorate = False
        draw_lift_options(layout, self, SHOWN)

    def _job(self, context: bpy.types.Context) -> LiftJob:
        if self.pattern == "file":
            self._check_file()
        drawing = curve_drawing(self.drawing) if self.pattern == "object" else None
        job = LiftJob(target_objects(context), lift_choice_of(self), drawing)
        if not job.outcomes:
            raise TransferError(lines("no copy was made.", job.problems))
        return job

    def _check_file(self) -> None:
        """Raise TransferError unless the file may be a pattern."""
        path = bpy.path.abspath(self.file)
        ending = os.path.splitext(path)[1].lower()
        if ending not in (".svg", ".png"):
            raise TransferError("choose an SVG or PNG file as the pattern")
        if not (os.path.isfile(path) and os.access(path, os.R_OK)):
            raise TransferError(f"there is no file {path} that can be read: choose another file as the pattern")
        if ending == ".png" and self.way == "perforate":
            raise TransferError("an image is a relief: set Make to Relief")

    def _finish(self, context: bpy.types.Context, job: LiftJob) -> set[str]:
        self.area = max((outcome.area for outcome in job.outcomes), default=0.0)  # for the redo panel
        with transaction() as run:
            made = job.write(run, context, settings_of(context).layer)
            if made:
                select_objects(run, context, [obj for _, _, obj in made])
            for _, source, _ in made if self.hide else ():
                _hide(run, source)
            failures = job.failures()
            done = {outcome.name for outcome, _, _ in made}
            for name in sorted(done):
                run_report.forget(run, context, name, layer="")  # why it had no copy before
            if failures:
                run_report.record(run, context, [outcome.row() for outcome in failures])
            redraw(context)
            return self._say(job, [outcome for outcome, _, _ in made])

    def _say(self, job: LiftJob, done: list[LiftOutcome]) -> set[str]:
        problems = [*(f"{one.name}: {one.reason()}" for one in job.failures()), *job.problems]
        if not done:
            return refused(self, "no copy was made.", problems)
        for outcome in done:
            warnings = outcome.warnings()
            self.report({"WARNING"} if warnings else {"INFO"}, outcome.line(self.way == "perforate"))
            for text in warnings:
                self.report({"WARNING"}, f"{outcome.name}: {text}")
        return finished(self, "left out", problems)


def _hide(run: Transaction, obj: MeshObject) -> None:
    """Hide an object in the view and in renders."""
    run.before_write(obj.hide_set, obj.hide_get())
    obj.hide_set(True)
    if obj.library is None:
        run.before_write(setattr, obj, "hide_render", obj.hide_render)
        obj.hide_render = True
