# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps surfaces with handles to fundamental domains of Schottky groups, with UV coordinates per corner."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError, elements_of, kind_of
from ..surfaces.rounding import RESOLUTION
from .domain import Domain, DomainError
from .domain_outcomes import DomainIsland, DomainOutcome
from .options import Chosen
from .outcomes import LATER, Task, in_numbers
from .wording import counted

ROUND = 1e-3  # largest distance of a round hole's vertices from its circle, over the radius


class CutError(MapError):
    """Handles that cannot be cut open. `elements` are vertices of the attempted cuts."""

    kind = "cut"

    def __init__(self, reason: str, elements: list[int]) -> None:
        super().__init__(reason)
        self.elements = elements


@dataclasses.dataclass
class SchottkyIsland(DomainIsland):
    """The outcome of one island: a result of `koebe.schottky_map`, or an error.

    circles  center (2,) and radius in the UVs of each loop of the result; 0 and 0 for a loop that the cuts tear
    """

    circles: list[tuple[tuple[float, float], float]] = LATER

    def cut(self) -> str:
        """What the UVs are cut along, in words."""
        return "circles" if self.result.by_circles else "edges"

    def map(self, koebe: ModuleType, task: Task, choice: Chosen, loops: list[np.ndarray], **run: Any) -> None:
        """As in `DomainIsland`, with its handles cut open."""
        island = self.island
        try:
            super().map(koebe, task, choice, loops, **run)
        except koebe.TopologyError as error:
            if kind_of(error) != "genus":
                raise
            known = [vertex for vertex in elements_of(error) if vertex < len(island.vertices)]
            raise CutError(str(error), known) from error  # the handles are not the fault
        triangles, uv, found = island.triangles, self.result.uv, self.result.loops
        self.circles = [_circle(koebe, triangles, uv, loop["vertices"]) for loop in found]


class SchottkyOutcome(DomainOutcome):
    """The outcome of one surface with its islands mapped into the disk, their handles cut open."""

    kind = SchottkyIsland

    def figures(self) -> list[str]:
        results = [one.result for one in self.mapped]
        return [
            counted(sum(len(result.handles) for result in results), "handle"),
            counted(sum(len(result.loops) for result in results), "hole"),
            "cut along " + " and ".join(sorted({one.cut() for one in self.mapped})),
        ]

    def _adapt(self, one: SchottkyIsland, result: dict[str, Any]) -> None:
        """Circles and generators are as in `koebe.SchottkyMap`."""
        in_numbers(result["handles"], one.island.source_vertex, "cut")

    def _row(self, one: SchottkyIsland) -> dict[str, Any]:
        result = one.result
        own = {"handles": len(result.handles), "by_circles": result.by_circles, "density": one.density_ratio}
        return {**super()._row(one), **own}

    def _loop_row(self, one: SchottkyIsland, number: int, of_loop: dict[str, Any]) -> dict[str, Any]:
        center, radius = one.circles[number]
        return {"uv_center": center, "uv_radius": radius, "name": f"{number}" if number else "Rim"}


def _circle(
    koebe: ModuleType, triangles: np.ndarray, uv: np.ndarray, loop: list[int]
) -> tuple[tuple[float, float], float]:
    """The circle of a loop whose corners in the UVs (t, 3, 2) of triangles (t, 3), one per vertex, lie on it."""
    at_loop = np.isin(triangles, loop)
    places = np.unique(np.column_stack([triangles[at_loop], uv[at_loop]]), axis=0)
    if len(places) == len(loop):
        center, radius, off = koebe.fit_circle(places[:, 1:])
        if off < ROUND * radius + RESOLUTION:
            return (float(center[0]), float(center[1])), radius
    return (0.0, 0.0), 0.0


def _check_schottky(handles: int, loops: int) -> None:
    if not handles:
        raise DomainError(
            "this surface has no handle: Unwrap Pretzel needs at least one", "uniformize" if loops else "sphere"
        )


SCHOTTKY = Domain(
    "schottky", "fundamental domain", "Unwrap Pretzel", "META_ELLIPSOID",
    "HANDLES", ("normalization", "layer", "checker", "checker_size"), _check_schottky, SchottkyOutcome,
    "Unwrap a surface with any number of handles, closed or with holes, into a disk. Angles are kept, and holes are "
    "round. Each handle is cut open, in the UVs only",
)  # fmt: skip
