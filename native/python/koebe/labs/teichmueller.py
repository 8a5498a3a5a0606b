"""The extremal quasiconformal map of one domain to another, and the Teichmueller distance."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from .._arrays import as_circles, as_indices
from .._comparable import Result
from .._native import _koebe
from .._options import callback, token
from .._progress import Shown
from .._types import Floats, Ints
from .._watched import watched
from ..errors import InputError
from ..maps.carry import landmark_pairs
from ..maps.result import UniformizeResult
from ..maps.tiles import TileMap
from .shapes import mapped_surface
from .transfer import places


@dataclass(frozen=True, eq=False)
class TeichmuellerMap(Result):
    """The extremal map of a to b: of all one-to-one maps the one whose largest |mu| is least.

    K           its dilatation, at least 1. 1: a conformal map takes a to b. Without landmarks it depends on the two
                circle domains alone: the way from b to a has the same K
    distance    the Teichmueller distance, log(K) / 2
    lower       no map has a smaller largest dilatation, of maps that go round the holes as this one. Without landmarks
                it is the same both ways, too
    largest     largest dilatation of a face of this map, on a's mesh, or K if that is more
    mu          (F,) |mu| of each face of a, from a's circle domain. Nearly (K - 1) / (K + 1) everywhere; 1 for a face
                without area there
    uv          (V, 2) places of a's vertices in b's domain; None for tori and rings that are TileMaps
    match       (L,) b's loop for each of a's
    path        'straight', or 'bows' if holes had to go round each other
    flipped     faces that the map turns over: 0
    refused     with match='least': matches whose K may be less, but for which no one-to-one map was found
    """

    K: float
    distance: float
    lower: float
    largest: float
    mu: Floats
    uv: Floats | None
    match: Ints
    path: str
    flipped: int
    refused: int = 0

    def _drawing(self) -> dict[str, Any]:
        return {"values": self.mu} if self.uv is None else {"points": self.uv}

    def __repr__(self) -> str:
        return f"<koebe.TeichmuellerMap K {self.K:.5g}, distance {self.distance:.4g}, {self.flipped} flipped>"


@watched()
def teichmueller(
    a: Any,
    b: Any,
    *,
    match: Sequence[int] | Literal["least"] | None = None,
    landmarks: Sequence[tuple[Any, Any]] | None = None,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> TeichmuellerMap:
    """The extremal quasiconformal map of circle domain a to circle domain b, and the Teichmueller distance.

    Rims go to rims and slide along them. |mu| is constant for the exact map. Koebe minimizes rising powers of |mu| on
    a's mesh and tells K from a quadratic differential, by the inequalities of Reich and Strebel.
    a           a result of uniformize
    b           a result of uniformize with equally many loops, or an object with `centers` and `radii`
    match       b's loop for each of a's, 0 for 0, as everywhere. None: by match_loops or, with landmarks and up to five
                holes, the match that brings circles and landmarks nearest. 'least': the match with the least K
    landmarks   pairs (on a, on b) of points that must correspond, as for `transfer`: the extremal map of those that
                keep them. On a rim landmarks are vertices of both. Four on the rim of a surface without holes are the
                corners of a quadrilateral, and K is the ratio of the moduli of the two rectangles
    progress, cancel    as for `uniformize`
    Two results of torus_map without holes, or of ring_map without further holes, are compared by their moduli, exactly.
    With three holes or more there are many ways round the holes, and each has its own K. The circles take the way of
    fit_circles: straight if there is room. So K is an upper bound for the least K of all ways.
    match='least' computes the maps of all matches that may have the least K. A map of dilatation K changes no
    separation of two loops by more than the factor K (separations), and this leaves most matches out.
    Raises InputError for different numbers of loops, circles that are not the surface's own, landmarks that exclude
    each other, and more than 100 matches that may have the least K; SolverError if no one-to-one map was found, with
    a's loops or the landmarks as `elements`; Cancelled.

    >>> import koebe
    >>> face, other = (koebe.uniformize(f"blend_samples/{name}.obj") for name in ("face", "surprised"))
    >>> extremal = koebe.teichmueller(face, other)
    >>> print(f"{extremal.K:.2f} {extremal.distance:.2f}", extremal.flipped)
    1.16 0.07 0
    """
    pairs = landmark_pairs(landmarks)
    # Tori and rings are compared by their moduli.
    if isinstance(a, TileMap) or isinstance(b, TileMap):
        if pairs:
            raise InputError("landmarks are for results of uniformize")
        return _of_tiles(a, b)
    if not isinstance(a, UniformizeResult):
        raise TypeError(f"teichmueller takes a result of uniformize first, not {type(a).__name__}")
    centers, radii = as_circles(b)
    least = isinstance(match, str) and match == "least"
    if least and pairs:
        raise InputError("the search for the least match has no landmarks")
    partners = np.zeros(0, np.int32)
    if match is not None and not least:
        partners = as_indices(match, "match", len(radii), "loops")
        if not len(partners):
            raise InputError("the match must name each of b's loops once, the outer one first")
    run = callback(progress, "progress"), token(cancel, "cancel")
    held = _held_points(a, b, pairs)
    native = _koebe.teichmueller_map(mapped_surface(a), centers, radii, partners, *held, least, *run)
    return TeichmuellerMap(
        native.dilatation,
        native.distance,
        native.lower,
        native.largest,
        native.mu,
        native.uv,
        np.array(native.match, np.int32),
        "straight" if native.straight else "bows",
        native.flipped,
        native.refused,
    )


def _held_points(a: UniformizeResult, b: Any, pairs: list[Any]) -> tuple[list[Any], list[complex]]:
    """Landmarks on a, and their places in b's domain."""
    if not pairs:
        return [], []
    if not isinstance(b, UniformizeResult):
        raise TypeError(f"with landmarks teichmueller takes two results of uniformize, not {type(b).__name__}")
    on_a, on_b = (places(result, [pair[side] for pair in pairs]) for side, result in enumerate((a, b)))
    return on_a, [point.place(b.conformal.uv, b.surface[1]) for point in on_b]


def _of_tiles(a: Any, b: Any) -> TeichmuellerMap:
    """Flat tori and cylinders: affine maps are extremal."""
    for tile in (a, b):
        if not isinstance(tile, TileMap):
            raise TypeError(f"a torus or ring is compared with another one, not with {type(tile).__name__}")
        if tile.even:
            raise InputError("the maps are made more even: give conformal ones")
    rims = [0 if len(tile.periods) == 2 else 2 for tile in (a, b)]
    if rims[0] != rims[1]:
        raise InputError("a torus cannot be compared with a ring")
    if any(len(tile.loops) != count for tile, count in zip((a, b), rims, strict=True)):
        raise InputError("the tori or rings have further holes: give results of uniformize")
    if rims[0]:
        ratio = a.modulus.imag / b.modulus.imag
        dilatation = max(ratio, 1 / ratio)
    else:
        dilatation = _koebe.torus_dilatation(a.modulus, b.modulus)
    mu = np.full(len(a.uv), (dilatation - 1) / (dilatation + 1))
    loops = np.arange(rims[0], dtype=np.int32)
    return TeichmuellerMap(dilatation, math.log(dilatation) / 2, dilatation, dilatation, mu, None, loops, "straight", 0)
