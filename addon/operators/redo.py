# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that looks after a run from the redo panel: the window stays alive, and the last map in it."""

from typing import Any

import bpy

from ..jobs.map_job import Job
from .modal_run import listen
from .run_operator import MapOperator
from .waiting_run import Waiting, forget_waiting


class UV_OT_koebe_redo(MapOperator, bpy.types.Operator):
    """Ends a run that was started from the redo panel"""

    bl_idname = "uv.koebe_redo"
    bl_label = "Koebe Redo"
    bl_options = {"INTERNAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        return {"CANCELLED"}  # there is nothing to look after

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        run = Waiting.last
        if run is None:
            return {"CANCELLED"}
        self._run = run
        context.evaluated_depsgraph_get()
        run.settled = True
        listen(HANDLERS, True)
        return self._start(context, run.job, None, run.worker)

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if Waiting.last is not self._run:  # another one has taken its place, or the user went on
            if event.type != "TIMER":
                return {"PASS_THROUGH"}
            if Waiting.last is None:
                self.report({"INFO"}, "Koebe UV: the model was changed, so the last map stays")
            self.cancel(context)
            return {"CANCELLED", "PASS_THROUGH"}
        answer = super().modal(context, event)
        if answer == {"RUNNING_MODAL"} and event.type != "ESC":
            return {"PASS_THROUGH"}  # the redo panel stays in use
        return answer

    def _stop_polling(self, context: bpy.types.Context) -> None:
        super()._stop_polling(context)
        if Waiting.last is self._run:
            Waiting.last = None
        if Waiting.last is None:
            listen(HANDLERS, False)

    def _finish(self, context: bpy.types.Context, job: Job) -> set[str]:
        """Put the new map in the place of the last one, in an undo step of its own.

        With another name, as the redo panel goes back to before the last step with the operator's name.
        """
        if job.mapped_any:
            self._run.preview.put_back()
        answer = super()._finish(context, job)
        if answer == {"FINISHED"}:
            Waiting.done = self._run.label, job
            bpy.ops.ed.undo_push(message=f"{self._run.label} Again")
        return answer


@bpy.app.handlers.persistent
def after_update(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Called by Blender after changes, which the last map is part of: what it replaced is no longer known."""
    if len(depsgraph.updates):
        after_undo()


@bpy.app.handlers.persistent
def after_undo(*_: object) -> None:
    """Called by Blender after undo and redo, and after a file was opened."""
    if Waiting.last is not None and Waiting.last.settled:
        forget_waiting()


HANDLERS: tuple[tuple[Any, Any], ...] = (
    (bpy.app.handlers.depsgraph_update_post, after_update),
    (bpy.app.handlers.undo_post, after_undo),
    (bpy.app.handlers.redo_post, after_undo),
    (bpy.app.handlers.load_post, after_undo),
)


def register() -> None:
    """Register the operator."""
    bpy.utils.register_class(UV_OT_koebe_redo)


def unregister() -> None:
    """The reverse of `register`."""
    forget_waiting()
    Waiting.done = None
    listen(HANDLERS, False)
    bpy.utils.unregister_class(UV_OT_koebe_redo)
