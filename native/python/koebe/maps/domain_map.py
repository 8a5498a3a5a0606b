"""What all maps have in common that give each corner UVs of its own."""

from collections.abc import Callable, Mapping
from typing import Any, ClassVar, TypeVar

import numpy as np

from .._options import callback, filled, token, vertex_weights
from .._types import Floats
from ..errors import OptionError
from ..io.corner_mesh import mesh_with_corner_uv
from .input import polygons_of, surface_of
from .result import MapReport
from .source import Source


class DomainMap(MapReport):
    """UVs with cuts, and a report. Each subclass describes its fields."""

    sweeps: int
    changes: list[float]
    turned: list[int]

    _of_faces: ClassVar[tuple[str, ...]] = ()  # further arrays of the library's result, kept in files

    def __init__(self, report: dict[str, Any], native: Any, source: Source) -> None:
        super().__init__(report, native, source)
        self._set(uv=native.uv.reshape(-1, 3, 2))
        self._set(**{name: np.array(getattr(native, name)) for name in self._of_faces})

    def _arrays(self) -> dict[str, Any]:
        return {**super()._arrays(), **{name: getattr(self, name) for name in self._of_faces}}

    def _counts(self) -> list[str]:
        """The parts of the result, in words."""
        return [f"{len(self.loops)} loops"]

    def __repr__(self) -> str:
        counts = ", ".join([f"{self.face_count} faces", *self._counts()])
        error = f"angle error {self.angle_error_deg['mean']:.3g} deg"
        return f"<koebe.{type(self).__name__} {counts}, {error}, {self.flipped} flipped>"

    def to_mesh(self) -> Any:
        """The mesh of the input, of the same kind, with the fields of UniformizeResult.to_mesh. A sphere's mesh has no
        fields of torn faces, but koebe_sphere, the points on the unit sphere. The scale is UV length per surface
        length. The faces are the same, in their order. Vertices are doubled along the cuts: koebe_vertex is the number
        of each vertex in the input. A GiftiImage keeps its vertices: koebe_uv is NaN at a vertex with several UVs, and
        koebe_corner_uv has the six numbers of each face. Raises InputError if the input was arrays."""
        return mesh_with_corner_uv(self._source, self.uv, self._drawn(), self._point_fields())

    def _point_fields(self) -> dict[str, Floats]:
        """Further fields of the vertices."""
        return {}


def prepared(
    of: str, native: Any, given: Mapping[str, Any], surface: tuple[Any, Any], degenerate: bool = False
) -> tuple[Any, dict[str, Any], Source, tuple[Any, Any]]:
    """What a call of a native function needs: its options, these for a report, the surface, and progress and cancel.

    of       the map's name in the table of options
    native   options, which are set here
    given    all keywords of the caller
    degenerate   faces may name a vertex twice
    Raises OptionError and InputError.
    """
    options, said = filled(of, native, given)
    run = callback(given["progress"], "progress"), token(given["cancel"], "cancel")
    source = surface_of(*surface, degenerate=degenerate, mask=given["mask"], weld=said.get("weld"))
    source.name_mapped_vertices(options)
    said.pop("threads", None)  # the result is the same for any number
    return options, said, source, run


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
    """The result of a native function, with the arguments of `prepared`. Raises the function's errors, too."""
    options, said, source, run = prepared(of, options, given, surface, degenerate)
    if given.get("importance") is not None:
        if not said["even"]:
            raise OptionError("importance needs even above 0: it weighs the sizes of faces")
        options.importance = vertex_weights("importance", given["importance"], len(source.vertices))
    options.polygon = polygons_of(given["polygon"], source)
    native = source.call(function, options, *run)
    return made({**native.report(), "options": said}, native, source)
