# SPDX-License-Identifier: GPL-3.0-or-later
"""A drag of the slider Even: which E the pointer asks for, and which step is computed next."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.errors import MapError
from ..surfaces.surface import Island, Surface
from ..surfaces.uv_islands import uv_islands, vertex_uv

WIDTH = 400.0  # pixels of a drag from 0 to 1
FINE = 0.1  # of a drag's speed, with Shift
STEPS = 1  # Newton steps at a time
ENOUGH = 80  # times STEPS at one E: then the map has settled, as far as one sees
STILL = 1e-4  # largest way of a UV, in the UV square: below it nothing is seen to move


class EvenDrag:
    """The state of a drag.

    even         E that the pointer asks for
    has_changed  whether it has asked for another E than the first
    """

    has_changed = False

    def __init__(self, even: float, x: float) -> None:
        self.even = self._pulled = self._computed = even
        self._x, self._count, self._settled = x, 0, True

    def pull(self, x: float, fine: bool = False) -> None:
        """The pointer is at pixel x."""
        way = (x - self._x) / WIDTH * (FINE if fine else 1.0)
        self._pulled = min(max(self._pulled + way, 0.0), 1.0)
        self._x = x
        if self._pulled != self.even:
            self.even, self._count, self._settled = self._pulled, 0, False
            self.has_changed = True

    def next(self) -> float | None:
        """The E of the next step; None if there is nothing to do."""
        if self._settled or self._count >= ENOUGH:
            return None
        self._computed = self.even
        self._count += 1
        return self.even

    def done(self, way: float) -> None:
        """A step has ended. @param way the largest way of a UV"""
        if self._computed == self.even and way < STILL:
            self._settled = True


@dataclasses.dataclass
class _Dial:
    """An island, and the box in which it lay at first."""

    island: Island
    native: Any
    middle: np.ndarray
    extent: float

    def put_back(self, points: np.ndarray) -> np.ndarray:
        """The points (n, 2), moved and scaled so that they are in the middle of that box, and as large as it is."""
        middle, extent = _box(points)
        return (points - middle) * (self.extent / extent) + self.middle


def _box(points: np.ndarray) -> tuple[np.ndarray, float]:
    low, high = points.min(axis=0), points.max(axis=0)
    return 0.5 * (low + high), max(float((high - low).max()), 1e-300)


class EvenPreview:
    """The islands of a UV layer, made more or less even where they lie. Touches no Blender data.

    uv  (C, 2) of the surface's corners after the last move, 32 bits: a move puts a new array in its place
    """

    def __init__(self, koebe: ModuleType, surface: Surface, uv: np.ndarray, round: bool, cancel: Any) -> None:
        """@param uv (C, 2) at first. Raises MapError if no island can be made even."""
        self.uv = uv.astype(np.float32)
        self._koebe, self._cancel, self._dials, reasons = koebe, cancel, [], []
        for island in uv_islands(surface, uv):
            try:
                places = vertex_uv(island, uv).astype(np.float64)
                dial = koebe.EvenDial(island.vertices, island.triangles, uv=places, round=round)
            except koebe.KoebeError as error:
                reasons.append(str(error))
                continue
            self._dials.append(_Dial(island, dial, *_box(places)))
        if not self._dials:
            raise MapError(reasons[0] if reasons else "it has no UVs: map it first")

    def move(self, even: float) -> float:
        """Some steps towards E: the largest way of a UV. Raises `koebe.Cancelled`."""
        before, uv = self.uv, self.uv.copy()
        for one in self._dials:
            points = one.put_back(one.native.move(even, steps=STEPS, cancel=self._cancel))
            uv[one.island.corners] = points[one.island.corner_vertex]
        self.uv = uv
        return float(np.abs(uv - before).max(initial=0.0))
