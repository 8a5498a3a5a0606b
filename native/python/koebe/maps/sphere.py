"""Maps surfaces without handles to the sphere, with round caps as holes."""

from typing import Any

import numpy as np

from .._native import _koebe
from .._options import takes
from .._signatures import SphereOptions, Unpack
from .._types import Bools, Floats
from ..io.mesh_copies import SPHERE
from .domain_map import DomainMap, domain_map
from .figures import Seconds
from .source import Source


class SphereMap(DomainMap):
    """A map to the unit sphere, its UVs, and its report.

    points           (V, 3) float64, unit vectors in the order of the vertices; read-only; seen from outside the faces
                     are counter-clockwise as on the surface; unused vertices are at (0, 0, 1)
    caps             (L, 4) float64 of the holes: a unit vector to the middle, and the radius as an angle in radians
    uv               (F, 3, 2) float64, u and v of each triangle's corners; read-only; all 32-bit floats, cut in the UVs
                     only. Across the cut the pattern continues: equirectangular with the period 1 along u, u in
                     [0, 2); octahedral with half turns round the middles of the square's sides, u and v in [-1, 2].
                     Triangles of a polygon lie side by side, if necessary farther out, up to 2 from 0
    layout           dict: kind; crossing, the faces that go beyond the layout's edge; moved, the faces whose corners
                     were moved in the UVs so that no face is flipped, most of them at a pole or at the middle of a side
                     of the square; torn, the faces whose UVs do not fit all neighbours; flipped, the faces without a
                     positive area in 32-bit UVs; below_resolution, the flipped faces that are too small for 32-bit UVs
    loops            list of Loop, by falling length: vertices, center, radius (of the cap), roundness,
                     roundness_least_squares, off_circle
    mean_point       length of the mean of the surface's points by area, 0 if the map is balanced and conformal
    converged, sweeps, changes    of the circles, or of the points of a closed surface, in each sweep
    turned           faces turned to the orientation of the others
    angle_error_deg, beltrami, area_distortion, conformal_energy    as in MapReport, of the flat faces between the
                     points
    angle_error_stored_deg, lost_area, flipped, below_resolution, flipped_faces    as in MapReport, of the UVs; a torn
                     face counts as it lies
    on_sphere        dict of counts: flipped, faces that are not upright on the sphere in exact arithmetic;
                     below_resolution, those that are smaller than the resolution of 64-bit coordinates there
    seconds, peak_memory_mb, warnings, version    as in MapReport
    """

    points: Floats
    caps: Floats
    layout: dict[str, Any]
    on_sphere: dict[str, int]
    mean_point: float
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        caps = np.array([[*loop["center"], loop["radius"]] for loop in self.loops], float).reshape(-1, 4)
        self._set(points=source.outside_nan(native.points), caps=caps)

    def _point_fields(self) -> dict[str, Floats]:
        return {SPHERE: self.points}

    def _arrays(self) -> dict[str, Any]:
        return {**super()._arrays(), "points": self.points}

    def _drawn(self) -> Bools:
        drawn = super()._drawn()
        drawn[self.layout["torn"]] = False
        return drawn


@takes("sphere", polygon=None, progress=None, cancel=None)
def sphere_map(vertices: Any, triangles: Any = None, **given: "Unpack[SphereOptions]") -> SphereMap:
    """Map a surface of genus 0, closed or with any number of holes, conformally to the sphere, with round holes.

    Of all conformal maps this one has the least area distortion: the mean over the surface of the log of area on the
    surface over area on the sphere. It is rotated like the surface. even above 0 then trades angles for areas.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    {options}
    polygon      (F,) integers: triangles of one number are one polygon, whose corners have one UV each. None: each by
                 itself, or as in the mesh
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), TopologyError (genus: handles), SolverError, Cancelled, or
    MemoryError. A map that is not one to one has converged = False, and a warning tells why.

    >>> import koebe, numpy as np
    >>> result = koebe.sphere_map("blend_samples/face.obj")
    >>> result
    <koebe.SphereMap 4379 faces, 4 loops, angle error 1.15 deg, 0 flipped>
    >>> bool(np.allclose(np.linalg.norm(result.points, axis=1), 1.0))
    True
    """
    return domain_map(SphereMap, _koebe.sphere_map, "sphere", _koebe.SphereOptions(), given, (vertices, triangles))
