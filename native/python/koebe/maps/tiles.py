"""Maps to a flat torus and to a cylinder: the UVs are one tile, whose copies continue them."""

from typing import Any

import numpy as np

from .._native import _koebe
from .._options import takes
from .._signatures import RingOptions, TorusOptions, Unpack
from .._types import Floats
from .domain_map import DomainMap, domain_map
from .figures import Seconds
from .source import Source


class TileMap(DomainMap):
    """A map to a flat torus or a cylinder, cut in its UVs only, and its report.

    uv               (F, 3, 2) float64 in [0, 1]^2, u and v of each triangle's corners; read-only; all 32-bit floats:
                     across the cut the two sides differ by whole multiples of the periods, to the last bit
    periods          (2, 2) float64, u and v of the torus's two periods; (1, 2) for a cylinder, along u
    modulus          complex: for a torus the ratio of the periods, |Re| <= 1/2 and at least 1 in size; for a ring i
                     times its height over its period, log(R / r) / 2 pi
    loops            list of Loop: vertices, rim (for a ring's two rims), off_circle; for a torus center and radius of
                     its circle in UVs (one of its copies), for a ring with holes='circles' in the unit disk, both
                     with roundness; for slits the two ends of the slit in UVs
    converged, sweeps, changes    of the circles in each sweep
    turned           faces turned to the orientation of the others
    cut_length       of the cut in the UVs, over the square root of the surface's area
    angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings, version    as in MapReport
    """

    periods: Floats
    modulus: complex
    cut_length: float
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        self._set(periods=np.array(report["periods"]))
        self._set(modulus=complex(*report["modulus"]))

    def _counts(self) -> list[str]:
        return [*super()._counts(), f"modulus {self.modulus:.4g}"]


@takes("torus", polygon=None, progress=None, cancel=None)
def torus_map(vertices: Any, triangles: Any = None, **given: "Unpack[TorusOptions]") -> TileMap:
    """Map a surface with one handle, and any number of holes, conformally to a flat torus, with round holes.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    {options}
    polygon      (F,) integers: triangles of one number are one polygon, and are not cut apart. None: the polygons of
                 the mesh, or with arrays each triangle by itself
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), TopologyError (genus: not one handle), SolverError, Cancelled, or
    MemoryError. A map that is not one to one has converged = False, and a warning tells why.

    >>> import koebe
    >>> result = koebe.torus_map("docs/link.obj")
    >>> print(len(result.periods), "periods, modulus", f"{result.modulus.imag:.2f} i")
    2 periods, modulus 2.03 i
    """
    return domain_map(TileMap, _koebe.torus_map, "torus", _koebe.TileOptions(), given, (vertices, triangles))


@takes("ring", polygon=None, progress=None, cancel=None)
def ring_map(vertices: Any, triangles: Any = None, **given: "Unpack[RingOptions]") -> TileMap:
    """Map a surface of genus 0 with at least two loops conformally to a cylinder and unroll it.

    Two loops become the rims, straight lines along u; v runs from the outer rim to the inner one. Copies of the map
    along u continue it.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    {options}
    polygon      as for `torus_map`
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), TopologyError, SolverError, Cancelled, or MemoryError. A map that is
    not one to one has converged = False, and a warning tells why.

    >>> import koebe
    >>> koebe.ring_map("blend_samples/face.obj", holes="radial")
    <koebe.TileMap 4379 faces, 4 loops, modulus 0+0.3031j, angle error 1.7 deg, 0 flipped>
    """
    return domain_map(TileMap, _koebe.ring_map, "ring", _koebe.TileOptions(), given, (vertices, triangles))
