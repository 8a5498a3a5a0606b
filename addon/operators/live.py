# SPDX-License-Identifier: GPL-3.0-or-later
"""Live: the islands of the edited mesh follow when a seam, a pin or a vertex changes."""

import time
from typing import Any

import bpy
from bpy.props import BoolProperty

from ..blender.errors import TransferError
from ..jobs.live_job import LiveJob, read_state
from ..maps.live import LiveState
from ..maps.options import OptionError
from ..solver.errors import NativeError
from ..solver.worker import Worker
from ..state.option_properties import choice_of, settings_of
from ..state.run_report import even_of
from ..surfaces.errors import KnownError
from .modal_run import listen, redraw

QUIET_SECONDS = 0.15  # without a change, before anything is computed: not during a drag
POLL_SECONDS = 0.05
OWN_SECONDS = 0.3  # after a look at the mesh, which Blender reports as a change of it: or looking would never end


class _Live:
    """What is known of the edited mesh, and the computation that runs.

    message  why the last change was not followed, or empty
    """

    def __init__(self) -> None:
        self.forget()

    def forget(self) -> None:
        """The state at first."""
        self.message = ""
        self._key: tuple[str, str] | None = None  # object and layer
        self._state: LiveState | None = None
        self._even: float | None = None  # E of the layer's last map
        self._next: LiveState | None = None  # as the running job read it
        self._job: LiveJob | None = None
        self._worker: Worker | None = None
        self._changed = 0.0  # seconds
        self._looked = 0.0  # seconds, when a look has found nothing new
        self._is_new = True  # what is there now is no change: after undo, and at first

    def touch(self, is_new: bool = False) -> None:
        """The mesh has changed. @param is_new not by the hand"""
        if not is_new and time.monotonic() - self._looked < OWN_SECONDS:
            self._looked = 0.0
            return
        self._changed, self._is_new = time.monotonic(), self._is_new or is_new
        if not bpy.app.background and not bpy.app.timers.is_registered(_tick):
            bpy.app.timers.register(_tick, first_interval=POLL_SECONDS)

    def step(self) -> float | None:
        """Does what can be done now. Returns the seconds until the next step, or None if nothing is left to do."""
        if self._worker is not None:
            if self._worker.running:
                return POLL_SECONDS
            self._end()
        if time.monotonic() - self._changed < QUIET_SECONDS:
            return POLL_SECONDS
        try:
            return self._begin()
        except (KnownError, TransferError, NativeError, OptionError) as error:
            self.message = str(error)
            return None

    def _begin(self) -> float | None:
        obj: Any = bpy.context.view_layer.objects.active
        if obj is None or obj.type != "MESH" or obj.mode != "EDIT" or obj.data.uv_layers.active is None:
            self._key = None
            return None
        key, now = (obj.name, obj.data.uv_layers.active.name), read_state(obj, obj.data.uv_layers.active.name)
        before = self._state
        is_new = self._is_new or key != self._key or before is None or not now.is_same_mesh(before)
        if key != self._key:
            self._even = even_of(bpy.context, *key)
        self._key, self._is_new = key, False
        faces = None if is_new or before is None else now.concerned(before)
        if before is None or faces is None or not faces.any():
            self._state, self._looked = now, time.monotonic()
            return None
        self._next = now
        self._job = LiveJob(obj, key[1], before, now, faces, choice_of("parts", settings_of(bpy.context)), self._even)
        self._worker = Worker(self._job.compute)
        return POLL_SECONDS

    def _end(self) -> None:
        worker, job = self._worker, self._job
        self._worker = self._job = None
        assert worker is not None and job is not None
        self._state, self.message = self._next, ""
        if self._is_new:  # undone meanwhile
            return
        try:
            worker.result()
            self._even = job.even
            job.write()
        except (KnownError, TransferError) as error:
            self.message = str(error)
        except job.koebe.Cancelled:
            return
        else:
            _push_undo()
        for window in bpy.context.window_manager.windows:
            for area in window.screen.areas:
                area.tag_redraw()

    def stop(self) -> None:
        """End the computation, and forget everything."""
        if self._job is not None:
            self._job.cancel_token.cancel()
        self.forget()


live = _Live()


def _push_undo() -> None:
    """An undo step of its own: so undo goes back to each state that was seen."""
    windows = bpy.context.window_manager.windows
    if bpy.app.background or not windows:
        return
    with bpy.context.temp_override(window=windows[0]):
        bpy.ops.ed.undo_push(message="Koebe Live")


def _tick() -> float | None:
    return live.step() if is_on() else None


def is_on() -> bool:
    """Whether Live is switched on."""
    return bool(getattr(bpy.context.window_manager, "koebe_live", False))


@bpy.app.handlers.persistent
def after_update(scene: bpy.types.Scene, depsgraph: bpy.types.Depsgraph) -> None:
    """Called by Blender after changes."""
    if is_on() and any(isinstance(update.id, bpy.types.Mesh) for update in depsgraph.updates):
        live.touch()


@bpy.app.handlers.persistent
def after_undo(*_: object) -> None:
    """Called by Blender after undo and redo, and after a file was opened: what is there then stays."""
    if is_on():
        live.touch(is_new=True)


HANDLERS = (
    (bpy.app.handlers.depsgraph_update_post, after_update),
    (bpy.app.handlers.undo_post, after_undo),
    (bpy.app.handlers.redo_post, after_undo),
    (bpy.app.handlers.load_post, after_undo),
)


def _listen(is_listening: bool) -> None:
    """Add the handlers, or remove them."""
    listen(HANDLERS, is_listening)
    if not is_listening:
        live.stop()
        if bpy.app.timers.is_registered(_tick):
            bpy.app.timers.unregister(_tick)


def _switched(manager: bpy.types.WindowManager, context: bpy.types.Context) -> None:
    _listen(is_on())
    if is_on():
        live.touch(is_new=True)
    redraw(context)


def register() -> None:
    """Add the switch. It is off in each session."""
    manager: Any = bpy.types.WindowManager
    manager.koebe_live = BoolProperty(
        name="Live",
        description="In Edit Mode let an island follow when one of its seams is marked or cleared, one of its pins "
        "is moved, or its vertices are. It stays where it lies, and the other islands are not touched",
        options={"SKIP_SAVE"},
        update=_switched,
    )


def unregister() -> None:
    """The reverse of `register`."""
    _listen(False)
    manager: Any = bpy.types.WindowManager
    del manager.koebe_live
