# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes circle domains of mirror-symmetric surfaces exactly symmetric."""

import dataclasses
from types import ModuleType

import numpy as np

from ..surfaces.moebius import balance_point, rotation, to_middle
from ..surfaces.triangles import as_points, flipped_triangles
from ..surfaces.upright import upright_turn
from .circle_domain import CircleDomain, CircleImage, DomainError, Loop

GRID = 2.0**-24  # UV units: for multiples u in [0, 1] both u and 1 - u are exact in 32 bits
NO_MIRROR = "the mesh is not symmetric: some vertices or faces have no mirror image"


@dataclasses.dataclass(frozen=True)
class Symmetry:
    """The result of making a domain symmetric.

    pairs  number of vertices whose mirror image is another vertex
    moved  largest move of a vertex besides the Möbius map, in UV units
    """

    image: CircleImage
    pairs: int
    moved: float


def symmetric(koebe: ModuleType, domain: CircleDomain) -> Symmetry:
    """The domain made exactly symmetric to the vertical line through its middle. Raises DomainError if impossible.

    A conformal map of a symmetric surface is symmetric up to a Möbius map and errors of the triangles. So the mirror
    line is brought onto the vertical line, with the centre kept as nearly as possible. Then every vertex goes halfway
    to the mirror image of its partner.
    """
    island = domain.island
    image = koebe.mirror_image(island.vertices, island.triangles, polygon=island.triangle_face)
    if image is None:
        raise DomainError(NO_MIRROR)
    partner = _partners(domain, image)
    z = _upright(domain, _on_the_line(domain, image))
    halfway = 0.5 * (z - z[image].conj())
    loops = [_halfway(koebe, domain, loop, z, halfway, partner, number) for number, loop in enumerate(domain.loops)]
    uv = _exact(domain, halfway, image)
    flipped = flipped_triangles(domain.island.triangles, uv)
    if len(flipped) > len(flipped_triangles(domain.island.triangles, domain.old_uv)):
        raise DomainError("the symmetric map would turn some triangles over, so the map stays as it was")
    pairs = int(np.count_nonzero(image != np.arange(len(image)))) // 2
    return Symmetry(CircleImage(domain, loops, uv, flipped), pairs, domain.scale * float(np.abs(halfway - z).max()))


def _partners(domain: CircleDomain, image: np.ndarray) -> list[int]:
    """For each loop the number of its mirror image. Raises DomainError if the rim's mirror image is another loop."""
    number = np.full(len(image), -1)
    for k, loop in enumerate(domain.loops):
        number[loop.vertices] = k
    partner = [int(number[image[loop.vertices[0]]]) for loop in domain.loops]
    if partner[0] != 0:
        raise DomainError("its rim is not symmetric: choose another boundary as the rim")
    return partner


def _on_the_line(domain: CircleDomain, image: np.ndarray) -> np.ndarray:
    """The points (n,) with the mirror on the imaginary axis, and the old centre as near to the middle as possible."""
    weights = domain.weights()
    moved = to_middle(balance_point(domain.points / np.maximum(np.abs(domain.points), 1.0), weights + weights[image]))
    z = moved.apply(domain.points)
    across = complex((weights * z[image] * z).sum())  # of angle t if the mirror is z -> exp(i t) conj(z)
    turned = rotation(0.5 * (np.pi - float(np.angle(across)))).after(moved)
    return to_middle(1j * turned(0.0).imag).after(turned).apply(domain.points)


def _upright(domain: CircleDomain, z: np.ndarray) -> np.ndarray:
    """The points, turned upside down if the surface's up requires it."""
    return z if upright_turn(domain.island, as_points(z)).real >= 0.0 else -z


def _halfway(
    koebe: ModuleType,
    domain: CircleDomain,
    loop: Loop,
    z: np.ndarray,
    halfway: np.ndarray,
    partner: list[int],
    number: int,
) -> Loop:
    """A loop on the circle halfway between its own and its partner's mirrored circle."""
    other = domain.loops[partner[number]]
    (center, radius, _), (mirrored, second, _) = (koebe.fit_circle(as_points(z[one.on])) for one in (loop, other))
    center, radius = 0.5 * (complex(*center) - complex(*mirrored).conjugate()), 0.5 * (radius + second)
    if number == 0:
        center, radius = 0.0j, 1.0
    arms = halfway[loop.on] - center
    halfway[loop.on] = center + arms * (radius / np.abs(arms))
    return dataclasses.replace(loop, center=center, radius=radius)


def _exact(domain: CircleDomain, z: np.ndarray, image: np.ndarray) -> np.ndarray:
    """UVs (n, 2) in 32 bits that are mirror images of each other to the last bit, about the grid's nearest line."""
    uv = domain.placed(z)
    middle = round(domain.offset.real / GRID) * GRID
    away = np.round((uv[:, 0] - domain.offset.real) / GRID) * GRID
    numbers = np.arange(len(z))
    first = np.minimum(numbers, image)
    away = np.where(image == numbers, 0.0, np.where(first == numbers, away, -away[image]))
    return np.stack([middle + away, uv[first, 1]], axis=1).astype(np.float32)
