# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that maps them to other domains than the disk: read, compute, write."""

from typing import Any

import bpy
import numpy as np

from ..blender import checker, map_writing
from ..blender.copied_object import add_copied_object
from ..blender.transaction import Transaction
from ..layers.tile_pattern import Pattern
from ..maps.beside import OVER
from ..maps.domain_outcomes import DomainOutcome, map_domain
from ..maps.outcomes import Progress, Task
from ..maps.sphere_copy import sphere_copy
from ..maps.spheres import SphereOutcome
from .choice_job import ChoiceJob

BESIDE = 0.1  # of an object's size, between the object and its sphere
OTHER_PERIODS = "its tiles differ in size: only on the largest tile the checker runs over the cut without a seam"


class DomainJob(ChoiceJob):
    """Maps to the domain of its choice."""

    def _map(self, task: Task, progress: Progress | None) -> DomainOutcome:
        outcome = map_domain(self.koebe, task, self.choice, progress, self.cancel_token, self.options.threads)
        if task.rest is not None and np.isfinite(task.rest).all() and np.ptp(task.rest, axis=0).max() > 0.0:
            outcome.hints.append(OVER)  # a tile needs its place in the square
        return outcome

    def _pattern(self, plan: map_writing.Plan, size: float) -> Pattern:
        """The checker that continues over the cuts."""
        pattern, alike = checker.pattern_for(plan.surface, plan.uv, size)
        if not alike:
            outcome = next(one for one in self.outcomes if one.name == plan.obj.name)
            outcome.remarks.append(OTHER_PERIODS)
        return pattern


class SphereJob(DomainJob):
    """Maps to spheres. On request adds the spheres as objects, beside their sources."""

    def _write_one(
        self, run: Transaction, outcome: SphereOutcome, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        super()._write_one(run, outcome, plan, material)
        if self.choice.add_sphere:
            origin: Any = plan.obj.matrix_world.translation
            across = outcome.task.surface.positions[:, 0]
            right = origin.x + float(across.max() + BESIDE * np.ptp(across))
            place, copy = (right, origin.y, origin.z), sphere_copy(outcome)
            add_copied_object(run, bpy.context, plan.obj, copy, self.options.layer, plan.uv, place, "Sphere")
