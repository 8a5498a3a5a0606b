# SPDX-License-Identifier: GPL-3.0-or-later
"""The common part of operators that map objects: their objects, their options, their messages."""

import time
from typing import Any, ClassVar

import bpy
import numpy as np

from ..blender import edit_mode
from ..blender.targets import target_objects
from ..blender.transaction import Transaction, transaction
from ..jobs.map_job import Job
from ..maps.option_table import ROWS
from ..maps.wording import failure_line
from ..solver.worker import Worker
from ..state import run_report
from ..surfaces.errors import KnownError
from .answers import finished, refused
from .modal_run import ModalRun, redraw
from .select_from_report import select_offenders
from .waiting_run import Waiting, go_on


def takes_parts(options: Any) -> bool:
    """Whether the map is one into parts, or may be."""
    return hasattr(options, "keep_angles") and getattr(options, "shape", "PARTS") in {"AUTO", "PARTS"}


def keeps_angles(options: Any) -> bool:
    """Whether the evenness of parts follows from their angles."""
    return takes_parts(options) and options.keep_angles


NEEDS = {  # options that matter only with certain values of others
    "margin": lambda options: takes_parts(options) or options.placement != "keep",
    "importance": lambda options: options.balance == "area" or options.even > 0.0 or takes_parts(options),
    "density": lambda options: options.texels == "number",
    "like": lambda options: options.texels == "layer",
    "evenness": lambda options: options.seams == "add",
    "even": lambda options: not keeps_angles(options),
    "hard_angle": lambda options: not options.no_hard,
    "cut_hard": lambda options: not options.no_hard,
    "loops": lambda options: keeps_angles(options) or options.even > 0.0,
    "checker_size": lambda options: options.checker,
    "checker_even": lambda options: options.checker,
    "play": lambda options: options.source == "FRAMES" and options.target == "ATTRIBUTE",
    "frame_start": lambda options: options.source == "FRAMES",
    "frame_end": lambda options: options.source == "FRAMES",
    "frame_step": lambda options: options.source == "FRAMES",
}


def is_used(options: Any, name: str) -> bool:
    """Whether an option matters with the present choices."""
    return name not in NEEDS or NEEDS[name](options)


SLIDERS = ("evenness",)  # over the whole width, with their names inside, as in the panel


def draw_option(layout: bpy.types.UILayout, options: Any, name: str, context: bpy.types.Context) -> None:
    """Draw a row for an option, grey if it does not matter."""
    row = layout.row()
    row.active = is_used(options, name)
    obj = context.active_object
    if name in SLIDERS:
        row.use_property_split = False
    if ROWS[name].kind == "weights" and obj is not None and obj.type == "MESH":
        row.prop_search(options, name, obj, "vertex_groups")
    else:
        row.prop(options, name, slider=name in SLIDERS)


def can_map(cls: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Whether there is a mesh to work on, in a possible mode. If not, tells the user what to do."""
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        cls.poll_message_set("Works in Object Mode and in Edit Mode")
        return False
    if not target_objects(context):
        cls.poll_message_set("Select a mesh object")
        return False
    return True


AT_ONCE = 0.3  # seconds for a run from the redo panel, before it goes on beside the window


class MapOperator(ModalRun):
    """Mixin of operators that map the selected objects. Each kind of map makes its own job.

    options_shown  the names of the properties in the redo panel
    redo_waits     a run from the redo panel goes on without a frozen window, if it is not done at once
    sketch         the job that runs, and the ends (E, 2, 3) in the world of the cuts that it has decided so far
    """

    bl_options = {"REGISTER", "UNDO"}
    options_shown: tuple[str, ...]
    redo_waits: ClassVar[bool] = True
    sketch: ClassVar[tuple[Job, np.ndarray] | None] = None

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_map(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        layout: Any = self.path_resolve("layout")  # `self.layout` is an option of spheres
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in self.options_shown:
            draw_option(layout, self, name, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        if bpy.app.background or context.window is None or not (self.options.is_repeat and self.redo_waits):
            return super().execute(context)
        job = self._begun(context)
        if job is None:
            return {"CANCELLED"}
        worker, until = Worker(job.compute), time.monotonic() + AT_ONCE
        while worker.running and time.monotonic() < until:
            time.sleep(AT_ONCE / 50)
        if worker.running:
            go_on(context.window, Waiting(self.bl_label, job, worker, self._preview(context)))
            return {"FINISHED"}
        try:
            worker.result()
        except KnownError as error:
            return self._refuse(error)
        return self._finish(context, job)

    def _preview(self, context: bpy.types.Context) -> Transaction:
        """Write the operator's last map again, as the redo panel has undone it."""
        run = Transaction()
        if Waiting.done is not None and Waiting.done[0] == self.bl_label:
            with run.part():
                self._write(run, context, Waiting.done[1])
            edit_mode.undo_all(context)
        redraw(context)
        return run

    def _show_progress(self, context: bpy.types.Context) -> None:
        super()._show_progress(context)
        cuts = self._running.sketched()
        if len(cuts):
            MapOperator.sketch = self._running, cuts
            redraw(context, ("VIEW_3D",))

    def _stop_polling(self, context: bpy.types.Context) -> None:
        if MapOperator.sketch is not None and MapOperator.sketch[0] is self._running:
            MapOperator.sketch = None
        super()._stop_polling(context)

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> Job:
        raise NotImplementedError

    def _job(self, context: bpy.types.Context) -> Job:
        return self._new_job(context, selected_only=context.mode == "EDIT_MESH")

    def _finish(self, context: bpy.types.Context, job: Job) -> set[str]:
        """Write the results, each object completely or not at all, and report on them."""
        with transaction() as run:
            self._write(run, context, job)
            run_report.record(run, context, job.rows())
            selected = select_offenders(run, context, job)
            redraw(context)
            edit_mode.undo_all(context)
            answer = self._tell(job)
            if answer == {"FINISHED"}:
                Waiting.done = self.bl_label, job
            if selected and answer == {"CANCELLED"}:  # after this Blender makes no undo step
                bpy.ops.ed.undo_push(message="Select Elements at Fault")
            return answer

    def _write(self, run: Transaction, context: bpy.types.Context, job: Job) -> None:
        with edit_mode.left_if_faster(run, context):
            job.write(run)

    def _tell(self, job: Job) -> set[str]:
        """Report on the objects: for each mapped one its line, notes and warnings; then why islands or objects have no
        new UVs."""
        failures = [failure_line(outcome) for outcome in job.outcomes if outcome.failed or outcome.not_written]
        failures += [text for _, text in job.refused]
        if not job.mapped_any:
            return refused(self, "nothing was mapped.", failures)
        for outcome in job.outcomes:
            if outcome.mapped:
                self.report({"INFO"} if outcome.is_good else {"WARNING"}, outcome.line())
                for note in [*[outcome.chosen] * bool(outcome.chosen), *outcome.said_notes(), *outcome.hints]:
                    self.report({"INFO"}, f"{outcome.name}: {note}")
                for warning in dict.fromkeys([*outcome.said_warnings(), *outcome.remarks]):
                    self.report({"WARNING"}, f"{outcome.name}: {warning}")
        return finished(self, "not mapped", failures)
