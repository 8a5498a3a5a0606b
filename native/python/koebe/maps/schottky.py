"""Maps surfaces with handles to fundamental domains of Schottky groups, with round holes."""

from typing import Any

import numpy as np

from .._native import _koebe
from .._options import takes
from .._signatures import SchottkyOptions, Unpack
from .._types import Complex, Floats
from .domain_map import DomainMap, domain_map
from .figures import Seconds
from .source import Source


class SchottkyMap(DomainMap):
    """A map of a surface with handles into the unit disk, cut in its UVs only, and its report.

    Circles and generators are given in the plane of z = 2 (u + i v) - 1 - i.

    uv               (F, 3, 2) float64 in [0, 1]^2, u and v of each triangle's corners; read-only; all 32-bit floats
    generators       (G, 2, 2) complex128 of determinant 1, a, b; c, d of z -> (a z + b) / (c z + d), one for each
                     handle: across a cut the generator, or its inverse, continues the pattern of the UVs
    multipliers      (G,) complex128: a generator's factor in a coordinate that is 0 and infinity at its fixed points;
                     below 1 in size. Invariant under Moebius maps, as are the traces of products
    circles          (G, 2, 3) float64, x and y of the center and the radius of each pair: a generator takes the outside
                     of the first circle to the inside of the second. Both are equally large if such circles are apart,
                     otherwise not. For an `outer` handle, of a surface without holes, the first circle is round 0, and
                     its inside goes to the inside of the second
    by_circles       whether the UVs are cut along these circles, as closely as faces allow; else along the edges of
                     `cut`, as the circles meet each other or a hole
    handles          list of dicts, longer cuts first: generator, multiplier, circles, outer; cut, the vertices on the
                     loop of the cut, which may run through faces between them; misfit, by how much the two sides of the
                     cut missed a Moebius map before they were fitted, over their radius: an estimate of the error
    loops            list of Loop, of the holes, by falling length, the first on the unit circle (scaled if the UVs
                     would not fit in the square): vertices; center, radius of the circle in the UVs, or of one of its
                     copies if polygons tear it there; roundness, roundness_least_squares, before the projection onto
                     the circle; off_circle, the vertices off it
    converged, sweeps, changes    of the disks that fill the loops, in each sweep
    turned           faces turned to the orientation of the others
    angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings, version    as in MapReport
    """

    generators: Complex
    multipliers: Complex
    circles: Floats
    by_circles: bool
    handles: list[dict[str, Any]]
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        matrices = np.array([handle["generator"] for handle in self.handles], float)
        self._set(
            generators=matrices[..., 0] + 1j * matrices[..., 1],
            multipliers=np.array([complex(*handle["multiplier"]) for handle in self.handles]),
            circles=np.array(
                [[(*circle["center"], circle["radius"]) for circle in handle["circles"]] for handle in self.handles]
            ),
        )

    def _counts(self) -> list[str]:
        return [f"{len(self.handles)} handles", *super()._counts()]


@takes("schottky", polygon=None, progress=None, cancel=None)
def schottky_map(vertices: Any, triangles: Any = None, **given: "Unpack[SchottkyOptions]") -> SchottkyMap:
    """Map a surface with at least one handle, and any number of holes, conformally into the disk, with round holes.

    Each handle is cut along a short loop. A Moebius map takes one side of a cut to the other, so that copies of the UVs
    continue them across every cut: they are a fundamental domain of a Schottky group.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    {options}
    polygon      (F,) integers: triangles of one number are one polygon, and are not cut apart. None: the polygons of
                 the mesh, or with arrays each triangle by itself
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), TopologyError (genus: no handle, or cuts that touch each other),
    SolverError, Cancelled, or MemoryError. A map that is not one to one has converged = False, and a warning tells why.

    >>> import koebe
    >>> result = koebe.schottky_map("docs/link.obj")
    >>> print(len(result.handles), result.flipped, bool(abs(result.multipliers[0]) < 1))
    1 0 True
    """
    options = _koebe.SchottkyOptions()
    return domain_map(SchottkyMap, _koebe.schottky_map, "schottky", options, given, (vertices, triangles))
