# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that cuts them into even parts: read, compute, write."""

import dataclasses
from typing import Any

import bpy

from ..blender import map_writing, mesh_reading, seams
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.transaction import Transaction
from ..maps.options import PartsChoice
from ..maps.outcomes import Progress, Task
from ..maps.parts import PartsOutcome, cut_into_parts
from ..maps.surface import Surface
from .choice_job import ChoiceJob


class PartsJob(ChoiceJob):
    """Has parts as outcomes. On request marks their cuts as seams."""

    choice: PartsChoice

    def __init__(self, *given: Any, **named: Any) -> None:
        super().__init__(*given, **named)
        if self.choice.show and all(task.show is None for task in self.tasks):
            raise TransferError(f"Show is the vertex group {self.choice.show!r}, but no object has this group")

    def _task(self, obj: MeshObject, surface: Surface) -> Task:
        show = mesh_reading.vertex_weights(obj, self.choice.show) if self.choice.show else None
        return dataclasses.replace(super()._task(obj, surface), show=show)

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
