# SPDX-License-Identifier: GPL-3.0-or-later
"""The outcome of a surface mapped to other domains than the disk. Each island has the UV square to itself."""

import dataclasses
import functools
from collections.abc import Sequence
from types import ModuleType
from typing import Any, ClassVar

import numpy as np

from ..surfaces.errors import MapError, failing_alone
from ..surfaces.islands import cut_into_islands
from ..surfaces.seams import cut_edges
from ..surfaces.stored import LostAreaError, Stored, flipped_corners, judge_corners
from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import density_ratio, signed_areas
from .domain import Domain
from .mapping import check_area
from .options import Chosen
from .outcomes import LATER, Outcome, Progress, Task, in_numbers, share_of
from .warning_words import of_solver
from .wording import UNEVEN_TEXELS, counted, density_text, in_mesh, too_uneven


@dataclasses.dataclass
class DomainIsland:
    """The outcome of one island: a result of the native package, or an error.

    corners, uv  corners (m,) of the surface and their UVs (m, 2) in 32 bits
    triangle_uv  (t, 3, 2) UVs of the island's triangles
    flipped      triangles (k,) without positive area in the UVs
    stored       the map as stored in the UVs
    cuts         (E,) bool, edges of the surface along which the UVs are cut
    """

    on_threads: ClassVar[bool] = False  # whether the solver's function has `threads`

    island: Island
    result: Any = LATER
    error: Exception | None = None
    corners: np.ndarray = LATER
    uv: np.ndarray = LATER
    triangle_uv: np.ndarray = LATER
    flipped: np.ndarray = LATER
    stored: Stored = LATER
    cuts: np.ndarray = LATER

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs."""
        return self.stored.angle_error

    @property
    def texel_uv(self) -> np.ndarray:
        """(t, 3, 2) the UVs whose texel density counts."""
        return self.result.uv

    @functools.cached_property
    def density_ratio(self) -> float:
        """Texel density at 95 % of the area over the density at 5 %."""
        corners = np.arange(3 * len(self.texel_uv)).reshape(-1, 3)
        return density_ratio(self.island.areas, np.abs(signed_areas(self.texel_uv.reshape(-1, 2), corners)))

    @property
    def flipped_faces(self) -> np.ndarray:
        """Faces of the surface with such triangles."""
        return np.unique(self.island.triangle_face[self.flipped])

    def faces(self, triangles: Sequence[int] | np.ndarray) -> list[int]:
        """The surface's faces of the island's triangles."""
        return np.unique(self.island.triangle_face[np.asarray(triangles, dtype=np.int64)]).tolist()

    def map(self, koebe: ModuleType, task: Task, choice: Chosen, loops: list[np.ndarray], **run: Any) -> None:
        """Compute the result, and take its UVs.

        loops  the island's boundary loops; their number fits the domain
        run    progress and cancel, for the native package
        """
        result = self._solve(koebe, choice, **run)
        self.take_corners(task.surface, result.uv.astype(np.float32))
        self.result = result

    def _solve(self, koebe: ModuleType, choice: Chosen, **arguments: Any) -> Any:
        """Call the domain's function of the native package, with the arguments common to all."""
        return getattr(koebe, f"{choice.domain.name}_map")(
            self.island.vertices, self.island.triangles, polygon=self.island.triangle_face,
            **choice.solver_arguments(), **arguments,
        )  # fmt: skip

    def take_corners(self, surface: Surface, triangle_uv: np.ndarray) -> None:
        """Take the UVs of the polygons' corners from those (t, 3, 2) of the triangles' corners, in 32 bits.

        Raises MapError if a corner of a polygon has two UVs.
        """
        inside = np.zeros(len(surface.face_size), dtype=bool)
        inside[self.island.faces] = True
        of_triangles = surface.triangle_corners[inside[surface.triangle_face]]
        uv = np.zeros((len(surface.corner_vertex), 2), dtype=np.float32)
        uv[of_triangles] = triangle_uv
        if (uv[of_triangles] != triangle_uv).any():
            raise MapError("its UVs cannot be cut along edges: triangulate its faces")
        self.triangle_uv = triangle_uv
        self.corners = np.unique(of_triangles).astype(np.int32)
        self.uv = uv[self.corners]
        self.cuts = cut_edges(dataclasses.replace(surface, selected=inside), uv)

    def judge(self, koebe: ModuleType, most_lost: float) -> None:
        """Judge the stored UVs. Raises LostAreaError if more area is lost than allowed."""
        island, turned = self.island, np.asarray(self.result.turned, dtype=np.int64)
        self.stored = judge_corners(koebe, island.vertices, island.triangles, self.triangle_uv, turned)
        self.flipped = flipped_corners(self.triangle_uv, turned)
        if self.stored.lost_area > most_lost:
            raise LostAreaError(self.stored.lost_area, self.flipped, "parts")


@dataclasses.dataclass
class DomainOutcome(Outcome):
    """The outcome of a surface: each island has the UV square to itself. A subclass names the islands' `kind`."""

    kind: ClassVar[type[DomainIsland]]

    islands: list[Any]
    choice: Chosen

    def warnings(self, one: Any) -> list[dict[str, Any]]:
        found = [warning for warning in of_solver(one.result) if warning.kind != LostAreaError.kind]  # already reported
        return [*(in_mesh(one.island, warning) for warning in found), *self._own_warnings()]

    def figures(self) -> list[str]:
        """Further figures of the mapped islands, beside angles and flips."""
        raise NotImplementedError

    def line(self) -> str:
        """One line: domains and their figures, evenness, angles, flips, seconds."""
        mapped = self.mapped
        words = [
            counted(len(mapped), self.choice.domain.title),
            *self.figures(),
            f"texel density 1 : {density_text(max(one.density_ratio for one in mapped))}",
            f"angle error {max(one.angle_error for one in mapped):.2f}°",
            counted(sum(len(one.flipped) for one in mapped), "flip"),
            f"{sum(one.result.seconds['total'] for one in mapped):.2f} s",
        ]
        if not self.converged:
            words.append("NOT CONVERGED")
        if any(too_uneven(one) for one in mapped):
            words.append(UNEVEN_TEXELS)
        return f"{self.name}: {', '.join(words)}"

    def _entry(self, index: int, one: Any) -> dict[str, Any]:
        entry = self._head(index, one, len(one.island.faces))
        if one.result is None:
            return entry
        result = one.result.to_dict()
        in_numbers(result["loops"], one.island.source_vertex, "vertices", "off_circle")
        result["turned"] = one.faces(result["turned"])
        self._adapt(one, result)
        result.update(one.stored.figures())
        result["flipped"] = len(one.flipped)
        if one.error is not None:  # too much area is lost: it is not finished
            result["converged"] = False
        result["warnings"] = self.warnings(one)
        return {**result, **entry, "domain": self.choice.domain.name}

    def _adapt(self, one: Any, result: dict[str, Any]) -> None:
        """Change the native result's dict to the mesh's numbers and to the UVs as written."""

    def _row(self, one: Any) -> dict[str, Any]:
        result = one.result
        return {
            "sweeps": result.sweeps, "domain": self.choice.domain.name, "angle_error": one.angle_error,
            "seconds": result.seconds["total"], "flipped": len(one.flipped),
            "flipped_faces": one.flipped_faces.tolist(), "uneven": too_uneven(one), "even": result.even,
            "cut_edges": np.flatnonzero(one.cuts).tolist(),
            "loops": [
                {
                    "vertices": one.island.source_vertex[of_loop["vertices"]].tolist(),
                    **self._loop_row(one, number, of_loop),
                }
                for number, of_loop in enumerate(result.loops)
            ],
        }  # fmt: skip

    def _loop_row(self, one: Any, number: int, of_loop: dict[str, Any]) -> dict[str, Any]:
        """A loop's row of the report, from its number and the native result's entry."""
        raise NotImplementedError


def islands_to_map(surface: Surface) -> list[Island]:
    """The islands of the selected faces. A seam with the same island on both sides is ignored: the UVs continue over
    cuts anyway. But edges of more than two faces come apart at seams."""
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


def map_domain(
    koebe: ModuleType,
    task: Task,
    choice: Chosen,
    progress: Progress | None = None,
    cancel: Any = None,
    threads: int = 0,
) -> DomainOutcome:
    """Map each island of the selected faces of a surface to the domain of the choice. Polygons stay whole.

    Errors are those of their islands; `koebe.Cancelled` goes on.
    """
    outcome_type: type[DomainOutcome] = choice.domain.outcome
    islands = [outcome_type.kind(island) for island in islands_to_map(task.surface)]
    done, total = 0, sum(len(one.island.triangles) for one in islands)
    for one in islands:
        size = len(one.island.triangles)
        with failing_alone(koebe, [one]):
            loops = checked_loops(koebe, one.island, choice.domain)
            run = {"threads": threads} if one.on_threads else {}
            one.map(koebe, task, choice, loops, progress=share_of(progress, done, size, total), cancel=cancel, **run)
            one.judge(koebe, choice.most_lost)
        done += size
    return outcome_type(task, islands, choice)


def checked_loops(koebe: ModuleType, island: Island, domain: Domain) -> list[np.ndarray]:
    """The boundary loops of an island that has an area and can be mapped to a domain; else raises."""
    check_area(island)
    loops: list[np.ndarray] = koebe.boundary_loops(island.triangles, vertex_count=len(island.vertices))
    domain.check(handles_of(island, loops), len(loops))
    return loops


def handles_of(island: Island, loops: list[np.ndarray]) -> int:
    """The genus of a manifold island with these boundary loops, by Euler's formula."""
    on_boundary = sum(map(len, loops))
    edges = (3 * len(island.triangles) + on_boundary) // 2
    return (2 - (len(island.vertices) - edges + len(island.triangles)) - len(loops)) // 2
