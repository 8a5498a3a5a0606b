# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that drags the slider Even, and shows the UVs at once."""

from typing import Any, ClassVar

import bpy

from ..blender.errors import TransferError
from ..blender.targets import reason, target_objects
from ..jobs.even_job import EvenJob
from ..layers.even_drag import EvenDrag
from ..solver.errors import NativeError
from ..solver.worker import Worker
from ..state.option_properties import UNWRAP_OPTION_NAMES, settings_of
from ..surfaces.errors import KnownError
from .answers import refused
from .modal_run import redraw
from .polls import OnTargets
from .uv_drag import ByHand

POLL_SECONDS = 0.01
KEEP = {"LEFTMOUSE", "RET", "NUMPAD_ENTER"}
NOT_PARTS = {"DISK", "RING", "TORUS"}  # shapes whose boundaries stay round


class UV_OT_koebe_even(OnTargets, ByHand, bpy.types.Operator):
    """Drag left or right: the UVs of the active object become more or less even at once. Click or Enter unwraps with
    this Even. Esc or right click puts the UVs back. Shift drags slowly"""

    bl_idname = "uv.koebe_even"
    bl_label = "Koebe Drag Even"
    bl_options = {"REGISTER", "BLOCKING", "GRAB_CURSOR"}
    needs, modes = "Select a mapped mesh object, in Object Mode", ("OBJECT",)
    dragged: ClassVar[str] = ""  # the object whose UVs are dragged now: the circles of its report lie elsewhere

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if settings_of(context).shape == "SPHERE":  # its UVs are no map that the slider could move
            cls.poll_message_set("Set Even and press Unwrap: the UVs of a sphere cannot be dragged")
            return False
        return super().poll(context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        self.report({"ERROR"}, "Koebe UV: only a mouse can drag this slider. In a script, set the "
                    "option even of uv.koebe_unwrap")
        return {"CANCELLED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        settings = settings_of(context)
        obj = target_objects(context)[0]
        is_round = settings.loops == "round" or (settings.loops == "auto" and settings.shape in NOT_PARTS)
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        try:
            self._job = EvenJob(obj, settings.layer, is_round)
        except (NativeError, TransferError, KnownError) as error:
            return refused(self, reason(obj.name, error))
        self._drag = EvenDrag(settings.even, event.mouse_x)
        self._worker = None
        self._way = 0.0
        self.moves = 0
        UV_OT_koebe_even.dragged = obj.name
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        self._say(context)
        return {"RUNNING_MODAL"}

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type in KEEP and event.value == "PRESS":
            return self._keep(context)
        if event.type == "MOUSEMOVE":
            self._drag.pull(event.mouse_x, event.shift)
            self._say(context)
        elif event.type == "TIMER":
            self._go_on(context)
        return {"RUNNING_MODAL"}

    def _go_on(self, context: bpy.types.Context) -> None:
        """Begin the next step, and meanwhile show the step that has ended."""
        ended = self._worker is not None
        if self._worker is not None:
            if self._worker.running:
                return
            self._worker.result()
            self._worker = None
            self._drag.done(self._way)
        even = self._drag.next()
        if even is not None:
            self._worker = Worker(lambda progress: self._step(even))
        if ended:
            self._job.show()
            self.moves += 1
            redraw(context, ("VIEW_3D", "IMAGE_EDITOR"))

    def _step(self, even: float) -> None:
        self._way = self._job.preview.move(even)

    def _keep(self, context: bpy.types.Context) -> set[str]:
        """Put the UVs back and unwrap with this E: the checked map, in one undo step."""
        settings, even = settings_of(context), self._drag.even
        self.cancel(context)
        if not self._drag.has_changed:
            return {"CANCELLED"}
        settings.even, settings.keep_angles = even, False
        options = {name: getattr(settings, name) for name in UNWRAP_OPTION_NAMES}
        unwrap: Any = bpy.ops.uv
        unwrap.koebe_unwrap("INVOKE_DEFAULT", **options)
        return {"FINISHED"}

    def cancel(self, context: bpy.types.Context) -> None:
        """End the computation and restore the UVs: after Esc, or when Blender ends the operator."""
        self._end_worker()
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        UV_OT_koebe_even.dragged = ""
        self._job.put_back()
        redraw(context)

    def _say(self, context: bpy.types.Context) -> None:
        keys = "Click or Enter: Unwrap with This Even      Shift: Slowly      Esc: Cancel"
        text = f"Koebe UV: Even {self._drag.even:.2f}      {keys}"
        context.workspace.status_text_set(text)
