# SPDX-License-Identifier: GPL-3.0-or-later
"""Unwraps again the islands of an edited mesh whose seams or pins have changed."""

import dataclasses
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import transaction
from ..maps.live import LiveState
from ..maps.outcomes import Progress, Task
from ..maps.parts import PartsOutcome, cut_into_parts, move_parts
from ..maps.wording import explain
from . import native_package


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
    """

    def __init__(
        self, obj: MeshObject, layer: str, before: LiveState, state: LiveState, faces: np.ndarray, choice: Any
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
        self._outcome: PartsOutcome | None = None

    def compute(self, progress: Progress | None = None) -> None:
        """Touches no Blender data. Raises koebe.Cancelled."""
        self._outcome = cut_into_parts(self.koebe, self._task, self._choice, progress, self.cancel_token)
        move_parts(self.koebe, self._outcome, self._choice, True, self.cancel_token)

    def write(self) -> None:
        """Write the islands. Raises TransferError, also if they could not be mapped; then nothing is changed."""
        assert self._outcome is not None
        (one,) = self._outcome.islands
        if one.error is not None:
            raise TransferError(f"{self._task.name}: {explain(one.error)}")
        with transaction() as run:
            plan = map_writing.plan(self._target, self._layer, self._task.surface, one.corners, one.uv)
            map_writing.write(run, plan, select=False)
