# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces without handles as spheres: from a surface to UV coordinates of its corners."""

import dataclasses
import functools
from types import ModuleType
from typing import Any

import numpy as np

from .domain_outcomes import DomainIsland, DomainOutcome, checked_loops, islands_to_map, map_islands
from .options import SphereChoice
from .outcomes import LATER, Progress, Task
from .surface import Surface
from .triangles import areas, density_ratio
from .wording import counted

WHERE_TORN = {"equirectangular": "round a pole", "octahedral": "round the middle of a side of the square"}


@dataclasses.dataclass
class SphereIsland(DomainIsland):
    """What became of one island: a result of `koebe.sphere_map`, or an error.

    torn     triangles (k,) that fit to no UVs of the layout
    """

    torn: np.ndarray = LATER

    @functools.cached_property
    def density_ratio(self) -> float:
        """On the sphere: length per length on the surface, at 95 % of the area over that at 5 %."""
        return density_ratio(self.island.areas, areas(self.result.points, self.island.triangles))

    @property
    def torn_faces(self) -> np.ndarray:
        """Faces of the surface with torn triangles."""
        return np.unique(self.island.triangle_face[self.torn])


class SphereOutcome(DomainOutcome):
    """What became of one surface: each island has the layout for itself."""

    choice: SphereChoice

    def notes(self, one: SphereIsland) -> list[str]:
        count = len(one.torn_faces)
        text = f"{counted(count, 'face')} {WHERE_TORN[self.choice.layout]} torn in the UVs: none fit there"
        return [text] if count else []

    def figures(self) -> list[str]:
        caps = sum(len(one.result.loops) for one in self.mapped)
        torn = sum(len(one.torn_faces) for one in self.mapped)
        return [self.choice.layout, counted(caps, "cap"), f"{torn} torn"]


def map_spheres(
    koebe: ModuleType, task: Task, choice: SphereChoice, progress: Progress | None = None, cancel: Any = None
) -> SphereOutcome:
    """Map each island of the selected faces of a surface to the sphere. Polygons stay whole.

    Errors are those of their islands; `koebe.Cancelled` goes on.
    """
    outcome = SphereOutcome(task, choice, [SphereIsland(island) for island in islands_to_map(task.surface)])

    def map_one(one: SphereIsland, own: Progress | None) -> None:
        _map(koebe, task.surface, one, choice, own, cancel)

    map_islands(koebe, outcome.islands, choice.most_lost, map_one, progress)
    return outcome


def _map(
    koebe: ModuleType,
    surface: Surface,
    one: SphereIsland,
    choice: SphereChoice,
    progress: Progress | None,
    cancel: Any,
) -> None:
    island = one.island
    checked_loops(koebe, island, choice.domain)
    result = koebe.sphere_map(
        island.vertices, island.triangles, polygon=island.triangle_face, progress=progress, cancel=cancel,
        **choice.solver_arguments(),
    )  # fmt: skip
    one.take_corners(surface, result.uv.astype(np.float32))
    one.torn = np.asarray(result.layout["torn"], dtype=np.int64)
    one.result = result
