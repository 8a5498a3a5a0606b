"""Joins islands of a UV layer along cuts."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from .._arrays import as_values
from .._comparable import TupleResult
from .._native import _koebe
from .._option_table import rows
from .._options import callback, number, token
from .._progress import Shown
from .._types import Floats, Ints, Whole
from .._watched import watched
from ..errors import InputError
from .input import polygons_of, surface_of
from .pack import corner_uv


class _Sewn(NamedTuple):
    uv: Floats
    island: Ints
    joined: int
    sewn: int


class SewnUV(TupleResult, _Sewn):
    """The result of `sew`.

    uv       (F, 3, 2) float64: triangles of other islands keep their UVs
    island   (F,) int32: the number of each triangle's new island; -1: its island stays
    joined   number of islands that are joined now
    sewn     number of edges that are no cuts any more
    """

    def _drawing(self) -> dict[str, Any]:
        return {"corners": self.uv}

    def __repr__(self) -> str:
        return f"<koebe.SewnUV {len(self.uv)} faces, {self.joined} islands joined, {self.sewn} edges sewn>"


@watched()
def sew(
    vertices: Any,
    triangles: Any = None,
    *,
    uv: Any,
    edges: Sequence[tuple[int, int]] | Whole,
    polygon: Any = None,
    even: float | None = None,
    mask: Any = None,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> SewnUV:
    """Join the two sides of cuts of UVs: two islands become one, or a cut inside one is closed.

    A joined island is mapped anew, one to one, and lies where its largest old island lay: at the same middle, size and
    turn, as well as a similarity can. It may lie over islands that stay: see `pack`.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    uv           (F, 3, 2) of the corners of the triangles, or (V, 2) of the vertices. Two corners of a vertex at an
                 edge are one point of the layer if they have the same UVs as 32-bit floats
    edges        (n, 2) pairs of vertices. Edges that are no cut stay as they are
    polygon      (F,) integers: triangles of one number are one polygon, and in one island
    even         E of the new islands, as for `parts`. None: as even as angles allow
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option); SolverError if a joined island cannot lie flat in one piece, as it
    would close or have a handle: its `elements` are the edges; Cancelled. Then nothing is joined.

    >>> import koebe
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> apart = [[[0, 0], [1, 0], [1, 1]], [[2, 2], [3, 3], [2, 3]]]
    >>> koebe.sew(*square, uv=apart, edges=[(0, 2)]).joined
    2
    """
    source = surface_of(vertices, triangles, degenerate=True, mask=mask)
    pairs = as_values(edges, "edges")
    if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
        raise InputError(f"edges must be (n, 2) numbers of vertices, not {pairs.shape} {pairs.dtype}")
    value = None if even is None else number(even, rows("parts")["even"])
    run = callback(progress, "progress"), token(cancel, "cancel")
    found = source.call(
        _koebe.sew, corner_uv(uv, source).reshape(-1, 2), pairs.tolist(), polygons_of(polygon, source), value, *run
    )
    return SewnUV(found[0].reshape(-1, 3, 2), *found[1:])
