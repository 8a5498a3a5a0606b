# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that maps them to domains that are no disks: read, compute, write."""

from typing import Any

import bpy
import numpy as np

from ..blender import checker, map_writing
from ..blender.copied_object import add_copied_object
from ..blender.mesh_object import MeshObject
from ..blender.transaction import Transaction
from ..maps.domain_outcomes import DomainChoice, DomainOutcome
from ..maps.handles import SchottkyOutcome, map_handles
from ..maps.json_report import domain_entries
from ..maps.options import Options, SchottkyChoice, SphereChoice
from ..maps.outcomes import LATER, Progress, Task, share_of
from ..maps.sphere_copy import sphere_copy
from ..maps.spheres import SphereOutcome, map_spheres
from ..maps.tile_pattern import Pattern
from .map_job import Job

BESIDE = 0.1  # of an object's size, between it and its sphere
OTHER_PERIODS = "its tiles have other periods: the checker runs over the cuts of the largest one"


class DomainJob(Job):
    """Reads and writes as `Job` does, and has outcomes of other domains."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: DomainChoice,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        self.choice: Any = choice
        super().__init__(objects, options, selected_only, refused)
        self.outcomes: list[DomainOutcome] = LATER  # type: ignore[assignment]

    def _map(self, task: Task, progress: Progress | None) -> DomainOutcome:
        raise NotImplementedError

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        outcomes, done = [], 0
        total = sum(len(task.surface.triangle_face) for task in self.tasks)
        for task in self.tasks:
            share = len(task.surface.triangle_face)
            outcomes.append(self._map(task, share_of(progress, done, share, total)))
            done += share
        self.outcomes = outcomes

    def line(self, outcome: DomainOutcome) -> str:
        """One line on a surface of which something was mapped."""
        return outcome.line()

    def entries(self, outcome: DomainOutcome) -> list[dict[str, Any]]:
        """One entry of the JSON report per island."""
        return domain_entries(outcome)

    def _pattern(self, plan: map_writing.Plan, size: float) -> Pattern:
        """The checker that runs over the cuts."""
        pattern, alike = checker.pattern_for(plan.surface, plan.uv, size)
        if not alike:
            outcome = next(one for one in self.outcomes if one.name == plan.obj.name)
            outcome.remarks.append(OTHER_PERIODS)
        return pattern


class SphereJob(DomainJob):
    """Maps to spheres. Asked to, it adds these as objects, beside their sources."""

    choice: SphereChoice
    outcomes: list[SphereOutcome]  # type: ignore[assignment]

    def _map(self, task: Task, progress: Progress | None) -> SphereOutcome:
        return map_spheres(self.koebe, task, self.choice, progress, self.cancel_token)

    def _write_one(
        self, run: Transaction, outcome: SphereOutcome, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        super()._write_one(run, outcome, plan, material)  # type: ignore[arg-type]
        if self.choice.add_sphere:
            origin: Any = plan.obj.matrix_world.translation
            across = outcome.task.surface.positions[:, 0]
            right = origin.x + float(across.max() + BESIDE * np.ptp(across))
            place, copy = (right, origin.y, origin.z), sphere_copy(outcome)
            add_copied_object(run, bpy.context, plan.obj, copy, self.options.layer, plan.uv, place, "Sphere")


class SchottkyJob(DomainJob):
    """Maps to fundamental domains of Schottky groups."""

    choice: SchottkyChoice

    def _map(self, task: Task, progress: Progress | None) -> SchottkyOutcome:
        return map_handles(self.koebe, task, self.choice, progress, self.cancel_token)
