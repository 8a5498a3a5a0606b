# SPDX-License-Identifier: GPL-3.0-or-later
"""Moves and bends the islands of a new map until its pinned UVs are at their places."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError
from ..surfaces.surface import Island
from ..surfaces.uv_islands import uv_islands, vertex_uv
from .outcomes import Task
from .wording import named_vertices


@dataclasses.dataclass(frozen=True)
class JoinedPins:
    """UVs (m, 2) of the new corners. @param held (m,) bool, corners of islands with pins"""

    uv: np.ndarray
    held: np.ndarray

    def beside(self, task: Task, corners: np.ndarray) -> Task:
        """The task of the other islands: these stay where they are."""
        rest = np.full((len(task.surface.corner_vertex), 2), np.nan) if task.rest is None else task.rest.copy()
        rest[corners[self.held]] = self.uv[self.held]
        return dataclasses.replace(task, rest=rest)


def join_pins(
    koebe: ModuleType, task: Task, corners: np.ndarray, uv: np.ndarray, even: float, cancel: Any = None
) -> JoinedPins:
    """Put the pinned UVs of the task into their places. The other UVs of their islands follow, one to one.

    corners, uv  (m,), (m, 2) of the new islands
    even         E of three pins and more, which bend an island

    Raises MapError, koebe.KoebeError, koebe.Cancelled.
    """
    assert task.pins is not None
    layer = np.full((len(task.surface.corner_vertex), 2), np.nan)
    layer[corners] = uv
    is_new = np.zeros(len(layer), dtype=bool)
    is_new[corners] = True
    held = np.zeros(len(layer), dtype=bool)
    surface = dataclasses.replace(task.surface, selected=is_new[task.surface.face_start])
    for island in uv_islands(surface, layer):
        if not has_pins(island, task.pins):
            continue
        dial = koebe.EvenDial(island.vertices, island.triangles, uv=vertex_uv(island, layer), round=False)
        layer[island.corners] = pin_island(koebe, dial, island, task.pins, even, cancel)[island.corner_vertex]
        held[island.corners] = True
    return JoinedPins(layer[corners], held[corners])


def has_pins(island: Island, pins: np.ndarray) -> bool:
    """Whether an island has pinned UVs. @param pins (C, 2), NaN at other corners"""
    return bool(np.isfinite(pins[island.corners]).all(axis=1).any())


def pin_island(koebe: ModuleType, dial: Any, island: Island, pins: np.ndarray, even: float, cancel: Any) -> np.ndarray:
    """The island's vertices (n, 2) with its pins in their places. @param dial `koebe.EvenDial` of its UVs

    Raises as `join_pins`.
    """
    try:
        made: np.ndarray = dial.pin(pins_of(island, pins), even=even, cancel=cancel)
    except (koebe.SolverError, koebe.InputError) as error:
        if error.of != "vertices":
            raise
        raise MapError(_blocked(error, island)) from error
    return made


def _blocked(error: Any, island: Island) -> str:
    vertices = np.unique(island.source_vertex[np.asarray(error.elements, dtype=np.int64)])
    return f"{error}: unpin or move the UVs of {named_vertices(vertices.tolist())}"


def pins_of(island: Island, pins: np.ndarray) -> dict[int, tuple[float, float]]:
    """The place of each pinned vertex of the island. Raises MapError for a vertex with two places."""
    found: dict[int, tuple[float, float]] = {}
    pinned = np.flatnonzero(np.isfinite(pins[island.corners]).all(axis=1))
    for vertex, corner in zip(island.corner_vertex[pinned].tolist(), island.corners[pinned], strict=True):
        place = (float(pins[corner, 0]), float(pins[corner, 1]))
        if found.setdefault(vertex, place) != place:
            raise MapError(
                f"vertex {island.source_vertex[vertex]} is pinned at two places, and no cut parts them: unpin one, or "
                "mark a seam there"
            )
    return found
