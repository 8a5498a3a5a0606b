# SPDX-License-Identifier: GPL-3.0-or-later
"""The tasks of a map of any kind, and their outcomes."""

import dataclasses
from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import elements_of, kind_of
from ..surfaces.offending_elements import offending_elements
from ..surfaces.surface import Surface
from .warning_words import in_words
from .wording import MIRRORED, explain, failure_line, own_warning

Progress = Callable[[float, str], None]  # called with a fraction and a stage
# A vertex of the surface, or a place (3,) in its space: then the nearest vertex is meant.
Place = int | np.ndarray | None
LATER: Any = None  # for values that are set later, before they are used


def share_of(progress: Progress | None, done: int, size: int, total: int) -> Progress | None:
    """Progress of a part of the work as progress of all work, after the finished part."""
    if progress is None:
        return None
    return lambda fraction, stage: progress((done + fraction * size) / max(total, 1), stage)


class Sketch:
    """Where a surface will be cut, as far as it is decided, while another thread computes."""

    def __init__(self) -> None:
        self._drawn: tuple[Any, np.ndarray] | None = None

    def begin(self, koebe: ModuleType, source_vertex: np.ndarray) -> Any:
        """A native sketch for a computation. @param source_vertex the surface's vertex for each of its vertices"""
        native = koebe.CutSketch()
        self._drawn = native, source_vertex
        return native

    def take(self) -> np.ndarray:
        """The cuts, as pairs (E, 2) of vertices of the surface; none if nothing is new."""
        if self._drawn is None:
            return np.zeros((0, 2), dtype=np.int32)
        native, source_vertex = self._drawn
        return np.asarray(source_vertex[native.take()])


@dataclasses.dataclass(frozen=True)
class Task:
    """A surface to map.

    `name` is its object's; `outer` is "auto", "longest" or a vertex of the surface; `center` and `point` are the
    vertices for the disk's centre and its right end; `old_uv` (C, 2) are the UVs of the surface's corners for the
    placement "keep"; `mirrored`: its object's scale is negative.
    `importance` (V,) in [0, 1] weighs the sizes of faces. `show` (V,) in [0, 1]: cuts of parts keep away from 1.
    `rest` (C, 2) are the UVs of the layer if faces that are not selected stay there. `pins` (C, 2) are the pinned UVs,
    NaN at other corners; None without pins. `sketch` is drawn on by maps into parts.
    `like` is the density that parts get: sides of the UV square per unit of length. `picked` (V,)
    bool are vertices that choose the rims of rings.
    """

    name: str
    surface: Surface
    outer: str | int = "auto"
    mirrored: bool = False
    old_uv: np.ndarray | None = None
    center: Place = None
    point: Place = None
    importance: np.ndarray | None = None
    show: np.ndarray | None = None
    like: float | None = None
    picked: np.ndarray | None = None
    rest: np.ndarray | None = None
    pins: np.ndarray | None = None
    sketch: Sketch | None = None


@dataclasses.dataclass
class Outcome:
    """The outcome of one surface. Each kind of map is a subclass with the missing parts.

    islands      the outcome of each: with a `result` of the native package, or an `error`
    not_written  why nothing of it could be written, or None
    remarks      notes on the object beside its islands
    chosen       the shape that was taken and why, if nobody has chosen
    hints        which other UV layers its materials show. The panel looks anew whenever it is drawn
    """

    task: Task
    islands: list[Any]
    not_written: str | None = dataclasses.field(default=None, kw_only=True)
    remarks: list[str] = dataclasses.field(default_factory=list, kw_only=True)
    chosen: str = dataclasses.field(default="", kw_only=True)
    hints: list[str] = dataclasses.field(default_factory=list, kw_only=True)

    @property
    def name(self) -> str:
        """Name of the surface's object."""
        return self.task.name

    @property
    def mapped(self) -> list[Any]:
        """The islands that have a result, unless it could not be written."""
        return [] if self.not_written else [one for one in self.islands if one.error is None]

    @property
    def failed(self) -> list[Any]:
        """The islands that have an error."""
        return [one for one in self.islands if one.error is not None]

    @property
    def converged(self) -> bool:
        """Whether every mapped island keeps its promises."""
        return all(one.result.converged for one in self.mapped)

    @property
    def is_good(self) -> bool:
        """Whether its line has nothing to look at."""
        return self.converged

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        mapped = self.mapped
        return np.concatenate([one.corners for one in mapped]), np.concatenate([one.uv for one in mapped])

    def offending(self) -> list[tuple[str, np.ndarray]]:
        """Kind and numbers of the offending elements, for each island with an error."""
        return [offending_elements(self.task.surface, one.island, one.error) for one in self.failed]

    # ---------------------------------------------------------------- words

    def line(self) -> str:
        """One line on what was mapped."""
        raise NotImplementedError

    def warnings(self, one: Any) -> list[dict[str, Any]]:
        """Warnings about a mapped island: kind, elements in the mesh's numbers, text."""
        raise NotImplementedError

    def notes(self) -> list[tuple[Any, str]]:
        """Notes on mapped islands: changes beside their maps, and limits."""
        return []

    def said_warnings(self) -> list[str]:
        """The warnings of all islands."""
        return [said["text"] for one in self.mapped for said in self._in_words(one)]

    def _in_words(self, one: Any) -> list[dict[str, Any]]:
        return in_words(self.warnings(one), getattr(one, "opening", None) is not None)

    def said_notes(self) -> list[str]:
        """The notes of all islands."""
        return [text for _, text in self.notes()]

    def _own_warnings(self) -> list[dict[str, Any]]:
        """Warnings about all islands, beside the solver's."""
        return [own_warning("mirrored", MIRRORED)] * self.task.mirrored

    # ---------------------------------------------------------------- the JSON report of the batch script

    def entries(self) -> list[dict[str, Any]]:
        """One dict per island: the native result's `to_dict()` in the mesh's numbers, or the error."""
        return [self._entry(index, one) for index, one in enumerate(self.islands)]

    def _entry(self, index: int, one: Any) -> dict[str, Any]:
        raise NotImplementedError

    def _head(self, index: int, one: Any, faces: int) -> dict[str, Any]:
        """The number of the island, and its error."""
        entry: dict[str, Any] = {"object": self.task.name, "island": index, "island_faces": faces}
        if one.error is None:
            return entry
        error: dict[str, Any] = {"name": type(one.error).__name__, "reason": str(one.error)}
        kind = kind_of(one.error)
        if kind is not None:
            error["kind"] = kind
            error["count"] = len(elements_of(one.error))
        return {**entry, "error": error}

    # ---------------------------------------------------------------- the report in Blender

    def rows(self, layer: str) -> list[dict[str, Any]]:
        """Rows of the report for each island written to a UV layer, or the reason why it was not.

        Keys are the names in state/run_report.py. The report keeps lists as JSON, but `loops` as entries of their own.
        """
        if self.not_written:
            return [failure_row(self.name, self.not_written)]
        said: dict[int, list[str]] = {id(one): [self.chosen] for one in self.mapped[:1] if self.chosen}
        for one, text in self.notes():
            said.setdefault(id(one), []).append(text)
        result = []
        for index, one in enumerate(self.islands):
            row: dict[str, Any] = {"object_name": self.name, "island": index, "layer": layer}
            if one.error is None:
                warnings = self.warnings(one)
                texts = [*(warning["text"] for warning in warnings), *self.remarks]
                row |= {"mapped": True, "converged": one.result.converged, "message": "; ".join(texts)}
                row["warnings"] = [*self._in_words(one), *({"text": remark} for remark in self.remarks)]
                row |= {"note": "; ".join(said.get(id(one), [])), **self._row(one)}
            else:
                kind, elements = offending_elements(self.task.surface, one.island, one.error)
                row |= {"message": explain(one.error), "offer": _offer(one.error)}
                row |= {"offenders": [kind, elements.tolist()]}
            result.append(row)
        return result

    def _row(self, one: Any) -> dict[str, Any]:
        """The row of a mapped island, without its texts."""
        raise NotImplementedError

    def _failure_row(self) -> dict[str, Any]:
        """The row of an object without any result."""
        offers = [_offer(one.error) for one in self.failed]
        return failure_row(self.task.name, failure_line(self), offers[0] if offers else "")


def failure_row(name: str, text: str, offer: str = "") -> dict[str, Any]:
    """The row of an object that was left out as a whole."""
    return {"object_name": name, "message": text.removeprefix(f"{name}: "), "offer": offer}


def _offer(error: Exception | None) -> str:
    """The operators that take a surface with this error."""
    return " ".join(getattr(error, "offer", ()))


def in_numbers(paths: list[dict[str, Any]], numbers: np.ndarray, *keys: str) -> None:
    """Translate the solver's vertices in a report's dicts to the mesh's."""
    for path in paths:
        for key in keys:
            if key in path:
                path[key] = numbers[np.asarray(path[key], dtype=np.int64)].tolist()
