# SPDX-License-Identifier: GPL-3.0-or-later
"""The layout of a UV layer as flat pieces in the surface's own lengths: for a flat mesh, and for cutting."""

import dataclasses

import numpy as np

from ..surfaces.connected_components import connected_components
from ..surfaces.errors import NOWHERE, KnownError
from ..surfaces.surface import Surface, next_corners
from ..surfaces.triangles import areas, signed_areas
from ..surfaces.uv_islands import uv_islands

PERCENTILES = (5.0, 95.0)  # most edges' lengths lie between these
TRUE = 0.05  # largest error of these for pieces that count as true to scale


class FlatError(KnownError):
    """A layer whose layout cannot be made into flat pieces."""


@dataclasses.dataclass(frozen=True)
class Piece:
    """An island in the plane.

    outline  vertices of the layout along its outer boundary
    holes    the same for the boundaries inside
    """

    outline: np.ndarray
    holes: list[np.ndarray]


@dataclasses.dataclass(frozen=True)
class FlatLayout:
    """The islands of a UV layer side by side, at their places: n vertices, p faces, c corners.

    points         (n, 2) in the surface's unit of length; the least coordinates are 0
    corner_vertex  (c,) vertex of each corner
    corners        (c,) corner of the surface
    faces          (p,) face of the surface, in its order
    face_size      (p,) number of corners
    edges          (e, 2) vertices of the edges between two faces of a piece, for engraving
    scale          length on the surface per unit of the UVs, right in the mean of the areas
    left_out       number of faces without UVs
    lengths        5th and 95th percentile over the edges of length here / length on the surface
    """

    points: np.ndarray
    corner_vertex: np.ndarray
    corners: np.ndarray
    faces: np.ndarray
    face_size: np.ndarray
    pieces: list[Piece]
    edges: np.ndarray
    scale: float
    left_out: int
    lengths: tuple[float, float]

    @property
    def is_true(self) -> bool:
        """Whether nearly all lengths equal those on the surface."""
        return max(abs(share - 1.0) for share in self.lengths) <= TRUE

    def describe(self) -> str:
        """How true to scale it is, in words."""
        low, high = (100.0 * share for share in self.lengths)
        text = f"lengths are {low:.4g} % to {high:.4g} % of lengths on the surface (9 of 10 edges)"
        return f"true to scale: {text}" if self.is_true else f"not true to scale: {text}"


def flat_layout(surface: Surface, uv: np.ndarray, scale: float | None = None) -> FlatLayout:
    """The layout of UVs (C, 2) of the surface's corners, cut where the UVs are cut. Raises FlatError without UVs.

    scale  length per unit of the UVs; None: as large as the surface in the mean of the areas
    """
    if not np.isfinite(uv).all():
        raise FlatError("its UVs are not finite")
    plane = uv.astype(np.float64)
    chosen = _with_area(surface, plane) & surface.selected
    if not chosen.any():
        raise FlatError("it has no UVs: map it first")
    left_out = int(np.count_nonzero(surface.selected & ~chosen))
    surface = dataclasses.replace(surface, selected=chosen)
    vertex, source = _numbers(surface, uv)
    corners = np.flatnonzero(vertex >= 0)
    triangles = vertex[surface.triangle_corners[chosen[surface.triangle_face]]]
    in_space = surface.positions[surface.corner_vertex[source]]
    if not np.isfinite(in_space).all():
        raise FlatError(NOWHERE)
    on_surface, total = areas(in_space, triangles).sum(), np.abs(signed_areas(plane[source], triangles)).sum()
    if not on_surface > 0.0:
        raise FlatError("all faces have area 0")
    if scale is None:
        scale = float(np.sqrt(on_surface / total))
    points = scale * plane[source]
    points -= points.min(axis=0)
    starts, ends = vertex[corners], vertex[next_corners(surface)[corners]]
    rims, inner = _rims_and_edges(starts, ends)
    return FlatLayout(
        points, starts, corners, np.flatnonzero(chosen), surface.face_size[chosen], _pieces(points, triangles, rims),
        inner, scale, left_out, _lengths(points, in_space, starts, ends),
    )  # fmt: skip


def _numbers(surface: Surface, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertex (C,) of the layout at each corner, or -1, and a corner (n,) at each of these vertices."""
    vertex, source, count = np.full(len(uv), -1), [], 0
    for island in uv_islands(surface, uv):
        vertex[island.corners] = island.corner_vertex + count
        source.append(island.some_corner())
        count += len(island.vertices)
    return vertex, np.concatenate(source)


def _with_area(surface: Surface, plane: np.ndarray) -> np.ndarray:
    """The faces (P,) with an area in the UVs."""
    each = np.abs(signed_areas(plane, surface.triangle_corners))
    return np.bincount(surface.triangle_face, each, minlength=len(surface.face_size)) > 0.0


def _lengths(points: np.ndarray, in_space: np.ndarray, starts: np.ndarray, ends: np.ndarray) -> tuple[float, float]:
    here, there = (np.linalg.norm(place[ends] - place[starts], axis=1) for place in (points, in_space))
    low, high = np.percentile(here[there > 0.0] / there[there > 0.0], PERCENTILES)
    return float(low), float(high)


def _rims_and_edges(starts: np.ndarray, ends: np.ndarray) -> tuple[list[np.ndarray], np.ndarray]:
    """The boundaries of the faces as loops of vertices, and the edges (e, 2) between two faces."""
    count = int(max(starts.max(), ends.max())) + 1
    lower, upper = np.minimum(starts, ends).astype(np.int64), np.maximum(starts, ends)
    _, first, inverse, uses = np.unique(lower * count + upper, return_index=True, return_inverse=True,
                                        return_counts=True)  # fmt: skip
    on_rim = uses[inverse.reshape(-1)] == 1
    inner = np.stack([lower, upper], axis=1)[first[uses > 1]]
    following: dict[int, list[int]] = {}
    for start, end in zip(starts[on_rim].tolist(), ends[on_rim].tolist()):
        following.setdefault(start, []).append(end)
    loops = []
    while following:
        at = begin = next(iter(following))
        loop = []
        while at in following:
            loop.append(at)
            targets = following[at]
            nearer = targets.pop()
            if not targets:
                del following[at]
            at = nearer
            if at == begin:
                break
        loops.append(np.array(loop))
    return loops, inner


def _pieces(points: np.ndarray, triangles: np.ndarray, rims: list[np.ndarray]) -> list[Piece]:
    """The pieces, each with its own boundaries. The boundary with the largest area is the outline."""
    root = connected_components(len(points), triangles[:, [0, 1]].ravel(), triangles[:, [1, 2]].ravel())
    of_piece: dict[int, list[np.ndarray]] = {}
    for rim in rims:
        of_piece.setdefault(int(root[rim[0]]), []).append(rim)
    pieces = []
    for _, own in sorted(of_piece.items()):
        own.sort(key=lambda rim: -abs(_enclosed(points[rim])))
        pieces.append(Piece(own[0], own[1:]))
    return pieces


def _enclosed(loop: np.ndarray) -> float:
    """Signed area that a closed loop (k, 2) encloses."""
    x, y = (loop - loop[0]).T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
