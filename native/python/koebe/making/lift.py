"""Brings flat patterns onto surfaces."""

import copy
import os
from typing import Any

import numpy as np

from .._comparable import Result
from .._native import _koebe
from .._options import takes, vertex_weights
from .._report_entries import Warning
from .._signatures import LiftOptions, Unpack
from .._types import Bools, Floats, Ints
from ..io.picture import outline_svg
from ..maps.domain_map import prepared


class LiftResult(Result):
    """A surface with a pattern on it, and its report.

    vertices     (V, 3) float64; of a perforated sheet the surface's own come first, in their order
    triangles    (F, 3) int32
    uv           (F, 3, 2) float64 of corners in [0, 1]^2, the map's; walls have no area in it; of a solid (0, 3, 2)
    original     (V,) int32: the vertex of the surface that lies there, to the last bit; -1: there is none
    patch        (F,) int32: of a sheet 0, and 1 raised, 2 walls; of a solid 0 outside, 1 inside, 2 walls
    face         (F,) int32: the surface's triangle below each; of a wall one at its foot; of a bent mesh (0,)
    weights      (F, 3, 3) float64: where the corners lie in that triangle, in barycentric coordinates; before they are
                 raised or made thick
    shape, pattern, size, bridge    as asked for or chosen; lengths in the unit of the vertices
    bend         above 1: a lattice is stretched by this much, so that it fits a torus
    outlines     on the surface
    crossings    pairs of faces that meet though they are no neighbours, of a relief, a solid or a mesh
    thin_bridges       pairs of openings with less material between than `bridge` asked for; 0 if it was not asked for
    thinnest_bridge    the least width of these, or None
    islands      holes in outlines that are cut out: what was inside has fallen out too
    left_out     dict of counts, why outlines were left out: at_border, too_fine, crossing, open
    loops, euler    dicts before and after: boundary loops and Euler characteristic of the sheet
    closed       whether it is a solid
    converged    of the map
    warnings     list of Warning: of the map, left_out with the faces where such outlines begin, and thin_bridges
                 with the faces where they are
    """

    pattern: str
    outlines: int
    crossings: int
    thin_bridges: int
    thinnest_bridge: float | None
    islands: int
    left_out: dict[str, int]
    loops: dict[str, int]
    euler: dict[str, int]
    closed: bool
    converged: bool

    _report: dict[str, Any]
    vertices: Floats
    triangles: Ints
    uv: Floats
    original: Ints
    patch: Ints
    face: Ints
    weights: Floats
    warnings: list[Warning]

    def __init__(self, report: dict[str, Any], native: Any) -> None:
        hidden = ("input", "vertices", "faces")
        self._set(_report=report, **{name: value for name, value in report.items() if name not in hidden})
        self._set(**{name: getattr(native, name) for name in ("vertices", "triangles", "original", "patch", "face")})
        self._set(uv=native.uv.reshape(-1, 3, 2), weights=native.weights.reshape(-1, 3, 3))
        self._set(warnings=[Warning(warning) for warning in report["warnings"]])

    @property
    def corner_uv(self) -> Floats:
        """(F, 3, 2): `uv`, under the name that it has in all results."""
        return self.uv

    def _drawn(self) -> Bools:
        return np.ones(len(self.triangles), bool)

    def _layout(self) -> tuple[Floats, float]:
        return (self.uv if len(self.uv) else np.zeros((len(self.triangles), 3, 2))), 1.0

    def _picture(self) -> str:
        return outline_svg(self.triangles, *self._layout(), self._drawn()) if len(self.uv) else ""

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with options."""
        return copy.deepcopy(self._report)

    def __repr__(self) -> str:
        kind = "closed" if self.closed else f"{self.loops['after']} loops"
        return f"<koebe.LiftResult {self.outlines} {self.pattern}, {len(self.triangles)} faces, {kind}>"


@takes("lift", progress=None, cancel=None)
def lift(
    vertices: Any,
    triangles: Any = None,
    pattern: "str | os.PathLike[str]" = "circles",
    **given: "Unpack[LiftOptions]",
) -> LiftResult:
    """Bring a flat pattern onto a surface, through a map of the surface: as holes, as a relief, as a closed solid.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    pattern      circles or voronoi, which are even on the surface; hexagons, triangles, diamonds or stripes, whose
                 lattices are even in the domain; or the name of an SVG file, whose closed paths are the outlines,
                 or of a PNG file: a relief with `height` where it is white; or of an OBJ file: a mesh whose x and y are
                 flat and whose z is height, bent over the surface as it is
    {options}
    mask, progress, cancel    as for `uniformize`
    Raises InputError (OptionError for an option), FileError for a file that cannot be read, TopologyError, SolverError,
    Cancelled, or MemoryError. Where it returns, each outline that is not left out has become one hole or one hill, no
    face is flipped, and a solid is closed.

    >>> import koebe
    >>> sheet = koebe.lift("blend_samples/face.obj", pattern="circles", perforate=True)
    >>> sheet.loops["after"] == sheet.loops["before"] + sheet.outlines
    True
    """
    options, said, source, run = prepared("lift", _koebe.LiftOptions(), given, (vertices, triangles))
    options.graded = vertex_weights("graded", given["graded"], len(source.vertices))
    if not isinstance(pattern, str | os.PathLike):
        raise TypeError(f"pattern must be a name or a file's path, not {pattern!r}")
    native = source.call(_koebe.lift, os.fspath(pattern), options, *run)
    return LiftResult({**source.with_input_warnings(native.report()), "options": said}, native)
