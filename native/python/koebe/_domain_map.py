"""What the maps to canonical domains other than the disk have in common."""

import copy
from typing import Any

import numpy as np

from ._corner_mesh import mesh_with_corner_uv
from ._files import Saved
from ._result import AngleError, AreaDistortion, Beltrami, Seconds, Source, Warning


class DomainMap(Saved):
    """UVs that are cut, and a report. What its fields mean, TileMap, SphereMap and SchottkyMap say."""

    version: str
    options: dict[str, Any]
    uv: np.ndarray
    loops: list[dict[str, Any]]
    vertices: int
    faces: int
    converged: bool
    sweeps: int
    changes: list[float]
    turned: list[int]
    angle_error_deg: AngleError
    beltrami: Beltrami
    area_distortion: AreaDistortion
    conformal_energy: float
    flipped: int
    below_resolution: int
    flipped_faces: np.ndarray
    seconds: Seconds
    peak_memory_mb: float
    warnings: list[Warning]

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        self._report = report
        self._source = source
        vars(self).update({name: value for name, value in report.items() if name != "input"})
        self.uv = native.uv.reshape(-1, 3, 2)
        self.uv.flags.writeable = False
        self.flipped_faces = np.asarray(native.flipped_faces, dtype=np.int32)
        self.warnings = [Warning(warning) for warning in report["warnings"]]

    def _set_arrays(self, **arrays: np.ndarray) -> None:
        for name, array in arrays.items():
            array.flags.writeable = False
            setattr(self, name, array)

    def _arrays(self) -> dict[str, Any]:
        return {"uv": self.uv, "flipped_faces": self.flipped_faces}

    def _drawn(self) -> np.ndarray:
        """(F,) which faces have UVs that can be drawn."""
        return np.ones(len(self.uv), bool)

    @property
    def surface(self) -> tuple[np.ndarray, np.ndarray]:
        """Vertices (V, 3) float64 and triangles (F, 3) int32 that were mapped."""
        return self._source.vertices, self._source.triangles

    def to_mesh(self) -> Any:
        """The mesh that was given, of the same kind, with fields as of CutResult.to_mesh, of a sphere without the torn
        faces'. Its vertices are doubled where the UVs are cut. Raises InputError if arrays were given."""
        return mesh_with_corner_uv(self._source, self.uv, self._drawn())

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with options."""
        return copy.deepcopy(self._report)
