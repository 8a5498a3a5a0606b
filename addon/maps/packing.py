# SPDX-License-Identifier: GPL-3.0-or-later
"""Where the islands' disks lie in the UV square."""

import cmath
import dataclasses
from collections.abc import Sequence
from typing import Any

import numpy as np

from .triangles import as_complex, as_points

# Halvings of the interval of scales: the packing is within 2⁻¹² of the largest this packer finds.
BISECTIONS = 12
# Above this many disks all candidate places of all pairs become slow; shelves waste little then.
MAX_NESTED_DISKS = 16
# UV units: an island that was smaller had no place of its own, as in a layer that was never unwrapped.
SMALLEST_PLACE = 1e-6


@dataclasses.dataclass(frozen=True)
class Placement:
    """The similarity z -> offset + scale·exp(i·rotation)·z from the unit disk to the UV plane."""

    offset: tuple[float, float] = (0.5, 0.5)
    scale: float = 0.5
    rotation: float = 0.0

    def apply(self, points: np.ndarray) -> np.ndarray:
        """UV coordinates (n, 2) of points (n, 2) of the unit disk."""
        return as_points(complex(*self.offset) + cmath.rect(self.scale, self.rotation) * as_complex(points))

    def to_dict(self) -> dict[str, Any]:
        """Plain values, for JSON."""
        return {"offset": list(self.offset), "scale": self.scale, "rotation": self.rotation}


def fit_placement(points: np.ndarray, targets: np.ndarray) -> Placement | None:
    """The placement that puts `points` (n, 2) of the disk where `targets` (n, 2) are, or None if these are one point.

    Centre, root mean square radius and mean direction agree.
    """
    source, target = as_complex(points), as_complex(targets)
    source_center, target_center = source.mean(), target.mean()
    source, target = source - source_center, target - target_center
    size = np.linalg.norm(target) / np.linalg.norm(source)
    if not SMALLEST_PLACE <= size < np.inf:  # nor where the targets are not finite
        return None
    rotation = float(np.angle(np.vdot(source, target)))
    offset = target_center - cmath.rect(size, rotation) * source_center
    return Placement((float(offset.real), float(offset.imag)), float(size), rotation)


def pack_disks(radii: Sequence[float], margin: float) -> list[Placement]:
    """Placements of disks with sizes in the given proportions, as large as they fit the unit square.

    Disks keep `margin` (in UV units) from each other and half of it from the border. A single disk
    has nothing to keep from: it fills the square.
    """
    sizes = np.asarray(radii, dtype=np.float64)
    if len(sizes) == 1:
        return [Placement()]
    margin = min(margin, 0.5 / len(sizes))
    relative = sizes / sizes.max()
    order = np.argsort(-relative, kind="stable")
    place = _nest if len(sizes) <= MAX_NESTED_DISKS else _shelve
    low, high, centers = 0.0, 0.5, None
    while centers is None or high - low > 0.5**BISECTIONS * high:
        scale = 0.5 * (low + high)
        tried = place(relative[order] * scale + 0.5 * margin)
        if tried is None:
            high = scale
        else:
            low, centers = scale, tried
    placements = [Placement()] * len(sizes)
    for center, index in zip(centers, order, strict=True):
        placements[index] = Placement(
            (float(center[0]), float(center[1])), float(low * relative[index])
        )
    return placements


def _shelve(radii: np.ndarray) -> np.ndarray | None:
    """Centers of disks of falling radius in rows from the bottom, or None."""
    centers, x, y, height = [], 0.0, 0.0, 0.0
    for radius in radii:
        if x + 2 * radius > 1.0:
            x, y, height = 0.0, y + height, 0.0
        if x + 2 * radius > 1.0 or y + 2 * radius > 1.0:
            return None
        centers.append((x + radius, y + radius))
        x += 2 * radius
        height = max(height, 2 * radius)
    return np.array(centers)


def _nest(radii: np.ndarray) -> np.ndarray | None:
    """Centers of disks of falling radius, each in the lowest place where it touches two things, or None."""
    centers = np.empty((0, 2))
    for count, radius in enumerate(radii):
        places = _touching_places(centers, radii[:count], radius)
        inside = ((places >= radius - 1e-12) & (places <= 1.0 - radius + 1e-12)).all(axis=1)
        places = places[inside]
        gaps = np.linalg.norm(places[:, None] - centers[None], axis=2) - (radii[:count] + radius)
        places = places[(gaps >= -1e-12).all(axis=1)]
        if len(places) == 0:
            return None
        best = np.lexsort((places[:, 0], places[:, 1]))[0]
        centers = np.vstack([centers, places[best]])
    return centers


def _touching_places(centers: np.ndarray, radii: np.ndarray, radius: float) -> np.ndarray:
    """Centers at which a disk touches two walls, a wall and a disk, or two disks."""
    low, high = radius, 1.0 - radius
    places = [np.array([[low, low], [low, high], [high, low], [high, high]])]
    reach = radii + radius
    for wall in (low, high):
        for axis in (0, 1):
            across = reach**2 - (wall - centers[:, axis]) ** 2
            for sign in (-1.0, 1.0):
                place = np.empty_like(centers)
                place[:, axis] = wall
                place[:, 1 - axis] = centers[:, 1 - axis] + sign * np.sqrt(np.maximum(across, 0.0))
                places.append(place[across >= 0.0])
    first, second = np.triu_indices(len(centers), 1)
    if len(first):
        step = centers[second] - centers[first]
        distance = np.linalg.norm(step, axis=1)
        along = (distance**2 + reach[first] ** 2 - reach[second] ** 2) / (2.0 * distance)
        across = reach[first] ** 2 - along**2
        meet = across >= 0.0
        step = step[meet] / distance[meet, None]
        foot = centers[first][meet] + along[meet, None] * step
        normal = np.stack([-step[:, 1], step[:, 0]], axis=1)
        for sign in (-1.0, 1.0):
            places.append(foot + sign * np.sqrt(across[meet])[:, None] * normal)
    return np.concatenate(places)
