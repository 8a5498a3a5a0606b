# SPDX-License-Identifier: GPL-3.0-or-later
"""How an operator computes without a frozen window: on a thread, with progress, Esc and polling."""

import time
from typing import TYPE_CHECKING, Any

import bpy

from ..solver.worker import Worker

# What the status line calls the stages of a computation.
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
}
POLL_SECONDS = 0.05  # how often a running computation is looked at: Esc acts within this and one checkpoint
SHOW_SECONDS = 0.25  # how often its progress is shown: each time Blender puts the whole window together again
# While a computation runs the view may be moved; everything else could change what is being mapped.
NAVIGATION = {
    "MOUSEMOVE", "INBETWEEN_MOUSEMOVE", "MIDDLEMOUSE", "WHEELUPMOUSE", "WHEELDOWNMOUSE",
    "WHEELINMOUSE", "WHEELOUTMOUSE", "TRACKPADPAN", "TRACKPADZOOM", "MOUSEROTATE", "NDOF_MOTION",
}  # fmt: skip

if TYPE_CHECKING:  # what is mixed into operators is one for the type checker alone
    OperatorBase = bpy.types.Operator
else:
    OperatorBase = object


def redraw(context: bpy.types.Context) -> None:
    """Let all editors of the window show what has changed."""
    for area in context.screen.areas if context.screen else ():
        area.tag_redraw()


class ModalRun(OperatorBase):
    """Mixed into operators that gather, compute and write. In the background, and where a script calls, all at once.

    A job has `compute(progress)`, which touches no Blender data, and a `cancel_token`.
    """

    def _job(self, context: bpy.types.Context) -> Any:
        """The job, or None where there is nothing to do and the user was told why."""
        raise NotImplementedError

    def _finish(self, context: bpy.types.Context, job: Any) -> set[str]:
        """Write what the job has computed."""
        raise NotImplementedError

    def execute(self, context: bpy.types.Context) -> set[str]:
        job = self._job(context)
        if job is None:
            return {"CANCELLED"}
        manager = context.window_manager
        manager.progress_begin(0, 100)
        try:
            job.compute(lambda fraction, stage: manager.progress_update(int(100 * fraction)))
        finally:
            manager.progress_end()
        return self._finish(context, job)

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if bpy.app.background:
            return self.execute(context)
        job = self._job(context)
        if job is None:
            return {"CANCELLED"}
        self._running = job
        self._worker = Worker(job.compute)
        self._shown_at, self._shown = time.monotonic(), ""
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "ESC" and event.value == "PRESS":
            # The thread has arrays of its own and ends at its next checkpoint: nobody has to wait for it.
            self.cancel(context)
            self.report({"INFO"}, "Koebe UV: cancelled, nothing was changed")
            return {"CANCELLED"}
        if event.type == "TIMER":
            self._show_progress(context)
            if not self._worker.running:
                return self._end(context)
        return {"PASS_THROUGH"} if event.type in NAVIGATION else {"RUNNING_MODAL"}

    def cancel(self, context: bpy.types.Context) -> None:
        """Give up: by Esc, or when Blender ends the operator, as when it quits."""
        self._running.cancel_token.cancel()
        self._stop_polling(context)

    def _end(self, context: bpy.types.Context) -> set[str]:
        self._stop_polling(context)
        self._worker.result()
        return self._finish(context, self._running)

    def _stop_polling(self, context: bpy.types.Context) -> None:
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)

    def _show_progress(self, context: bpy.types.Context) -> None:
        stage = STAGES.get(self._worker.stage, self._worker.stage)
        text = f"Koebe UV: {100 * self._worker.fraction:.0f} % done, {stage}      Esc: Cancel"
        now = time.monotonic()
        if text != self._shown and now >= self._shown_at + SHOW_SECONDS:
            context.workspace.status_text_set(text)
            self._shown_at, self._shown = now, text
