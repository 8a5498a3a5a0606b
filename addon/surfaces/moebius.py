# SPDX-License-Identifier: GPL-3.0-or-later
"""Möbius maps of the plane: they keep angles, and circles stay circles. Points are complex numbers."""

import cmath
import dataclasses

import numpy as np

from .triangles import blocks

# Newton's method for the balance point: limit of steps, and accuracy, far below 32-bit UVs (disk radius 1).
BALANCE_STEPS, BALANCED = 60, 1e-9
LONGEST_STEP = 0.5  # of that method, in the unit disk: its steps may be too long at first


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

        Computes blocks of points, so that intermediate values stay in the processor's cache.
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
        """The map that applies `first`, then this one."""
        return Moebius(
            self.a * first.a + self.b * first.c, self.a * first.b + self.b * first.d,
            self.c * first.a + self.d * first.c, self.c * first.b + self.d * first.d,
        )  # fmt: skip

    @property
    def inverse(self) -> "Moebius":
        """The inverse map."""
        return Moebius(self.d, -self.b, -self.c, self.a)

    @property
    def is_identity(self) -> bool:
        """Whether no point moves."""
        return self.b == 0 and self.c == 0 and self.a == self.d

    def circle(self, center: complex, radius: float) -> tuple[complex, float]:
        """Centre and radius of the image of a circle that does not pass through the pole.

        The new centre is the image of the pole's mirror image in the circle.
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
    """The automorphism of the unit disk that brings a point to 0 and does not rotate there."""
    return Moebius(1.0, -point, -complex(point).conjugate(), 1.0)


def dragged(start: complex, end: complex) -> Moebius:
    """The automorphism of the unit disk that brings one point to another and does not rotate there."""
    return to_middle(end).inverse.after(to_middle(start)) if start != end else Moebius()


def inside_out(center: complex, radius: float) -> Moebius:
    """The map that takes the circle to the unit circle and its outside to the inside; infinity goes to 0."""
    return Moebius(0.0, radius, 1.0, -center)


def center_and_turn(moved: Moebius) -> tuple[complex, float]:
    """The point of the unit disk that an automorphism brings to 0, and the angle of the rotation after `to_middle`.
    Together they give the automorphism."""
    center = moved.inverse(0.0)
    turn = moved.after(to_middle(center).inverse)
    return center, cmath.phase(turn.a / turn.d)


def own_center(center: complex, radius: float) -> complex:
    """The point of the unit disk after whose `to_middle` a circle inside the disk is centred at 0.

    It is the circle's centre in the disk's hyperbolic geometry: halfway between the ends of the diameter through 0.
    """
    away = abs(center)
    if away == 0.0:
        return 0.0j
    near, far = (np.arctanh(np.clip(away + sign * radius, -1.0 + 1e-15, 1.0 - 1e-15)) for sign in (-1.0, 1.0))
    return complex(center / away * np.tanh(0.5 * (near + far)))


def balance_point(z: np.ndarray, weights: np.ndarray) -> complex:
    """The point of the unit disk after whose `to_middle` the weighted mean of points (n,) is 0.

    It is unique unless one point has half of the weight [Douady and Earle 1986]. Found by Newton's method.
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
