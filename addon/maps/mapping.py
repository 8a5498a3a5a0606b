# SPDX-License-Identifier: GPL-3.0-or-later
"""Maps surfaces to UV coordinates of their corners: the one function behind operator and batch."""

import dataclasses
import functools
import itertools
from collections.abc import Callable, Sequence
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError, failing_alone, foreseen
from ..surfaces.islands import cut_into_islands, whole_island
from ..surfaces.opening import Opening, open_island
from ..surfaces.stored import SERVES, judge, lost_text, turned_of
from ..surfaces.surface import Island
from ..surfaces.triangles import areas, flipped_triangles
from ..surfaces.tube import unroll
from ..surfaces.upright import upright_turn
from . import places
from .disk_outcomes import IslandOutcome, SurfaceOutcome
from .disk_placement import lay_out
from .options import Options
from .outcomes import Progress, Task
from .side_by_side import Unit, side_by_side
from .symmetry import make_symmetric
from .wording import counted

# Of the extent: the distance from a line that rounding to 32 bits can cause, and a little more.
FLAT = 2.4e-7
FEW = 1000  # triangles that are checked first
UNROLLED_STAYS = "Even does nothing to an unrolled tube: use Unwrap to Cylinder"


def map_surfaces(
    koebe: ModuleType, tasks: Sequence[Task], options: Options, progress: Progress | None = None, cancel: Any = None
) -> list[SurfaceOutcome]:
    """Map every island of every task's surface to its circle domain and lay the islands out.

    `koebe` is the native package; `progress(fraction, stage)` is called on this thread; `cancel` is a
    `koebe.CancelToken`, and `koebe.Cancelled` ends the run. Any other error is its island's outcome. Islands are mapped
    side by side, at most `options.threads` at once, and any number gives the same outcomes. An exception that leaves
    this function raises the token, so that all work stops.
    """
    run = _Run(koebe, options, sum(map(_size, tasks)), progress, cancel or koebe.CancelToken())
    outcomes = [SurfaceOutcome(task, islands) for task, islands in zip(tasks, run.map(tasks), strict=True)]
    for outcome in outcomes:
        _unroll(koebe, outcome, options)
    lay_out(koebe, outcomes, options, cancel)
    for outcome in outcomes:
        for one in outcome.mapped:
            if not np.isfinite(one.uv).all():  # computed here, on this thread
                one.error = MapError("its UVs are not finite")
    if options.symmetry == "auto":
        for outcome in outcomes:
            for one in outcome.mapped:
                with failing_alone(koebe, [one]):
                    make_symmetric(koebe, one)
    for outcome in outcomes:
        for one in outcome.mapped:
            with failing_alone(koebe, [one]):
                judge_island(koebe, one, options.most_lost)
    return outcomes


def judge_island(koebe: ModuleType, one: IslandOutcome, most_lost: float) -> None:
    """Judge the stored UVs of a mapped and placed island."""
    one.stored = judge(koebe, one.sheet.vertices, one.sheet.triangles, one.uv, turned_of(one.result))
    if one.stored.lost_area > most_lost:
        one.lost = f"{lost_text(one.stored.lost_area)}. Use {SERVES['parts']}"


class _Run:
    """The native calls of a run, several at once."""

    def __init__(
        self, koebe: ModuleType, options: Options, size: int, progress: Progress | None, cancel: Any
    ) -> None:
        self._koebe, self._options, self._progress, self._cancel = koebe, options, progress, cancel
        self._total, self._done, self._reported = max(size, 1), 0, 0.0  # triangles: all, finished; last reported share

    def map(self, tasks: Sequence[Task]) -> list[list[IslandOutcome]]:
        """The outcome of each island of each task's surface."""
        # First try each surface as a whole; cut those that the solver refuses into islands.
        wholes = [whole_island(task.surface) for task in tasks]
        each = iter(
            self._map_all([(task, [whole]) for task, whole in zip(tasks, wholes, strict=True) if whole], _is_mapped)
        )
        outcomes = [next(each) if whole else [] for whole in wholes]
        cut = {index: _cut(task, *one) for index, (task, one) in enumerate(zip(tasks, outcomes, strict=True))}
        cut = {index: islands for index, islands in cut.items() if islands}
        again = self._map_all([(tasks[index], islands) for index, islands in cut.items()], self._is_last)
        for index, islands in zip(cut, again, strict=True):
            outcomes[index] = islands
        if self._options.cut:
            self._open(tasks, outcomes)
        return outcomes

    def _open(self, tasks: Sequence[Task], outcomes: list[list[IslandOutcome]]) -> None:
        """Replace each island that cannot be mapped by the outcomes of its pieces."""
        opened = [[self._opened(task, one) for one in islands] for task, islands in zip(tasks, outcomes, strict=True)]
        named = [_names_left(task, islands, found)
                 for task, islands, found in zip(tasks, outcomes, opened, strict=True)]  # fmt: skip
        pieces = [[piece for one in found if one for piece in one[1]] for found in opened]
        mapped = self._map_all([pair for pair in zip(named, pieces, strict=True) if pair[1]], _is_any)
        each = iter(mapped)
        for islands, found, own in zip(outcomes, opened, pieces, strict=True):
            if not own:
                continue
            made = iter(next(each))
            result: list[IslandOutcome] = []
            for one, pair in zip(islands, found, strict=True):
                result += [one] if pair is None else itertools.islice(made, len(pair[1]))
                if pair is not None:
                    for piece in result[len(result) - len(pair[1]) :]:
                        piece.opening = pair[0]
            islands[:] = result

    def _opened(self, task: Task, one: IslandOutcome) -> tuple[Opening, list[Island]] | None:
        """The pieces of an island that the solver has refused, or None if cutting cannot help."""
        if not self._may_open(one):
            return None
        try:
            return open_island(self._koebe, task.surface, one.island, self._cancel)
        except self._koebe.Cancelled:
            raise
        except (MapError, MemoryError, self._koebe.SolverError) as error:
            one.error = foreseen(self._koebe, error)
        except self._koebe.KoebeError:  # the arrays are not a mesh, as the solver has said
            pass
        return None

    def _may_open(self, one: IslandOutcome) -> bool:
        """Whether the options allow to cut this island and map its pieces."""
        return self._options.cut and isinstance(one.error, (self._koebe.TopologyError, self._koebe.InputError))

    def _is_last(self, one: IslandOutcome) -> bool:
        """Whether this is the last attempt for an island."""
        return not self._may_open(one)

    def _map_all(
        self, surfaces: list[tuple[Task, list[Island]]], counts: Callable[[IslandOutcome], bool]
    ) -> list[list[IslandOutcome]]:
        """The outcomes of islands of surfaces. Attempts that are not the last do not count as finished work."""
        units: list[Unit[IslandOutcome]] = []
        count = sum(len(islands) for _, islands in surfaces)
        threads = self._options.threads if count == 1 else 1  # several run side by side, each on one thread
        for task, islands in surfaces:
            centers, points = places.centers(islands, task.center), places.points(islands, task.point)
            for island, center, point in zip(islands, centers, points, strict=True):
                vertices = {"outer": _outer_loop(island, task.outer), "center": center, "point": point}
                importance = None if task.importance is None else task.importance[island.source_vertex]
                compute = functools.partial(
                    _map_island, self._koebe, island, vertices, importance, self._options, threads, cancel=self._cancel
                )
                units.append(Unit(len(island.triangles), compute))
        share = self._share(sum(unit.size for unit in units))
        outcomes = side_by_side(units, self._options.threads, share, self._cancel.cancel, counts)
        self._done += sum(unit.size for unit, one in zip(units, outcomes, strict=True) if counts(one))
        if len(units) > 1 and self._options.threads != 1:
            outcomes = [
                unit.compute(None) if self._may_be_of_memory(one.error) else one
                for unit, one in zip(units, outcomes, strict=True)
            ]
        each = iter(outcomes)
        return [list(itertools.islice(each, len(islands))) for _, islands in surfaces]

    def _may_be_of_memory(self, error: Exception | None) -> bool:
        """Whether an island that failed beside others must be tried alone."""
        return isinstance(error, self._koebe.SolverError) or isinstance(getattr(error, "__cause__", None), MemoryError)

    def _share(self, size: int) -> Progress | None:
        """Progress of work of this size as a part of the progress of all work, which never falls."""
        progress, done = self._progress, self._done
        if progress is None:
            return None

        def tell(fraction: float, stage: str) -> None:
            self._reported = max(self._reported, (done + fraction * size) / self._total)
            progress(self._reported, stage)

        return tell


def _names_left(
    task: Task, islands: Sequence[IslandOutcome], found: Sequence[tuple[Opening, list[Island]] | None]
) -> Task:
    """The task for the pieces: they get a place in space only if no other island has taken it."""
    others = [one.places for one, pair in zip(islands, found, strict=True) if pair is None]
    left: dict[str, Any] = {}
    for name in ("center", "point"):
        if isinstance(getattr(task, name), np.ndarray) and any(places.get(name) is not None for places in others):
            left[name] = None
    return dataclasses.replace(task, **left)


def _is_mapped(one: IslandOutcome) -> bool:
    return one.error is None


def _is_any(one: IslandOutcome) -> bool:
    return True


def _size(task: Task) -> int:
    """The number of a surface's triangles to map."""
    return int(np.count_nonzero(task.surface.selected[task.surface.triangle_face]))


def _cut(task: Task, whole: IslandOutcome | None = None) -> list[Island]:
    """The islands of a surface; empty if the whole surface is one island, mapped or not."""
    if whole is not None and whole.error is None:
        return []
    islands = cut_into_islands(task.surface)
    if whole is not None and len(islands) == 1 and len(islands[0].vertices) == len(whole.island.vertices):
        return []  # nothing to cut: the error is the island's own
    return islands


def _map_island(
    koebe: ModuleType,
    island: Island,
    vertices: dict[str, Any],
    importance: np.ndarray | None,
    options: Options,
    threads: int,
    progress: Progress | None,
    cancel: Any,
) -> IslandOutcome:
    arguments = {**options.solver_arguments(), "threads": threads}
    one = IslandOutcome(island, places=vertices)
    with failing_alone(koebe, [one]):
        check_area(island)
        if options.tube == "unroll" and _is_tube(koebe, island):
            # A concentric annulus keeps its digits for a hole of any size; moved off the centre it loses them.
            arguments["balance"] = "none"
            vertices = {"outer": vertices["outer"]}
            if options.even > 0.0:
                arguments["even"], one.remark = 0.0, UNROLLED_STAYS
        if vertices.get("center") is not None:
            places.check_center(island, vertices["center"])
            arguments["balance"] = "none"  # the balance would choose the centre as well
        if vertices.get("point") is not None:
            places.check_point(island, vertices["point"])
        if importance is not None and (arguments["balance"] == "area" or arguments["even"] > 0.0):
            arguments["importance"] = importance
        one.result = koebe.uniformize(
            island.vertices,
            island.triangles,
            polygon=island.triangle_face,
            progress=progress,
            cancel=cancel,
            **vertices,
            **arguments,
        )
        one.has_circles = options.loops != "free" or not one.result.even
        if not _is_unrolled(one, options):  # otherwise the whole surface is turned together
            _shape(one, options)
    return one


def _is_tube(koebe: ModuleType, island: Island) -> bool:
    return len(koebe.boundary_loops(island.triangles, vertex_count=len(island.vertices))) == 2


def check_area(island: Island) -> None:
    """Raise MapError if every face is collapsed. The solver judges coordinates that are not finite."""
    some = island.triangles[:: max(1, len(island.triangles) // FEW)]
    if _are_flat(island.vertices, some) and _are_flat(island.vertices, island.triangles):
        raise MapError("the surface is collapsed to a line: all faces have area 0")


def _are_flat(vertices: np.ndarray, triangles: np.ndarray) -> bool:
    """Whether no triangle has more area than rounding can cause."""
    a, b, c = (vertices.take(corner, axis=0) for corner in triangles.T)
    with np.errstate(invalid="ignore"):
        longest = np.max([np.linalg.norm(one - two, axis=1) for one, two in ((a, b), (b, c), (c, a))], axis=0)
        extent = np.ptp(vertices[triangles], axis=(0, 1)).max()
        return bool((areas(vertices, triangles) <= FLAT * extent * longest).all())


def _shape(one: IslandOutcome, options: Options) -> None:
    """Give a mapped island its shape: the unchanged disk."""
    one.sheet, one.shape = one.island, one.result.uv
    _turn(one, options)


def _turn(one: IslandOutcome, options: Options) -> None:
    """Turn a shape upright, if requested."""
    if options.upright and one.result.point is None:
        turn = upright_turn(one.sheet, one.shape)
        # A rectangle stays level.
        one.turn = (1.0 if turn.real >= 0.0 else -1.0 + 0.0j) if one.unrolled else turn


def _is_unrolled(one: IslandOutcome, options: Options) -> bool:
    return options.tube == "unroll" and len(one.result.loops) == 2


def _unroll(koebe: ModuleType, outcome: SurfaceOutcome, options: Options) -> None:
    """Give the mapped tubes of a surface their shapes, if they become rectangles."""
    tubes = [one for one in outcome.mapped if _is_unrolled(one, options)]
    with failing_alone(koebe, tubes):
        cases = [(one.island, one.result.loops, one.opening is not None) for one in tubes]
        for one, unrolled in zip(tubes, unroll(koebe, outcome.task.surface, cases), strict=True):
            if unrolled is None:
                one.error = MapError("the tube cannot be cut open along its edges: take Tube: Ring")
                continue
            if one.opening is not None and len(over := flipped_triangles(unrolled[0].triangles, unrolled[1])):
                one.remark = f"not unrolled, as {counted(len(over), 'triangle')} would be turned over"
                _shape(one, options)
                continue
            one.sheet, one.shape = unrolled
            one.distortion = koebe.distortion(one.sheet.vertices, one.sheet.triangles, one.shape)
            with failing_alone(koebe, [one]):
                _turn(one, options)


def _outer_loop(island: Island, outer: str | int) -> str | int:
    """The solver's `outer` for this island: a vertex counts only in its own island."""
    if isinstance(outer, str):
        return outer
    here = np.flatnonzero(island.source_vertex == outer)
    return int(here[0]) if len(here) else "auto"
