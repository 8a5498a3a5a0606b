# SPDX-License-Identifier: GPL-3.0-or-later
"""The brush that relaxes the UVs under it and keeps them one to one: all that is not under it stays where it is."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..surfaces.islands import cut_into_islands
from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import signed_areas
from ..surfaces.uv_islands import uv_islands, vertex_uv

ROUNDS = 2  # tries with a smaller circle, where the relaxed UVs would turn over a face once they are stored in 32 bits
SMALLER = 0.7


@dataclasses.dataclass
class Dab:
    """What a dab changed.

    corners, uv  (m,), (m, 2) in 32 bits
    problem      why nothing moves there, or empty
    """

    corners: np.ndarray
    uv: np.ndarray
    problem: str = ""


class RelaxBrush:
    """The UVs of a layer while a brush relaxes them. Touches no Blender data.

    The borders of islands, pinned UVs and faces that are not selected stay. Faces under the brush fill the same region
    as before without turning over, so a map that was one to one stays so.

    uv  (C, 2) of the surface's corners after the last dab, 32 bits
    """

    def __init__(self, koebe: ModuleType, surface: Surface, uv: np.ndarray, pinned: np.ndarray, cancel: Any) -> None:
        """@param pinned (C,) bool"""
        self._koebe, self._surface, self._cancel = koebe, surface, cancel
        self.uv = uv.astype(np.float32)
        self._islands = uv_islands(surface, uv)
        self._held = [_held(island, pinned) for island in self._islands]

    def island_at(self, place: tuple[float, float]) -> int | None:
        """The number of the island whose face has this place, or None."""
        for k, island in enumerate(self._islands):
            a, b, c = (vertex_uv(island, self.uv).astype(np.float64)[island.triangles[:, i]] for i in range(3))
            with np.errstate(invalid="ignore", over="ignore"):
                inside = [_cross(q - p, place - p) >= 0.0 for p, q in ((a, b), (b, c), (c, a))]
            if np.logical_and.reduce(inside).any():
                return k
        return None

    def dab(self, number: int, place: tuple[float, float], radius: tuple[float, float], even: float) -> Dab:
        """Relax the vertices of an island in an ellipse. @param radius along u and v @param even E

        Raises koebe.Cancelled.
        """
        island = self._islands[number]
        points = vertex_uv(island, self.uv)
        problem = ""
        for _ in range(ROUNDS):
            with np.errstate(all="ignore"):  # UVs may not be finite
                away = np.hypot(*((points.astype(np.float64) - place) / radius).T)
            free = (away < 1.0) & ~self._held[number]
            made, problem = self._relaxed(island, points, free, even)
            if made is not None:
                at = free[island.corner_vertex]
                corners, uv = island.corners[at], made[island.corner_vertex[at]]
                self.uv[corners] = uv
                return Dab(corners, uv)
            radius = (radius[0] * SMALLER, radius[1] * SMALLER)
        return Dab(np.zeros(0, dtype=np.int32), np.zeros((0, 2), dtype=np.float32), problem)

    def _relaxed(
        self, island: Island, points: np.ndarray, free: np.ndarray, even: float
    ) -> tuple[np.ndarray | None, str]:
        """The island's points (n, 2) in 32 bits with its free vertices relaxed; or None, and why."""
        patch = island.triangles[free[island.triangles].any(axis=1)]
        if not len(patch):
            return None, "no UV inside an island is under the brush: borders and pinned UVs stay"
        made = points.copy()
        for piece in cut_into_islands(_surface_of(island.vertices, patch)):
            at = piece.source_vertex
            places = points[at].astype(np.float64)
            try:
                dial = self._koebe.EvenDial(piece.vertices, piece.triangles, uv=places, round=False)
                stay = np.flatnonzero(~free[at])
                relaxed = dial.pin(dict(zip(stay.tolist(), places[stay].tolist(), strict=True)), even=even,
                                   cancel=self._cancel)  # fmt: skip
            except self._koebe.Cancelled:
                raise
            except self._koebe.KoebeError as error:
                return None, str(error)
            moves = free[at]
            made[at[moves]] = relaxed[moves].astype(np.float32)
        if not (signed_areas(made.astype(np.float64), patch) > 0.0).all():
            return None, "faces there are too small for 32 bits"
        return made, ""


def _held(island: Island, pinned: np.ndarray) -> np.ndarray:
    """The vertices (n,) that stay: on the border, pinned, or at edges with more than two faces."""
    sides = np.concatenate([island.triangles[:, [i, (i + 1) % 3]] for i in range(3)]).astype(np.int64)
    count = len(island.vertices)
    _, which, times = np.unique(
        np.sort(sides, axis=1) @ np.array([count, 1]), return_inverse=True, return_counts=True
    )
    held = np.zeros(count, dtype=bool)
    held[sides[times[which] != 2].ravel()] = True
    held[island.corner_vertex[pinned[island.corners]]] = True
    return held


def _surface_of(positions: np.ndarray, triangles: np.ndarray) -> Surface:
    """Triangles as a surface."""
    corners = np.arange(triangles.size, dtype=np.int32).reshape(-1, 3)
    vertex = triangles.ravel()
    ends = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    edges, edge = np.unique(ends.astype(np.int64) @ np.array([len(positions), 1]), return_inverse=True)
    count = len(triangles)
    return Surface(
        positions=positions, corner_vertex=vertex, corner_edge=edge.astype(np.int32), face_start=corners[:, 0],
        face_size=np.full(count, 3, dtype=np.int32), seam=np.zeros(len(edges), dtype=bool),
        selected=np.ones(count, dtype=bool), triangle_corners=corners,
        triangle_face=np.arange(count, dtype=np.int32),
    )  # fmt: skip


def _cross(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    return np.asarray(one[:, 0] * two[:, 1] - one[:, 1] * two[:, 0])
