# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as tiles of flat tori and cylinders: from a surface to UV coordinates of its corners."""

import dataclasses
import functools
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import MapError
from .islands import cut_into_islands
from .mapping import check_area, foreseen
from .options import TileChoice
from .outcomes import LATER, Progress, Task, share_of
from .seams import cut_edges
from .surface import Island, Surface
from .tile_domains import DOMAINS
from .tile_fit import FittedTile, fitted
from .triangles import density_ratio, signed_areas
from .wording import counted, own_warnings, too_uneven

if TYPE_CHECKING:
    from koebe import TileMap

UP = (2, 1)  # axes that may be up: of a ring's two rims the lower one is where v is 0


@dataclasses.dataclass
class TileIsland:
    """What became of one island: a result of `koebe.torus_map` or `koebe.ring_map` and its tile, or an error.

    tile         fitted as it was asked for
    corners, uv  corners (m,) of the surface and their UVs (m, 2) in 32 bits
    flipped      triangles (k,) whose area in these is not positive
    distortion   `koebe.distortion` of what is in the UVs, where it is not that of the result
    cuts         (E,) bool, edges of the surface along which the UVs are cut
    """

    island: Island
    result: "TileMap" = LATER
    error: Exception | None = None
    tile: FittedTile = LATER
    corners: np.ndarray = LATER
    uv: np.ndarray = LATER
    flipped: np.ndarray = LATER
    distortion: dict[str, Any] | None = None
    cuts: np.ndarray = LATER

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs."""
        return (self.distortion["angle_error_deg"] if self.distortion else self.result.angle_error_deg)["mean"]

    @functools.cached_property
    def density_ratio(self) -> float:
        """Texel density at 95 % of the area over that at 5 %."""
        count = len(self.tile.uv)
        corners = np.arange(3 * count).reshape(-1, 3)
        return density_ratio(self.island.areas, np.abs(signed_areas(self.tile.uv.reshape(-1, 2), corners)))

    @property
    def flipped_faces(self) -> np.ndarray:
        """Faces of the surface with such triangles."""
        return np.unique(self.island.triangle_face[self.flipped])

    def circle(self, loop: dict[str, Any], fit: str) -> tuple[tuple[float, float], float]:
        """Centre and radius in the UVs of a loop that is a circle there, else 0 and 0."""
        if len(self.result.periods) < 2 or "center" not in loop or fit == "square":
            return (0.0, 0.0), 0.0
        matrix, offset = self.tile.move
        x, y = matrix @ np.array(loop["center"]) + offset
        return (float(x), float(y)), float(loop["radius"] * matrix[0, 0])


@dataclasses.dataclass
class TileOutcome:
    """What became of one surface: each island fills the UV square for itself.

    not_written  why nothing of it could be written, or None
    remarks      what to say of the object beside its islands
    """

    task: Task
    choice: TileChoice
    islands: list[TileIsland]
    not_written: str | None = None
    remarks: list[str] = dataclasses.field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the surface's object."""
        return self.task.name

    @property
    def mapped(self) -> list[TileIsland]:
        """The islands that have a result, unless it could not be written."""
        return [] if self.not_written else [one for one in self.islands if one.error is None]

    @property
    def failed(self) -> list[TileIsland]:
        """The islands that have an error."""
        return [one for one in self.islands if one.error is not None]

    @property
    def converged(self) -> bool:
        """Whether every mapped island is what it promises."""
        return all(one.result.converged for one in self.mapped)

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        mapped = self.mapped
        return np.concatenate([one.corners for one in mapped]), np.concatenate([one.uv for one in mapped])

    def warnings(self, one: TileIsland) -> list[str]:
        """What to watch out for in a mapped island."""
        return [*(warning.text for warning in one.result.warnings), *(text for _, text in self.own_warnings(one))]

    def own_warnings(self, one: TileIsland) -> list[tuple[str, str]]:
        """Kind and text of those that are not the solver's."""
        lost = len(np.setdiff1d(one.flipped, one.result.flipped_faces))
        text = f"{counted(lost, 'triangle')} turned over as the tile was fitted: take Fit: Inside"
        return [("flipped", text)] * (lost > 0) + own_warnings(self.task)

    def line(self) -> str:
        """One line: domains, modulus, loops, angles, flips, seconds."""
        results = [one.result for one in self.mapped]
        words = [
            counted(len(results), DOMAINS[self.choice.domain].title),
            "modulus " + modulus_text(results[0]),
            counted(sum(len(result.loops) for result in results), "loop"),
            f"angle error {max(one.angle_error for one in self.mapped):.2f}°",
            counted(sum(len(one.flipped) for one in self.mapped), "flip"),
            f"{sum(result.seconds['total'] for result in results):.2f} s",
        ]
        if len(results) > 1:
            words.pop(1)
        if not self.converged:
            words.append("NOT CONVERGED")
        if any(too_uneven(one) for one in self.mapped):
            words.append("texels very uneven: Unwrap to Parts makes them even")
        return f"{self.name}: {', '.join(words)}"


def modulus_text(result: "TileMap") -> str:
    """Of a torus the ratio of its periods, of a cylinder i times its height over its period."""
    real = f"{round(result.modulus.real, 3) + 0.0:.3f} + " if len(result.periods) > 1 else ""  # never -0
    return f"{real}{result.modulus.imag:.3f} i"


def periods_text(tile: FittedTile) -> str:
    """The periods in UVs."""
    return " and ".join(f"({u:.4f}, {v:.4f})" for u, v in tile.periods)


def islands_to_tile(surface: Surface) -> list[Island]:
    """The islands of the selected faces. A seam with the same island on both sides divides nothing: a tile goes on
    over its cut, wherever that is. But edges of more than two faces come apart at seams."""
    islands = cut_into_islands(surface)
    chosen = np.repeat(surface.selected, surface.face_size)
    edges = surface.corner_edge[chosen]
    number = np.zeros(len(surface.face_size), dtype=np.int64)
    for index, island in enumerate(islands):
        number[island.faces] = index
    at_corner = np.repeat(number, surface.face_size)[chosen]
    total = np.bincount(edges, at_corner, minlength=len(surface.seam))
    square = np.bincount(edges, at_corner**2, minlength=len(surface.seam))
    uses = np.bincount(edges, minlength=len(surface.seam))
    idle = surface.seam & (uses == 2) & (2.0 * square == total**2)  # a = b
    return cut_into_islands(dataclasses.replace(surface, seam=surface.seam & ~idle)) if idle.any() else islands


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
    outcome = TileOutcome(task, choice, [TileIsland(island) for island in islands_to_tile(task.surface)])
    done, total = 0, sum(len(one.island.triangles) for one in outcome.islands)
    for one in outcome.islands:
        share = len(one.island.triangles)
        try:
            _map(koebe, task.surface, one, choice, picked, share_of(progress, done, share, total), cancel)
        except koebe.Cancelled:
            raise
        except Exception as error:
            one.error = foreseen(koebe, error)
        done += share
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
    check_area(island)
    loops = koebe.boundary_loops(island.triangles, vertex_count=len(island.vertices))
    DOMAINS[choice.domain].check(handles_of(island, loops), len(loops))
    arguments: dict[str, Any] = {"tolerance": choice.tolerance, "max_sweeps": choice.max_sweeps}
    if choice.domain == "ring":
        outer, inner = rims_of(island, loops, choice.rims, picked)
        arguments.update(outer=outer, inner=inner, holes=choice.holes)
    function = getattr(koebe, f"{choice.domain}_map")
    result = function(
        island.vertices, island.triangles, polygon=island.triangle_face, progress=progress, cancel=cancel, **arguments
    )
    one.tile = fitted(result.uv, island.triangles, result.periods, choice.fit)
    _take_corners(surface, one)
    one.flipped = one.tile.flipped(np.asarray(result.turned, dtype=np.int64))
    if choice.fit == "square":
        corners = island.vertices[island.triangles].reshape(-1, 3)
        apart = np.arange(len(corners), dtype=np.int32).reshape(-1, 3)
        one.distortion = koebe.distortion(corners, apart, one.tile.uv.reshape(-1, 2).astype(np.float64))
    one.result = result


def _take_corners(surface: Surface, one: TileIsland) -> None:
    """The UVs of the polygons' corners out of those of the triangles' corners."""
    inside = np.zeros(len(surface.face_size), dtype=bool)
    inside[one.island.faces] = True
    of_triangles = surface.triangle_corners[inside[surface.triangle_face]]
    uv = np.zeros((len(surface.corner_vertex), 2), dtype=np.float32)
    uv[of_triangles] = one.tile.uv
    if (uv[of_triangles] != one.tile.uv).any():
        raise MapError("its tile could be cut only through a polygon: triangulate its faces")
    one.corners = np.unique(of_triangles).astype(np.int32)
    one.uv = uv[one.corners]
    one.cuts = cut_edges(dataclasses.replace(surface, selected=inside), uv)


def handles_of(island: Island, loops: list[np.ndarray]) -> int:
    """Of a manifold island with these boundary loops, by Euler's formula."""
    on_boundary = sum(map(len, loops))
    edges = (3 * len(island.triangles) + on_boundary) // 2
    return (2 - (len(island.vertices) - edges + len(island.triangles)) - len(loops)) // 2


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
