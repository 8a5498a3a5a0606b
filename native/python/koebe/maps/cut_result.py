"""The result of uniformize(..., cut=True): pieces, each with a map, side by side in the unit square."""

import copy
from typing import Any

import numpy as np

from ..io.corner_mesh import mesh_with_corner_uv
from .result import MapReport, Seconds, Source, Warning, figures_of


class CutResult(MapReport):
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
    uv: np.ndarray
    piece: np.ndarray
    pieces: list[dict[str, Any]]
    cuts: list[dict[str, Any]]
    handles_cut: int
    left_out: list[dict[str, Any]]
    turned: list[int]
    method: str
    engine: str
    seconds: Seconds

    def __init__(self, report: dict[str, Any], uv: np.ndarray, flipped_faces: np.ndarray, source: Source) -> None:
        self._report = report = source.with_input_warnings(report)
        self._source = source
        vars(self).update(figures_of(report))
        self.uv = uv.reshape(-1, 3, 2)
        self.uv.flags.writeable = False
        self.piece = np.full(len(self.uv), -1, np.int32)
        for number, piece in enumerate(self.pieces):
            self.piece[piece["faces"]] = number
        self.flipped_faces = np.asarray(flipped_faces, dtype=np.int32)
        self.warnings = [Warning(warning) for warning in report["warnings"]]

    def _drawn(self) -> np.ndarray:
        return self.piece >= 0

    def _counts(self) -> list[str]:
        return [f"{len(self.pieces)} pieces", f"{len(self.cuts)} cuts"]

    def to_mesh(self) -> Any:
        """The mesh of the input, of the same kind, with the fields of UniformizeResult.to_mesh. The scale is UV length
        per surface length. The faces are the same, in their order. Vertices are doubled along the cuts: koebe_vertex is
        the number of each vertex in the input. A GiftiImage keeps its vertices: koebe_uv is NaN at a vertex with
        several UVs, and koebe_corner_uv has the six numbers of each face. Raises InputError if the input was arrays."""
        return mesh_with_corner_uv(self._source, self.uv, self._drawn())

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with input_sha256 and options."""
        return copy.deepcopy(self._report)

    def _arrays(self) -> dict[str, Any]:
        return {"uv": self.uv, "flipped_faces": self.flipped_faces}

    def __repr__(self) -> str:
        return (
            f"<koebe.CutResult {self.face_count} faces, {len(self.pieces)} pieces, {len(self.cuts)} cuts, "
            f"angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )
