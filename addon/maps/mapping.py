# SPDX-License-Identifier: GPL-3.0-or-later
"""From surfaces to UV coordinates of their corners: the one function behind operator and batch."""

import contextlib
import traceback
from collections.abc import Iterable, Iterator, Sequence
from types import ModuleType
from typing import Any

import numpy as np

from . import places
from .islands import cut_into_islands, whole_island
from .options import Options
from .outcomes import IslandOutcome, MapError, Progress, SurfaceOutcome, Task
from .packing import Placement, fit_placement, pack_disks
from .surface import Island
from .triangles import areas, signed_areas
from .tube import unroll
from .upright import upright_turn

# Of the largest coordinate: so far beside a line the rounding of 32-bit coordinates may leave a vertex, and a bit more.
FLAT = 2.4e-7
FEW = 1000  # triangles that are looked at first


def map_surfaces(
    koebe: ModuleType, tasks: Sequence[Task], options: Options, progress: Progress | None = None, cancel: Any = None
) -> list[SurfaceOutcome]:
    """Map every island of every task's surface to its circle domain and lay the islands out.

    `koebe` is the native package; `progress(fraction, stage)` is called on this thread; `cancel` is a
    `koebe.CancelToken`, and `koebe.Cancelled` ends everything. Any other error is the outcome of its island.
    """
    sizes = [int(np.count_nonzero(task.surface.selected[task.surface.triangle_face])) for task in tasks]
    done, outcomes = 0, []
    for task, size in zip(tasks, sizes, strict=True):
        share = _share_of(progress, done, size, sum(sizes))
        outcome = SurfaceOutcome(task, _map_islands(koebe, task, options, share, cancel))
        _shape(koebe, outcome, options)
        outcomes.append(outcome)
        done += size
    _lay_out(koebe, outcomes, options)
    for outcome in outcomes:
        for one in outcome.mapped:
            if not np.isfinite(one.uv).all():  # worked out here, on this thread
                one.error = MapError("its UVs are not finite")
    return outcomes


def _map_islands(
    koebe: ModuleType, task: Task, options: Options, progress: Progress | None, cancel: Any
) -> list[IslandOutcome]:
    """The outcome of each island of a task's surface."""
    first: IslandOutcome | None = None
    whole = whole_island(task.surface)
    if whole is not None:
        (first,) = _map_each(koebe, [whole], task, options, progress, cancel)
        if first.error is None:
            return [first]
    islands = cut_into_islands(task.surface)
    if first is not None and len(islands) == 1 and len(islands[0].vertices) == len(first.island.vertices):
        return [first]  # nothing to cut: the error is the island's own
    return _map_each(koebe, islands, task, options, progress, cancel)


def _map_each(
    koebe: ModuleType, islands: list[Island], task: Task, options: Options, progress: Progress | None, cancel: Any
) -> list[IslandOutcome]:
    done, total = 0, sum(len(island.triangles) for island in islands)
    outcomes = []
    fixed = zip(islands, places.centers(islands, task.center), places.points(islands, task.point), strict=True)
    for island, center, point in fixed:
        share = _share_of(progress, done, len(island.triangles), total)
        vertices = {"outer": _outer_loop(island, task.outer), "center": center, "point": point}
        outcomes.append(_map_island(koebe, island, vertices, options, share, cancel))
        done += len(island.triangles)
    return outcomes


def _share_of(progress: Progress | None, done: int, part: int, total: int) -> Progress | None:
    if progress is None:
        return None
    return lambda fraction, stage: progress((done + fraction * part) / total, stage)


def _map_island(
    koebe: ModuleType,
    island: Island,
    vertices: dict[str, Any],
    options: Options,
    progress: Progress | None,
    cancel: Any,
) -> IslandOutcome:
    arguments = options.solver_arguments()
    one = IslandOutcome(island)
    with _failing_alone(koebe, [one]):
        _check_area(island)
        if options.tube == "unroll" and _is_tube(koebe, island):
            # A concentric annulus keeps its digits however small the hole; moved off the centre it loses them.
            arguments["balance"] = "none"
            vertices = {"outer": vertices["outer"]}
        if vertices.get("center") is not None:
            places.check_center(island, vertices["center"])
            arguments["balance"] = "none"  # which chooses the centre as well
        if vertices.get("point") is not None:
            places.check_point(island, vertices["point"])
        one.result = koebe.uniformize(
            island.vertices,
            island.triangles,
            progress=progress,
            cancel=cancel,
            **vertices,
            **arguments,
        )
    return one


def _is_tube(koebe: ModuleType, island: Island) -> bool:
    return len(koebe.boundary_loops(island.triangles, vertex_count=len(island.vertices))) == 2


def _check_area(island: Island) -> None:
    """Raise MapError where every face is collapsed; coordinates that are not finite are the solver's to judge."""
    some = island.triangles[:: max(1, len(island.triangles) // FEW)]
    if _are_flat(island.vertices, some) and _are_flat(island.vertices, island.triangles):
        raise MapError("the surface is collapsed to a line: none of its faces has an area")


def _are_flat(vertices: np.ndarray, triangles: np.ndarray) -> bool:
    """Whether no triangle has an area beyond what rounding can give it."""
    a, b, c = (vertices.take(corner, axis=0) for corner in triangles.T)
    with np.errstate(invalid="ignore"):
        longest = np.max([np.linalg.norm(one - two, axis=1) for one, two in ((a, b), (b, c), (c, a))], axis=0)
        return bool((areas(vertices, triangles) <= FLAT * np.abs(vertices).max() * longest).all())


@contextlib.contextmanager
def _failing_alone(koebe: ModuleType, ones: Iterable[IslandOutcome]) -> Iterator[None]:
    """Whatever goes wrong inside is the error of these islands, and what comes after goes on."""
    try:
        yield
    except koebe.Cancelled:
        raise
    except Exception as error:
        for one in ones:
            one.error = _foreseen(koebe, error)


def _foreseen(koebe: ModuleType, error: Exception) -> Exception:
    """The error, if it was meant to be read; else one that says so, and where it comes from on the console."""
    if isinstance(error, (koebe.KoebeError, MapError)):
        return error
    traceback.print_exception(type(error), error, error.__traceback__)
    return MapError(f"{type(error).__name__}, which nobody foresaw: {error}")


def _shape(koebe: ModuleType, outcome: SurfaceOutcome, options: Options) -> None:
    """Give the mapped islands of a surface their shapes: disks as they are or unrolled, and upright if asked."""
    for one in outcome.mapped:
        one.sheet, one.shape = one.island, one.result.uv
    tubes = [one for one in outcome.mapped if options.tube == "unroll" and len(one.result.loops) == 2]
    with _failing_alone(koebe, tubes):
        cases = [(one.island, one.result.uv, one.result.loops) for one in tubes]
        for one, unrolled in zip(tubes, unroll(outcome.task.surface, cases), strict=True):
            if unrolled is None:
                one.error = MapError("the tube cannot be cut open along its edges: take Tube: Annulus")
                continue
            one.sheet, one.shape = unrolled
            one.distortion = koebe.distortion(one.sheet.vertices, one.sheet.triangles, one.shape)
    for one in outcome.mapped if options.upright else ():
        if one.result.point is not None:
            continue
        with _failing_alone(koebe, [one]):
            turn = upright_turn(one.sheet, one.shape)
            # A rectangle stays level.
            one.turn = (1.0 if turn.real >= 0.0 else -1.0 + 0.0j) if one.unrolled else turn


def _outer_loop(island: Island, outer: str | int) -> str | int:
    """The solver's `outer` for this island: a vertex counts only for the island that has it."""
    if isinstance(outer, str):
        return outer
    here = np.flatnonzero(island.source_vertex == outer)
    return int(here[0]) if len(here) else "auto"


def _lay_out(koebe: ModuleType, outcomes: Sequence[SurfaceOutcome], options: Options) -> None:
    """Give every mapped island its placement."""
    if options.placement == "together":
        groups = [[one for outcome in outcomes for one in outcome.mapped]]
    else:
        groups = [outcome.mapped for outcome in outcomes if not (options.placement == "keep" and _keep_places(outcome))]
    for group in groups:
        with _failing_alone(koebe, group):
            _pack(group, options.margin)


def _pack(group: list[IslandOutcome], margin: float) -> None:
    if len(group) == 1:
        group[0].placement = Placement(scale=0.5 / _half_size(group[0]))
    elif group:
        sizes = [_natural_radius(one.sheet, one.flat) for one in group]
        for one, placement in zip(group, pack_disks(sizes, margin), strict=True):
            one.placement = placement


def _half_size(one: IslandOutcome) -> float:
    """Half the side of the smallest square around 0 that holds an island: 1 for a disk."""
    return float(np.abs(one.flat).max()) if one.unrolled else 1.0


def _keep_places(outcome: SurfaceOutcome) -> bool:
    """Place every island where it was, or none: whether all of them had a place."""
    if outcome.task.old_uv is None:
        return False
    found = [fit_placement(one.flat, outcome.task.old_uv[one.sheet.some_corner()]) for one in outcome.mapped]
    placements = [placement for placement in found if placement is not None]
    if len(placements) < len(found):
        return False
    for one, placement in zip(outcome.mapped, placements, strict=True):
        one.placement = placement
    return True


def _natural_radius(island: Island, uv: np.ndarray) -> float:
    """Radius of the disk at which the island's mean texel density is one."""
    in_disk = np.abs(signed_areas(uv, island.triangles)).sum()
    return float(np.sqrt(island.areas.sum() / in_disk))
