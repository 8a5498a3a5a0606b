# SPDX-License-Identifier: GPL-3.0-or-later
"""Circle domains in a UV layer, and their images under Möbius maps. Nothing is solved; circles stay circles."""

import dataclasses
import functools
from types import ModuleType

import numpy as np

from ..surfaces.errors import NOWHERE, KnownError
from ..surfaces.moebius import Moebius, balance_point, inside_out, own_center, rotation, to_middle
from ..surfaces.rounding import RESOLUTION, rounded
from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import as_complex, as_points, longest_edges
from ..surfaces.upright import upright_turn
from ..surfaces.uv_islands import uv_islands, vertex_uv

ON_CIRCLE = 1e-5  # UV units: distance from its circle allowed in 32-bit UVs
LEAST_ROUND = 0.5  # share of a loop's vertices on its circle; the others belong to ears of the loop


class DomainError(KnownError):
    """UVs that are not a circle domain, or a map of one that is impossible."""


@dataclasses.dataclass(frozen=True)
class Loop:
    """A boundary loop of an island and its circle in the unit disk.

    vertices  of the island, along the loop
    on        the vertices that lie on the circle
    """

    vertices: np.ndarray
    on: np.ndarray
    center: complex
    radius: float


@dataclasses.dataclass(frozen=True)
class CircleDomain:
    """An island whose UVs are a circle domain: the rim's disk moved to the unit disk.

    old_uv          (n, 2) UVs of the island's vertices, in 32 bits as they were stored
    points          (n,) complex, the vertices in the unit disk
    loops           the rim first, then the holes; at first sorted by the mesh's first vertex on each
    offset, scale   the disk's centre and radius in the UVs
    """

    island: Island
    old_uv: np.ndarray
    points: np.ndarray
    loops: list[Loop]
    offset: complex
    scale: float

    def placed(self, z: np.ndarray) -> np.ndarray:
        """UVs (n, 2) of points (n,) of the unit disk."""
        return as_points(self.offset + self.scale * z)

    def key(self, loop: Loop) -> int:
        """The mesh's first vertex on a loop, which identifies the loop."""
        return int(self.island.source_vertex[loop.vertices].min())

    def numbered(self, keys: list[int]) -> "CircleDomain":
        """The domain with its holes in the order of these keys of all loops."""
        known = {self.key(loop): loop for loop in self.loops[1:]}
        return dataclasses.replace(self, loops=[self.loops[0], *(known.pop(key) for key in keys if key in known),
                                                *known.values()])  # fmt: skip

    def in_disk(self, u: float, v: float) -> complex:
        """The point in the plane where the disk is the unit disk."""
        return (complex(u, v) - self.offset) / self.scale

    def hole_at(self, z: complex, near: float = 0.0) -> int:
        """Number of the hole whose circle holds that point, or else of the nearest hole within `near`; or 0.
        """
        away = {k: abs(z - loop.center) - loop.radius for k, loop in enumerate(self.loops) if k}
        nearest = min(away, key=lambda k: away[k], default=0)
        return nearest if nearest and away[nearest] <= near else 0

    def rim_change(self, number: int) -> Moebius:
        """The map of the domain that makes a hole the rim: it inverts the hole's circle, then brings the point where
        the surface's area balances to 0, then turns up upwards. The rim, number 0, needs no map.
        """
        if not 0 <= number < len(self.loops):
            raise DomainError(f"there is no loop {number}: the island has {len(self.loops)}")
        if number == 0:
            return Moebius()
        loop = self.loops[number]
        turned = inside_out(loop.center, loop.radius)
        z, weights = turned.apply(self.points), self.weights()
        moved = to_middle(balance_point(_in_disk(z), weights)).after(turned)
        turn = upright_turn(self.island, as_points(self.moved_points(moved)))
        return rotation(float(np.angle(turn))).after(moved)

    def moved(self, number: int, center: complex, angle: float, hole: int = 0) -> Moebius:
        """The map that makes a loop the rim, then brings a point of the disk to 0, then turns by an angle in radians.

        With `hole`, the number of a loop, its circle comes to the middle instead of the point. Raises DomainError if
        there is no such loop, or if the point is not inside the disk.
        """
        if not abs(center) < 1.0:
            raise DomainError("the centre must be inside the disk: nearer than 1 to (0, 0)")
        changed = self.rim_change(number)
        if hole:
            center = self._middle_of(hole, changed, number)
        if center:
            changed = to_middle(center).after(changed)
        return rotation(angle).after(changed) if angle else changed

    def _middle_of(self, hole: int, changed: Moebius, rim: int) -> complex:
        """The point that must come to 0, after `changed`, to bring a hole's circle to the middle."""
        if not 0 < hole < len(self.loops):
            raise DomainError(f"there is no hole {hole}: the island has {len(self.loops) - 1}")
        if hole == rim:
            raise DomainError(f"loop {hole} becomes the rim, so it cannot be the hole in the middle")
        return own_center(*changed.circle(self.loops[hole].center, self.loops[hole].radius))

    def weights(self) -> np.ndarray:
        """The surface's area (n,) at each vertex."""
        return np.bincount(
            self.island.triangles.ravel(), np.repeat(self.island.areas, 3), minlength=len(self.points)
        ) + np.finfo(float).tiny

    @functools.cached_property
    def _ears(self) -> np.ndarray:
        """Triangles (k, 3) with two edges on one loop, first the tip, the vertex between these edges."""
        triangles, number = self.island.triangles, np.full(len(self.points), -1)
        for k, loop in enumerate(self.loops):
            number[loop.vertices] = k
        around = number[triangles]
        found = np.flatnonzero((around[:, 0] >= 0) & (around == around[:, :1]).all(axis=1))
        alone = np.bincount(triangles.ravel(), minlength=len(number))[triangles[found]] == 1
        found, tip = found[alone.any(axis=1)], np.argmax(alone[alone.any(axis=1)], axis=1)
        return triangles[found[:, None], (tip[:, None] + np.arange(3)) % 3]

    def _turn_ears(self, z: np.ndarray) -> np.ndarray:
        """Turn flipped ears among points z (n,) back. Returns their tips (k,).

        A triangle with three vertices on the rim flips when the rim becomes a hole, as its edges are straight. Its tip
        is mirrored into the hole, so that the angles stay.
        """
        tip, one, other = z[self._ears].T
        over = ((one - tip).conj() * (other - tip)).imag <= 0.0
        if over.any():
            chord = other[over] - one[over]
            z[self._ears[over, 0]] = one[over] + chord * ((tip[over] - one[over]) / chord).conj()
        return self._ears[over, 0]

    def moved_points(self, moved: Moebius) -> np.ndarray:
        """Images (n,) of the points, accurate enough for a drag."""
        z = moved.apply(self.points)
        self._turn_ears(z)
        return z

    def image(self, moved: Moebius) -> "CircleImage":
        """The complete image of the domain, ready to be written and reported."""
        if moved.is_identity:
            return CircleImage(self, self.loops, self.old_uv, rounded(self.old_uv, self.island.triangles)[1])
        z = moved.apply(self.points)
        loops = [self._moved_loop(loop, moved, z) for loop in self.loops]
        off = self._turn_ears(z)
        loops = [dataclasses.replace(loop, on=np.setdiff1d(loop.on, off)) for loop in loops]
        rim = int(np.argmax([loop.radius for loop in loops]))
        loops[0], loops[rim] = loops[rim], loops[0]  # the other loops keep their numbers
        uv, flipped = rounded(self.placed(z), self.island.triangles)
        return CircleImage(self, loops, uv, flipped)

    def _moved_loop(self, loop: Loop, moved: Moebius, z: np.ndarray) -> Loop:
        """The image of a loop. Puts its points z (n,) onto its circle, as 32 bits had moved them off it.

        Tips of ears, which had been mirrored into the loop, go there too.
        """
        center, radius = moved.circle(loop.center, loop.radius)
        on = np.union1d(loop.on, np.intersect1d(loop.vertices, self._ears[:, 0]))
        arms = z[on] - center
        z[on] = center + arms * (radius / np.abs(arms))
        return dataclasses.replace(loop, on=on, center=center, radius=radius)


@dataclasses.dataclass(frozen=True)
class CircleImage:
    """The image of a circle domain under a Möbius map.

    loops    the rim first
    uv       (n, 2) in 32 bits
    flipped  triangles (k,) of the island whose signed area is not positive
    """

    domain: CircleDomain
    loops: list[Loop]
    uv: np.ndarray
    flipped: np.ndarray

    @property
    def too_small(self) -> int:
        """The number of triangles that became too small for 32-bit UVs."""
        triangles = self.domain.island.triangles
        now, before = (
            longest_edges(uv.astype(np.float64)[triangles]) < RESOLUTION for uv in (self.uv, self.domain.old_uv)
        )
        return int(np.count_nonzero(now & ~before))


def read_domains(koebe: ModuleType, surface: Surface, uv: np.ndarray) -> tuple[list[CircleDomain], list[DomainError]]:
    """The islands of a surface with UVs (C, 2) that are circle domains, and the reasons why others are not."""
    domains, errors = [], []
    for island in uv_islands(surface, uv):
        try:
            domains.append(read_domain(koebe, island, uv))
        except DomainError as error:
            errors.append(error)
    return domains, errors


def read_domain(koebe: ModuleType, island: Island, uv: np.ndarray) -> CircleDomain:
    """The circle domain of an island with UVs (C, 2) of the surface's corners. Raises DomainError."""
    return domain_in(koebe, island, vertex_uv(island, uv))


def domain_in(koebe: ModuleType, island: Island, old_uv: np.ndarray) -> CircleDomain:
    """The circle domain of an island with UVs (n, 2) of its vertices in 32 bits."""
    if not np.isfinite(old_uv).all():
        raise DomainError("its UVs are not finite")
    if not np.isfinite(island.vertices).all():
        raise DomainError(NOWHERE)
    plane = old_uv.astype(np.float64)
    if np.ptp(plane, axis=0).max() < RESOLUTION:
        raise DomainError("it has no UVs: map it first")
    loops = [_fitted(koebe, plane, vertices) for vertices in _boundary_loops(koebe, island)]
    if not loops:
        raise DomainError("it is closed: it has no rim")
    loops.sort(key=lambda loop: -loop.radius)
    rim = loops[0]
    # As exact as 32-bit UVs, and 0.5 where that is meant.
    offset, scale = complex(round(rim.center.real, 7), round(rim.center.imag, 7)), round(rim.radius, 7)
    holes = sorted(loops[1:], key=lambda loop: int(island.source_vertex[loop.vertices].min()))
    inside = [dataclasses.replace(loop, center=(loop.center - offset) / scale, radius=loop.radius / scale)
              for loop in holes]  # fmt: skip
    if not all(abs(loop.center) + loop.radius < 1.0 for loop in inside):
        raise DomainError("its UVs are not a disk with round holes: unwrap it with Shape: Disk and Tube: Ring")
    unit = dataclasses.replace(rim, center=0.0j, radius=1.0)
    return CircleDomain(island, old_uv, (as_complex(plane) - offset) / scale, [unit, *inside], offset, scale)


def _boundary_loops(koebe: ModuleType, island: Island) -> list[np.ndarray]:
    try:
        return list(koebe.boundary_loops(island.triangles, vertex_count=len(island.vertices)))
    except koebe.KoebeError as error:
        raise DomainError(str(error)) from error


def _fitted(koebe: ModuleType, plane: np.ndarray, vertices: np.ndarray) -> Loop:
    """A loop with its circle in the UVs (n, 2). Raises DomainError if it is not round."""
    on = vertices
    center, radius, off = koebe.fit_circle(plane[on])
    if off > ON_CIRCLE and len(on) > 3:  # some may belong to ears
        arms = np.abs(np.linalg.norm(plane[on] - center, axis=1) - radius)
        on = vertices[arms <= np.median(arms) + ON_CIRCLE]
        center, radius, _ = koebe.fit_circle(plane[on])
        on = vertices[np.abs(np.linalg.norm(plane[vertices] - center, axis=1) - radius) <= ON_CIRCLE]
        if len(on) > 2:
            center, radius, off = koebe.fit_circle(plane[on])
    if not (radius > 0.0 and off <= ON_CIRCLE and len(on) >= LEAST_ROUND * len(vertices)):
        raise DomainError("its UVs are not a disk with round holes: unwrap it with Shape: Disk and Tube: Ring")
    return Loop(vertices, on, complex(*center), radius)


def _in_disk(z: np.ndarray) -> np.ndarray:
    """Points with those that rounding put beyond the unit circle moved onto it."""
    return z / np.maximum(np.abs(z), 1.0)

