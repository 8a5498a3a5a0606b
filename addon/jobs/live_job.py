# SPDX-License-Identifier: GPL-3.0-or-later
"""Lets the islands of an edited mesh follow whose seams, pins or vertices have changed."""

import contextlib
import dataclasses
import threading
import time
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import transaction
from ..maps.live import LiveState, follow, joined, parted
from ..maps.outcomes import Progress, Task
from ..maps.parts import PartsIsland, cut_into_parts, move_parts
from ..maps.wording import explain
from ..surfaces.errors import MapError
from . import native_package

LONGEST = 10.0  # processor seconds until it gives up: a pin far outside its island must not end the work with Live
LOOK_SECONDS = 0.25


def read_state(obj: MeshObject, layer: str) -> LiveState:
    """The state of an object in Edit Mode. Raises TransferError."""
    check_mesh(obj)
    surface = mesh_reading.read_surface(obj, selected_only=False)
    uv = mesh_reading.read_layer(obj, layer)
    pinned = mesh_reading.pinned_corners(obj, layer)
    return LiveState(surface, uv, np.where(pinned[:, None], uv, np.nan))


class LiveJob:
    """A new map of some islands, cut along seams only, where they lay before. Raises NativeError.

    faces   (P,) bool, of these islands
    choice  a `PartsChoice`
    even    E of the layer, if it is known. Where the angles are kept, finding it takes most of the time
    """

    def __init__(
        self,
        obj: MeshObject,
        layer: str,
        before: LiveState,
        state: LiveState,
        faces: np.ndarray,
        choice: Any,
        even: float | None,
    ) -> None:
        self.koebe = native_package.load()
        self.cancel_token = self.koebe.CancelToken()
        self._choice = dataclasses.replace(
            choice, seams="only", stack=False, stack_mirrored=False, atlas=False, tiles=1
        )
        self._target, self._layer = Target.of(obj), layer
        surface = dataclasses.replace(state.surface, selected=faces)
        pins = np.where(np.repeat(faces, surface.face_size)[:, None], state.pins, np.nan)
        has_pins = bool(np.isfinite(pins).any())
        self._task = Task(obj.name, surface, old_uv=before.uv, rest=state.uv, pins=pins if has_pins else None)
        self._near = state.near(before, faces)  # what follows of a large island
        self.even = even if choice.keep_angles else choice.even
        self._cleared = before.surface.seam & ~state.surface.seam
        self._made: tuple[np.ndarray, np.ndarray] | None = None
        self._late = False

    def compute(self, progress: Progress | None = None) -> None:
        """Touches no Blender data. Raises TransferError, also if it takes too long, or koebe.Cancelled."""
        done = threading.Event()
        threading.Thread(target=self._watch, args=(done,), daemon=True).start()
        try:
            self._compute(progress)
        except self.koebe.Cancelled:
            if not self._late:
                raise
            raise TransferError(
                f"{self._task.name}: its islands did not follow within {LONGEST:.0f} s: go in smaller steps, or press "
                "Unwrap"
            ) from None
        finally:
            done.set()

    def _watch(self, done: threading.Event) -> None:
        """Raise the token if it takes too long."""
        begin = time.process_time()
        while not done.wait(LOOK_SECONDS):
            if time.process_time() - begin > LONGEST:
                self._late = True
                self.cancel_token.cancel()
                return

    def _compute(self, progress: Progress | None) -> None:
        if self.even is not None:
            for task, start in self._starts(progress):
                with contextlib.suppress(MapError):  # pins that are in the way there may not be in another map's
                    self._made = follow(self.koebe, task, start, self.even, self.cancel_token)
                if self._near is not None and task.surface is self._near.surface:
                    self._made = self._beside_the_others(self._made)
                if self._made is not None:
                    return
        one = self._anew(self._task, self._choice, progress)
        self._made, self.even = (one.corners, one.uv), one.result.even

    def _starts(self, progress: Progress | None) -> Iterator[tuple[Task, np.ndarray]]:
        """What follows, and UVs (C, 2) that it may follow from: where the islands lie, at first near the change; if
        they have grown together, brought together, or a conformal map."""
        assert self._task.old_uv is not None
        if not self._cleared.any():
            if self._near is not None:
                apart, held = parted(self._near)
                yield Task(self._task.name, self._near.surface, pins=held), apart
            yield self._task, self._task.old_uv
            return
        start = joined(self._task.surface, self._cleared, self._task.old_uv)
        if start is not None:
            yield self._task, start
        conformal = dataclasses.replace(self._choice, keep_angles=False, even=0.0)
        with contextlib.suppress(TransferError):
            one = self._anew(dataclasses.replace(self._task, pins=None, rest=None), conformal, progress)
            start = self._task.old_uv.copy()
            start[one.corners] = one.uv
            yield self._task, start

    def _beside_the_others(self, made: tuple[np.ndarray, np.ndarray] | None) -> tuple[np.ndarray, np.ndarray] | None:
        """What is near the change, by corners of the whole surface, or None if it lies over other faces."""
        if made is None:
            return None
        assert self._near is not None and self._task.old_uv is not None
        corners, uv = self._near.corners[made[0]], self._task.old_uv.copy()
        uv[corners] = made[1]
        if self._near.is_free and self._near.lies_over(self.koebe, self._task.surface, uv):
            return None
        return corners, made[1]

    def _anew(self, task: Task, choice: Any, progress: Progress | None) -> PartsIsland:
        """A map of its own. Raises TransferError."""
        outcome = cut_into_parts(self.koebe, task, choice, progress, self.cancel_token)
        move_parts(self.koebe, outcome, choice, True, self.cancel_token)
        (one,) = outcome.islands
        if one.error is not None:
            raise TransferError(f"{task.name}: {explain(one.error)}")
        return one

    def write(self) -> None:
        """Write the islands. Raises TransferError; then nothing is changed."""
        assert self._made is not None
        with transaction() as run:
            plan = map_writing.plan(self._target, self._layer, self._task.surface, *self._made)
            map_writing.write(run, plan, select=False)
