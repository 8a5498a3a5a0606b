# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts several surfaces into parts that share one UV square, or its tiles: they are mapped as one surface."""

import dataclasses
from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError
from ..surfaces.stored import LostAreaError
from ..surfaces.surface import Numbers, Surface
from .options import PartsChoice
from .outcomes import LATER, Progress, Task
from .parts import OTHERS, PartsIsland, PartsOutcome, cut_into_parts
from .warning_words import of_solver
from .wording import in_mesh

TINY = 1e-5  # of the largest surface's extent: about a hundred steps of UVs in 32 bits


@dataclasses.dataclass(frozen=True)
class Begin:
    """Numbers of the first vertex, edge, face, corner and triangle of a surface among those of several."""

    vertex: int = 0
    edge: int = 0
    face: int = 0
    corner: int = 0

    def after(self, surface: Surface) -> "Begin":
        """That of the surface that follows."""
        return Begin(
            self.vertex + len(surface.positions), self.edge + len(surface.seam),
            self.face + len(surface.face_start), self.corner + len(surface.corner_vertex),
        )  # fmt: skip


def _begins(surfaces: Sequence[Surface]) -> list[Begin]:
    """Of each surface, and of one that would follow."""
    begins = [Begin()]
    for surface in surfaces:
        begins.append(begins[-1].after(surface))
    return begins


def joined(surfaces: Sequence[Surface]) -> Surface:
    """The surfaces side by side as one."""
    first = {"corner_vertex": "vertex", "corner_edge": "edge", "face_start": "corner", "triangle_corners": "corner",
             "triangle_face": "face"}  # fmt: skip
    begins = _begins(surfaces)
    return Surface(**{
        field.name: np.concatenate([
            getattr(surface, field.name) + getattr(begin, first[field.name]) if field.name in first
            else getattr(surface, field.name)
            for surface, begin in zip(surfaces, begins, strict=False)
        ])
        for field in dataclasses.fields(Surface)
    })  # fmt: skip


def _joined_weights(tasks: Sequence[Task], name: str) -> np.ndarray | None:
    """Weights of vertices; 0 for an object without them, None if no object has them."""
    given = [getattr(task, name) for task in tasks]
    if all(weights is None for weights in given):
        return None
    return np.concatenate([
        np.zeros(len(task.surface.positions)) if weights is None else weights
        for task, weights in zip(tasks, given, strict=True)
    ])  # fmt: skip


def _joined_task(tasks: Sequence[Task]) -> Task:
    likes = [task.like for task in tasks if task.like is not None]
    return dataclasses.replace(
        tasks[0], name=" + ".join(task.name for task in tasks), surface=joined([task.surface for task in tasks]),
        importance=_joined_weights(tasks, "importance"), show=_joined_weights(tasks, "show"),
        like=min(likes) if likes else None,
    )  # fmt: skip


class TooSmallError(LostAreaError):
    """A surface that can be mapped alone, but whose faces have no area at the texel density of the others."""

    def __init__(self) -> None:
        MapError.__init__(self, "it is too small beside the other objects of the atlas: faces have no area in the UVs. "
                                "Unwrap it by itself")  # fmt: skip
        self.elements, self.offer = np.zeros(0, dtype=np.int32), ()


@dataclasses.dataclass
class AtlasOutcome(PartsOutcome):
    """The outcome of one surface of several. Its figures are of all of them.

    atlas   names of all objects
    whole   the island of all surfaces
    begin   this surface's first numbers among all
    """

    atlas: list[str] = dataclasses.field(default_factory=list)
    whole: PartsIsland = LATER
    begin: Begin = LATER

    def _own(self, of: str, elements: list[int]) -> list[int]:
        """Those of these vertices or faces that are this surface's, in its numbers."""
        surface, begin = self.task.surface, self.begin
        first, count = {
            "vertices": (begin.vertex, len(surface.positions)), "faces": (begin.face, len(surface.face_start))
        }[of]  # fmt: skip
        return [element - first for element in elements if first <= element < first + count]

    def warnings(self, one: PartsIsland) -> list[dict[str, Any]]:
        found = []
        for warning in of_solver(one.result):
            said = in_mesh(self.whole.numbers, warning)
            if warning.of in ("vertices", "faces") and said["elements"]:
                own = self._own(warning.of, said["elements"])
                if not own:
                    continue
                if len(own) < len(said["elements"]):
                    said["text"] += " (in all objects of the atlas)"
                said["elements"] = own
            found.append(said)
        return found

    def notes(self) -> list[tuple[Any, str]]:
        others = [name for name in self.atlas if name != self.name]
        return [(one, f"in one atlas with {', '.join(others)}: figures are of all") for one in self.mapped]

    def line(self) -> str:
        first = self.atlas[0]
        if self.name != first:
            return f"{self.name}: in one atlas with {first}, whose line has the figures"
        return f"{super().line()}, in one atlas of {len(self.atlas)} objects"

    def _entry(self, index: int, one: PartsIsland) -> dict[str, Any]:
        entry = super()._entry(index, one)
        if one.result is not None:
            numbered = [{"number": number, **part} for number, part in enumerate(entry["parts"])]
            entry["parts"] = [part for part in numbered if part["faces"] != [OTHERS]]
            own = {part["number"] for part in entry["parts"]}
            entry["stacked"] = [stacked for stacked in entry["stacked"] if stacked["part"] in own]
            entry["atlas"] = self.atlas
        return entry


def _is_mapped(outcome: PartsOutcome) -> bool:
    return outcome.islands[0].error is None


def _is_tiny(tasks: Sequence[Task], index: int) -> bool:
    """Whether one surface is so small beside another one that faces have the size of a texel's rounding."""
    extents = [float(np.ptp(task.surface.positions, axis=0).max()) for task in tasks]
    return extents[index] < TINY * max(extents)


def _lost_shares(whole: PartsIsland, surface: Surface, tasks: Sequence[Task]) -> np.ndarray:
    """The share of each surface's area in triangles without area in the UVs."""
    if whole.result is None:
        return np.zeros(len(tasks))
    points = surface.positions[surface.corner_vertex[surface.triangle_corners[surface.selected[surface.triangle_face]]]]
    points = points / max(float(np.abs(points).max(initial=0.0)), 1e-300)
    sides = points[:, 1:] - points[:, :1]
    area = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1)
    ends = [begin.face for begin in _begins([task.surface for task in tasks])]
    owner = np.searchsorted(ends, whole.numbers.triangle_face, side="right") - 1
    lost = np.zeros(len(area), dtype=bool)
    lost[whole.result.flipped_faces] = True
    total = np.bincount(owner, area, len(tasks))
    return np.bincount(owner[lost], area[lost], len(tasks)) / np.where(total > 0.0, total, 1.0)


def one_atlas(
    koebe: ModuleType, tasks: Sequence[Task], choice: PartsChoice, progress: Progress | None = None, cancel: Any = None
) -> list[PartsOutcome]:
    """Cut the selected faces of all surfaces into parts that share one UV square, or its tiles, at one texel density.

    A surface that cannot be mapped is left out, with its own error. So is one that would lose too much of its area,
    because it is too small beside the others. Errors are stored in the outcomes; `koebe.Cancelled` is raised.
    """
    if len(tasks) < 2:
        return [cut_into_parts(koebe, task, choice, progress, cancel) for task in tasks]
    surface = _joined_task(tasks)
    whole = cut_into_parts(koebe, surface, choice, progress, cancel).islands[0]
    lost = _lost_shares(whole, surface.surface, tasks)
    most_lost = choice.solver_arguments()["most_lost"]
    suspects = [k for k in range(len(tasks)) if whole.result is None or lost[k] > most_lost]
    left_out = {k: cut_into_parts(koebe, tasks[k], choice, None, cancel) for k in suspects}
    if whole.result is None:
        failed = {k: outcome for k, outcome in left_out.items() if not _is_mapped(outcome)}
        left_out = failed or {k: outcome for k, outcome in left_out.items() if _is_tiny(tasks, k)}
        if not left_out:
            return [PartsOutcome(task, [PartsIsland(error=whole.error)]) for task in tasks]
    if left_out:
        for k, outcome in left_out.items():
            if _is_mapped(outcome):  # but not beside the others
                left_out[k] = PartsOutcome(tasks[k], [PartsIsland(error=TooSmallError())])
        others = [dataclasses.replace(task, sketch=None) for k, task in enumerate(tasks) if k not in left_out]
        each = iter(one_atlas(koebe, others, choice, progress, cancel))
        return [left_out[k] if k in left_out else next(each) for k in range(len(tasks))]
    begins = _begins([task.surface for task in tasks])
    return [_share(task, tasks, whole, begin, end)
            for task, begin, end in zip(tasks, begins, begins[1:], strict=False)]  # fmt: skip


def _share(task: Task, tasks: Sequence[Task], whole: PartsIsland, begin: Begin, end: Begin) -> AtlasOutcome:
    """One surface's share of the outcome of all."""
    one = PartsIsland(whole.result, whole.error)
    names = [other.name for other in tasks]
    outcome = AtlasOutcome(task, [one], atlas=names, whole=whole, begin=begin)
    if whole.error is None:
        own = (whole.corners >= begin.corner) & (whole.corners < end.corner)
        one.corners, one.uv = whole.corners[own] - begin.corner, whole.uv[own]
        one.cuts = whole.cuts[begin.edge : end.edge]
    face, vertex = whole.numbers.triangle_face - begin.face, whole.numbers.source_vertex - begin.vertex
    others = (face < 0) | (face >= len(task.surface.face_start))
    one.numbers = Numbers(np.where(others, OTHERS, face), vertex)
    return outcome
