"""Cuts surfaces in their UVs into even disks and tubes."""

from typing import Any

import numpy as np

from .._arrays import as_values
from .._native import _koebe
from .._options import flag, takes, vertex_weights
from .._signatures import PartsOptions, Unpack
from .._types import Bools, Ints
from ..errors import InputError
from .domain_map import DomainMap, prepared
from .figures import Seconds
from .input import polygons_of


class PartsResult(DomainMap):
    """The result of `parts`.

    uv               (F, 3, 2) float64 in [0, 1]^2, or on tiles: of each corner of each triangle, read-only
    part             (F,) int32: the part of each triangle; -1 for triangles in no part, degenerate or duplicates
    parts            for each part a dict: kind ('disk' or 'tube'), faces, angle_error_deg (mean), loops (lists of
                     vertices), off_round (for each loop its largest distance from the disk's circle, or from the end
                     of a tube's rectangle, over the circle's radius, or over the length of a turn)
    stacked          for each part that lies on another part a dict: part, onto (their numbers), mirrored (it lies
                     there with its back to the front: its triangles are turned over in the UVs, as intended)
    tiles            number of tiles with parts
    cut_length, slit_length    of all cuts, and of the tubes' slits among them, over the square root of the area
    handles_cut      number of handles cut
    density_ratio_5_95    texel density (a length over a length) at 95 % of the area over the density at 5 %
    density          texel density: pixels per unit of the mesh (median over the area) on a texture of `pixels`
    even_area        share of the area whose texel density lies within the best factor 3
    margin           least distance of two parts, in pixels: many parts get less than the option says
    coverage         share of the unit square, or of the tiles, that the faces cover, as stored
    regions          number of planar regions of the surface with more than 1 % of the area
    whole            share of the area of these regions that lie in one part, similar to the region; 1 without any
    aligned          share of the length of straight outer edges that lie within 0.1 degrees of an axis in the UVs
    maps             faces mapped in all maps, in faces of the mesh
    converged, angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings, version    as in MapReport. Faces in no
                     part count in lost_area only, and only if they have no area at all
    """

    part: Ints
    parts: list[dict[str, Any]]
    stacked: list[dict[str, Any]]
    tiles: int
    cut_length: float
    slit_length: float
    handles_cut: int
    density_ratio_5_95: float
    density: float
    even_area: float
    margin: float
    coverage: float
    regions: int
    whole: float
    aligned: float
    seconds: Seconds
    maps: float

    _of_faces = ("part",)

    def _drawn(self) -> Bools:
        return self.part >= 0

    def _counts(self) -> list[str]:
        return [f"{len(self.parts)} parts", f"texel density within {self.density_ratio_5_95:.3g}"]

    def __repr__(self) -> str:
        return (
            f"<koebe.PartsResult {len(self.parts)} parts, cuts {self.cut_length:.3g}, "
            f"texel density within {self.density_ratio_5_95:.3g}, "
            f"angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )


@takes("parts", polygon=None, slits=None, cuts=None, sketch=None, progress=None, cancel=None)
def parts(vertices: Any, triangles: Any = None, **given: "Unpack[PartsOptions]") -> PartsResult:
    """Cut a surface in its UVs only into disks and tubes of even texel density, packed into a square or onto tiles.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both, whose polygons stay whole
    {options}
    polygon      (F,) integers: triangles of one number are one polygon and stay together. None: the polygons of the
                 mesh, or with arrays each triangle by itself
    slits        (E, 2) vertices of edges along which a tube is opened if they lead from one of its loops to the other.
                 None: along a short, straight path
    cuts         (E, 2) vertices of edges that no part goes over, beside all other cuts: borders of materials
    sketch       a CutSketch that gets the cuts as soon as they are decided
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), TopologyError with cut=False, SolverError, Cancelled, or MemoryError.

    >>> import koebe
    >>> result = koebe.parts("docs/link.obj", darts=0)
    >>> [part["kind"] for part in result.parts]
    ['tube']
    >>> print(result.uv.shape, result.flipped)
    (1024, 3, 2) 0
    """
    options = _koebe.PartsOptions()
    degenerate = flag(given["cut"], "cut")
    options, said, source, run = prepared("parts", options, given, (vertices, triangles), degenerate)
    options.polygon = polygons_of(given["polygon"], source)
    options.importance = vertex_weights("importance", given["importance"], len(source.vertices))
    options.show = vertex_weights("show", given["show"], len(source.vertices))
    for name in ("slits", "cuts"):
        if given[name] is not None:
            edges = _edges(name, given[name], len(source.vertices))
            setattr(options, name, (edges if source.first is None else source.first[edges]).tolist())
    if given["sketch"] is not None:
        if not isinstance(given["sketch"], _koebe.CutSketch):
            raise TypeError(f"sketch must be a CutSketch, not {given['sketch']!r}")
        options.draw_on(given["sketch"])
    native = source.call(_koebe.parts, options, *run)
    return PartsResult({**native.report(), "options": said}, native, source)


def _edges(name: str, edges: Any, count: int) -> Ints:
    """Vertices of edges as int32."""
    given = as_values(edges, name)
    if given.size == 0:
        return np.zeros((0, 2), np.int32)
    if given.ndim != 2 or given.shape[1] != 2 or given.dtype.kind not in "iu":
        raise InputError(f"{name} must be (E, 2) integers, not {given.shape} {given.dtype}")
    if given.min() < 0 or given.max() >= count:
        raise InputError(f"{name} name a vertex that is not among the {count}")
    return given.astype(np.int32)
