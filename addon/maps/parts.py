# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces cut in their UVs into even parts: from a surface to UV coordinates of its corners."""

import dataclasses
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from .islands import cut_into_islands
from .mapping import foreseen
from .options import PartsChoice
from .outcomes import LATER, Progress, Task
from .seams import cut_edges, inner_seams, tube_slits
from .stored import LostAreaError
from .surface import Surface, next_corners
from .wording import counted, density_text, in_mesh

if TYPE_CHECKING:
    from koebe import PartsResult

# The price of a part at the dial's ends: as few parts as there can be, and texels as even as they can be.
HIGHEST, LOWEST = 0.03, 0.0003
# More than any unevenness costs: no cut is made but those without which there would be no map.
NO_CUTS = 1e3


def price_of(evenness: float) -> float:
    """The price of a part, by a dial from 0, fewer parts, to 1, more even ones."""
    return float(HIGHEST * (LOWEST / HIGHEST) ** evenness)


@dataclasses.dataclass
class PartsOutcome:
    """What became of one surface.

    corners, uv  corners (m,) of the surface and their UVs (m, 2) in 32 bits
    numbers      what the solver's triangles and vertices are on the surface
    cuts         (E,) bool, edges of the surface along which the UVs are cut
    not_written  why nothing of it could be written, or None
    remarks      what to say of the object beside its parts
    """

    task: Task
    corners: np.ndarray
    uv: np.ndarray
    numbers: "Numbers" = LATER
    result: "PartsResult | None" = None
    error: Exception | None = None
    cuts: np.ndarray | None = None
    not_written: str | None = None
    remarks: list[str] = dataclasses.field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the surface's object."""
        return self.task.name

    @property
    def mapped(self) -> list["PartsResult"]:
        """The result, unless there is none or it could not be written."""
        return [] if self.result is None or self.error is not None or self.not_written else [self.result]

    @property
    def flipped_faces(self) -> np.ndarray:
        """Faces of the surface with triangles that are turned over in the UVs."""
        return np.unique(self.numbers.triangle_face[self.mapped[0].flipped_faces])

    def warnings(self) -> list[dict[str, Any]]:
        """What to watch out for in the parts, in the mesh's numbers."""
        found = [warning for result in self.mapped for warning in result.warnings]
        return [in_mesh(self.numbers, warning) for warning in found if warning.kind != LostAreaError.kind]

    @property
    def islands(self) -> list["PartsOutcome"]:
        """The surface as one, as of other outcomes."""
        return [self]

    @property
    def failed(self) -> list["PartsOutcome"]:
        """The same if it has an error."""
        return [self] if self.error is not None else []

    @property
    def converged(self) -> bool:
        """Whether the parts are what they promise."""
        return all(result.converged for result in self.mapped)

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) and their UV coordinates (m, 2) in 32 bits."""
        return self.corners, self.uv

    def line(self) -> str:
        """One line: parts, cuts, evenness, angles, flips, seconds."""
        result = self.mapped[0]
        kinds = [part["kind"] for part in result.parts]
        words = [
            counted(len(kinds), "part") + f" ({', '.join(counted(kinds.count(kind), kind) for kind in _kinds(kinds))})",
            f"cuts {result.cut_length:.1f} times the root of the area",
            f"texel density 1 : {density_text(result.density_ratio_5_95)} on nine tenths",
            f"angle error {result.angle_error_stored_deg['mean']:.2f}°",
            counted(result.flipped, "flip"),
            f"{result.seconds:.2f} s",
        ]
        if result.handles_cut:
            words.insert(1, counted(result.handles_cut, "handle") + " cut")
        if not result.converged:
            words.append("NOT CONVERGED")
        return f"{self.name}: {', '.join(words)}"


@dataclasses.dataclass(frozen=True)
class Numbers:
    """What the solver's triangles (t,) and vertices (n,) are on the surface."""

    triangle_face: np.ndarray
    source_vertex: np.ndarray


def _kinds(kinds: list[str]) -> list[str]:
    return sorted(set(kinds))


def cut_into_parts(
    koebe: ModuleType, task: Task, choice: PartsChoice, progress: Progress | None = None, cancel: Any = None
) -> PartsOutcome:
    """Cut the selected faces of a surface into parts. Seams stay cuts. Polygons stay whole.

    A seam that makes a disk of a tube is where that tube is unrolled. Where it is not mapped as a tube after all, it
    is a cut as the others are.

    Errors are the outcome's; `koebe.Cancelled` goes on.
    """
    surface, price = task.surface, price_of(choice.evenness) if choice.seams == "add" else NO_CUTS
    arguments = {"price": price, **choice.solver_arguments()}
    outcome = PartsOutcome(task, np.zeros(0, dtype=np.int32), np.zeros((0, 2), dtype=np.float32))
    slits = tube_slits(surface, cut_into_islands(surface))
    try:
        if slits.any():
            _map(koebe, outcome, surface, slits, arguments, progress, cancel)
            assert outcome.cuts is not None
            if not (inner_seams(surface) & ~outcome.cuts).any():
                return outcome
        _map(koebe, outcome, surface, np.zeros_like(slits), arguments, progress, cancel)
    except koebe.Cancelled:
        raise
    except Exception as error:
        outcome.error = foreseen(koebe, error)
    return outcome


def _map(
    koebe: ModuleType,
    outcome: PartsOutcome,
    surface: Surface,
    slits: np.ndarray,
    arguments: dict[str, Any],
    progress: Progress | None,
    cancel: Any,
) -> None:
    """Fill the outcome. @param slits (E,) bool, seams that are cut only where a tube is opened."""
    vertex_of_corner = np.zeros(len(surface.corner_vertex), dtype=np.int32)
    positions, sources, count = [], [], 0
    for island in cut_into_islands(dataclasses.replace(surface, seam=surface.seam & ~slits)):
        vertex_of_corner[island.corners] = island.corner_vertex + count
        positions.append(island.vertices)
        sources.append(island.source_vertex)
        count += len(island.vertices)
    chosen = surface.selected[surface.triangle_face]
    corners = surface.triangle_corners[chosen]
    on_slit = np.flatnonzero(slits[surface.corner_edge] & np.repeat(surface.selected, surface.face_size))
    ends = np.stack([on_slit, next_corners(surface)[on_slit]], axis=1)
    outcome.numbers = Numbers(surface.triangle_face[chosen], np.concatenate(sources))
    result = koebe.parts(
        np.concatenate(positions), vertex_of_corner[corners], polygon=outcome.numbers.triangle_face,
        slits=vertex_of_corner[ends], progress=progress, cancel=cancel, **arguments,
    )  # fmt: skip
    if result.lost_area > arguments["most_lost"]:
        outcome.result = result
        raise LostAreaError(result.lost_area, result.flipped_faces, "uniformize")
    uv = np.zeros((len(surface.corner_vertex), 2), dtype=np.float32)
    uv[corners.ravel()] = result.uv.reshape(-1, 2)
    outcome.result, outcome.corners = result, np.unique(corners)
    outcome.uv, outcome.cuts = uv[outcome.corners], cut_edges(surface, uv)
