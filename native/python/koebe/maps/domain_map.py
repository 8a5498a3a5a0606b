"""What the maps to canonical domains other than the disk have in common."""

import copy
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import numpy as np

from .._options import callback, filled, token, vertex_weights
from .._report_entries import Loop, Warning
from ..errors import OptionError
from ..io.corner_mesh import mesh_with_corner_uv
from .input import polygons_of, surface_of
from .result import MapReport, Seconds, Source, figures_of


class DomainMap(MapReport):
    """UVs with cuts, and a report. TileMap, SphereMap and SchottkyMap describe the fields."""

    uv: np.ndarray
    loops: list[Loop]
    sweeps: int
    changes: list[float]
    turned: list[int]
    seconds: Seconds

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        self._report = report = source.with_input_warnings(report)
        self._source = source
        vars(self).update(figures_of(report))
        self.uv = native.uv.reshape(-1, 3, 2)
        self.uv.flags.writeable = False
        self.flipped_faces = np.asarray(native.flipped_faces, dtype=np.int32)
        self.loops = [Loop(loop) for loop in report.get("loops", ())]
        self.warnings = [Warning(warning) for warning in report["warnings"]]

    def _set_arrays(self, **arrays: np.ndarray) -> None:
        for name, array in arrays.items():
            array.flags.writeable = False
            setattr(self, name, array)

    def _arrays(self) -> dict[str, Any]:
        return {"uv": self.uv, "flipped_faces": self.flipped_faces}

    def _counts(self) -> list[str]:
        """The parts of the result, in words."""
        return [f"{len(self.loops)} loops"]

    def __repr__(self) -> str:
        counts = ", ".join([f"{self.face_count} faces", *self._counts()])
        error = f"angle error {self.angle_error_deg['mean']:.3g} deg"
        return f"<koebe.{type(self).__name__} {counts}, {error}, {self.flipped} flipped>"

    def to_mesh(self) -> Any:
        """The mesh of the input, of the same kind, with fields as in CutResult.to_mesh; for a sphere without the torn
        faces' fields, and with koebe_sphere, the points on the unit sphere. Raises InputError if arrays were given."""
        return mesh_with_corner_uv(self._source, self.uv, self._drawn(), self._point_fields())

    def _point_fields(self) -> dict[str, np.ndarray]:
        """Further fields of the vertices."""
        return {}

    def to_dict(self) -> dict[str, Any]:
        """The command's JSON report as a new dict, with options."""
        return copy.deepcopy(self._report)


Made = TypeVar("Made", bound=DomainMap)


def domain_map(
    made: type[Made],
    function: Callable[..., Any],
    of: str,
    options: Any,
    given: Mapping[str, Any],
    surface: tuple[Any, Any],
    degenerate: bool = False,
) -> Made:
    """The result of a native function.

    of       the map's name in the table of options
    options  native ones, which are set here
    given    all keywords of the caller
    degenerate   faces may name a vertex twice
    Raises OptionError and InputError, and the function's errors.
    """
    options, said = filled(of, options, given)
    progress, cancel = callback(given["progress"], "progress"), token(given["cancel"], "cancel")
    source = surface_of(*surface, degenerate=degenerate, mask=given["mask"], weld=said["weld"])
    source.name_mapped_vertices(options)
    if given.get("importance") is not None:
        if not said["even"]:
            raise OptionError("importance needs even above 0: it weighs the sizes of faces")
        options.importance = vertex_weights("importance", given["importance"], len(source.vertices))
    options.polygon = polygons_of(given["polygon"], source)
    native = source.call(function, options, progress, cancel)
    said.pop("threads", None)  # the result is the same for any number
    return made({**native.report(), "options": said}, native, source)
