# SPDX-License-Identifier: GPL-3.0-or-later
"""Opens, cuts and splits islands in the UVs until each piece can be mapped."""

import dataclasses
from types import ModuleType
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import MapError
from .surface import Island, Surface

if TYPE_CHECKING:
    import koebe


@dataclasses.dataclass(frozen=True)
class Opening:
    """The changes to an island, in the surface's numbers.

    cuts         kind, as in `koebe.SurfaceCut`, and vertices along each cut; for bow ties all such vertices
    handles      number of handles cut
    turned       faces (k,) that were turned to the direction of the others
    left_out     faces (k,) in no piece: degenerate, or duplicates of others
    copied       corners (m,) of such faces, and the corners (m,) whose places they take
    """

    cuts: list[tuple[str, np.ndarray]]
    handles: int
    turned: np.ndarray
    left_out: np.ndarray
    copied: tuple[np.ndarray, np.ndarray]


def open_island(
    koebe: ModuleType, surface: Surface, island: Island, cancel: Any
) -> tuple[Opening, list[Island]] | None:
    """The pieces of an island, with whole polygons, or None if nothing must be cut, turned or left out.

    Raises MapError if a cut would go through a polygon, and the errors of `koebe.open_surface`.
    """
    opened = koebe.open_surface(island.vertices, island.triangles, polygon=island.triangle_face, cancel=cancel)
    turned = [piece.source_face[piece.turned] for piece in opened.pieces]
    if len(opened.pieces) == 1 and not (opened.cuts or opened.left_out or len(turned[0])):
        return None
    corners = _triangle_corners(surface, island)
    vertex = np.full(len(surface.corner_vertex), -1, dtype=np.int32)  # in its piece, at each corner
    pieces = [_piece(island, corners, vertex, piece) for piece in opened.pieces]
    out = np.array([one.face for one in opened.left_out], dtype=np.int64)
    opening = Opening(
        cuts=[(cut.kind, island.source_vertex[cut.vertices]) for cut in opened.cuts],
        handles=opened.handles_cut,
        turned=np.unique(island.triangle_face[np.concatenate(turned)]),
        left_out=np.setdiff1d(island.triangle_face[out], np.concatenate([piece.faces for piece in pieces])),
        copied=_copied(island, corners, vertex, opened.left_out),
    )
    return opening, pieces


def _triangle_corners(surface: Surface, island: Island) -> np.ndarray:
    """Corners (t, 3) of the surface at the corners of the island's triangles."""
    inside = np.zeros(len(surface.face_size), dtype=bool)
    inside[island.faces] = True
    return surface.triangle_corners[inside[surface.triangle_face]]


def _piece(island: Island, corners: np.ndarray, vertex: np.ndarray, piece: "koebe.SurfacePiece") -> Island:
    """A piece as an island. Notes the vertex at each of its corners."""
    own = corners[piece.source_face]
    own[piece.turned] = own[piece.turned][:, [0, 2, 1]]
    shared = (vertex[own] >= 0).any()  # some corner is also in another piece
    vertex[own] = piece.triangles
    if shared or (vertex[own] != piece.triangles).any():
        raise MapError("it cannot be opened along edges: triangulate its faces")
    used, face = np.unique(own), island.triangle_face[piece.source_face]
    return Island(
        vertices=piece.vertices,
        triangles=piece.triangles,
        triangle_face=face,
        source_vertex=island.source_vertex[piece.source_vertex],
        corners=used.astype(np.int32),
        corner_vertex=vertex[used],
        faces=np.unique(face),
    )


def _copied(
    island: Island, corners: np.ndarray, vertex: np.ndarray, left_out: "list[koebe.LeftOutFace]"
) -> tuple[np.ndarray, np.ndarray]:
    """Corners in no piece, and the corners whose places they take."""
    places: dict[int, int] = {}
    for out in left_out:
        if out.like is None:
            continue
        like = {int(v): int(c) for v, c in zip(island.triangles[out.like], corners[out.like], strict=True)}
        same = [like.get(int(v)) for v in island.triangles[out.face]]
        some = next(corner for corner in same if corner is not None)
        for corner, place in zip(corners[out.face].tolist(), same, strict=True):
            if vertex[corner] < 0:
                places.setdefault(corner, some if out.degenerate or place is None else place)
    return np.array(list(places), dtype=np.int64), np.array(list(places.values()), dtype=np.int64)
