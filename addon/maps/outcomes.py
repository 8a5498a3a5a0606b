# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be mapped, and what became of it, whatever the kind of map."""

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from .errors import elements_of, kind_of
from .offending_elements import offending_elements
from .surface import Surface
from .warning_words import in_words
from .wording import MIRRORED, PINNED, explain, failure_line, own_warning

Progress = Callable[[float, str], None]  # called with a fraction and a stage
# A vertex of the surface, or a place (3,) in its space that a vertex is to be nearest to.
Place = int | np.ndarray | None
LATER: Any = None  # of what is not there from the start, and is not asked for before it is


def share_of(progress: Progress | None, done: int, size: int, total: int) -> Progress | None:
    """Progress of some of all work as a part of that of all, given what is done before."""
    if progress is None:
        return None
    return lambda fraction, stage: progress((done + fraction * size) / max(total, 1), stage)


@dataclasses.dataclass(frozen=True)
class Task:
    """A surface to map.

    `name` is its object's; `outer` is "auto", "longest" or a vertex of the surface; `center` and `point` are
    the vertices that go to the disk's centre and to its right end; `old_uv` (C, 2) are the UVs of the
    surface's corners that the placement "keep" goes by; `mirrored` tells that its object's scale is
    negative, `pinned` that UVs of the layer to write are pinned. `importance` (V,) in [0, 1] weighs the balance.
    `picked` (V,) bool are the vertices by which the rims of rings are known.
    """

    name: str
    surface: Surface
    outer: str | int = "auto"
    mirrored: bool = False
    pinned: bool = False
    old_uv: np.ndarray | None = None
    center: Place = None
    point: Place = None
    importance: np.ndarray | None = None
    picked: np.ndarray | None = None


@dataclasses.dataclass
class Outcome:
    """What became of one surface. A kind of map is a subclass, and what it leaves open.

    islands      what became of each: with a `result` of the native package, or an `error`
    not_written  why nothing of it could be written, or None
    remarks      what to say of the object beside its islands
    chosen       which shape was taken for it and why, where nobody has chosen
    """

    task: Task
    islands: list[Any]
    not_written: str | None = dataclasses.field(default=None, kw_only=True)
    remarks: list[str] = dataclasses.field(default_factory=list, kw_only=True)
    chosen: str = dataclasses.field(default="", kw_only=True)

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
        """Whether every mapped island is what it promises."""
        return all(one.result.converged for one in self.mapped)

    @property
    def is_good(self) -> bool:
        """Whether there is nothing in its line that has to be looked at."""
        return self.converged

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        mapped = self.mapped
        return np.concatenate([one.corners for one in mapped]), np.concatenate([one.uv for one in mapped])

    def offending(self) -> list[tuple[str, np.ndarray]]:
        """Kind and numbers of the elements at fault, for each island that has an error."""
        return [offending_elements(self.task.surface, one.island, one.error) for one in self.failed]

    # ---------------------------------------------------------------- words

    def line(self) -> str:
        """One line on what was mapped."""
        raise NotImplementedError

    def warnings(self, one: Any) -> list[dict[str, Any]]:
        """What to watch out for in a mapped island: kind, elements in the mesh's numbers, text."""
        raise NotImplementedError

    def notes(self) -> list[tuple[Any, str]]:
        """What was done to mapped islands beside their maps, or cannot be otherwise."""
        return []

    def said_warnings(self) -> list[str]:
        """What to watch out for in all of it."""
        return [said["text"] for one in self.mapped for said in in_words(self.warnings(one))]

    def said_notes(self) -> list[str]:
        """The notes of all islands."""
        return [text for _, text in self.notes()]

    def _own_warnings(self) -> list[dict[str, Any]]:
        """What to watch out for in all islands, beside what the solver warns of."""
        task = self.task
        return [own_warning("mirrored", MIRRORED)] * task.mirrored + [own_warning("pinned", PINNED)] * task.pinned

    # ---------------------------------------------------------------- the JSON report of the batch script

    def entries(self) -> list[dict[str, Any]]:
        """One dict per island: the native result's `to_dict()` in the mesh's numbers, or the error."""
        return [self._entry(index, one) for index, one in enumerate(self.islands)]

    def _entry(self, index: int, one: Any) -> dict[str, Any]:
        raise NotImplementedError

    def _head(self, index: int, one: Any, faces: int) -> dict[str, Any]:
        """Which island it is, and its error."""
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
        """What the report keeps of each island that was written to a UV layer, or why it was not.

        By the names of state/run_report.py; lists are kept there as JSON, but `loops` as entries of their own.
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
                row["warnings"] = [*in_words(warnings), *({"text": remark} for remark in self.remarks)]
                row |= {"note": "; ".join(said.get(id(one), [])), **self._row(one)}
            else:
                kind, elements = offending_elements(self.task.surface, one.island, one.error)
                row |= {"message": explain(one.error), "offer": _offer(one.error)}
                row |= {"offenders": [kind, elements.tolist()]}
            result.append(row)
        return result

    def _row(self, one: Any) -> dict[str, Any]:
        """What the report keeps of a mapped island beside words."""
        raise NotImplementedError

    def _failure_row(self) -> dict[str, Any]:
        """The row of an object of which nothing can be kept."""
        offers = [_offer(one.error) for one in self.failed]
        return failure_row(self.task.name, failure_line(self), offers[0] if offers else "")


def failure_row(name: str, text: str, offer: str = "") -> dict[str, Any]:
    """The row of an object that was left out as a whole."""
    return {"object_name": name, "message": text.removeprefix(f"{name}: "), "offer": offer}


def _offer(error: Exception | None) -> str:
    """The operators that take what this error is of."""
    return " ".join(getattr(error, "offer", ()))


def in_numbers(paths: list[dict[str, Any]], numbers: np.ndarray, *keys: str) -> None:
    """Turn the solver's vertices in dicts of a report into those of the mesh."""
    for path in paths:
        for key in keys:
            if key in path:
                path[key] = numbers[np.asarray(path[key], dtype=np.int64)].tolist()
