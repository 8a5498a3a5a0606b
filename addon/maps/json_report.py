# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcomes as JSON: the report that the batch script writes."""

from typing import Any

import numpy as np

from .errors import elements_of, kind_of
from .outcomes import IslandOutcome, SurfaceOutcome, Task
from .rounding import RESOLUTION
from .triangles import longest_edges
from .wording import warnings


def entries(outcome: SurfaceOutcome) -> list[dict[str, Any]]:
    """One dict per island: `result.to_dict()` in the mesh's vertex numbers, or the error."""
    return [_entry(outcome.task, index, one) for index, one in enumerate(outcome.islands)]


def _entry(task: Task, index: int, one: IslandOutcome) -> dict[str, Any]:
    entry = {"object": task.name, "island": index, "island_faces": len(one.island.faces)}
    if one.error is not None:
        error: dict[str, Any] = {"name": type(one.error).__name__, "reason": str(one.error)}
        kind = kind_of(one.error)
        if kind is not None:
            error["kind"] = kind
            error["count"] = len(elements_of(one.error))
        return {**entry, "error": error}
    result = one.result.to_dict()
    source = one.island.source_vertex
    for name in {"center", "point"} & result.keys():
        result[name] = int(source[result[name]])
    for loop in result["loops"]:
        for key in ("vertices", "off_circle"):
            loop[key] = source[np.asarray(loop[key], dtype=np.int64)].tolist()
        if not one.unrolled:
            loop["center"] = one.turned(np.array([loop["center"]]))[0].tolist()
    result.update(one.distortion or {})
    result["unrolled"] = one.unrolled
    result["warnings"] = warnings(task, one)
    result["flipped"] = len(one.flipped)  # of the UVs as they are written: turned, placed and rounded
    result["below_resolution"] = _below_resolution(one)
    return {**result, **entry, "placement": one.placement.to_dict()}


def _below_resolution(one: IslandOutcome) -> int:
    """Flipped triangles whose longest edge in the UVs is too short to be drawn."""
    corners = one.uv[one.sheet.triangles[one.flipped]].astype(np.float64)
    return int(np.count_nonzero(longest_edges(corners) < RESOLUTION))
