# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as tiles of flat tori and cylinders: from a surface to UV coordinates of its corners."""

import dataclasses
import functools
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from .domain_outcomes import DomainIsland, DomainOutcome, checked_loops, islands_to_map, map_islands
from .errors import MapError
from .options import TileChoice
from .outcomes import LATER, Progress, Task
from .surface import Island, Surface
from .tile_fit import FittedTile, fitted
from .triangles import density_ratio, signed_areas
from .wording import counted, own_warning

if TYPE_CHECKING:
    from koebe import TileMap

UP = (2, 1)  # axes that may be up: of a ring's two rims the lower one is where v is 0


@dataclasses.dataclass
class TileIsland(DomainIsland):
    """What became of one island: a result of `koebe.torus_map` or `koebe.ring_map` and its tile, or an error.

    tile  fitted as it was asked for
    """

    tile: FittedTile = LATER

    @functools.cached_property
    def density_ratio(self) -> float:
        """Texel density at 95 % of the area over that at 5 %."""
        count = len(self.tile.uv)
        corners = np.arange(3 * count).reshape(-1, 3)
        return density_ratio(self.island.areas, np.abs(signed_areas(self.tile.uv.reshape(-1, 2), corners)))

    def circle(self, loop: dict[str, Any], fit: str) -> tuple[tuple[float, float], float]:
        """Centre and radius in the UVs of a loop that is a circle there, else 0 and 0."""
        if len(self.result.periods) < 2 or "center" not in loop or fit == "square":
            return (0.0, 0.0), 0.0
        matrix, offset = self.tile.move
        x, y = matrix @ np.array(loop["center"]) + offset
        return (float(x), float(y)), float(loop["radius"] * matrix[0, 0])


class TileOutcome(DomainOutcome):
    """What became of one surface: each island fills the UV square for itself."""

    def warnings(self, one: TileIsland) -> list[dict[str, Any]]:
        lost = len(np.setdiff1d(one.flipped, one.result.flipped_faces))
        text = f"{counted(lost, 'triangle')} turned over as the tile was fitted: take Fit: Inside"
        return [*super().warnings(one), *[own_warning("flipped", text)] * (lost > 0)]

    def figures(self) -> list[str]:
        results = [one.result for one in self.mapped]
        loops = counted(sum(len(result.loops) for result in results), "loop")
        return ["modulus " + modulus_text(results[0]), loops] if len(results) == 1 else [loops]


def modulus_text(result: "TileMap") -> str:
    """Of a torus the ratio of its periods, of a cylinder i times its height over its period."""
    real = f"{round(result.modulus.real, 3) + 0.0:.3f} + " if len(result.periods) > 1 else ""  # never -0
    return f"{real}{result.modulus.imag:.3f} i"


def periods_text(tile: FittedTile) -> str:
    """The periods in UVs."""
    return " and ".join(f"({u:.4f}, {v:.4f})" for u, v in tile.periods)


def map_tiles(
    koebe: ModuleType,
    task: Task,
    choice: TileChoice,
    picked: np.ndarray | None = None,
    progress: Progress | None = None,
    cancel: Any = None,
) -> TileOutcome:
    """Map each island of the selected faces of a surface to a tile. Polygons stay whole.

    picked  (V,) bool, vertices by which the rims of rings are known, or None
    Errors are those of their islands; `koebe.Cancelled` goes on.
    """
    outcome = TileOutcome(task, choice, [TileIsland(island) for island in islands_to_map(task.surface)])

    def map_one(one: TileIsland, own: Progress | None) -> None:
        _map(koebe, task.surface, one, choice, picked, own, cancel)

    map_islands(koebe, outcome.islands, choice.most_lost, map_one, progress)
    return outcome


def _map(
    koebe: ModuleType,
    surface: Surface,
    one: TileIsland,
    choice: TileChoice,
    picked: np.ndarray | None,
    progress: Progress | None,
    cancel: Any,
) -> None:
    island = one.island
    loops = checked_loops(koebe, island, choice.domain)
    arguments = choice.solver_arguments()
    if choice.domain == "ring":
        outer, inner = rims_of(island, loops, choice.rims, picked)
        arguments.update(outer=outer, inner=inner)
    function = getattr(koebe, f"{choice.domain}_map")
    result = function(
        island.vertices, island.triangles, polygon=island.triangle_face, progress=progress, cancel=cancel, **arguments
    )
    one.tile = fitted(result.uv, island.triangles, result.periods, choice.fit)
    one.take_corners(surface, one.tile.uv)
    one.result = result


def rims_of(island: Island, loops: list[np.ndarray], rims: str, picked: np.ndarray | None) -> tuple[int, int]:
    """A vertex of each of the two rims of a ring: the lower one in space first, or else the longer one.

    Raises MapError where they are to be the selected ones, and these are not two.
    """
    touched = [] if picked is None else [loop for loop in loops if picked[island.source_vertex[loop]].any()]
    if rims == "selected" and len(touched) != 2:
        raise MapError(
            f"the rims are to be the two loops with selected vertices, but {counted(len(touched), 'loop')} of it "
            "have some: select on two loops, in Edit Mode"
        )
    length = [_length(island, loop) for loop in loops]
    two = touched if len(touched) == 2 else [loops[k] for k in np.argsort(length, kind="stable")[: -3 : -1]]
    low, high = sorted(two, key=lambda loop: -_length(island, loop))
    extent = float(np.ptp(island.vertices, axis=0).max())
    for axis in UP:
        rise = float(island.vertices[high][:, axis].mean() - island.vertices[low][:, axis].mean())
        if abs(rise) > 0.1 * extent:
            return (int(low[0]), int(high[0])) if rise > 0.0 else (int(high[0]), int(low[0]))
    return int(low[0]), int(high[0])


def _length(island: Island, loop: np.ndarray) -> float:
    points = island.vertices[loop]
    return float(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())
