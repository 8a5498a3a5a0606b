# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be mapped, and what became of it."""

import dataclasses
import functools
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from .mirror import Symmetry
from .opening import Opening
from .packing import Placement
from .rounding import rounded
from .stored import Stored
from .surface import Island, Surface
from .triangles import as_complex, as_points, density_ratio, signed_areas

if TYPE_CHECKING:
    from koebe import UniformizeResult

Progress = Callable[[float, str], None]  # called with a fraction and a stage
# A vertex of the surface, or a place (3,) in its space that a vertex is to be nearest to.
Place = int | np.ndarray | None
LATER: Any = None  # of what is not there from the start, and is not asked for before it is


def share_of(progress: Progress | None, done: int, size: int, total: int) -> Progress | None:
    """Progress of some of all work as a part of that of all, given what is done before."""
    if progress is None:
        return None
    return lambda fraction, stage: progress((done + fraction * size) / max(total, 1), stage)


class Mapped(Protocol):
    """An island with a map, and how even its texels are."""

    @property
    def result(self) -> Any: ...
    @property
    def density_ratio(self) -> float: ...


class Failed(Protocol):
    """Why something could not be mapped."""

    @property
    def error(self) -> Exception | None: ...


class Failure(Failed, Protocol):
    """An island, and why it could not be mapped."""

    @property
    def island(self) -> Island: ...


class Failures(Protocol):
    """What became of a surface, as far as it could not be mapped, or not be written."""

    @property
    def name(self) -> str: ...
    @property
    def not_written(self) -> str | None: ...
    @property
    def islands(self) -> Sequence[Failed]: ...
    @property
    def failed(self) -> Sequence[Failed]: ...


@dataclasses.dataclass(frozen=True)
class Task:
    """A surface to map.

    `name` is its object's; `outer` is "auto", "longest" or a vertex of the surface; `center` and `point` are
    the vertices that go to the disk's centre and to its right end; `old_uv` (C, 2) are the UVs of the
    surface's corners that the placement "keep" goes by; `mirrored` tells that its object's scale is
    negative, `pinned` that UVs of the layer to write are pinned. `importance` (V,) in [0, 1] weighs the balance.
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


@dataclasses.dataclass
class IslandOutcome:
    """What became of one island: a result of `koebe.uniformize`, its shape and its place, or an error.

    sheet       the island with the vertices that have UVs: itself, or cut open if it was unrolled
    shape       (n, 2) those vertices before they are placed, in the unit disk: the result's disk, or a rectangle
    turn        complex number of modulus 1 by which the shape is turned about 0
    distortion  `koebe.distortion` of the shape, where it is not that of the result
    stored      what the UVs hold of the map
    lost        what to say first where more is lost in the UVs than may be, or empty
    places      the vertices that were asked for, by the solver's names: center, point
    opening     what was cut to get this piece, with others, or None
    symmetry    the island made symmetric, or None
    remark      why something that was asked for was not done with it, or empty
    """

    island: Island
    result: "UniformizeResult" = LATER
    error: Exception | None = None
    sheet: Island = LATER
    shape: np.ndarray = LATER
    turn: complex = 1.0
    distortion: dict[str, Any] | None = None
    stored: Stored = LATER
    lost: str = ""
    placement: Placement = LATER
    places: dict[str, Any] = dataclasses.field(default_factory=dict)
    opening: Opening | None = None
    symmetry: Symmetry | None = None
    remark: str = ""

    @property
    def unrolled(self) -> bool:
        """Whether it is a rectangle: then its circles are not in the UVs."""
        return self.sheet is not self.island

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs, once these are there."""
        if self.stored is not None:
            return self.stored.angle_error
        return (self.distortion["angle_error_deg"] if self.distortion else self.result.angle_error_deg)["mean"]

    @functools.cached_property
    def density_ratio(self) -> float:
        """Texel density (a length over a length) at 95 % of the area over that at 5 %."""
        return density_ratio(self.sheet.areas, np.abs(signed_areas(self.shape, self.sheet.triangles)))

    def turned(self, points: np.ndarray) -> np.ndarray:
        """Points (n, 2) of the shape after the turn."""
        if self.turn == 1.0:
            return points
        return as_points(self.turn * as_complex(points))

    @functools.cached_property
    def flat(self) -> np.ndarray:
        """The sheet's vertices (n, 2) after the turn, in the unit disk."""
        return self.turned(self.shape)

    @functools.cached_property
    def _rounded(self) -> tuple[np.ndarray, np.ndarray]:
        return rounded(self.placement.apply(self.flat), self.sheet.triangles)

    @property
    def uv(self) -> np.ndarray:
        """UV coordinates (n, 2) of the sheet's vertices, in 32 bits as Blender keeps them."""
        return self._rounded[0] if self.symmetry is None else self.symmetry.image.uv

    @property
    def flipped(self) -> np.ndarray:
        """The triangles (k,) of the sheet whose signed area in the UVs is not positive."""
        return self._rounded[1] if self.symmetry is None else self.symmetry.image.flipped

    def circles(self) -> tuple[np.ndarray, np.ndarray]:
        """Centres (k, 2) and radii (k,) of the loops' circles in the UVs; of a rectangle they mean nothing."""
        if self.symmetry is not None:
            domain, loops = self.symmetry.image.domain, self.symmetry.image.loops
            centers = domain.placed(np.array([loop.center for loop in loops]))
            return centers, domain.scale * np.array([loop.radius for loop in loops])
        return self.placement.apply(self.turned(self.result.centers)), self.placement.scale * self.result.radii


@dataclasses.dataclass
class SurfaceOutcome:
    """What became of one surface.

    not_written  why nothing of it could be written, or None
    remarks      what to say of the object beside its islands
    """

    task: Task
    islands: list[IslandOutcome]
    not_written: str | None = None
    remarks: list[str] = dataclasses.field(default_factory=list)

    @property
    def name(self) -> str:
        """Name of the surface's object."""
        return self.task.name

    @property
    def mapped(self) -> list[IslandOutcome]:
        """The islands that have a result, unless it could not be written."""
        return [] if self.not_written else [outcome for outcome in self.islands if outcome.error is None]

    @property
    def failed(self) -> list[IslandOutcome]:
        """The islands that have an error."""
        return [outcome for outcome in self.islands if outcome.error is not None]

    @property
    def lost(self) -> list[IslandOutcome]:
        """The mapped islands of which more is lost in the UVs than may be."""
        return [outcome for outcome in self.mapped if outcome.lost]

    @property
    def converged(self) -> bool:
        """Whether every mapped island reached the tolerance."""
        return all(outcome.result.converged for outcome in self.mapped)

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        corners = [outcome.sheet.corners for outcome in self.mapped]
        uv = [outcome.uv.take(outcome.sheet.corner_vertex, axis=0) for outcome in self.mapped]
        openings = self.openings
        if len(uv) == 1 and not openings:
            return corners[0], uv[0]
        return _with_copied(np.concatenate(corners), np.concatenate(uv), openings)

    @property
    def openings(self) -> list[Opening]:
        """What was cut, for each island that was."""
        return list({id(one.opening): one.opening for one in self.islands if one.opening is not None}.values())


def _with_copied(corners: np.ndarray, uv: np.ndarray, openings: list[Opening]) -> tuple[np.ndarray, np.ndarray]:
    """The corners and those that take their places, as far as these are mapped."""
    copied = [opening.copied for opening in openings if len(opening.copied[0])]
    if not copied:
        return corners, uv
    here, there = (np.concatenate(each) for each in zip(*copied))
    row = np.full(int(max(corners.max(), there.max())) + 1, -1, dtype=np.int64)
    row[corners] = np.arange(len(corners))
    known = row[there] >= 0
    return np.concatenate([corners, here[known]]), np.concatenate([uv, uv[row[there[known]]]])
