"""The result of uniformize(..., cut=True): pieces, each with a map, side by side in the unit square."""

from typing import Any

import numpy as np

from .._types import Bools, Ints
from .domain_map import DomainMap
from .figures import Seconds
from .source import Source


class CutResult(DomainMap):
    """The maps of the pieces of any mesh, and their report.

    uv               (F, 3, 2) float64, u and v of each triangle's corners in [0, 1]^2; read-only. The two sides
                     of a cut have different UVs
    piece            (F,) int32, the place of each triangle's piece in `pieces`; -1 for faces that are left out
    pieces           list of dicts: faces, mapped, place (center and radius of its disk in the square), loops with
                     circles in the coordinates of its own unit disk, and its figures. Numbers are the input's
    cuts             list of dicts: kind ('crowded_edge', 'orientation', 'bow_tie', 'handle', 'opening'), elements (the
                     vertices along the cut; a closed one ends with its first), text
    handles_cut      number of handles cut
    left_out         list of dicts: face, and the face that it is drawn like, or None. These faces count in lost_area
                     only, and only if they have no area at all
    turned           faces turned to the orientation of their piece
    converged        whether all pieces converged
    angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces    over all pieces, as they lie in the square, as in MapReport
    version, input_sha256, options, vertices, triangles, method, engine, seconds, peak_memory_mb, warnings
                     as in UniformizeResult
    """

    input_sha256: str
    piece: Ints
    pieces: list[dict[str, Any]]
    cuts: list[dict[str, Any]]
    handles_cut: int
    left_out: list[dict[str, Any]]
    method: str
    engine: str
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        place = np.full(len(self.uv), -1, np.int32)
        for number, piece in enumerate(self.pieces):
            place[piece["faces"]] = number
        self._set(piece=place)

    def _drawn(self) -> Bools:
        return self.piece >= 0

    def _counts(self) -> list[str]:
        return [f"{len(self.pieces)} pieces", f"{len(self.cuts)} cuts"]
