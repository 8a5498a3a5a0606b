"""Surfaces cut in their UVs into even disks and tubes."""

import copy
from collections.abc import Callable
from typing import Any

import numpy as np

from ._api import polygons_of, surface_of
from ._native import _koebe
from ._options import callback, flag, positive, share, token
from ._result import MapReport, Warning
from .errors import InputError


class PartsResult(MapReport):
    """What `parts` gives.

    uv               (F, 3, 2) float64 in [0, 1]^2: of each corner of each triangle, read-only
    part             (F,) int32: the part of each triangle; -1 for those in none, degenerate or the double of another
    parts            of each part a dict: kind ('disk' or 'tube'), faces, angle_error_deg (mean), loops (lists of
                     vertices), off_round (of each loop how far it is from the circle of a disk, or the end of a tube's
                     rectangle, at most: over the circle's radius, or the end's length over a turn)
    cut_length, slit_length    of all cuts, and of the slits of tubes among them, over the root of the area
    handles_cut      handles that were cut
    density_ratio_5_95    texel density (a length over a length) at 95 % of the area over that at 5 %
    even_area        share of the area whose texel density lies within the best factor 3
    seconds          of the whole
    maps             faces mapped, in faces of the mesh
    converged, angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, peak_memory_mb, warnings, version, vertices, faces    as in MapReport. Faces in no
                     part count in lost_area alone, and there only where they have no area at all
    """

    uv: np.ndarray
    part: np.ndarray
    parts: list[dict[str, Any]]
    cut_length: float
    slit_length: float
    handles_cut: int
    density_ratio_5_95: float
    even_area: float
    seconds: float
    maps: float

    def __init__(self, report: dict[str, Any], uv: np.ndarray, part: np.ndarray, flipped_faces: np.ndarray) -> None:
        self._report = report
        vars(self).update({name: value for name, value in report.items() if name != "input"})
        self.uv = uv.reshape(-1, 3, 2)
        self.uv.flags.writeable = False
        self.part = part
        self.flipped_faces = flipped_faces
        self.warnings = [Warning(warning) for warning in report["warnings"]]

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict."""
        return copy.deepcopy(self._report)

    def __repr__(self) -> str:
        return (
            f"<koebe.PartsResult {len(self.parts)} parts, cuts {self.cut_length:.3g}, "
            f"texel density within {self.density_ratio_5_95:.3g}, "
            f"angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )


def parts(
    vertices: Any,
    triangles: Any = None,
    *,
    price: float | None = None,
    cut: bool = True,
    polygon: Any = None,
    slits: Any = None,
    round_cuts: bool = False,
    most_lost: float = _koebe.most_lost_area,
    progress: Callable[[float, str], Any] | None = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> PartsResult:
    """Cut a surface in its UVs alone into disks and tubes of even texel density, packed into the unit square.

    vertices, triangles    as of `uniformize`, or a mesh of another package in place of both, whose polygons stay whole
    price     of a part, in area share times the log of the density outside a factor 3: a higher one makes fewer parts.
              None: 0.0037
    cut       True: any mesh; what is not manifold is split, handles are cut, what is closed is opened, each component
              is laid out by itself. False: only what `uniformize` takes
    polygon   (F,) integers: triangles of one number are one polygon and stay together. None: each by itself, or as the
              mesh has them
    slits     (E, 2) vertices of edges along which a tube is opened where they lead from one of its loops to the other.
              None: along a short, straight path
    round_cuts    True: loops at cuts lie on circles and on straight ends of tubes, as the own loops do. False:
              they follow the surface's edges, for less angle error
    most_lost    share of the surface's area that may have no area as stored: beyond it converged is False
    progress, cancel    as of `uniformize`
    Raises InputError (OptionError for an option), TopologyError with cut=False, SolverError, Cancelled, or MemoryError.
    """
    loss = share(most_lost, "most_lost")
    chosen = _koebe.default_price if price is None else positive(price, "price")
    whole, is_round = flag(cut, "cut"), flag(round_cuts, "round_cuts")
    progress, cancel = callback(progress, "progress"), token(cancel, "cancel")
    source = surface_of(vertices, triangles, degenerate=whole)
    numbers = polygons_of(polygon, source)
    edges = np.zeros((0, 2), np.int32) if slits is None else _edges(slits, len(source.vertices))
    native = _koebe.parts(
        source.vertices, source.triangles, chosen, whole, numbers, edges.tolist(), is_round, loss,
        progress, cancel
    )
    report = native.report()
    report["options"] = {"price": chosen, "cut": whole, "round_cuts": is_round, "most_lost": loss}
    return PartsResult(report, native.uv, native.part, np.array(native.flipped_faces, dtype=np.int32))


def _edges(slits: Any, count: int) -> np.ndarray:
    """Vertices of edges, in int32."""
    given = np.asarray(slits)
    if given.size == 0:
        return np.zeros((0, 2), np.int32)
    if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
        raise InputError(f"slits must be (E, 2) integers, not {given.shape} {given.dtype}")
    if given.min() < 0 or given.max() >= count:
        raise InputError(f"slits name a vertex that is not among the {count}")
    return given.astype(np.int32)
