"""The surface that a result is a map of."""

import hashlib
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._comparable import fixed
from .._native import _koebe
from .._types import Bools, Floats, Ints
from ..errors import KoebeError
from ..io.meshes import Polygons


@dataclass(frozen=True)
class Source:
    """The mapped surface: its arrays, the polygons they were cut from, and the mesh of another package that they come
    from, if any."""

    vertices: Floats
    triangles: Ints
    mesh: Any = None
    polygons: Polygons | None = None
    polygon: Ints | None = None  # (F,) of each triangle
    kept: Ints | None = None  # (F,) the numbers of these triangles in the input, if others are left out
    mask: Bools | None = None  # (V,) bool, as given
    first: Ints | None = None  # (V,) the vertex that each one is joined to, with `weld`
    filed: Ints | None = None  # (F, 3) the triangles with the vertices that they had before

    def __post_init__(self) -> None:
        self.__setstate__(vars(self))

    def __setstate__(self, state: dict[str, Any]) -> None:
        vars(self).update({name: fixed(value) for name, value in state.items()})

    @property
    def given_triangles(self) -> Ints:
        """(F, 3) int32: the triangles with all vertices of the input, also those that `weld` joined."""
        return self.triangles if self.filed is None else self.filed

    @property
    def source_face(self) -> Ints:
        """(F,) int32: the number of each triangle in the input."""
        return np.arange(len(self.triangles), dtype=np.int32) if self.kept is None else self.kept

    def with_input_warnings(self, report: dict[str, Any]) -> dict[str, Any]:
        """The report, without vertices that have a face in the input, and with a warning of vertices in one place."""
        warnings = report["warnings"]
        if self.kept is not None or self.first is not None:
            warnings = [one for one in warnings if one["kind"] != "unused_vertices"]
        if self.kept is None and self.first is not None and not self.used.all():
            unused = np.flatnonzero(~self.used).tolist()
            text = f"{len(unused)} vertices in no face; the first vertex is {unused[0]}"
            warnings = [*warnings, {"kind": "unused_vertices", "elements": unused, "text": text}]
        if not any(one["kind"] == "coincident" for one in warnings):  # else it was loaded
            warnings = [*warnings, *self._coincident()]
        return {**report, "warnings": warnings}

    def _coincident(self) -> list[dict[str, Any]]:
        if self.first is None:
            found: list[dict[str, Any]] = _koebe.coincident_vertices(self.vertices, self.triangles)
            return found
        joined = np.flatnonzero(self.first != np.arange(len(self.first))).tolist()
        text = f"{len(joined)} vertices joined to earlier ones in the map"
        return [{"kind": "coincident", "elements": joined, "text": text}] if joined else []

    def mapped(self, vertex: int) -> int:
        """The vertex that stands for a vertex in the map; also -1 for none."""
        return int(self.first[vertex]) if self.first is not None and 0 <= vertex < len(self.first) else vertex

    def name_mapped_vertices(self, options: Any) -> None:
        """Change the vertices that native options name to those that they are joined to."""
        for name in ("outer_vertex", "center", "point", "outer", "inner", "around"):
            vertex = getattr(options, name, None)
            if isinstance(vertex, int):
                setattr(options, name, self.mapped(vertex))

    def call(self, function: Callable[..., Any], *others: Any) -> Any:
        """The native function of vertices, triangles and the others. Faces of errors have the input's numbers."""
        try:
            return function(self.vertices, self.triangles, *others)
        except KoebeError as error:
            if self.kept is not None and error.of == "faces":
                error.elements = self.kept[list(error.elements)].tolist()
            raise

    @property
    def used(self) -> Bools:
        """(V,) bool: vertices with a triangle."""
        found = np.zeros(len(self.vertices), bool)
        found[self.given_triangles] = True
        return found

    def outside_nan(self, values: Floats) -> Floats:
        """The values (V, k) of the vertices, with NaN at those that are left without a triangle. Joined vertices have
        one value."""
        if self.first is not None:
            values = np.asarray(values)[self.first]
        if self.kept is not None:
            values = np.array(values)
            values[~self.used] = np.nan
        return values


def with_origin(report: dict[str, Any], source: Source, options: dict[str, Any]) -> dict[str, Any]:
    """The report with its origin: the arrays' hash and the options, after the version."""
    digest = hashlib.sha256()
    for array, kind in ((source.vertices, "<f8"), (source.triangles, "<i4")):
        digest.update(np.ascontiguousarray(array, dtype=kind).tobytes())
    origin = {"input_sha256": digest.hexdigest(), "options": options}
    return {"version": report["version"], "input": report["input"], **origin, **report}
