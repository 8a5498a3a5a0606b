# SPDX-License-Identifier: GPL-3.0-or-later
"""Judges a map as Blender's 32-bit UVs store it: how true its angles are, and how much area is lost."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from .errors import MapError
from .triangles import signed_areas


@dataclasses.dataclass(frozen=True)
class Stored:
    """A map as it is stored. @param report `koebe.distortion` of it"""

    report: dict[str, Any]

    @property
    def lost_area(self) -> float:
        """Share of the surface's area in triangles without a positive area in the UVs."""
        return float(self.report["lost_area"])

    @property
    def angle_error(self) -> float:
        """Mean difference, in degrees, of the triangles' angles on the surface and in the UVs."""
        return float(self.report["angle_error_stored_deg"]["mean"])

    def figures(self) -> dict[str, Any]:
        """The figures under the names of `koebe.MapReport`."""
        return {name: self.report[name] for name in ("lost_area", "angle_error_stored_deg")}


class LostAreaError(MapError):
    """A map that loses too much area. `elements` are the lost triangles; `offer` names operators for such surfaces."""

    kind = "lost_area"

    def __init__(self, share: float, elements: np.ndarray, *offer: str) -> None:
        super().__init__(f"{lost_text(share)}. The layer stays as it was: use {SERVES[offer[0]]}")
        self.elements, self.offer = elements, offer


SERVES = {"parts": "Unwrap to Parts", "uniformize": "Unwrap to Disk"}


def lost_text(share: float) -> str:
    """The sentence about a lost share of the area."""
    said = f"{100.0 * share:.0f}" if share >= 0.1 else f"{100.0 * share:.2g}"
    return f"{said} % of its area is lost: faces there have no area in the UVs"


def judge(
    koebe: ModuleType, vertices: np.ndarray, triangles: np.ndarray, uv: np.ndarray, turned: np.ndarray
) -> Stored:
    """The verdict on UVs (n, 2) in 32 bits of vertices (n, 3).

    turned  triangles that the map has in the other orientation
    """
    if len(turned):
        triangles = triangles.copy()
        triangles[turned] = triangles[turned, ::-1]
    return Stored(koebe.distortion(vertices, triangles, 2.0 * uv.astype(np.float64) - 1.0))  # as points of the disk


def judge_corners(
    koebe: ModuleType, vertices: np.ndarray, triangles: np.ndarray, uv: np.ndarray, turned: np.ndarray
) -> Stored:
    """The verdict on UVs (t, 3, 2) of the triangles' corners."""
    return judge(koebe, vertices[triangles].reshape(-1, 3), _apart(len(uv)), uv.reshape(-1, 2), turned)


def flipped_corners(uv: np.ndarray, turned: np.ndarray) -> np.ndarray:
    """Triangles (k,) without positive area in these UVs."""
    area = signed_areas(uv.reshape(-1, 2), _apart(len(uv)))
    area[turned] *= -1.0
    return np.flatnonzero(area <= 0.0)


def turned_of(result: Any) -> np.ndarray:
    """The triangles that a result of `koebe.uniformize` has in the other orientation."""
    found = [warning["elements"] for warning in result.warnings if warning["kind"] == "reoriented_faces"]
    return np.concatenate([np.zeros(0, dtype=np.int64), *found]).astype(np.int64)


def _apart(count: int) -> np.ndarray:
    return np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
