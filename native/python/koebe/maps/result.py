"""The result of a uniformization."""

import copy
import json
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib import import_module
from typing import Any

import numpy as np

from .._arrays import as_loops
from .._comparable import Result, fixed
from .._fields import face_angle_error_deg, log_scale
from .._native import _koebe
from .._report_entries import Loop, Warning
from .._types import Bools, Complex, Floats, Ints
from ..errors import InputError
from ..io.mesh_copies import ANGLE_ERROR, LOG_SCALE, Fields, mesh_with_fields
from ..io.picture import drawing_svg, outline_svg
from .figures import AngleError, AreaDistortion, Beltrami, MeanRoundness, Seconds, Step
from .source import Source

# UV units: a face whose longest edge is shorter is below the resolution of 32-bit UVs.
UV_RESOLUTION: float = _koebe.uv_resolution
# Disk units: how far from its circle a loop vertex may lie to count as on it.
CIRCLE_TOLERANCE: float = _koebe.circle_tolerance


def figures_of(report: Mapping[str, Any]) -> dict[str, Any]:
    """The entries of a report that are attributes of its result."""
    return {name: value for name, value in report.items() if name not in ("input", "vertices", "faces", "cut")}


class MapReport(Result):
    """The report of every map, for any domain. It does not change, and is equal to another one of the same surface, map
    and report; times and memory do not count.

    converged        False: the map is not finished, and a warning tells why
    angle_error_deg, beltrami, area_distortion, conformal_energy    as the types of figures.py say, in 64 bits
    angle_error_stored_deg    the angle error of the UVs as stored, in 32-bit floats. Faces without area count too: a
                     corner at a side without length counts as a right angle
    lost_area        share of the surface's area in faces without a positive area as stored
    flipped, below_resolution    counts of faces, as in the command's JSON
    concave_polygons    count of polygons that are convex on the surface, but not in the UVs
    flipped_faces    int32 array of the faces that `flipped` counts, ascending
    even, overlaps   for maps with the option `even`: the E that was reached, and how often loops cross
    loops            list of Loop: of the whole surface. Empty where parts or pieces have loops of their own
    seconds          of each stage
    peak_memory_mb   of the process
    warnings         list of Warning: kind, elements, text. A warning of too much lost area comes first
    uv               as each result says. corner_uv is the same thing of all results
    """

    _report: dict[str, Any]
    _source: Source
    version: str
    options: dict[str, Any]
    uv: Floats
    converged: bool
    angle_error_deg: AngleError
    angle_error_stored_deg: AngleError
    lost_area: float
    beltrami: Beltrami
    area_distortion: AreaDistortion
    conformal_energy: float
    flipped: int
    below_resolution: int
    flipped_faces: Ints
    even: float = 0.0
    overlaps: int = 0
    concave_polygons: int = 0
    loops: list[Loop]
    seconds: Any
    peak_memory_mb: float
    warnings: list[Warning]

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        """@param native has the arrays: the library's result, or the content of a file"""
        report = source.with_input_warnings(report)
        self._set(_report=report, _source=source, **figures_of(report))
        self._set(
            loops=[Loop(loop) for loop in report.get("loops", ())],
            warnings=[Warning(warning) for warning in report["warnings"]],
            flipped_faces=np.array(native.flipped_faces, dtype=np.int32),
        )

    def __hash__(self) -> int:
        return hash((type(self), self._report.get("input_sha256")))

    def _compared(self) -> dict[str, Any]:
        return {**self._report, **self._arrays(), "of_vertices": self.vertices, "of_triangles": self.triangles}

    def _arrays(self) -> dict[str, Any]:
        """Its arrays in a file, under the library's names."""
        return {"uv": self.uv, "flipped_faces": self.flipped_faces}

    def _entries(self) -> dict[str, Any]:
        """All of its file."""
        source = {name: getattr(self._source, name) for name in ("vertices", "triangles", "kept", "first", "filed")}
        known = {name: array for name, array in source.items() if array is not None}
        report = np.array(json.dumps(self._report))
        return {"kind": np.array(type(self).__name__), "report": report, **known, **self._arrays()}

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with options."""
        return copy.deepcopy(self._report)

    @property
    def vertices(self) -> Floats:
        """(V, 3) float64: the positions of the surface's vertices."""
        return self._source.vertices

    @property
    def triangles(self) -> Ints:
        """(F, 3) int32: the mapped triangles, without those that a mask left out."""
        return self._source.triangles

    @property
    def vertex_count(self) -> int:
        """V, the number of vertices."""
        return len(self._source.vertices)

    @property
    def face_count(self) -> int:
        """F, the number of mapped triangles."""
        return len(self._source.triangles)

    @property
    def corner_uv(self) -> Floats:
        """(F, 3, 2) float64, texture coordinates of each triangle's corners: of every kind of result, as its files have
        them. For UniformizeResult and FitResult they lie in [0, 1]^2 and are (1 + uv) / 2, for others they are `uv`."""
        return self.uv if self.uv.ndim == 3 else 0.5 * (1.0 + self.uv[self._source.triangles])

    @property
    def surface(self) -> tuple[Floats, Ints]:
        """Vertices (V, 3) float64 and triangles (F, 3) int32 of the mapped surface, without what a mask left out."""
        return self._source.vertices, self._source.triangles

    @property
    def source_face(self) -> Ints:
        """(F,) int32: the number in the input of each mapped triangle; 0, 1, 2, ... without a mask."""
        return self._source.source_face

    def _drawn(self) -> Bools:
        """(F,) triangles that have a place of their own in the map."""
        return np.ones(self.face_count, bool)

    def _layout(self) -> tuple[Floats, float]:
        """(F, 3, 2) places of the corners in a picture of the map, and the length of a side of its square."""
        return self.corner_uv, 1.0

    def _counts(self) -> list[str]:
        """The parts of the result, in words."""
        return []

    def _picture(self) -> str:
        """The map as SVG."""
        return outline_svg(self.triangles, *self._layout(), self._drawn())

    def _lines(self) -> list[str]:
        sweeps = getattr(self, "sweeps", None)
        return [
            ", ".join([f"{self.vertex_count:,} vertices", f"{self.face_count:,} faces", *self._counts()]),
            ("converged" if self.converged else "not converged") + (f" in {sweeps} sweeps" if sweeps else ""),
            f"angle error {self.angle_error_deg['mean']:.3g}°, {self.flipped} flipped",
        ]

    def export(self, path: str | os.PathLike[str]) -> None:
        """Write the map in the format that the file's name says. The file is complete or absent.

        .surf.gii, lh.NAME, rh.NAME    the map itself as a surface with the same vertices, as Workbench and FreeSurfer
                          read it: flat, of the surface's area, or the sphere of radius 100 (not for maps with cuts)
        lh.NAME.patch.flat, .flat      the flat map as FreeSurfer's patch
        .shape.gii, .func.gii          koebe_log_scale, koebe_u and koebe_v at the vertices
        .gii, .vtk, .vtu, .vtp, .msh   the surface with the fields of to_mesh()
        .obj              the surface with UVs
        Needs nibabel, meshio, or PyVista for .vtp. Raises InputError for another name, OSError.
        """
        import_module("..io.export", __package__).export(self, path)


@dataclass(frozen=True, eq=False, repr=False)
class ConformalDomain(Result):
    """The circle domain of the surface itself. Shapes are compared by it, whatever map the result shows.

    centers, radii   (L, 2) and (L,) circles in the unit disk, in the order of the result's loops
    own              (L,) whether each circle is the iteration's, and not lost in rounding. Others are not compared
    converged        whether the iteration has converged. Otherwise nothing is compared
    uv               (V, 2) the conformal map; read-only
    off_circle       int32 arrays: vertices of each loop that are not on its circle
    """

    centers: Floats
    radii: Floats
    own: Bools
    converged: bool
    uv: Floats
    off_circle: list[Ints]

    def _drawing(self) -> dict[str, Any]:
        return {"circles": (self.centers, self.radii)}

    def __repr__(self) -> str:
        return f"<koebe.ConformalDomain {len(self.radii)} loops, {len(self.uv)} vertices>"


class UniformizeResult(MapReport):
    """A circle domain and its report.

    version          of the koebe that made it
    input_sha256     of the vertices' bytes as float64 and the triangles' as int32, little-endian, row after row
    options          of the call: method, engine, outer, tolerance, ...
    uv               (V, 2) float64, points of the closed unit disk in the input's vertex order; read-only
    loops            list of Loop: int32 arrays of vertices, the surface on the left, the outer loop first
    centers, radii   (L, 2) and (L,) circles in the unit disk
    roundness        (L,) the paper's e(gamma_k) before the final projection (section 5)
    roundness_least_squares     (L,) deviation from the circle of least squares, in radii, before the final projection
    mean_roundness   their means
    off_circle       int32 arrays: vertices of each loop that are not on its circle
    rims             'smooth': the circles are those of loops that are samples of smooth curves (conformal_module)
    own_circle       (L,) whether each circle is the surface's own: the iteration's, not lost in rounding, and not moved
                     by `even` or to a template
    conformal        the ConformalDomain, by which shapes are compared: that of the same call without `even`
    vertices, triangles, vertex_count, face_count    as in MapReport
    method, engine   as chosen
    outer_loop       number of the outer loop in boundary_loops(triangles)
    center, point    vertices at 0 and at 1, as in the options, or None
    converged, sweeps, steps     of the iteration
    history          one Step per step
    step_maps        per step, if asked for: (V, 2) the step's image, with the first loop that it opened on the unit
                     circle; NaN for vertices that the image lacks
    angle_error_deg, angle_error_stored_deg, lost_area, beltrami, area_distortion, conformal_energy, flipped,
    below_resolution, flipped_faces, seconds, peak_memory_mb, warnings    as in MapReport
    """

    _conformal_uv: Floats | None
    input_sha256: str = ""
    uv: Floats
    centers: Floats
    radii: Floats
    roundness: Floats
    roundness_least_squares: Floats
    mean_roundness: MeanRoundness
    off_circle: list[Ints]
    own_circle: Bools
    rims: str = "smooth"
    method: str
    engine: str
    outer_loop: int
    center: int | None = None
    point: int | None = None
    sweeps: int
    steps: int
    history: list[Step]
    step_maps: list[Floats]
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        loops, conformal_uv = report["loops"], getattr(native, "conformal_uv", None)
        self._set(options=report.get("options", {}))
        self._set(uv=source.outside_nan(native.uv))
        columns = {"centers": "center", "radii": "radius"}
        names = ("centers", "radii", "roundness", "roundness_least_squares", "own_circle")
        self._set(
            **{name: np.array([loop[columns.get(name, name)] for loop in loops]) for name in names},
            off_circle=as_loops([loop["off_circle"] for loop in loops]),
            step_maps=list(getattr(native, "step_maps", ())),
            _conformal_uv=None if conformal_uv is None else source.outside_nan(conformal_uv),
        )

    @cached_property
    def conformal(self) -> ConformalDomain:
        """The circle domain of the surface itself, by which shapes are compared."""
        loops = [loop.get("conformal", loop) for loop in self._report["loops"]]
        kept = self.even == 0.0 or "conformal" in self._report["loops"][0]  # early files have only the moved circles
        uv = self.uv if self._conformal_uv is None else self._conformal_uv
        return ConformalDomain(
            np.array([loop["center"] for loop in loops]),
            np.array([loop["radius"] for loop in loops]),
            np.array([loop["own_circle"] and kept for loop in loops]),
            not any(warning.kind == "not_converged" for warning in self.warnings),
            uv,
            as_loops([loop["off_circle"] for loop in loops]),
        )

    @property
    def z(self) -> Complex:
        """(V,) complex128: `uv` as points x + iy of the unit disk."""
        return np.asarray(self.uv @ [1.0, 1.0j], np.complex128)

    @cached_property
    def log_scale(self) -> Floats:
        """(V,) log of the map's scale at each vertex, disk lengths per surface length; NaN where there is no scale."""
        scale = log_scale(self._source.vertices, self._source.triangles, self.uv)
        return fixed(self._source.outside_nan(scale))

    @cached_property
    def face_angle_error_deg(self) -> Floats:
        """(F,) mean angle error of each triangle's corners, degrees; NaN for triangles without area."""
        return fixed(face_angle_error_deg(self._source.vertices, self._source.triangles, self.uv))

    def to_mesh(self) -> Any:
        """The mesh of the input, of the same kind, with UVs in [0, 1]^2, koebe_log_scale at the vertices and
        koebe_angle_error (degrees) at the faces. Raises InputError if the input was arrays."""
        source = self._source
        if source.mesh is None or source.polygons is None or source.polygon is None:
            raise InputError("the surface came as arrays or as a file: there is no mesh to give back")
        faces, known = len(source.polygons.cell), np.isfinite(self.face_angle_error_deg)
        number, error = source.polygon[known], self.face_angle_error_deg[known]
        with np.errstate(invalid="ignore"):
            angle = np.bincount(number, error, minlength=faces) / np.bincount(number, minlength=faces)
        uv = 0.5 * (1.0 + self.uv)
        return mesh_with_fields(
            source.mesh, source.polygons, Fields(uv, {LOG_SCALE: self.log_scale}, {ANGLE_ERROR: angle})
        )

    def _arrays(self) -> dict[str, Any]:
        maps = np.stack(self.step_maps) if self.step_maps else np.zeros((0, len(self.uv), 2))
        conformal = {} if self._conformal_uv is None else {"conformal_uv": self._conformal_uv}
        return {**super()._arrays(), **conformal, "step_maps": maps}

    def __repr__(self) -> str:
        return (
            f"<koebe.UniformizeResult {self.vertex_count} vertices, {len(self.loops)} loops, "
            f"{self.sweeps} sweeps, angle error {self.angle_error_deg['mean']:.3g} deg, {self.flipped} flipped>"
        )

    def _layout(self) -> tuple[Floats, float]:
        return self.uv[self.triangles], 2.0

    def _counts(self) -> list[str]:
        return [f"{len(self.loops)} loops"]

    def _picture(self) -> str:
        """The circle domain."""
        return drawing_svg({"circles": (self.centers, self.radii)})
