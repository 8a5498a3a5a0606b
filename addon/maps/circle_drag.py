# SPDX-License-Identifier: GPL-3.0-or-later
"""What a pointer does to a circle domain: what it has hold of, and the Möbius map that a drag makes."""

import cmath
import dataclasses
import math

from .circle_domain import CircleDomain
from .moebius import Moebius, center_and_turn, dragged, own_center, rotation

REACH = 1.35  # radii from the disk's middle: so far outside a drag turns it
FARTHEST = 0.98  # radii from the middle: nothing is dragged farther out, where 32 bits would not tell faces apart
STEP = math.radians(5.0)  # of a turn, if it goes in steps
TURN, POINT, HOLE = "turn", "point", "hole"


@dataclasses.dataclass(frozen=True)
class Grip:
    """What a drag has hold of.

    start  where it began, in the unit disk
    hole   number of the hole there, or 0
    """

    domain: CircleDomain
    start: complex
    hole: int

    @classmethod
    def at(cls, domain: CircleDomain, u: float, v: float, near: float) -> "Grip":
        """What is at a place of the UVs. A hole is taken hold of from as far as `near`, in UV units."""
        start = domain.in_disk(u, v)
        return cls(domain, start, domain.hole_at(start, near / domain.scale))

    @property
    def kind(self) -> str:
        """HOLE, POINT, or TURN outside the disk."""
        return HOLE if self.hole else POINT if abs(self.start) < 1.0 else TURN

    def moved(self, u: float, v: float, snap: float, steps: bool) -> Moebius:
        """The map that a drag to that place of the UVs makes: what is held follows it; outside, the disk turns.

        A hole that comes as near to the middle as `snap`, in UV units, goes there. With `steps` a turn goes in such.
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
    """A point of the disk that is not too near to its rim."""
    return z * min(1.0, FARTHEST / abs(z)) if z else z
