# SPDX-License-Identifier: GPL-3.0-or-later
"""Places the islands' disks in the UV square."""

import cmath
import dataclasses
from collections.abc import Sequence
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.triangles import as_complex, as_points

# UV units: a smaller island had no place of its own, as in a layer that was never unwrapped.
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
    """The placement that puts `points` (n, 2) of the disk at `targets` (n, 2), or None if these are one point.

    Centre, root mean square radius and mean direction agree.
    """
    source, target = as_complex(points), as_complex(targets)
    source_center, target_center = source.mean(), target.mean()
    source, target = source - source_center, target - target_center
    size = np.linalg.norm(target) / np.linalg.norm(source)
    if not SMALLEST_PLACE <= size < np.inf:  # nor if the targets are not finite
        return None
    rotation = float(np.angle(np.vdot(source, target)))
    offset = target_center - cmath.rect(size, rotation) * source_center
    return Placement((float(offset.real), float(offset.imag)), float(size), rotation)


def packed(koebe: ModuleType, radii: Sequence[float], margin: float) -> list[Placement]:
    """Placements of disks in the unit square, by `koebe.pack_disks`."""
    centers, scales = koebe.pack_disks(radii, margin)
    return [Placement((x, y), scale) for (x, y), scale in zip(centers.tolist(), scales.tolist(), strict=True)]
