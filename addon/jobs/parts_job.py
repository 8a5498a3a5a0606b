# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that cuts them into even parts: read, compute, write."""

from ..blender.mesh_object import MeshObject
from ..maps.options import Options
from ..maps.outcomes import LATER, Progress
from ..maps.parts import PartsOutcome, cut_into_parts
from .map_job import Job


class PartsJob(Job):
    """Reads and writes as `Job` does, and has parts for outcomes."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        price: float,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        super().__init__(objects, options, selected_only, refused)
        self.price = price
        self.outcomes: list[PartsOutcome] = LATER  # type: ignore[assignment]

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        outcomes, done = [], 0
        total = sum(len(task.surface.triangle_face) for task in self.tasks)
        for task in self.tasks:
            share = len(task.surface.triangle_face)

            def tell(fraction: float, stage: str, done: int = done, share: int = share) -> None:
                assert progress is not None
                progress((done + fraction * share) / total, stage)

            outcomes.append(
                cut_into_parts(self.koebe, task, self.price, tell if progress else None, self.cancel_token)
            )
            done += share
        self.outcomes = outcomes
