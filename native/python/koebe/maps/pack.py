"""Packs the islands of any UV layer."""

from typing import Any

import numpy as np

from .._arrays import as_flags, as_values
from .._native import _koebe
from .._options import takes, token
from .._signatures import PackOptions, Unpack
from .._types import Floats, Ints
from ..errors import InputError
from .domain_map import DomainMap, prepared
from .input import polygons_of
from .source import Source


class PackResult(DomainMap):
    """The result of `pack`.

    uv               (F, 3, 2) float64 in [0, 1]^2, or on tiles: of each corner of each triangle, read-only
    island           (F,) int32: the island of each triangle
    islands          for each island a dict: faces, overlaps (it lies on itself, or its border touches itself),
                     locked (it kept its place)
    overlaps         number of such islands. They are moved as they are
    tiles            number of tiles with islands
    margin           least distance of two islands, in pixels, unless both kept their place: many islands get less than
                     the option says
    scale            of the islands that were moved, against their UVs as given: the root of the ratio of their areas
    coverage         area of the triangles over the area of the unit square, or of the tiles, as stored. Triangles that
                     lie on each other all count
    turned           triangles of islands that lie with their back to the front: no island is turned over
    converged        False: packing lost too much of the surface's area
    angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings, version    as in MapReport. flipped counts
                     triangles that are turned over within their island, or have no area, too
    """

    island: Ints
    islands: list[dict[str, Any]]
    overlaps: int
    tiles: int
    margin: float
    scale: float
    coverage: float

    _of_faces = ("island",)

    def _counts(self) -> list[str]:
        return [f"{len(self.islands)} islands", f"coverage {self.coverage:.3g}"]


@takes("pack", uv=None, polygon=None, locked=None, enough=None, progress=None, cancel=None)
def pack(vertices: Any, triangles: Any = None, **given: "Unpack[PackOptions]") -> PackResult:
    """Pack the islands of UVs into the unit square, or onto tiles, as large as they have room.

    Triangles that share a vertex with the same UVs are one island. Islands are moved, turned and scaled, all by one
    factor: none is cut, turned over or bent. Islands with much of their outline along the axes are turned by quarter
    turns only.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    uv           (F, 3, 2) of the corners of the triangles, or (V, 2) of the vertices: finite numbers, anywhere
    {options}
    polygon      (F,) integers: triangles of one number are one polygon, and in one island
    locked       (F,) bool: islands with such a triangle keep their place, anywhere in the plane. The others go into the
                 free space of the unit square, at the size that they have, or smaller where there is less room. With
                 average_scale they get at most the texel density of those islands. Not with several tiles
    enough       a CancelToken that ends the search, also before the `seconds` end: the best packing is taken
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), SolverError, Cancelled, or MemoryError.

    >>> import koebe
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [[0, 1, 2], [0, 2, 3]]
    >>> result = koebe.pack(*square, uv=[[4, 4], [5, 4], [5, 5], [4, 5]], margin=0)
    >>> len(result.islands), round(result.coverage, 2)
    (1, 1.0)
    """
    options, said, source, run = prepared("pack", _koebe.PackOptions(), given, (vertices, triangles), degenerate=True)
    options.polygon = polygons_of(given["polygon"], source)
    options.uv = corner_uv(given["uv"], source).reshape(-1, 2)
    options.locked = _locks(given["locked"], source)
    options.enough = token(given["enough"], "enough")
    native = source.call(_koebe.pack, options, *run)
    return PackResult({**native.report(), "options": said}, native, source)


def _locks(given: Any, source: Source) -> Floats:
    """(F,) 1 for triangles whose island keeps its place, or empty."""
    if given is None:
        return np.zeros(0)
    locked = as_values(given, "locked")
    if source.kept is not None and locked.ndim and len(locked) > source.kept[-1]:  # of all triangles
        locked = locked[source.kept]
    return as_flags(locked, "locked", len(source.triangles)).astype(np.float64)


def corner_uv(given: Any, source: Source) -> Floats:
    """(F, 3, 2) float64 of the source's triangles."""
    uv = as_values([] if given is None else given, "uv")
    if uv.dtype.kind in "fiu" and uv.shape == source.vertices.shape[:1] + (2,):
        uv = uv[source.triangles]
    elif source.kept is not None and uv.ndim and len(uv) > source.kept[-1]:  # of all triangles
        uv = uv[source.kept]
    if uv.shape != (len(source.triangles), 3, 2) or uv.dtype.kind not in "fiu":
        raise InputError(
            f"uv must be (F, 3, 2) real numbers, of the {len(source.triangles)} triangles' corners, or (V, 2), of the "
            f"{len(source.vertices)} vertices, not {uv.shape} {uv.dtype}"
        )
    return uv.astype(np.float64)
