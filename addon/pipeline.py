# SPDX-License-Identifier: GPL-3.0-or-later
"""From surfaces to UV coordinates of their corners: the one function behind operator and batch. No bpy."""

import dataclasses
import functools

import numpy as np

from .layout import Placement, fit_placement, pack_disks
from .rounding import rounded
from .surface import Island, Surface, as_complex, as_points, cut_into_islands, signed_areas, whole_island
from .tube import unroll
from .upright import upright_turn


@dataclasses.dataclass(frozen=True)
class Task:
    """A surface to map.

    `name` is its object's; `outer` is "auto", "longest" or a vertex of the surface; `old_uv` (C, 2) are
    the UVs of its corners that the placement "keep" goes by; `mirrored` tells that its object's scale is
    negative, `pinned` that UVs of the layer to write are pinned.
    """

    name: str
    surface: Surface
    outer: object = "auto"
    mirrored: bool = False
    pinned: bool = False
    old_uv: np.ndarray = None


@dataclasses.dataclass
class IslandOutcome:
    """What became of one island: a result of `koebe.uniformize`, its shape and its place, or an error.

    sheet       the island with the vertices that have UVs: itself, or cut open if it was unrolled
    shape       (n, 2) those vertices before they are placed, in the unit disk: the result's disk, or a rectangle
    turn        complex number of modulus 1 by which the shape is turned about 0
    distortion  `koebe.distortion` of the shape, where it is not that of the result
    """

    island: Island
    result: object = None
    error: Exception = None
    sheet: Island = None
    shape: np.ndarray = None
    turn: complex = 1.0
    distortion: dict = None
    placement: Placement = None

    @property
    def unrolled(self):
        """Whether it is a rectangle: then its circles are not in the UVs."""
        return self.sheet is not self.island

    @property
    def angle_error(self):
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs."""
        return (self.distortion["angle_error_deg"] if self.distortion else self.result.angle_error_deg)["mean"]

    def turned(self, points):
        """Points (n, 2) of the shape after the turn."""
        if self.turn == 1.0:
            return points
        return as_points(self.turn * as_complex(points))

    @functools.cached_property
    def flat(self):
        """The sheet's vertices (n, 2) after the turn, in the unit disk."""
        return self.turned(self.shape)

    @functools.cached_property
    def _rounded(self):
        return rounded(self.placement.apply(self.flat), self.sheet.triangles)

    @property
    def uv(self):
        """UV coordinates (n, 2) of the sheet's vertices, in 32 bits as Blender keeps them."""
        return self._rounded[0]

    @property
    def flipped(self):
        """The triangles (k,) of the sheet whose signed area in the UVs is not positive."""
        return self._rounded[1]


@dataclasses.dataclass
class SurfaceOutcome:
    """What became of one surface."""

    task: Task
    islands: list

    @property
    def name(self):
        """Name of the surface's object."""
        return self.task.name

    @property
    def mapped(self):
        """The islands that have a result."""
        return [outcome for outcome in self.islands if outcome.error is None]

    @property
    def failed(self):
        """The islands that have an error."""
        return [outcome for outcome in self.islands if outcome.error is not None]

    @property
    def converged(self):
        """Whether every mapped island reached the tolerance."""
        return all(outcome.result.converged for outcome in self.mapped)

    def work_out(self):
        """Compute now, on this thread, what the results will be asked for."""
        for outcome in self.mapped:
            outcome.uv  # noqa: B018

    def corner_uv(self):
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        corners = [outcome.sheet.corners for outcome in self.mapped]
        uv = [outcome.uv.take(outcome.sheet.corner_vertex, axis=0) for outcome in self.mapped]
        return (corners[0], uv[0]) if len(uv) == 1 else (np.concatenate(corners), np.concatenate(uv))


def map_surfaces(koebe, tasks, options, progress=None, cancel=None):
    """Map every island of every task's surface to its circle domain and lay the islands out.

    `koebe` is the native package; `progress(fraction,
    stage)` is called on this thread; `cancel` is a `koebe.CancelToken`, and `koebe.Cancelled` ends
    everything. Other `koebe.KoebeError`s are kept as the outcome of their island.
    """
    sizes = [int(np.count_nonzero(task.surface.selected[task.surface.triangle_face])) for task in tasks]
    done, outcomes = 0, []
    for task, size in zip(tasks, sizes, strict=True):
        share = _share_of(progress, done, size, sum(sizes))
        outcome = SurfaceOutcome(task, _map_islands(koebe, task, options, share, cancel))
        _shape(koebe, outcome, options)
        outcomes.append(outcome)
        done += size
    _lay_out(outcomes, options)
    for outcome in outcomes:
        outcome.work_out()
    return outcomes


def _map_islands(koebe, task, options, progress, cancel):
    """The outcome of each island of a task's surface."""
    first = None
    whole = whole_island(task.surface)
    if whole is not None:
        first = _map_island(koebe, whole, task.outer, options, progress, cancel)
        if first.error is None:
            return [first]
    islands = cut_into_islands(task.surface)
    if first is not None and len(islands) == 1 and len(islands[0].vertices) == len(whole.vertices):
        return [first]  # nothing to cut: the error is the island's own
    done, total = 0, sum(len(island.triangles) for island in islands)
    outcomes = []
    for island in islands:
        share = _share_of(progress, done, len(island.triangles), total)
        outcomes.append(_map_island(koebe, island, task.outer, options, share, cancel))
        done += len(island.triangles)
    return outcomes


def _share_of(progress, done, part, total):
    if progress is None:
        return None
    return lambda fraction, stage: progress((done + fraction * part) / total, stage)


def _map_island(koebe, island, outer, options, progress, cancel):
    arguments = options.solver_arguments()
    try:
        if options.tube == "unroll" and len(koebe.boundary_loops(island.triangles, len(island.vertices))) == 2:
            # A concentric annulus keeps its digits however small the hole; moved off the centre it loses them.
            arguments["balance"] = "none"
        result = koebe.uniformize(
            island.vertices,
            island.triangles,
            outer=_outer_loop(island, outer),
            progress=progress,
            cancel=cancel,
            **arguments,
        )
    except koebe.Cancelled:
        raise
    except koebe.KoebeError as error:
        return IslandOutcome(island, error=error)
    return IslandOutcome(island, result=result)


def _shape(koebe, outcome, options):
    """Give the mapped islands of a surface their shapes: disks as they are or unrolled, and upright if asked."""
    for one in outcome.mapped:
        one.sheet, one.shape = one.island, one.result.uv
    tubes = [one for one in outcome.mapped if options.tube == "unroll" and len(one.result.loops) == 2]
    if tubes:
        cases = [(one.island, one.result.uv, one.result.loops) for one in tubes]
        for one, (sheet, shape) in zip(tubes, unroll(outcome.task.surface, cases), strict=True):
            one.sheet, one.shape = sheet, shape
            one.distortion = koebe.distortion(sheet.vertices, sheet.triangles, shape)
    for one in outcome.mapped if options.upright else ():
        turn = upright_turn(one.sheet, one.shape)
        # A rectangle stays level.
        one.turn = (1.0 if turn.real >= 0.0 else -1.0 + 0.0j) if one.unrolled else turn


def _outer_loop(island, outer):
    """The solver's `outer` for this island: a vertex counts only for the island that has it."""
    if isinstance(outer, str):
        return outer
    here = np.flatnonzero(island.source_vertex == outer)
    return int(here[0]) if len(here) else "auto"


def _lay_out(outcomes, options):
    """Give every mapped island its placement."""
    if options.placement == "together":
        _pack([one for outcome in outcomes for one in outcome.mapped], options.margin)
        return
    for outcome in outcomes:
        if not (options.placement == "keep" and _keep_places(outcome)):
            _pack(outcome.mapped, options.margin)


def _pack(group, margin):
    if len(group) == 1:
        group[0].placement = Placement(scale=0.5 / _half_size(group[0]))
    elif group:
        sizes = [_natural_radius(one.sheet, one.flat) for one in group]
        for one, placement in zip(group, pack_disks(sizes, margin), strict=True):
            one.placement = placement


def _half_size(one):
    """Half the side of the smallest square around 0 that holds an island: 1 for a disk."""
    return float(np.abs(one.flat).max()) if one.unrolled else 1.0


def _keep_places(outcome):
    """Place every island where it was, or none: whether all of them had a place."""
    if outcome.task.old_uv is None:
        return False
    placements = [
        fit_placement(one.flat, outcome.task.old_uv[one.sheet.some_corner()]) for one in outcome.mapped
    ]
    if any(placement is None for placement in placements):
        return False
    for one, placement in zip(outcome.mapped, placements, strict=True):
        one.placement = placement
    return True


def _natural_radius(island, uv):
    """Radius of the disk at which the island's mean texel density is one."""
    in_disk = np.abs(signed_areas(uv, island.triangles)).sum()
    return float(np.sqrt(island.areas.sum() / in_disk))
