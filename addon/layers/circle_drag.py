# SPDX-License-Identifier: GPL-3.0-or-later
"""Drags in a circle domain: what the pointer holds, and the Möbius map of the drag."""

import cmath
import dataclasses
import math

from ..surfaces.moebius import Moebius, center_and_turn, dragged, own_center, rotation
from .circle_domain import CircleDomain

REACH = 1.35  # radii from the disk's middle: up to here a drag outside the disk turns it
FARTHEST = 0.98  # radii from the middle: no drag goes farther out, where 32 bits cannot tell faces apart
STEP = math.radians(5.0)  # of a turn, with steps
TURN, POINT, HOLE = "turn", "point", "hole"


@dataclasses.dataclass(frozen=True)
class Grip:
    """The place that a drag holds.

    start  where the drag began, in the unit disk
    hole   number of the hole there, or 0
    """

    domain: CircleDomain
    start: complex
    hole: int

    @classmethod
    def at(cls, domain: CircleDomain, u: float, v: float, near: float) -> "Grip":
        """The grip at a place of the UVs. A hole can be held within `near`, in UV units."""
        start = domain.in_disk(u, v)
        return cls(domain, start, domain.hole_at(start, near / domain.scale))

    @property
    def kind(self) -> str:
        """HOLE, POINT, or TURN outside the disk."""
        return HOLE if self.hole else POINT if abs(self.start) < 1.0 else TURN

    def moved(self, u: float, v: float, snap: float, steps: bool) -> Moebius:
        """The map of a drag to that place of the UVs: what is held follows; outside, the disk turns.

        A hole within `snap` of the middle, in UV units, goes to the middle. With `steps` a turn goes in steps.
        """
        now = self.domain.in_disk(u, v)
        if self.kind == TURN:
            angle = cmath.phase(now / self.start) if now else 0.0
            return rotation(round(angle / STEP) * STEP if steps else angle)
        moved = dragged(_held(self.start), _held(now))
        if self.hole:
            loop = self.domain.loops[self.hole]
            middle, _ = moved.circle(loop.center, loop.radius)
            if abs(middle) * self.domain.scale <= snap:
                return dragged(own_center(loop.center, loop.radius), 0.0)
        return moved

    def properties(self, moved: Moebius) -> tuple[complex, float]:
        """The centre and the turn, in radians, that make the same map."""
        return center_and_turn(moved)


def _held(z: complex) -> complex:
    """The point of the disk, moved away from the rim if it is too near to it."""
    return z * min(1.0, FARTHEST / abs(z)) if z else z
