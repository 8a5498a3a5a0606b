# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that cuts them into even parts: read, compute, write."""

import bpy

from ..blender import map_writing, seams
from ..blender.errors import TransferError
from ..blender.transaction import Transaction
from ..maps.options import PartsChoice
from ..maps.outcomes import Progress, Task
from ..maps.parts import PartsOutcome, cut_into_parts
from .choice_job import ChoiceJob


class PartsJob(ChoiceJob):
    """Has parts as outcomes. On request marks their cuts as seams."""

    choice: PartsChoice

    def _map(self, task: Task, progress: Progress | None) -> PartsOutcome:
        return cut_into_parts(self.koebe, task, self.choice, progress, self.cancel_token)

    def _write_one(
        self, run: Transaction, outcome: PartsOutcome, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        super()._write_one(run, outcome, plan, material)
        if self.choice.write_seams:
            (one,) = outcome.islands
            try:
                seams.mark_seams(run, plan.obj, one.cuts)
            except TransferError as error:  # the map is there nevertheless
                outcome.remarks.append(f"its cuts were not marked as seams. {error}")
