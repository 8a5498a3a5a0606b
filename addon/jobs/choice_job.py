# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that maps each by itself, with the settings of a choice."""

from typing import Any

import numpy as np

from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..maps.options import Options
from ..maps.outcomes import Outcome, Progress, Task, share_of
from ..maps.wording import counted
from ..surfaces.surface import Surface
from .map_job import Job


class ChoiceJob(Job):
    """Reads and writes as `Job`. Each kind of map is a subclass that maps one task."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: Any,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options only layer, checker and threads are used. Raises as `Job`."""
        self.choice = choice
        self._begin()
        super().__init__(objects, options, selected_only, refused)

    @property
    def _importance(self) -> str:
        return str(getattr(self.choice, "importance", ""))

    def _check_pins(self, obj: MeshObject, surface: Surface) -> None:
        """Raise TransferError if there are pinned UVs: a tile has its place in the square, and its periods."""
        pins = self._pinned(obj, surface)
        if pins.any():
            count = counted(len(np.unique(surface.corner_vertex[pins])), "vertex", "vertices")
            raise TransferError(
                f"{obj.name}: pinned UVs of {count} would move. Unwrap to Parts keeps them. Or in the UV Editor Shift "
                "P selects them and Alt P unpins them"
            )

    def _begin(self) -> None:
        """Prepare before the objects are read."""

    def _size(self, task: Task) -> int:
        """The amount of work of a task, relative to others."""
        return len(task.surface.triangle_face)

    def _map(self, task: Task, progress: Progress | None) -> Outcome:
        raise NotImplementedError

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        outcomes, done = [], 0
        sizes = [self._size(task) for task in self.tasks]
        for task, size in zip(self.tasks, sizes, strict=True):
            outcomes.append(self._map(task, share_of(progress, done, size, sum(sizes))))
            done += size
        self.outcomes = outcomes
