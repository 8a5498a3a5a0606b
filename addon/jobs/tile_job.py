# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects that maps them to tiles of flat tori or cylinders: read, compute, write."""

import dataclasses
from typing import Any

import numpy as np

from ..blender import checker, map_writing, mesh_reading
from ..blender.mesh_object import MeshObject
from ..maps.json_report import tile_entries
from ..maps.options import Options, TileChoice
from ..maps.outcomes import LATER, Progress, share_of
from ..maps.surface import Surface
from ..maps.tile_pattern import Pattern
from ..maps.tiles import TileOutcome, islands_to_tile, map_tiles
from .map_job import Job

OTHER_PERIODS = "its tiles have other periods: the checker runs over the cuts of the largest one"


class TileJob(Job):
    """Reads and writes as `Job` does, and has tiles for outcomes."""

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        choice: TileChoice,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. @param options of which layer and checker count. Raises as `Job`."""
        self.choice = choice
        self._picked: dict[str, np.ndarray] = {}  # by object: vertices (V,) that tell which loops are the rims
        super().__init__(objects, options, selected_only, refused)
        self.outcomes: list[TileOutcome] = LATER  # type: ignore[assignment]

    def _surface(self, obj: MeshObject, selected_only: bool) -> Surface:
        """The surface, in Edit Mode of the selected faces. Where vertices tell which loops are the rims, because that
        is asked for or no face is selected, it is all of the islands that have such vertices."""
        surface = super()._surface(obj, selected_only)
        if self.choice.domain != "ring" or not selected_only:
            return surface
        picked = mesh_reading.selected_vertices(obj)
        self._picked[obj.name] = picked
        if self.choice.rims != "selected" and surface.selected.any():
            return surface
        shown = dataclasses.replace(surface, selected=mesh_reading.shown_faces(obj))
        selected = np.zeros_like(surface.selected)
        for island in islands_to_tile(shown):
            if picked[island.source_vertex].any():
                selected[island.faces] = True
        return dataclasses.replace(surface, selected=selected)

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        outcomes, done = [], 0
        total = sum(len(task.surface.triangle_face) for task in self.tasks)
        for task in self.tasks:
            share = len(task.surface.triangle_face)

            picked, part = self._picked.get(task.name), share_of(progress, done, share, total)
            outcomes.append(map_tiles(self.koebe, task, self.choice, picked, part, self.cancel_token))
            done += share
        self.outcomes = outcomes

    def line(self, outcome: TileOutcome) -> str:
        """One line on a surface of which something was mapped."""
        return outcome.line()

    def entries(self, outcome: TileOutcome) -> list[dict[str, Any]]:
        """One entry of the JSON report per island."""
        return tile_entries(outcome)

    def _pattern(self, plan: map_writing.Plan, size: float) -> Pattern:
        """The checker that runs over the cuts."""
        pattern, alike = checker.pattern_for(plan.surface, plan.uv, size)
        if not alike:
            outcome = next(one for one in self.outcomes if one.name == plan.obj.name)
            outcome.remarks.append(OTHER_PERIODS)
        return pattern
