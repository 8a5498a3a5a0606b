# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts surfaces in their UVs into even parts, with UV coordinates per corner."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError, failing_alone
from ..surfaces.islands import cut_into_islands, put_together
from ..surfaces.seams import cut_edges, inner_seams, tube_slits
from ..surfaces.stored import LostAreaError, judge_corners, lost_text
from ..surfaces.surface import Numbers, Surface, next_corners
from ..surfaces.triangles import areas, density_ratio, signed_areas
from .beside import OVER, PINNED_OVER, in_place, new_overlaps, put_beside
from .option_table import ROWS, solver_default
from .options import PartsChoice
from .outcomes import LATER, Outcome, Progress, Task
from .pins import join_pins
from .warning_words import of_solver
from .wording import counted, density_text, in_mesh

# The price of a part: at the dial's default the command's, at its ends ten times as much and a tenth. Darts cost so
# too. These ends make as few cuts as possible, and texels as even as possible.
PRICE, SPREAD = solver_default("parts", "price"), 10.0
# More than any unevenness costs: only necessary cuts are made.
NO_CUTS = 1e3
OTHERS = -1  # the number of a face of another surface in the same atlas


def price_of(evenness: float) -> float:
    """The price of a part, from a dial between 0, fewer parts, and 1, more even parts."""
    return float(PRICE / _eagerness(evenness))


def darts_of(darts: float, evenness: float) -> float:
    """The option `darts` of the command, from that of the add-on and the dial."""
    return min(1.0, darts * _eagerness(evenness))


def _eagerness(evenness: float) -> float:
    return float(SPREAD ** (2.0 * (evenness - ROWS["evenness"].default)))


@dataclasses.dataclass
class PartsIsland:
    """The outcome of all selected faces: a result of `koebe.parts`, or an error, or both if too much area is lost.

    numbers      the solver's triangles and vertices in the surface's numbers
    corners, uv  corners (m,) of the surface and their UVs (m, 2) in 32 bits
    cuts         (E,) bool, edges of the surface along which the UVs are cut
    coverage     share of the UV square, if the parts were moved after the solver packed them
    turned       triangles that rounding to 32 bits turned over then
    bent         figures of the report if pins have bent parts: they are no more the result's
    """

    result: Any = None
    error: Exception | None = None
    numbers: Numbers = LATER
    corners: np.ndarray = LATER
    uv: np.ndarray = LATER
    cuts: np.ndarray = LATER
    coverage: float | None = None
    turned: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros(0, dtype=np.int32))
    bent: dict[str, Any] = dataclasses.field(default_factory=dict)

    def figure(self, name: str) -> Any:
        """A figure of the report, by its name in the result."""
        return self.bent.get(name, getattr(self.result, name))

    @property
    def flipped(self) -> int:
        """Triangles that are turned over in the UVs."""
        return int(self.result.flipped) + len(self.turned)

    @property
    def flipped_faces(self) -> np.ndarray:
        """Faces of the surface with triangles that are turned over in the UVs."""
        faces = np.unique(self.numbers.triangle_face[np.append(self.result.flipped_faces, self.turned)])
        return faces[faces != OTHERS]


class PartsOutcome(Outcome):
    """The outcome of one surface: all its parts are one island."""

    islands: list[PartsIsland]

    def warnings(self, one: PartsIsland) -> list[dict[str, Any]]:
        found = [warning for warning in of_solver(one.result) if warning.kind != LostAreaError.kind]
        return [in_mesh(one.numbers, warning) for warning in found]

    def offending(self) -> list[tuple[str, np.ndarray]]:
        """Empty: no single face can be mended."""
        return []

    def line(self) -> str:
        """One line: parts, evenness, angles, flips, seconds."""
        result = self.mapped[0].result
        kinds = [part["kind"] for part in result.parts]
        of_kind = ", ".join(counted(kinds.count(kind), kind) for kind in sorted(set(kinds)))
        words = [
            f"{counted(len(kinds), 'part')} ({of_kind})",
            f"texel density 1 : {density_text(self.mapped[0].figure('density_ratio_5_95'))}",
            f"angle error {self.mapped[0].figure('angle_error_stored_deg')['mean']:.2f}°",
            counted(self.mapped[0].flipped, "flip"),
            f"{result.seconds['total']:.2f} s",
        ]
        if result.stacked:
            words.insert(1, counted(len(result.stacked), "part") + " stacked")
        if result.tiles > 1:
            words.insert(1, counted(result.tiles, "tile"))
        if result.handles_cut:
            words.insert(1, counted(result.handles_cut, "handle") + " cut")
        if not result.converged:
            words.append("NOT CONVERGED")
        return f"{self.name}: {', '.join(words)}"

    def _entry(self, index: int, one: PartsIsland) -> dict[str, Any]:
        entry = self._head(index, one, int(np.count_nonzero(self.task.surface.selected)))
        if one.result is None:
            return entry
        result, numbers = {**one.result.to_dict(), **one.bent}, one.numbers
        for part in result["parts"]:
            part["faces"] = np.unique(numbers.triangle_face[part["faces"]]).tolist()
            part["loops"] = [numbers.source_vertex[np.asarray(loop, dtype=np.int64)].tolist() for loop in part["loops"]]
        result["warnings"] = [] if one.error is not None else self.warnings(one)
        if one.error is not None:
            result["converged"] = False
        return {**result, **entry}

    def rows(self, layer: str) -> list[dict[str, Any]]:
        """As in `Outcome`. Parts have no circles to draw, and a failure names no elements."""
        return [self._failure_row()] if self.failed or self.not_written else super().rows(layer)

    def _row(self, one: PartsIsland) -> dict[str, Any]:
        result = one.result
        return {
            "parts": len(result.parts), "angle_error": one.figure("angle_error_stored_deg")["mean"],
            "flipped": one.flipped, "flipped_faces": one.flipped_faces.tolist(), "seconds": result.seconds["total"],
            "density": one.figure("density_ratio_5_95"),
            "coverage": result.coverage if one.coverage is None else one.coverage,
            "cut_length": result.cut_length, "even": result.even,
            **({"cut_edges": np.flatnonzero(one.cuts).tolist()} if one.cuts.any() else {}),
        }  # fmt: skip


def cut_into_parts(
    koebe: ModuleType, task: Task, choice: PartsChoice, progress: Progress | None = None, cancel: Any = None
) -> PartsOutcome:
    """Cut the selected faces of a surface into parts. Seams stay cuts. Polygons stay whole.

    A seam that makes a disk of a tube is where that tube is unrolled. If it is not mapped as a tube, the seam is a cut
    like the others.

    Errors are stored in the outcome; `koebe.Cancelled` is raised.
    """
    surface, arguments = task.surface, choice.solver_arguments()
    arguments |= {"price": price_of(choice.evenness), "darts": darts_of(choice.darts, choice.evenness)}
    if task.like is not None:
        arguments["density"] = task.like * choice.pixels
    if choice.seams == "only":
        arguments |= {"price": NO_CUTS, "darts": 0.0}
    one = PartsIsland()
    slits = tube_slits(surface, cut_into_islands(surface))
    with failing_alone(koebe, [one]):
        if slits.any():
            _map(koebe, one, task, slits, arguments, progress, cancel)
        if not slits.any() or (inner_seams(surface) & ~one.cuts).any():
            _map(koebe, one, task, np.zeros_like(slits), arguments, progress, cancel)
    return PartsOutcome(task, [one])


def move_parts(koebe: ModuleType, outcome: PartsOutcome, choice: PartsChoice, keep: bool, cancel: Any = None) -> None:
    """Put new parts of selected faces where the old ones lay, with `keep`, or beside the islands of the other faces.

    Parts with pins follow their pins, and the others go beside them, too. Parts on several tiles, and parts that lie on
    each other, stay where the solver put them. Any error is the outcome's; `koebe.Cancelled` is raised.
    """
    (one,) = outcome.islands
    task = outcome.task
    if one.error is not None or (task.rest is None and task.pins is None and not keep):
        return
    with failing_alone(koebe, [one]):
        uv, remark = one.uv.astype(np.float64), ""
        # To their old place, or to their pins; and what is free beside the others.
        kept = in_place(task, one.corners, uv) if keep else None
        is_moved = kept is not None or task.pins is not None
        uv, free = uv if kept is None else kept, np.ones(len(uv), dtype=bool)
        if task.pins is not None:
            joined = join_pins(koebe, task, one.corners, uv, one.result.even, cancel)
            uv, free, task = joined.uv, ~joined.held, joined.beside(task, one.corners)
        if kept is None and (choice.tiles != 1 or one.result.stacked):
            remark = OVER * (task.rest is not None)
        elif kept is None and free.any():
            own_size = choice.texels != "fill"
            made = put_beside(koebe, task, one.corners[free], uv[free], choice.margin, choice.pixels, own_size, cancel)
            if made is not None:
                uv[free], remark, is_moved = made.uv, made.remark, True
        outcome.remarks += [remark] * bool(remark)
        if is_moved:
            _take_place(one, task.surface, uv)
        # Pins bend parts: their figures are others now.
        if task.pins is not None:
            one.bent = _figures(koebe, one, task)
            layer = np.full((len(task.surface.corner_vertex), 2), np.nan) if task.rest is None else task.rest.copy()
            layer[one.corners] = one.uv
            outcome.remarks += [PINNED_OVER] * new_overlaps(koebe, task.surface, layer, one.corners)
            if one.bent["lost_area"] > choice.solver_arguments()["most_lost"]:
                raise MapError(f"{lost_text(one.bent['lost_area'])}: the pins are too near each other")


def _take_place(one: PartsIsland, surface: Surface, uv: np.ndarray) -> None:
    """Give the parts other UVs (m, 2), and measure them again where a similarity and rounding change them."""
    one.uv = uv.astype(np.float32)
    layer = np.zeros((len(surface.corner_vertex), 2))
    layer[one.corners] = one.uv
    area = signed_areas(layer, surface.triangle_corners[surface.selected[surface.triangle_face]])
    upright = np.ones(len(area), dtype=bool)
    for stacked in one.result.stacked:
        upright[one.result.part == stacked["part"]] = not stacked["mirrored"]
    one.turned = np.setdiff1d(np.flatnonzero(np.where(upright, area, -area) <= 0.0), one.result.flipped_faces)
    one.coverage = float(np.abs(area).sum())


def _figures(koebe: ModuleType, one: PartsIsland, task: Task) -> dict[str, Any]:
    """The figures of the UVs as they are now."""
    layer = np.zeros((len(task.surface.corner_vertex), 2), dtype=np.float32)
    layer[one.corners] = one.uv
    corners = task.surface.triangle_corners[task.surface.selected[task.surface.triangle_face]]
    triangles = task.surface.corner_vertex[corners]
    uv, none = layer[corners], np.zeros(0, dtype=np.int64)
    stored = judge_corners(koebe, task.surface.positions, triangles, uv, none)
    ratio = density_ratio(areas(task.surface.positions, triangles), np.abs(signed_areas(layer, corners)))
    known = one.result.to_dict()
    return {**{name: value for name, value in stored.report.items() if name in known}, "density_ratio_5_95": ratio}


def _weights(task: Task, source: np.ndarray) -> dict[str, np.ndarray]:
    """The task's weights of vertices, for the solver's vertices."""
    given = {"show": task.show, "importance": task.importance}
    return {name: weights[source] for name, weights in given.items() if weights is not None}


def _map(
    koebe: ModuleType,
    one: PartsIsland,
    task: Task,
    slits: np.ndarray,
    arguments: dict[str, Any],
    progress: Progress | None,
    cancel: Any,
) -> None:
    """Fill in the result. @param slits (E,) bool, seams that are cut only where a tube is opened."""
    surface = task.surface
    islands = cut_into_islands(dataclasses.replace(surface, seam=surface.seam & ~slits))
    positions, vertex_of_corner, source = put_together(surface, islands)
    chosen = surface.selected[surface.triangle_face]
    corners = surface.triangle_corners[chosen]
    on_slit = np.flatnonzero(slits[surface.corner_edge] & np.repeat(surface.selected, surface.face_size))
    ends = np.stack([on_slit, next_corners(surface)[on_slit]], axis=1)
    one.numbers = Numbers(surface.triangle_face[chosen], source)
    sketch = None if task.sketch is None else task.sketch.begin(koebe, source)
    result = koebe.parts(
        positions, vertex_of_corner[corners], polygon=one.numbers.triangle_face,
        slits=vertex_of_corner[ends], **_weights(task, one.numbers.source_vertex),
        sketch=sketch, progress=progress, cancel=cancel, **arguments,
    )  # fmt: skip
    if result.lost_area > arguments["most_lost"]:
        one.result = result
        raise LostAreaError(result.lost_area, result.flipped_faces, "uniformize")
    uv = np.zeros((len(surface.corner_vertex), 2), dtype=np.float32)
    uv[corners.ravel()] = result.uv.reshape(-1, 2)
    one.result, one.corners = result, np.unique(corners)
    layer = np.zeros(len(uv), dtype=np.int64)
    for stacked in result.stacked:  # it may meet the part under it in a fold
        layer[corners[result.part == stacked["part"]].ravel()] = stacked["part"] + 1
    one.uv, one.cuts = uv[one.corners], cut_edges(surface, uv, layer)
