"""Cuts any mesh, in its connectivity only, into surfaces that can be mapped."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from .._comparable import Result
from .._native import _koebe
from .._options import callback, token
from .._progress import Shown
from .._types import Bools, Floats, Ints
from .._watched import watched
from .input import polygons_of, surface_of
from .source import Source


@dataclass(frozen=True, eq=False, repr=False)
class SurfacePiece(Result):
    """A connected, oriented, manifold surface of genus 0 with at least one boundary loop, as `uniformize` needs it.

    vertices        (V', 3) float64, the input's positions
    triangles       (F', 3) int32 into them; a face's corners are in the input's order, except in turned faces
    source_vertex   (V',) int32, of the input
    source_face     (F',) int32, of the input, ascending
    turned          (F',) bool, where the second and third corner are exchanged
    """

    vertices: Floats
    triangles: Ints
    source_vertex: Ints
    source_face: Ints
    turned: Bools

    def _drawing(self) -> dict[str, Any]:
        return {"corners": self.vertices[self.triangles]}

    def __repr__(self) -> str:
        return f"<koebe.SurfacePiece {len(self.vertices)} vertices, {len(self.triangles)} faces>"


@dataclass(frozen=True, eq=False)
class SurfaceCut(Result):
    """A cut.

    kind       'crowded_edge', 'orientation', 'bow_tie', 'handle' or 'opening', as in CutResult
    vertices   int32, of the input: a path along edges, a closed one ends with its first vertex; for bow ties all such
               vertices instead
    text       a sentence for people
    """

    kind: str
    vertices: Ints
    text: str


@dataclass(frozen=True, eq=False)
class LeftOutFace(Result):
    """A face in no piece: `degenerate`, it names a vertex twice, or else it duplicates another face. `like` is the face
    that it can be drawn like, or None."""

    face: int
    like: int | None
    degenerate: bool


@dataclass(frozen=True, eq=False, repr=False)
class OpenedSurface(Result):
    """The result of `open_surface`: pieces by lowest face, cuts, faces left out (ascending), the number of handles."""

    pieces: list[SurfacePiece]
    cuts: list[SurfaceCut]
    left_out: list[LeftOutFace]
    handles_cut: int

    def _drawing(self) -> dict[str, Any]:
        return {"corners": np.concatenate([piece.vertices[piece.triangles] for piece in self.pieces])}

    def __repr__(self) -> str:
        return f"<koebe.OpenedSurface {len(self.pieces)} pieces, {len(self.cuts)} cuts, {self.handles_cut} handles cut>"


@watched()
def open_surface(
    vertices: Any,
    triangles: Any = None,
    *,
    polygon: Any = None,
    mask: Any = None,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> OpenedSurface:
    """Open, cut and split any mesh until each piece can be mapped, as `uniformize(..., cut=True)` does first.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both; its polygons stay whole;
                           triangles may name a vertex twice
    polygon   (F,) integers: triangles of one number are one polygon and are not cut apart. None: each triangle by
              itself
    mask, progress, cancel    as for `uniformize`
    Handles are cut along short loops of a greedy homology basis [Erickson and Whittlesey 2005], a closed surface is
    opened along a shortest path between vertices far apart. Raises InputError, Cancelled, or MemoryError.

    >>> import koebe
    >>> opened = koebe.open_surface("docs/link.obj")  # a closed surface with a handle
    >>> [cut.kind for cut in opened.cuts], [len(piece.triangles) for piece in opened.pieces]
    (['handle', 'opening'], [1024])
    """
    progress, cancel = callback(progress, "progress"), token(cancel, "cancel")
    source = surface_of(vertices, triangles, degenerate=True, mask=mask)
    numbers = polygons_of(polygon, source)
    pieces, cuts, left_out, handles = source.call(_koebe.open_surface, numbers, progress, cancel)
    return OpenedSurface(
        [
            SurfacePiece(points, faces, vertex, source.source_face[face], turned.astype(bool))
            for points, faces, vertex, face, turned in pieces
        ],
        [SurfaceCut(*cut) for cut in cuts],
        [_left_out(source, face, like, degenerate) for face, like, degenerate in left_out],
        handles,
    )


def _left_out(source: Source, face: int, like: int, degenerate: bool) -> LeftOutFace:
    number = source.source_face
    return LeftOutFace(int(number[face]), int(number[like]) if like >= 0 else None, degenerate)
