# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps one surface in several shapes, each laid over the first: frames of an animation, shape keys."""

import dataclasses
from collections.abc import Sequence
from types import ModuleType
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from ..surfaces.errors import MapError, failing_alone
from ..surfaces.surface import Surface
from .disk_outcomes import IslandOutcome, SurfaceOutcome
from .mapping import check_area, judge_island, map_surfaces
from .options import Options
from .outcomes import Outcome, Progress, Task, share_of
from .wording import counted

if TYPE_CHECKING:
    import koebe

ALIKE = 1e-6  # of the largest coordinate: rounding error to 32 bits of edges in equal shapes
NAMED = 6  # shapes in one message


class Shape(Protocol):
    """A shape of a surface.

    positions  (V, 3), as in `Surface`
    """

    @property
    def label(self) -> str: ...
    @property
    def positions(self) -> np.ndarray: ...


@dataclasses.dataclass
class SequenceOutcome(Outcome):
    """The outcome of a surface in its shapes: a map of each, or only the shape that failed.

    islands  those of the failed shape
    labels   of the shapes
    maps     in the order of the shapes; the names of their tasks name the shapes
    broken   the shape that could not be mapped
    alike    number of shapes that are equal up to their places, and so have one map; 0 otherwise
    written  the UV layer for each shape or, if not `in_layers`, its attribute
    in_uv    whether a UV layer has the only map, beside the attribute
    how_shown  a sentence: where the maps are to be seen
    """

    labels: list[str]
    maps: list[SurfaceOutcome]
    broken: SurfaceOutcome | None = None
    alike: int = 0
    written: list[str] = dataclasses.field(default_factory=list)
    in_layers: bool = True
    in_uv: bool = False
    how_shown: str = ""

    @property
    def name(self) -> str:
        """Name of the surface's object, and of the failed shape."""
        return self.task.name if self.broken is None else self.broken.name

    @property
    def mapped(self) -> list[SurfaceOutcome]:
        """The maps that can be written, or were: all, or an empty list."""
        return [] if self.broken is not None or self.not_written else self.maps

    @property
    def converged(self) -> bool:
        """Whether every map reached the tolerance."""
        return all(one.converged for one in self.mapped)

    @property
    def is_good(self) -> bool:
        return self.converged and not self.alike

    def offending(self) -> list[tuple[str, np.ndarray]]:
        """Empty: the object shows another shape."""
        return []

    def line(self) -> str:
        """One line on all maps."""
        seconds = sum(one.result.seconds["total"] for made in self.maps for one in made.mapped)
        return f"{self.task.name}: {self.figures()}, {seconds:.2f} s"

    def figures(self) -> str:
        """Figures over all maps."""
        angles = [made.mean_angle_error for made in self.maps]
        return ", ".join([
            counted(len(self.maps), "shape"),
            counted(sum(len(one.result.loops) for one in self.maps[0].mapped), "loop"),
            *self._quality(f", mean {sum(angles) / len(angles):.2f}°"),
        ])  # fmt: skip

    def _quality(self, mean: str = "") -> list[str]:
        """How good the maps are, for the report. @param mean the words on the mean angle error"""
        angles = [made.mean_angle_error for made in self.maps]
        late = [label for label, made in zip(self.labels, self.maps, strict=True) if not made.converged]
        return [
            f"angle error {min(angles):.2f}° to {max(angles):.2f}°{mean}",
            counted(sum(len(one.flipped) for made in self.maps for one in made.mapped), "flip"),
            *([f"NOT CONVERGED: {named(late)}"] if late else []),
        ]

    def said_warnings(self) -> list[str]:
        """The warnings, each once, with the shapes that it applies to unless it applies to all."""
        found: dict[str, list[str]] = {}
        for label, made in zip(self.labels, self.maps, strict=True):
            for text in dict.fromkeys(made.said_warnings()):
                found.setdefault(text, []).append(label)
        return self._nothing_moves() + [
            text if len(labels) == len(self.labels) else f"{text} ({named(labels)})" for text, labels in found.items()
        ]

    def _nothing_moves(self) -> list[str]:
        if self.alike:
            return [f"nothing moves: its faces keep their form in all {self.alike} shapes, so one map is written"]
        return ["only one shape was mapped, so nothing moves"] if len(self.maps) == 1 else []

    def said_notes(self) -> list[str]:
        return [self.how_shown] if self.how_shown else []

    def entries(self) -> list[dict[str, Any]]:
        """One entry of the JSON report per shape and island; `shape` and `written` name the shape and its UVs."""
        if self.broken is not None:
            return [{**one, "object": self.task.name} for one in self.broken.entries()]
        return [
            {**one, "object": self.task.name, "shape": label, "written": name, "alike": self.alike}
            for label, name, made in zip(self.labels, self.written, self.maps, strict=True)
            for one in made.entries()
        ]

    def rows(self, layer: str) -> list[dict[str, Any]]:
        """Rows of the report for each shape and island. The layer is the shape's, if it has one."""
        if not self.mapped:
            return [self._failure_row()]
        in_short = ", ".join([counted(len(self.maps), "map"), *self._quality()])
        said = "; ".join(filter(None, [self.how_shown, in_short]))
        layers = self.written if self.in_layers else [layer if self.in_uv else ""] * len(self.written)
        own = [*self._nothing_moves(), *self.remarks]
        return [
            {**row, "object_name": self.task.name, "shape": label, "note": "; ".join(filter(None, [said, row["note"]])),
             "message": "; ".join(filter(None, [*own, row["message"]])),
             "warnings": [*({"text": text} for text in own), *row["warnings"]]}
            for label, layer, made in zip(self.labels, layers, self.maps, strict=True)
            for row in made.rows(layer)
        ]  # fmt: skip


def are_alike(shapes: Sequence[Shape], triangles: np.ndarray) -> bool:
    """Whether all shapes are equal up to scale, by the edges of the triangles (t, 3): then they have one map.

    Moving, turning and bending without stretching keeps them equal.
    """
    first = _edge_lengths(shapes[0].positions, triangles)
    for shape in shapes[1:]:
        length = _edge_lengths(shape.positions, triangles)
        scale = length.sum() / max(first.sum(), np.finfo(float).tiny)
        if not (np.abs(length - scale * first) <= ALIKE * np.abs(shape.positions).max(initial=0.0)).all():
            return False
    return True


def _edge_lengths(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    corners = positions[triangles]
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2)


def named(labels: Sequence[str]) -> str:
    """The first shapes' labels, and the number of the others."""
    more = [f"{len(labels) - NAMED} more"] if len(labels) > NAMED else []
    return ", ".join([*labels[:NAMED], *more])


def map_sequence(
    koebe: ModuleType, task: Task, shapes: Sequence[Shape], options: Options, progress: Progress | None, cancel: Any
) -> SequenceOutcome:
    """Map the task's surface, in its first shape, by `map_surfaces`, and then the other shapes over it.

    The free choices, which are outer loop, cuts, turn and place in the UVs, are as in the first map. Ends with the
    first shape that has no map. Raises `koebe.Cancelled`.
    """
    kept = _Kept(koebe)
    outcome = SequenceOutcome(task, [], [shape.label for shape in shapes], [])
    for number, shape in enumerate(shapes):
        of_shape = _of_shape(task, shape)
        part = share_of(progress, number, 1, len(shapes))
        if number == 0:
            (made,) = map_surfaces(kept, [of_shape], options, _saying(part, shape), cancel)  # type: ignore[arg-type]
        else:
            made = _next_map(kept, outcome.maps[0], of_shape, options.most_lost, _saying(part, shape), cancel)
        if made.failed or not made.islands:
            outcome.broken, outcome.islands = made, made.islands
            break
        outcome.maps.append(made)
    return outcome


class _Kept:
    """The native package, except that it keeps the surface of each map, to map it again."""

    def __init__(self, koebe: ModuleType) -> None:
        self._koebe = koebe
        self._surfaces: dict[int, tuple[Any, Any]] = {}

    def __getattr__(self, name: str) -> Any:
        return getattr(self._koebe, name)

    def uniformize(
        self, vertices: np.ndarray, triangles: np.ndarray, *, progress: Any, cancel: Any, engine: str, even: float,
        loops: str, margin: float, pixels: int, **options: Any
    ) -> "koebe.UniformizeResult":  # fmt: skip
        """As the package's, conformal, with the condensed engine, which alone can map again. It packs no pieces."""
        surface = self._koebe.Surface(vertices, triangles, **options)
        result = surface.uniformize(progress=progress, cancel=cancel)
        self._surfaces[id(result)] = result, surface  # keep the result, too: then no other result gets its id
        return result

    def surface_of(self, result: "koebe.UniformizeResult") -> "koebe.Surface":
        """The surface of a result."""
        return self._surfaces[id(result)][1]


def _of_shape(task: Task, shape: Shape) -> Task:
    surface: Surface = dataclasses.replace(task.surface, positions=shape.positions)
    return dataclasses.replace(task, name=f"{task.name}, {shape.label}", surface=surface)


def _saying(progress: Progress | None, shape: Shape) -> Progress | None:
    """Progress with the shape as its stage."""
    if progress is None:
        return None
    return lambda fraction, stage: progress(fraction, f"mapping {shape.label}")


def _next_map(
    kept: _Kept, first: SurfaceOutcome, task: Task, most_lost: float, progress: Progress | None, cancel: Any
) -> SurfaceOutcome:
    """The map of another shape, laid over the first."""
    islands, done = [], 0
    total = sum(len(one.island.triangles) for one in first.islands)
    for old in first.islands:
        vertices = np.ascontiguousarray(task.surface.positions[old.island.source_vertex])
        island = dataclasses.replace(old.island, vertices=vertices)
        one = IslandOutcome(
            island, sheet=island, places=old.places, opening=old.opening, turn=old.turn, placement=old.placement
        )
        size = len(island.triangles)
        with failing_alone(kept, [one]):  # type: ignore[arg-type]
            check_area(island)
            one.result = kept.surface_of(old.result).uniformize(
                vertices, progress=share_of(progress, done, size, total), cancel=cancel
            )
            one.shape = one.result.uv
            if not np.isfinite(one.uv).all():  # computed here, on this thread
                raise MapError("its UVs are not finite")
            judge_island(kept, one, most_lost)  # type: ignore[arg-type]
        islands.append(one)
        done += size
    return SurfaceOutcome(task, islands)


def point_values(surface: Surface, corners: np.ndarray, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """Vertices (k,) and their UVs (k, 2), from UVs (m, 2) of corners (m,); None if corners of a vertex differ."""
    vertex = surface.corner_vertex[corners]
    values = np.zeros((len(surface.positions), 2), dtype=uv.dtype)
    values[vertex] = uv
    if not np.array_equal(values[vertex], uv):
        return None
    found = np.unique(vertex)
    return found, values[found]
