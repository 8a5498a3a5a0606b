# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that maps each by itself, as a choice says."""

from typing import Any

from ..blender.mesh_object import MeshObject
from ..maps.options import Options
from ..maps.outcomes import Outcome, Progress, Task, share_of
from .map_job import Job


class ChoiceJob(Job):
    """Reads and writes as `Job` does. A kind of map is a subclass that says how one task is mapped."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: Any,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        self.choice = choice
        self._begin()
        super().__init__(objects, options, selected_only, refused)

    def _begin(self) -> None:
        """Make what has to be there before the objects are read."""

    def _size(self, task: Task) -> int:
        """How much work a task is, beside others."""
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
