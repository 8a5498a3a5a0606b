"""Maps a surface many times while its vertices move."""

from dataclasses import replace
from typing import Any

import numpy as np

from .._arrays import as_points
from .._native import _koebe
from .._options import callback, takes, token
from .._progress import Shown
from .._signatures import SequenceOptions, Unpack
from .._types import Values, Whole
from ..errors import InputError
from .input import is_surface, polygons_of, surface_of
from .result import UniformizeResult
from .source import Source, with_origin
from .uniformize import importance_of, solver_options


class Surface:
    """A surface that is mapped again and again: an animation, a sculpting stroke, scans of one topology.

    Topology, the order of elimination and the outer loop are found once. Each map starts at angles forecast from the
    last maps. Up to an automorphism of the disk its circles are those of uniformize for the same positions and outer
    loop: after a large move to rounding; after a small move, which keeps the last triangulation, up to the mesh's
    resolution (docs/labs.md has figures). The freedom that the options leave is used to lay the loops over those of the
    first map, so that a texture stays in its place.

    vertices, triangles    as for `uniformize`, or a mesh of another package in place of both
    method, outer, center, point, tolerance, max_sweeps, balance, importance, polish, threads, most_lost, weld, mask,
    polygon    as for `uniformize`
    With outer='auto' or 'longest' the first positions choose the outer loop, with balance='area' the first map does.
    Raises InputError, TopologyError, SolverError, MemoryError.

    >>> import koebe
    >>> surface = koebe.Surface("blend_samples/face.obj")
    >>> first = surface.uniformize()
    >>> moved = surface.uniformize("blend_samples/surprised.obj")
    >>> print(first.flipped, moved.flipped, moved.converged)
    0 0 True
    """

    @takes("sequence", polygon=None)
    def __init__(self, vertices: Any, triangles: Any = None, **given: "Unpack[SequenceOptions]") -> None:
        options, self._options = solver_options("sequence", given)
        self._faces = _faces(surface_of(vertices, triangles, mask=given["mask"]))
        self._source = surface_of(vertices, triangles, mask=given["mask"], weld=self._options["weld"])
        self._source.name_mapped_vertices(options)
        options.importance = importance_of(given["importance"], self._options, len(self._source.vertices))
        self._polygon = polygons_of(given["polygon"], self._source)
        self._native = self._source.call(_koebe.Surface, options)

    def uniformize(
        self, vertices: Any = None, *, progress: Shown = None, cancel: "_koebe.CancelToken | None" = None
    ) -> UniformizeResult:
        """Map the surface with its vertices at new positions.

        vertices   (V, 3) new positions, or a whole surface with the same faces; None: the surface's first positions
        progress, cancel   as for uniformize. After a cancel or an error the next map takes as long as a first one
        Calls of several threads wait for each other. Raises InputError, SolverError, Cancelled, or MemoryError.
        """
        progress, cancel = callback(progress, "progress"), token(cancel, "cancel")
        source = self._source if vertices is None else self._moved(vertices)
        native = self._native.uniformize(source.vertices, progress, cancel)
        source.call(_koebe.make_polygons_convex, native, self._polygon, True, cancel)
        report = native.report()
        # Other positions might choose another outer loop: this one makes uniformize repeat the map.
        options = {**self._options, "outer": int(report["loops"][0]["vertices"][0])}
        report = with_origin(report, source, options)
        return UniformizeResult(report, native, source)

    def _moved(self, vertices: Any) -> Source:
        kept = self._source
        if not is_surface(vertices):
            points = as_points(vertices, "vertices", 3, len(kept.vertices))
            return replace(kept, vertices=points, mesh=None, polygons=None, polygon=None)
        if len(surface_of(vertices).vertices) != len(kept.vertices):
            raise InputError("the mesh has other faces than the surface")
        moved = surface_of(vertices, mask=kept.mask)
        if not all(map(np.array_equal, _faces(moved), self._faces)):
            raise InputError("the mesh has other faces than the surface")
        polygon = moved.polygon if kept.polygon is None else kept.polygon
        return replace(kept, vertices=moved.vertices, mesh=moved.mesh, polygons=moved.polygons, polygon=polygon)

    def __repr__(self) -> str:
        return f"<koebe.Surface {len(self._source.vertices)} vertices, {len(self._source.triangles)} faces>"


def _faces(source: Source) -> tuple[Values, Whole]:
    """Vertices at the corners of the polygons, and the first corner of each polygon."""
    if source.polygons is not None:
        return source.polygons.corners, source.polygons.begin
    return source.triangles.ravel(), np.arange(0, source.triangles.size + 1, 3)
