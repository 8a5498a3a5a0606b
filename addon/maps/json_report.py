# SPDX-License-Identifier: GPL-3.0-or-later
"""Outcomes as JSON: the report that the batch script writes."""

from typing import Any

import numpy as np

from .domain_outcomes import DomainIsland, DomainOutcome
from .errors import elements_of, kind_of
from .handles import SchottkyIsland, SchottkyOutcome
from .opening import Opening
from .outcomes import Failed, IslandOutcome, SurfaceOutcome, Task
from .parts import PartsOutcome
from .rounding import RESOLUTION
from .spheres import SphereIsland, SphereOutcome
from .tiles import TileIsland, TileOutcome
from .triangles import longest_edges
from .wording import cut_line, warnings


def entries(outcome: SurfaceOutcome) -> list[dict[str, Any]]:
    """One dict per island: `result.to_dict()` in the mesh's vertex numbers, or the error.

    A piece of an island that was cut has the number of the cut, and the first of these has what was done.
    """
    numbers = {id(opening): number for number, opening in enumerate(outcome.openings)}
    said: set[int] = set()
    result = []
    for index, one in enumerate(outcome.islands):
        entry = _entry(outcome.task, index, one)
        if one.opening is not None:
            entry["opening"] = numbers[id(one.opening)]
            if id(one.opening) not in said:
                entry.update(_cuts(one.opening))
            said.add(id(one.opening))
        result.append(entry)
    return result


def _cuts(opening: Opening) -> dict[str, Any]:
    """What was cut, in the mesh's numbers."""
    return {
        "cuts": [{"kind": kind, "elements": vertices.tolist()} for kind, vertices in opening.cuts],
        "handles_cut": opening.handles,
        "turned": opening.turned.tolist(),
        "left_out": opening.left_out.tolist(),
        "cut_text": cut_line(opening),
    }


def domain_entries(outcome: DomainOutcome) -> list[dict[str, Any]]:
    """One dict per island: `result.to_dict()` in the mesh's numbers, as it is in the UVs, or the error."""
    if isinstance(outcome, TileOutcome):
        return [_tile_entry(outcome, index, one) for index, one in enumerate(outcome.islands)]
    if isinstance(outcome, SchottkyOutcome):
        return [_schottky_entry(outcome, index, one) for index, one in enumerate(outcome.islands)]
    assert isinstance(outcome, SphereOutcome)
    return [_sphere_entry(outcome, index, one) for index, one in enumerate(outcome.islands)]


def parts_entry(outcome: PartsOutcome) -> dict[str, Any]:
    """`result.to_dict()` in the mesh's numbers, or the error."""
    entry = _head(outcome.task, 0, outcome, int(np.count_nonzero(outcome.task.surface.selected)))
    if outcome.result is None:
        return entry
    result, numbers = outcome.result.to_dict(), outcome.numbers
    for part in result["parts"]:
        part["faces"] = np.unique(numbers.triangle_face[part["faces"]]).tolist()
        part["loops"] = [numbers.source_vertex[np.asarray(loop, dtype=np.int64)].tolist() for loop in part["loops"]]
    result["warnings"] = outcome.warnings()
    if outcome.error is not None:
        result["converged"] = False
    return {**result, **entry}


def _sphere_entry(outcome: SphereOutcome, index: int, one: SphereIsland) -> dict[str, Any]:
    """Of the sphere; `layout` is of the UVs."""
    entry = _head(outcome.task, index, one, len(one.island.faces))
    if one.result is None:
        return entry
    result, source = one.result.to_dict(), one.island.source_vertex
    for loop in result["loops"]:
        for key in ("vertices", "off_circle"):
            loop[key] = source[np.asarray(loop[key], dtype=np.int64)].tolist()
    result["turned"] = _faces(one, result["turned"])
    for key in ("crossing", "torn", "flipped", "below_resolution"):
        result["layout"][key] = _faces(one, result["layout"][key])
    result.update(_stored(one))
    result["warnings"] = outcome.warnings(one)
    return {**result, **entry, "domain": outcome.choice.domain}


def _schottky_entry(outcome: SchottkyOutcome, index: int, one: SchottkyIsland) -> dict[str, Any]:
    """Circles and generators are those of `koebe.SchottkyMap`."""
    entry = _head(outcome.task, index, one, len(one.island.faces))
    if one.result is None:
        return entry
    result, source = one.result.to_dict(), one.island.source_vertex
    for part, key in (("loops", "vertices"), ("handles", "cut")):
        for path in result[part]:
            path[key] = source[np.asarray(path[key], dtype=np.int64)].tolist()
    result["turned"] = _faces(one, result["turned"])
    result.update(_stored(one))
    result["warnings"] = outcome.warnings(one)
    return {**result, **entry, "domain": outcome.choice.domain}


def _stored(one: DomainIsland) -> dict[str, Any]:
    """What the UVs hold of the map; where too much is lost it is not done."""
    lost = {"converged": False} if one.error is not None else {}
    return {**one.stored.figures(), "flipped": len(one.flipped), **lost}


def _faces(one: DomainIsland, triangles: list[int]) -> list[int]:
    """The surface's faces that triangles of an island are of."""
    return np.unique(one.island.triangle_face[np.asarray(triangles, dtype=np.int64)]).tolist()


def _tile_entry(outcome: TileOutcome, index: int, one: TileIsland) -> dict[str, Any]:
    entry = _head(outcome.task, index, one, len(one.island.faces))
    if one.result is None:
        return entry
    result, source = one.result.to_dict(), one.island.source_vertex
    matrix, offset = one.tile.move
    for loop in result["loops"]:
        for key in ("vertices", "off_circle"):
            loop[key] = source[np.asarray(loop[key], dtype=np.int64)].tolist()
        if "slit" in loop:
            loop["slit"] = (np.array(loop["slit"]) @ matrix.T + offset).tolist()
        if "center" in loop and outcome.choice.domain == "torus":
            if outcome.choice.fit == "square":  # an ellipse
                del loop["center"], loop["radius"]
            else:
                center, loop["radius"] = one.circle(loop, outcome.choice.fit)
                loop["center"] = list(center)
    result["turned"] = _faces(one, result["turned"])
    result["periods"] = one.tile.periods.tolist()
    if outcome.choice.fit == "square":
        result.update(one.stored.report)
    result.update(_stored(one))
    result["warnings"] = outcome.warnings(one)
    return {**result, **entry, "domain": outcome.choice.domain, "fit": outcome.choice.fit}


def _head(task: Task, index: int, one: Failed, faces: int) -> dict[str, Any]:
    """Which island it is, and its error."""
    entry: dict[str, Any] = {"object": task.name, "island": index, "island_faces": faces}
    if one.error is None:
        return entry
    error: dict[str, Any] = {"name": type(one.error).__name__, "reason": str(one.error)}
    kind = kind_of(one.error)
    if kind is not None:
        error["kind"] = kind
        error["count"] = len(elements_of(one.error))
    return {**entry, "error": error}


def _entry(task: Task, index: int, one: IslandOutcome) -> dict[str, Any]:
    entry = _head(task, index, one, len(one.island.faces))
    if one.error is not None:
        return entry
    result = one.result.to_dict()
    source = one.island.source_vertex
    for name in {"center", "point"} & result.keys():
        result[name] = int(source[result[name]])
    for loop in result["loops"]:
        for key in ("vertices", "off_circle"):
            loop[key] = source[np.asarray(loop[key], dtype=np.int64)].tolist()
        if one.symmetry is not None:
            continue
        if not one.unrolled:
            loop["center"] = one.turned(np.array([loop["center"]]))[0].tolist()
    if one.symmetry is not None:
        for loop, made in zip(result["loops"], one.symmetry.image.loops, strict=True):
            loop["center"], loop["radius"] = [made.center.real, made.center.imag], made.radius
        result["symmetric"] = True
    if one.remark:
        result["remark"] = one.remark
    result.update(one.distortion or {})
    result.update(one.stored.figures())
    result["unrolled"] = one.unrolled
    result["warnings"] = warnings(task, one)
    result["flipped"] = len(one.flipped)  # of the UVs as they are written: turned, placed and rounded
    result["below_resolution"] = _below_resolution(one)
    return {**result, **entry, "placement": one.placement.to_dict()}


def _below_resolution(one: IslandOutcome) -> int:
    """Flipped triangles whose longest edge in the UVs is too short to be drawn."""
    corners = one.uv[one.sheet.triangles[one.flipped]].astype(np.float64)
    return int(np.count_nonzero(longest_edges(corners) < RESOLUTION))
