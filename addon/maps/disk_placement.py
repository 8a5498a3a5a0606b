# SPDX-License-Identifier: GPL-3.0-or-later
"""Where mapped disks and rectangles go in the UVs: packed, in their former places, or beside the other faces."""

import dataclasses
import itertools
from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np

from ..layers.packing import Placement, fit_placement, packed
from ..surfaces.errors import MapError, failing_alone
from ..surfaces.stored import SERVES
from ..surfaces.surface import Island
from ..surfaces.triangles import signed_areas
from .beside import OVER, PINNED_OVER, new_overlaps, put_beside
from .disk_outcomes import IslandOutcome, SurfaceOutcome
from .domain import DomainError
from .options import Options
from .outcomes import Task
from .pins import pins_of
from .wording import named_vertices


def lay_out(koebe: ModuleType, outcomes: Sequence[SurfaceOutcome], options: Options, cancel: Any) -> None:
    """Give every mapped island its placement."""
    moved = [outcome for outcome in outcomes if not (options.placement == "keep" and _keep_places(outcome))]
    groups = [[(outcome.task, one) for one in outcome.mapped] for outcome in moved]
    if options.placement == "together":
        groups = [list(itertools.chain.from_iterable(groups))]
    for group in groups:
        with failing_alone(koebe, [one for _, one in group]):
            _pack(koebe, group, options.margin / options.pixels)
    for outcome in outcomes:
        if outcome.task.pins is not None:
            _take_pins(koebe, outcome)
    for outcome in moved:
        if (outcome.task.rest is None and outcome.task.pins is None) or not outcome.mapped:
            continue
        if options.placement == "together" and len(moved) > 1:  # one square for the other faces of all objects
            outcome.remarks.append(OVER)
        else:
            with failing_alone(koebe, outcome.mapped):
                _put_beside(koebe, outcome, options, cancel)
    for outcome in outcomes:
        if outcome.task.pins is not None and outcome.mapped:
            with failing_alone(koebe, outcome.mapped):
                corners, uv = outcome.corner_uv()
                layer = _layer(outcome.task)
                layer[corners] = uv
                outcome.remarks += [PINNED_OVER] * new_overlaps(koebe, outcome.task.surface, layer, corners)


def _layer(task: Task) -> np.ndarray:
    """The UVs (C, 2) that stay, NaN elsewhere."""
    return np.full((len(task.surface.corner_vertex), 2), np.nan) if task.rest is None else task.rest.astype(np.float64)


def _take_pins(koebe: ModuleType, outcome: SurfaceOutcome) -> None:
    """Bring the pinned vertices of a surface's islands to their places. An island that cannot gets an error."""
    assert outcome.task.pins is not None
    for one in outcome.mapped:
        with failing_alone(koebe, [one]):
            pins = pins_of(one.sheet, outcome.task.pins)
            if pins:
                one.pins, one.placement = pins, _pinned(one, pins)


def _pinned(one: IslandOutcome, pins: dict[int, tuple[float, float]]) -> Placement:
    """The placement that brings one vertex to its place by a shift, or two by a similarity. Raises MapError."""
    points, places = one.flat[list(pins)], np.array(list(pins.values()))
    if len(pins) == 1:
        shift = places[0] - one.placement.apply(points)[0]
        x, y = (one.placement.offset + shift).tolist()
        return dataclasses.replace(one.placement, offset=(x, y))
    vertices = named_vertices(one.sheet.source_vertex[list(pins)].tolist())
    if len(pins) > 2:
        raise DomainError(
            f"{len(pins)} UVs are pinned: {vertices}. With round holes two can be kept, as no circle stays round if "
            f"a map is bent. {SERVES['parts']} keeps all. Or unpin the others", "parts",
        )  # fmt: skip
    placement = fit_placement(points, places)
    if placement is None:
        raise MapError(f"pinned at one place: unpin or move the UVs of {vertices}")
    return placement


def _put_beside(koebe: ModuleType, outcome: SurfaceOutcome, options: Options, cancel: Any) -> None:
    """Move the placed islands of a surface into the room that the islands of the other faces leave."""
    mapped, task = [one for one in outcome.mapped if not one.pins], outcome.task
    if not mapped:
        return
    if task.pins is not None:
        layer = _layer(task)
        for one in outcome.mapped:
            if one.pins:
                layer[one.sheet.corners] = one.uv[one.sheet.corner_vertex]
        task = dataclasses.replace(task, rest=layer)
    placed = [one.placement.apply(one.flat) for one in mapped]
    corners = np.concatenate([one.sheet.corners for one in mapped])
    uv = np.concatenate([at[one.sheet.corner_vertex] for one, at in zip(mapped, placed, strict=True)])
    made = put_beside(koebe, task, corners, uv, options.margin, options.pixels, cancel=cancel)
    if made is None:
        return
    layer = np.zeros((len(outcome.task.surface.corner_vertex), 2))
    layer[corners] = made.uv
    for one in mapped:
        placement = fit_placement(one.flat, layer[one.sheet.some_corner()])
        if placement is None:
            raise MapError("it is too small beside the other faces: unwrap them together")
        one.placement = placement
    outcome.remarks += [made.remark] * bool(made.remark)


def _pack(koebe: ModuleType, group: list[tuple[Task, IslandOutcome]], margin: float) -> None:
    if len(group) == 1:
        group[0][1].placement = Placement(scale=0.5 / _half_size(group[0][1]))
    elif group:
        most = koebe.maps.layout.MOST_IMPORTANT
        sizes = [_natural_radius(one.sheet, one.flat, task.importance, most) for task, one in group]
        for (_, one), placement in zip(group, packed(koebe, sizes, margin), strict=True):
            one.placement = placement


def _half_size(one: IslandOutcome) -> float:
    """Half the side of the smallest square around 0 that holds an island: 1 for a disk."""
    return float(np.abs(one.flat).max()) if one.unrolled else 1.0


def _keep_places(outcome: SurfaceOutcome) -> bool:
    """Place every island at its former place, or none. Returns whether all had a place."""
    if outcome.task.old_uv is None:
        return False
    found = [fit_placement(one.flat, outcome.task.old_uv[one.sheet.some_corner()]) for one in outcome.mapped]
    placements = [placement for placement in found if placement is not None]
    if len(placements) < len(found):
        return False
    for one, placement in zip(outcome.mapped, placements, strict=True):
        one.placement = placement
    return True


def _natural_radius(island: Island, uv: np.ndarray, importance: np.ndarray | None, most_important: float) -> float:
    """Radius of the disk where the island's mean texel density is one; up to `most_important` times as large."""
    in_disk, on_surface = np.abs(signed_areas(uv, island.triangles)).sum(), island.areas
    if importance is not None:
        weight = importance[island.source_vertex][island.triangles].mean(axis=1)
        on_surface = on_surface * most_important ** (2.0 * weight)
    return float(np.sqrt(on_surface.sum() / in_disk))
