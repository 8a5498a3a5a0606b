# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs an operator's computation without a frozen window: on a thread, with progress, Esc and polling."""

import time
from collections.abc import Collection, Generator
from typing import TYPE_CHECKING, Any, ClassVar

import bpy

from ..maps.options import OptionError
from ..solver.errors import NativeError
from ..solver.worker import Worker
from ..surfaces.errors import KnownError
from .answers import refused

# The status line's names for the stages of a computation.
STAGES = {
    "topology": "reading the surface",
    "metric": "measuring the surface",
    "cut": "cutting the surface open",
    "factor": "preparing the equations",
    "iterate": "making the holes round",
    "finish": "finishing the map",
    "polish": "polishing the angles",
    "split": "cutting into parts",
    "pack": "packing the parts",
    "even": "making the texels even",
}
POLL_SECONDS = 0.05  # interval between looks at a running computation: Esc acts within this time and one checkpoint
READ_SECONDS = 0.1  # time to read Blender's data between two looks at the keys, if one step takes no longer
SHOW_SECONDS = 0.25  # interval of progress reports
DRAWING_SHARE = 0.2  # largest share of the time for drawing them
BAR_EDITORS = ("VIEW_3D", "IMAGE_EDITOR")  # with a bar of the progress in their headers
SAME_TURN = 0.005  # an event so soon after a report came before the window was drawn
# During a computation the view may move; everything else could change the mapped data.
NAVIGATION = {
    "MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE",
    "WHEELINMOUSE", "WHEELOUTMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "NDOF_MOTION",
}  # fmt: skip

if TYPE_CHECKING:  # mixins have this base for the type checker only
    OperatorBase = bpy.types.Operator
else:
    OperatorBase = object


def redraw(context: bpy.types.Context, editors: Collection[str] = ()) -> None:
    """Make the window's editors of these types show the changes; without types, all of them."""
    for area in context.screen.areas if context.screen else ():
        if not editors or area.type in editors:
            area.tag_redraw()


def redraw_bars(context: bpy.types.Context) -> None:
    """Make the window show the progress. Headers are drawn at once, where a view of a large mesh can take a second."""
    for area in context.screen.areas if context.screen else ():
        for region in area.regions:
            if area.type in BAR_EDITORS and region.type == "HEADER":
                region.tag_redraw()


def listen(handlers: Collection[tuple[Any, Any]], is_listening: bool) -> None:
    """Add functions to Blender's lists of handlers, or remove them. @param handlers a list and a function each"""
    for functions, function in handlers:
        if function in functions:
            functions.remove(function)
        if is_listening:
            functions.append(function)


def finish_early(job: Any) -> bool:
    """Whether the job ends with the best that it has, in place of being cancelled."""
    return hasattr(job, "finish_early") and job.finish_early()


class ModalRun(OperatorBase):
    """Mixin of operators that gather, compute and write. In the background, and called by a script, they run at once.

    A job has `compute(progress)`, which touches no Blender data, and a `cancel_token`. If it has `finish_early()`, the
    first Esc calls this, and the job is cancelled only if it says False.

    bar  the share that is done and its words, for all windows, while an operator runs
    """

    bar: ClassVar[tuple[float, str] | None] = None

    def _job(self, context: bpy.types.Context) -> Any:
        """The job. Raises KnownError, NativeError or OptionError."""
        raise NotImplementedError

    def _begun(self, context: bpy.types.Context) -> Any:
        """The job, or None if it cannot begin, and then an error is reported."""
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        try:
            return self._job(context)
        except (KnownError, NativeError, OptionError) as error:
            self._refuse(error)
            return None

    def _reading(self, context: bpy.types.Context, job: Any) -> Generator[float, None, None] | None:
        """Reads data step by step before the job computes, and yields the share that is read. Or None.

        When it ends, or is closed, Blender is in its former state. Raises KnownError.
        """
        return None

    def _finish(self, context: bpy.types.Context, job: Any) -> set[str]:
        """Write the job's results."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        job = self._begun(context)
        if job is None:
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            for fraction in self._reading(context, job) or ():
                manager.progress_update(int(100 * fraction))
            job.compute(lambda fraction, stage: manager.progress_update(int(100 * fraction)))
        except KnownError as error:
            return self._refuse(error)
        finally:
            manager.progress_end()
        return self._finish(context, job)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if bpy.app.background:
            return self.execute(context)
        job = self._begun(context)
        if job is None:
            return {"CANCELLED"}
        to_read = self._reading(context, job)
        return self._start(context, job, to_read, None if to_read else Worker(job.compute))

    def _start(self, context: bpy.types.Context, job: Any, to_read: Any, worker: Worker | None) -> set[str]:
        """Look after a computation until it ends."""
        self._running, self._to_read, self._worker = job, to_read, worker
        self._read: float | None = None
        self._shown_at, self._shown = time.monotonic(), ""
        self._show_next: float | None = self._shown_at + SHOW_SECONDS
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC" and event.value == "PRESS":
            if self._worker is not None and finish_early(self._running):
                return {"RUNNING_MODAL"}
            # The thread has its own arrays and ends at its next checkpoint, so nothing waits for it.
            self.cancel(context)
            self.report({"INFO"}, "Koebe UV: cancelled, nothing was changed")
            return {"CANCELLED"}
        if event.type == "TIMER":
            try:
                self._read_some()
            except KnownError as error:
                self._stop_polling(context)
                return self._refuse(error)
            self._show_progress(context)
            if self._worker is not None and not self._worker.running:
                return self._end(context)
        return {"PASS_THROUGH"} if event.type in NAVIGATION else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Cancel: after Esc, or when Blender ends the operator, for example at exit."""
        self._running.cancel_token.cancel()
        if self._to_read is not None:
            self._to_read.close()
        self._stop_polling(context)

    def _read_some(self) -> None:
        """Read for a short time, and start to compute once everything is read."""
        until = time.monotonic() + READ_SECONDS
        while self._to_read is not None and time.monotonic() < until:
            self._read = next(self._to_read, None)
            if self._read is None:
                self._to_read, self._worker = None, Worker(self._running.compute)

    def _refuse(self, error: Exception) -> set[str]:
        return refused(self, str(error))

    def _end(self, context: bpy.types.Context) -> set[str]:
        assert self._worker is not None
        self._stop_polling(context)
        try:
            self._worker.result()
        except KnownError as error:
            return self._refuse(error)
        return self._finish(context, self._running)

    def _stop_polling(self, context: bpy.types.Context) -> None:
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        ModalRun.bar = None
        redraw_bars(context)

    def _show_progress(self, context: bpy.types.Context) -> None:
        if self._worker is None:
            share, done = self._read or 0.0, f"{100 * (self._read or 0.0):.0f} % read"
        else:
            stage = STAGES.get(self._worker.stage, self._worker.stage)
            share, done = self._worker.fraction, f"{100 * self._worker.fraction:.0f} % done{', ' * bool(stage)}{stage}"
        text = f"Koebe UV: {done}      Esc: Cancel"
        now = time.monotonic()
        if self._show_next is None:
            drawn = now - self._shown_at  # until the first event after the report
            if drawn > SAME_TURN:
                pause = max(0.0, drawn - POLL_SECONDS) / DRAWING_SHARE
                self._show_next = max(self._shown_at + SHOW_SECONDS, now + pause)
        elif text != self._shown and now >= self._show_next:
            context.workspace.status_text_set(text)
            ModalRun.bar = share, text
            redraw_bars(context)
            self._shown_at, self._shown, self._show_next = now, text, None
