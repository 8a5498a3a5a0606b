# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that gives each the shape that serves it: a disk or parts."""

import bpy

from ..blender import map_writing
from ..blender.transaction import Transaction
from ..maps.automatic import map_automatically
from ..maps.outcomes import Outcome, Progress, Task
from ..maps.parts import PartsOutcome
from .map_job import Job
from .parts_job import PartsJob


class AutoJob(PartsJob):
    """Has outcomes of both kinds."""

    def _map(self, task: Task, progress: Progress | None) -> Outcome:
        outcome = map_automatically(self.koebe, task, self.options, self.choice, progress, self.cancel_token)
        if isinstance(outcome, PartsOutcome):
            self._move(outcome)
        return outcome

    def _write_one(
        self, run: Transaction, outcome: Outcome, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        if isinstance(outcome, PartsOutcome):
            super()._write_one(run, outcome, plan, material)
        else:
            Job._write_one(self, run, outcome, plan, material)
