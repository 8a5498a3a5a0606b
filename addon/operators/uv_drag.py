# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators share that follow the mouse, in the UV Editor and elsewhere."""

import contextlib
from typing import Any, ClassVar

import bpy

from ..solver.worker import Worker
from .answers import refused
from .modal_run import OperatorBase


class ByHand(OperatorBase):
    """Mixin of operators that follow the mouse. After Esc, a right click and errors `cancel` puts all back."""

    _job: Any
    _worker: Worker | None
    shown_errors: ClassVar[tuple[type[Exception], ...]] = ()  # errors that are shown; others are raised

    def modal(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        try:
            if event.type in {"ESC", "RIGHTMOUSE"} and event.value == "PRESS":
                self.cancel(context)
                self.report({"INFO"}, "Koebe UV: cancelled, nothing was changed")
                return {"CANCELLED"}
            return self._follow(context, event)
        except BaseException as error:
            self.cancel(context)
            if isinstance(error, self.shown_errors):
                return refused(self, self._reason(error))
            raise

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        """Answer an event."""
        raise NotImplementedError

    def _reason(self, error: Exception) -> str:
        return str(error)

    def _end_worker(self) -> None:
        """Cancel the job, and wait for the step at work."""
        self._job.cancel_token.cancel()
        if self._worker is not None:
            with contextlib.suppress(Exception):  # it was cancelled, or nobody needs this step any more
                self._worker.result()
            self._worker = None


class UvDrag(ByHand):
    """Mixin of operators that go on while a button is down in a region of the UV Editor."""

    _region: bpy.types.Region

    def _press(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Note the region in which the mouse was pressed. False if the operator was called in another way."""
        space, region = context.space_data, context.region
        by_hand = event.type == "LEFTMOUSE" and space is not None and space.type == "IMAGE_EDITOR"
        if bpy.app.background or not by_hand or region is None or region.type != "WINDOW":
            return False
        self._region = region
        return True

    def _place(self, x: float, y: float) -> tuple[float, float]:
        """The place of the UVs at a pixel of the region."""
        u, v = self._region.view2d.region_to_view(x, y)
        return u, v
