# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be mapped, and what became of it."""

import dataclasses
import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import KnownError
from .packing import Placement
from .rounding import rounded
from .surface import Island, Surface
from .triangles import as_complex, as_points

if TYPE_CHECKING:
    from koebe import UniformizeResult

Progress = Callable[[float, str], None]  # called with a fraction and a stage
# A vertex of the surface, or a place (3,) in its space that a vertex is to be nearest to.
Place = int | np.ndarray | None
LATER: Any = None  # of what is not there from the start, and is not asked for before it is


class MapError(KnownError):
    """An island that cannot be mapped, beside the native package's own errors."""


@dataclasses.dataclass(frozen=True)
class Task:
    """A surface to map.

    `name` is its object's; `outer` is "auto", "longest" or a vertex of the surface; `center` and `point` are
    the vertices that go to the disk's centre and to its right end; `old_uv` (C, 2) are the UVs of the
    surface's corners that the placement "keep" goes by; `mirrored` tells that its object's scale is
    negative, `pinned` that UVs of the layer to write are pinned.
    """

    name: str
    surface: Surface
    outer: str | int = "auto"
    mirrored: bool = False
    pinned: bool = False
    old_uv: np.ndarray | None = None
    center: Place = None
    point: Place = None


@dataclasses.dataclass
class IslandOutcome:
    """What became of one island: a result of `koebe.uniformize`, its shape and its place, or an error.

    sheet       the island with the vertices that have UVs: itself, or cut open if it was unrolled
    shape       (n, 2) those vertices before they are placed, in the unit disk: the result's disk, or a rectangle
    turn        complex number of modulus 1 by which the shape is turned about 0
    distortion  `koebe.distortion` of the shape, where it is not that of the result
    """

    island: Island
    result: "UniformizeResult" = LATER
    error: Exception | None = None
    sheet: Island = LATER
    shape: np.ndarray = LATER
    turn: complex = 1.0
    distortion: dict[str, Any] | None = None
    placement: Placement = LATER

    @property
    def unrolled(self) -> bool:
        """Whether it is a rectangle: then its circles are not in the UVs."""
        return self.sheet is not self.island

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs."""
        return (self.distortion["angle_error_deg"] if self.distortion else self.result.angle_error_deg)["mean"]

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
        return self._rounded[0]

    @property
    def flipped(self) -> np.ndarray:
        """The triangles (k,) of the sheet whose signed area in the UVs is not positive."""
        return self._rounded[1]


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
    def converged(self) -> bool:
        """Whether every mapped island reached the tolerance."""
        return all(outcome.result.converged for outcome in self.mapped)

    def corner_uv(self) -> tuple[np.ndarray, np.ndarray]:
        """Corners (m,) of the mapped islands and their UV coordinates (m, 2) in 32 bits."""
        corners = [outcome.sheet.corners for outcome in self.mapped]
        uv = [outcome.uv.take(outcome.sheet.corner_vertex, axis=0) for outcome in self.mapped]
        return (corners[0], uv[0]) if len(uv) == 1 else (np.concatenate(corners), np.concatenate(uv))
