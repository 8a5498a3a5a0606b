# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that cuts them into even parts: read, compute, write."""

import dataclasses
from typing import Any

import bpy
import numpy as np

from ..blender import map_writing, mesh_reading, seams
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.transaction import Transaction
from ..layers.uv_density import mean_density
from ..maps.atlas import one_atlas
from ..maps.beside import OVER
from ..maps.options import PartsChoice
from ..maps.outcomes import Progress, Sketch, Task
from ..maps.parts import PartsOutcome, cut_into_parts, move_parts
from ..surfaces.surface import Surface
from .choice_job import ChoiceJob


class PartsJob(ChoiceJob):
    """Has parts as outcomes. On request marks their cuts as seams."""

    choice: PartsChoice

    def __init__(self, *given: Any, **named: Any) -> None:
        self._places: list[np.ndarray] = []  # (V, 3) of each task's vertices in the world
        super().__init__(*given, **named)
        if self.choice.show and all(task.show is None for task in self.tasks):
            raise TransferError(f"Avoid is the vertex group {self.choice.show!r}, but no object has this group")

    @property
    def _cut_at(self) -> str:
        return str(self.choice.cut_at)

    def _task(self, obj: MeshObject, surface: Surface) -> Task:
        show = mesh_reading.vertex_weights(obj, self.choice.show) if self.choice.show else None
        like = self._density_of_layer(obj, surface) if self.choice.texels == "layer" else None
        task = dataclasses.replace(
            super()._task(obj, surface), show=show, like=like, sketch=Sketch()
        )
        self._places.append(surface.positions + np.array(obj.matrix_world.translation))
        return task

    def _check_pins(self, obj: MeshObject, surface: Surface) -> None:
        """Raise TransferError if pinned UVs would move. Otherwise parts join them."""
        choice = self.choice
        if (choice.tiles != 1 or choice.atlas or choice.stack or choice.stack_mirrored) and (
            self._pinned(obj, surface).any()
        ):
            raise TransferError(
                f"{obj.name}: pinned UVs cannot be kept on several tiles, in one atlas or with Overlap: "
                "switch these off"
            )

    def _density_of_layer(self, obj: MeshObject, surface: Surface) -> float:
        """The mean density of the layer that the parts shall be like. Raises TransferError."""
        active = obj.data.uv_layers.active
        layer = self.choice.like or (active and active.name)
        if not layer or layer not in obj.data.uv_layers:
            missing = f"it has no UV layer {layer!r}" if layer else "it has no UVs"
            raise TransferError(f"{obj.name}: {missing} whose density the parts could get: choose another layer")
        density = mean_density(surface, mesh_reading.read_layer(obj, layer))
        if not density > 0.0:
            raise TransferError(f"{obj.name}: the UV layer {layer!r} has no area: choose another layer")
        return density

    def sketched(self) -> np.ndarray:
        """The ends (E, 2, 3) in the world of the cuts that are decided so far; none if nothing is new."""
        cuts = [task.sketch.take() if task.sketch else np.zeros((0, 2), np.int32) for task in self.tasks]
        if not any(map(len, cuts)):  # nearly always
            return super().sketched()
        begins = np.cumsum([0, *map(len, self._places[:-1])])  # one atlas draws all on the first sketch
        ends = np.concatenate([begin + own for begin, own in zip(begins, cuts, strict=True)])
        return np.concatenate(self._places)[ends].astype(np.float32)

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        if self.choice.atlas and len(self.tasks) > 1:
            self.outcomes = one_atlas(self.koebe, self.tasks, self.choice, progress, self.cancel_token)
            for outcome in self.outcomes:
                outcome.remarks += [OVER] * (outcome.task.rest is not None and bool(outcome.mapped))
        else:
            super().compute(progress)

    def _map(self, task: Task, progress: Progress | None) -> PartsOutcome:
        outcome = cut_into_parts(self.koebe, task, self.choice, progress, self.cancel_token)
        self._move(outcome)
        return outcome

    def _move(self, outcome: PartsOutcome) -> None:
        """Put parts in place, or beside the faces that are not selected."""
        move_parts(self.koebe, outcome, self.choice, self.options.placement == "keep", self.cancel_token)

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
