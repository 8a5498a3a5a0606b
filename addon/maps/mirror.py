# SPDX-License-Identifier: GPL-3.0-or-later
"""Mirror symmetry: the plane in which a surface is its own image, and circle domains made exactly symmetric by it."""

import dataclasses
import itertools

import numpy as np

from .circle_domain import CircleDomain, CircleImage, DomainError, Loop
from .circle_fit import fitted_circle
from .moebius import balance_point, rotation, to_middle
from .surface import Island
from .triangles import as_points, flipped_triangles
from .upright import upright_turn

TOLERANCE = 1e-4  # of the bounding box's diagonal: so far from its mirror image a vertex may be
MOST_FIXED = 0.5  # share of vertices in the plane: a flat surface is no mirror image of itself in its own plane
GRID = 2.0**-24  # UV units: places u in [0, 1] that are such multiples, and 1 - u, are exact in 32 bits
NO_MIRROR = "no plane was found in which the surface is its own mirror image, vertex by vertex and face by face"


@dataclasses.dataclass(frozen=True)
class Symmetry:
    """What was made symmetric.

    pairs  number of vertices that have another one as their image
    moved  by how much a vertex was moved at most beside a Möbius map, in UV units
    """

    image: CircleImage
    pairs: int
    moved: float


def mirror_of(island: Island) -> np.ndarray | None:
    """The vertex (n,) that is the mirror image of each, or None if there is no plane that maps faces to faces.

    Tried are planes across x, y and z, then across the main axes, through the mean of the vertices.
    """
    arms = island.vertices - island.vertices.mean(axis=0)
    tolerance = TOLERANCE * float(np.linalg.norm(np.ptp(arms, axis=0)))
    axes = np.linalg.eigh(np.einsum("ij,ik->jk", arms, arms))[1].T
    for normal in [*np.eye(3), *axes]:
        image = _nearest(arms, arms - 2.0 * np.outer(np.einsum("ij,j->i", arms, normal), normal), tolerance)
        if image is not None and _maps_faces(island, image):
            return image
    return None


def _nearest(points: np.ndarray, places: np.ndarray, tolerance: float) -> np.ndarray | None:
    """The point (n,) at each of the places (n, 3), each one once and back and forth, or None."""
    cell = 4.0 * tolerance
    keys, found = _key(np.floor(points / cell)), np.full(len(points), -1)
    order = np.argsort(keys, kind="stable")
    ranked = keys[order]
    near = np.full(len(points), tolerance)
    # A place within the tolerance of a cell's wall may have its point on the other side.
    for side in itertools.product((-1.0, 1.0), repeat=3):
        wanted = _key(np.floor((places + np.array(side) * tolerance) / cell))
        first, last = np.searchsorted(ranked, wanted), np.searchsorted(ranked, wanted, side="right")
        for step in range(int((last - first).max(initial=0))):
            here = np.flatnonzero(first + step < last)
            candidate = order[first[here] + step]
            away = np.linalg.norm(points[candidate] - places[here], axis=1)
            better = away < near[here]
            near[here[better]], found[here[better]] = away[better], candidate[better]
    numbers = np.arange(len(points))
    if (found < 0).any() or (found[found] != numbers).any():
        return None
    return found if np.count_nonzero(found == numbers) <= MOST_FIXED * len(points) else None


def _key(cells: np.ndarray) -> np.ndarray:
    """One number for each cell; cells far apart may share it."""
    x, y, z = cells.astype(np.int64).T
    return x * 73856093 ^ y * 19349663 ^ z * 83492791


def _maps_faces(island: Island, image: np.ndarray) -> bool:
    """Whether the vertices of every face are mapped to those of a face. Faces are told apart by sums of random numbers.
    """
    number = np.random.default_rng(20101).integers(0, 2**62, size=len(image), dtype=np.int64)
    faces, sizes = _faces(island)
    if sizes.sum() != len(faces):  # of a polygon with a corner in no triangle
        return False
    ends = np.cumsum(sizes)
    sums = (np.add.reduceat(numbers, ends - sizes) for numbers in (number[faces], number[image[faces]]))
    one, other = (np.sort(each) for each in sums)
    return bool((one == other).all())


def _faces(island: Island) -> tuple[np.ndarray, np.ndarray]:
    """Vertex at each corner, the corners of a face in a row, and the number of corners of each face.

    Quads may be split along either diagonal, so triangles are no help.
    """
    size = np.bincount(np.searchsorted(island.faces, island.triangle_face), minlength=len(island.faces)) + 2
    return island.corner_vertex, size


def symmetric(domain: CircleDomain) -> Symmetry:
    """The domain made exactly symmetric to the vertical line through its middle. Raises DomainError where it cannot.

    A conformal map of a symmetric surface is symmetric up to a Möbius map and what the triangles spoil. So the mirror
    is brought onto the vertical line, the centre stays as nearly as it can, and every vertex goes halfway between where
    it is and the mirror image of its partner.
    """
    image = mirror_of(domain.island)
    if image is None:
        raise DomainError(NO_MIRROR)
    partner = _partners(domain, image)
    z = _upright(domain, _on_the_line(domain, image))
    halfway = 0.5 * (z - z[image].conj())
    loops = [_halfway(domain, loop, z, halfway, partner, number) for number, loop in enumerate(domain.loops)]
    uv = _exact(domain, halfway, image)
    flipped = flipped_triangles(domain.island.triangles, uv)
    if len(flipped) > len(flipped_triangles(domain.island.triangles, domain.old_uv)):
        raise DomainError("made symmetric, some triangles would be turned over: it stays as it is")
    pairs = int(np.count_nonzero(image != np.arange(len(image)))) // 2
    return Symmetry(CircleImage(domain, loops, uv, flipped), pairs, domain.scale * float(np.abs(halfway - z).max()))


def _partners(domain: CircleDomain, image: np.ndarray) -> list[int]:
    """Number of the loop that is the mirror image of each. Raises DomainError if the rim is not its own."""
    number = np.full(len(image), -1)
    for k, loop in enumerate(domain.loops):
        number[loop.vertices] = k
    partner = [int(number[image[loop.vertices[0]]]) for loop in domain.loops]
    if partner[0] != 0:
        raise DomainError("its rim is not symmetric: make a loop the rim that is its own mirror image")
    return partner


def _on_the_line(domain: CircleDomain, image: np.ndarray) -> np.ndarray:
    """The points (n,) with the mirror on the imaginary axis, and the old centre as near to the middle as can be."""
    weights = domain.weights()
    moved = to_middle(balance_point(domain.points / np.maximum(np.abs(domain.points), 1.0), weights + weights[image]))
    z = moved.apply(domain.points)
    across = complex((weights * z[image] * z).sum())  # of angle t where the mirror is z -> exp(i t) conj(z)
    turned = rotation(0.5 * (np.pi - float(np.angle(across)))).after(moved)
    return to_middle(1j * turned(0.0).imag).after(turned).apply(domain.points)


def _upright(domain: CircleDomain, z: np.ndarray) -> np.ndarray:
    """The points, or upside down, as the surface's up has it."""
    return z if upright_turn(domain.island, as_points(z)).real >= 0.0 else -z


def _halfway(
    domain: CircleDomain, loop: Loop, z: np.ndarray, halfway: np.ndarray, partner: list[int], number: int
) -> Loop:
    """A loop with the circle halfway between its own and its partner's mirrored one; its points go onto that circle."""
    other = domain.loops[partner[number]]
    (center, radius), (mirrored, second) = (_circle(z[one.on]) for one in (loop, other))
    center, radius = 0.5 * (center - mirrored.conjugate()), 0.5 * (radius + second)
    if number == 0:
        center, radius = 0.0j, 1.0
    arms = halfway[loop.on] - center
    halfway[loop.on] = center + arms * (radius / np.abs(arms))
    return dataclasses.replace(loop, center=center, radius=radius)


def _circle(points: np.ndarray) -> tuple[complex, float]:
    center, radius, _ = fitted_circle(as_points(points))
    return complex(*center), radius


def _exact(domain: CircleDomain, z: np.ndarray, image: np.ndarray) -> np.ndarray:
    """UVs (n, 2) in 32 bits that are mirror images of each other to the last bit, about the grid's nearest line."""
    uv = domain.placed(z)
    middle = round(domain.offset.real / GRID) * GRID
    away = np.round((uv[:, 0] - domain.offset.real) / GRID) * GRID
    numbers = np.arange(len(z))
    first = np.minimum(numbers, image)
    away = np.where(image == numbers, 0.0, np.where(first == numbers, away, -away[image]))
    return np.stack([middle + away, uv[first, 1]], axis=1).astype(np.float32)
