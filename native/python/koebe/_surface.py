"""Many maps of one surface whose vertices move."""

from typing import Any

import numpy as np

from ._api import Progress, importance_of, solver_options, surface_of
from ._arrays import as_points
from ._meshes import is_mesh, read_mesh
from ._native import _koebe
from ._options import callback, token
from ._result import Source, UniformizeResult, with_origin
from .errors import InputError


class Surface:
    """A surface that is mapped again and again: an animation, a sculpting stroke, scans of one topology.

    Topology, the order of elimination and the outer loop are found once; each map begins at the angles that the last
    ones forecast. It is the map that uniformize gives for the same positions and outer loop, within the tolerance and
    up to an automorphism of the disk: of the freedom that the options leave, as much as there is goes into laying the
    loops over those of the first map, so that a texture stays in its place.

    vertices, triangles, or a mesh of another package, and the options: as for uniformize. With outer='auto' or
    'longest' the first positions choose the outer loop, with balance='area' the first map does.
    Raises InputError, TopologyError, SolverError, MemoryError.
    """

    def __init__(
        self,
        vertices: Any,
        triangles: Any = None,
        *,
        method: str = "gk",
        outer: str | int = "auto",
        tolerance: float = 1e-6,
        max_sweeps: int = 50,
        most_lost: float = _koebe.most_lost_area,
        balance: str = "none",
        threads: int = 0,
        polish: bool = False,
        center: int | None = None,
        point: int | None = None,
        importance: Any = None,
    ) -> None:
        options = solver_options(
            method, "condensed", outer, tolerance, max_sweeps, balance, threads, polish, center, point,
            most_lost,
        )
        self._source = surface_of(vertices, triangles)
        options.importance = importance_of(importance, balance, len(self._source.vertices))
        self._options = {
            "method": method, "outer": outer if isinstance(outer, str) else int(outer),
            "tolerance": options.tolerance, "max_sweeps": options.max_sweeps,
            "most_lost": options.most_lost, "balance": balance,
            "threads": options.threads, "polish": options.polish,
            "center": None if center is None else options.center, "point": None if point is None else options.point,
        }  # fmt: skip
        if importance is not None:
            self._options["importance"] = True
        self._native = _koebe.Surface(self._source.vertices, self._source.triangles, options)

    def uniformize(
        self, vertices: Any = None, *, progress: Progress | None = None, cancel: "_koebe.CancelToken | None" = None
    ) -> UniformizeResult:
        """The map with the vertices elsewhere.

        vertices   (V, 3) new positions; where the surface was made of a mesh of another package, also such a mesh with
                   the same faces; None: those the surface was made of
        progress, cancel   as for uniformize. After a cancel or an error the next map takes as long as a first one
        Calls of several threads wait for each other. Raises InputError, SolverError, Cancelled, or MemoryError.
        """
        progress, cancel = callback(progress, "progress"), token(cancel, "cancel")
        source = self._source if vertices is None else self._moved(vertices)
        native = self._native.uniformize(source.vertices, progress, cancel)
        report = native.report()
        # Other positions might choose another outer loop: with this one uniformize makes the map again.
        options = {**self._options, "outer": int(report["loops"][0]["vertices"][0])}
        report = with_origin(report, source, options)
        return UniformizeResult(report, native.uv, np.array(native.flipped_faces), native.step_maps, source)

    def _moved(self, vertices: Any) -> Source:
        kept = self._source
        if not is_mesh(vertices):
            return Source(as_points(vertices, "vertices", 3, len(kept.vertices)), kept.triangles)
        polygons = read_mesh(vertices)
        if kept.polygons is None or not np.array_equal(polygons.corners, kept.polygons.corners):
            raise InputError("the mesh has other faces than the surface")
        points = as_points(np.asarray(polygons.vertices, dtype=np.float64), "vertices", 3, len(kept.vertices))
        return Source(points, kept.triangles, vertices, polygons, kept.polygon)

    def __repr__(self) -> str:
        return f"<koebe.Surface {len(self._source.vertices)} vertices, {len(self._source.triangles)} faces>"
