# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that cuts them into even parts: read, compute, write."""

from typing import Any

import bpy

from ..blender import map_writing, seams
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.transaction import Transaction
from ..maps import json_report
from ..maps.options import Options, PartsChoice
from ..maps.outcomes import LATER, Progress, share_of
from ..maps.parts import PartsOutcome, cut_into_parts
from .map_job import Job


class PartsJob(Job):
    """Reads and writes as `Job` does, and has parts for outcomes."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: PartsChoice,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        super().__init__(objects, options, selected_only, refused)
        self.choice = choice
        self.outcomes: list[PartsOutcome] = LATER  # type: ignore[assignment]

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        outcomes, done = [], 0
        total = sum(len(task.surface.triangle_face) for task in self.tasks)
        for task in self.tasks:
            share = len(task.surface.triangle_face)

            part = share_of(progress, done, share, total)
            outcomes.append(cut_into_parts(self.koebe, task, self.choice, part, self.cancel_token))
            done += share
        self.outcomes = outcomes

    def line(self, outcome: PartsOutcome) -> str:
        """One line on an object."""
        return outcome.line()

    def entries(self, outcome: PartsOutcome) -> list[dict[str, Any]]:
        """The entry of the JSON report."""
        return [json_report.parts_entry(outcome)]

    def _write_one(
        self, run: Transaction, outcome: PartsOutcome, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        super()._write_one(run, outcome, plan, material)  # type: ignore[arg-type]
        if self.choice.write_seams and outcome.cuts is not None:
            try:
                seams.mark_seams(run, plan.obj, outcome.cuts)
            except TransferError as error:  # the map is there all the same
                outcome.remarks.append(f"its cuts are no seams. {error}")
