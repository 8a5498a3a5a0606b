# SPDX-License-Identifier: GPL-3.0-or-later
"""Möbius maps of the plane: they keep angles, and circles stay circles. Points are complex numbers."""

import cmath
import dataclasses

import numpy as np

from .triangles import blocks

# Steps of Newton's method for the balance point, and where they end: far below what 32-bit UVs show (disk radius 1).
BALANCE_STEPS, BALANCED = 60, 1e-9
LONGEST_STEP = 0.5  # of that method, in the unit disk: from far away its steps may be too long


@dataclasses.dataclass(frozen=True)
class Moebius:
    """The map z -> (a z + b) / (c z + d), a d - b c not 0."""

    a: complex = 1.0
    b: complex = 0.0
    c: complex = 0.0
    d: complex = 1.0

    def __call__(self, z: complex) -> complex:
        """Image of one point."""
        return (self.a * z + self.b) / (self.c * z + self.d)

    def apply(self, z: np.ndarray) -> np.ndarray:
        """Images of points (n,).

        Blocks of them at a time: what is computed on the way stays in the processor's cache.
        """
        result = np.empty_like(z)
        for part in blocks(len(z)):
            below = z[part] * self.c
            below += self.d
            above = z[part] * self.a
            above += self.b
            above /= below
            result[part] = above
        return result

    def after(self, first: "Moebius") -> "Moebius":
        """The map that does `first`, then this one."""
        return Moebius(
            self.a * first.a + self.b * first.c, self.a * first.b + self.b * first.d,
            self.c * first.a + self.d * first.c, self.c * first.b + self.d * first.d,
        )  # fmt: skip

    @property
    def inverse(self) -> "Moebius":
        """The map that undoes this one."""
        return Moebius(self.d, -self.b, -self.c, self.a)

    @property
    def is_identity(self) -> bool:
        """Whether no point moves."""
        return self.b == 0 and self.c == 0 and self.a == self.d

    def circle(self, center: complex, radius: float) -> tuple[complex, float]:
        """Centre and radius of the image of a circle that does not pass through the pole.

        The new centre is the image of the point that is mirrored to the pole in the circle.
        """
        if self.c == 0:
            return self(center), abs(self.a / self.d) * radius
        pole = -self.d / self.c
        away = (pole - center).conjugate()
        middle = self.a / self.c if away == 0 else self(center + radius * radius / away)
        return middle, abs(self(center + radius) - middle)


def rotation(angle: float) -> Moebius:
    """The turn about 0 by an angle in radians, counter-clockwise."""
    return Moebius(cmath.exp(1j * angle)) if angle else Moebius()


def to_middle(point: complex) -> Moebius:
    """The map of the unit disk onto itself that brings a point of it to 0 and does not turn there."""
    return Moebius(1.0, -point, -complex(point).conjugate(), 1.0)


def dragged(start: complex, end: complex) -> Moebius:
    """The map of the unit disk onto itself that brings one point of it to another and does not turn there."""
    return to_middle(end).inverse.after(to_middle(start)) if start != end else Moebius()


def inside_out(center: complex, radius: float) -> Moebius:
    """The map that makes the circle the unit circle, and what is outside it the inside; infinity goes to 0."""
    return Moebius(0.0, radius, 1.0, -center)


def center_and_turn(moved: Moebius) -> tuple[complex, float]:
    """The point of the unit disk that goes to 0, and the angle of the turn after `to_middle`, of a map of the disk
    onto itself: together they are that map."""
    center = moved.inverse(0.0)
    turn = moved.after(to_middle(center).inverse)
    return center, cmath.phase(turn.a / turn.d)


def own_center(center: complex, radius: float) -> complex:
    """The point of the unit disk that comes to 0 together with the centre of a circle inside the disk.

    It is the circle's centre in the disk's hyperbolic geometry: halfway between the ends of the diameter through 0.
    """
    away = abs(center)
    if away == 0.0:
        return 0.0j
    near, far = (np.arctanh(np.clip(away + sign * radius, -1.0 + 1e-15, 1.0 - 1e-15)) for sign in (-1.0, 1.0))
    return complex(center / away * np.tanh(0.5 * (near + far)))


def balance_point(z: np.ndarray, weights: np.ndarray) -> complex:
    """The point of the unit disk such that, once it is at 0, the weighted mean of points (n,) of the disk is 0.

    There is exactly one unless half of the weight is in one point [Douady and Earle 1986]; found by Newton's method.
    """
    share = weights / weights.sum()
    moved = Moebius()
    for _ in range(BALANCE_STEPS):
        now = moved.apply(z)
        mean, second = complex((share * now).sum()), complex((share * now * now).sum())
        if abs(mean) <= BALANCED:
            break
        step = (mean + mean.conjugate() * second) / max(1.0 - abs(second) ** 2, 1e-3)
        step *= min(1.0, LONGEST_STEP / abs(step))
        moved = to_middle(step).after(moved)
        scale = abs(moved.a * moved.d - moved.b * moved.c) ** 0.5
        moved = Moebius(moved.a / scale, moved.b / scale, moved.c / scale, moved.d / scale)
    return moved.inverse(0.0)
