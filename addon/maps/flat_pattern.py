# SPDX-License-Identifier: GPL-3.0-or-later
"""Cuts a surface anew and lays it flat, as true to size as it can be: for a flat mesh, and for patterns to cut out."""

import dataclasses
import math
from types import ModuleType
from typing import Any

import numpy as np

from ..layers.flat_layout import FlatError, FlatLayout, flat_layout
from ..surfaces.errors import NOWHERE
from ..surfaces.islands import cut_into_islands, put_together
from ..surfaces.surface import Surface
from ..surfaces.triangles import areas
from .outcomes import Progress
from .wording import counted

PATTERN_SIDE = 300.0  # mm, the root of the area of a surface that is laid flat at no real size


@dataclasses.dataclass(frozen=True)
class Label:
    """The number of a seam, on a side of it, or "P" and the number of a piece.

    at      (2,) the middle of the text, from the layout's lower left corner
    height  of capitals
    angle   radians, counter-clockwise
    """

    text: str
    at: np.ndarray
    height: float
    angle: float


@dataclasses.dataclass(frozen=True)
class FlatPattern:
    """A surface laid flat.

    uv       (C, 2) of the surface's corners in its own unit of length; 0 at corners of faces that were left out
    faces    (P,) bool, the faces that were laid flat
    low      (2,) least coordinates of these faces' UVs
    size     the surface's unit of length, in millimetres of the pattern
    result   of `koebe.flatten`
    """

    uv: np.ndarray
    faces: np.ndarray
    low: np.ndarray
    size: float
    result: Any

    def labels(self) -> list[Label]:
        """Of a pattern on one sheet, in the surface's unit of length."""
        return [
            Label(one["text"], np.array(one["at_mm"]) / self.size - self.low, one["height_mm"] / self.size,
                  math.radians(one["angle_deg"]))
            for one in self.result.sheets[0]["labels"]
        ]  # fmt: skip

    def describe(self) -> str:
        """Pieces, and how far lengths are off, in words."""
        stretch = self.result.stretch_percent
        text = f"{counted(len(self.result.pieces), 'piece')}, lengths off by {stretch['mean']:.2g} % in the mean"
        return f"{text} and {stretch['max']:.2g} % at most"

    def unit_uv(self) -> np.ndarray:
        """(C, 2) the same, as large as it fits into the UV square."""
        return self.uv / max(float(self.uv.max(initial=0.0)), 1e-300)


def flat_pattern(
    koebe: ModuleType,
    surface: Surface,
    millimetres: float | None = None,
    progress: Progress | None = None,
    cancel: Any = None,
    **options: Any,
) -> FlatPattern:
    """Cut the selected faces into pieces and lay these flat. Seams are cuts. Polygons stay whole.

    millimetres  of the pattern per unit of length of the surface; None: only the flat pieces are wanted
    options      page and allowance of the pattern, as of `koebe.flatten`

    Raises FlatError, and the errors of `koebe.flatten`.
    """
    chosen = surface.selected[surface.triangle_face]
    corners = surface.triangle_corners[chosen]
    positions, vertex_of_corner, _ = put_together(surface, cut_into_islands(surface))
    if not np.isfinite(positions).all():
        raise FlatError(NOWHERE)
    triangles = vertex_of_corner[corners]
    if millimetres is None:
        root = float(np.sqrt(areas(positions, triangles).sum()))
        if not root > 0.0:
            raise FlatError("all faces have area 0")
        millimetres, options = PATTERN_SIDE / root, {"page": "none"}
    result = koebe.flatten(
        positions * millimetres, triangles, polygon=surface.triangle_face[chosen], units="mm",
        progress=progress, cancel=cancel, **options,
    )  # fmt: skip
    uv = np.zeros((len(surface.corner_vertex), 2))
    laid = np.zeros(len(uv), dtype=bool)
    flat = result.part >= 0
    uv[corners[flat]] = result.uv[flat] / millimetres
    laid[corners[flat]] = True
    # A face with a corner at degenerate triangles only has no place for this corner.
    whole = np.logical_and.reduceat(laid, surface.face_start) if len(uv) else np.zeros(0, dtype=bool)
    kept = np.repeat(whole, surface.face_size)
    uv[~kept] = 0.0
    low = uv[kept].min(axis=0, initial=np.inf) if kept.any() else np.zeros(2)
    return FlatPattern(uv, whole, low, millimetres, result)


def pattern_layout(surface: Surface, pattern: FlatPattern) -> FlatLayout:
    """The layout of the pattern's pieces. Raises FlatError without any."""
    return flat_layout(surface, pattern.uv, scale=1.0)
