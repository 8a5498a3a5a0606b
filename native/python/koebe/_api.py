"""The public functions: arrays checked, options made native, results wrapped."""

import json
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ._arrays import as_loops, as_planar, as_triangles, as_vertices
from ._native import _koebe
from ._result import UniformizeResult
from .errors import InputError

Progress = Callable[[float, str], Any]


def _choice(enumeration: Any, option: str, value: str) -> Any:
    members = enumeration.__members__
    if value not in members:
        raise InputError(f"{option} must be one of {', '.join(members)}, not {value!r}")
    return members[value]


def _options(method, engine, outer, tolerance, max_sweeps, balance, threads, polish) -> "_koebe.UniformizeOptions":
    options = _koebe.UniformizeOptions()
    options.method = _choice(_koebe.Method, "method", method)
    options.engine = _choice(_koebe.Engine, "engine", engine)
    options.balance = _choice(_koebe.Balance, "balance", balance)
    if isinstance(outer, (int, np.integer)) and not isinstance(outer, bool):
        options.outer = _koebe.OuterLoop.vertex
        options.outer_vertex = int(outer)
    elif outer in ("auto", "longest"):
        options.outer = _koebe.OuterLoop.automatic if outer == "auto" else _koebe.OuterLoop.longest
    else:
        raise InputError(f"outer must be 'auto', 'longest' or a vertex of the loop, not {outer!r}")
    if not tolerance > 0.0:
        raise InputError(f"tolerance must be positive, not {tolerance!r}")
    if max_sweeps < 1:
        raise InputError(f"max_sweeps must be at least 1, not {max_sweeps!r}")
    if threads < 0:
        raise InputError(f"threads must be 0 (all cores) or more, not {threads!r}")
    options.tolerance = float(tolerance)
    options.max_sweeps = int(max_sweeps)
    options.threads = int(threads)
    options.polish = bool(polish)
    return options


def uniformize(
    vertices: Any,
    triangles: Any,
    method: str = "gk",
    engine: str = "condensed",
    outer: str | int = "auto",
    tolerance: float = 1e-6,
    max_sweeps: int = 50,
    balance: str = "none",
    progress: Progress | None = None,
    cancel: "_koebe.CancelToken | None" = None,
    threads: int = 0,
    polish: bool = False,
) -> UniformizeResult:
    """Map a surface of genus 0 with boundary loops conformally to the unit disk, every loop on a round circle.

    vertices     (V, 3) float32 or float64, any unit, any order, read-only accepted, never modified
    triangles    (F, 3) int32 or int64, counter-clockwise seen from outside
    method       'gk': pairs of loops opened at once; 'ck': one loop and the outer one (paper, section 4.4)
    engine       'condensed': boundary angles alone (default); 'mesh': the paper's patches as real triangles
    outer        the loop on the unit circle: 'auto', 'longest', or a vertex of it
    tolerance    stop when the circles move by less in a sweep, a length in the unit disk
    max_sweeps   then stop with converged = False
    balance      'none', or 'area': the disk automorphism with the least area distortion
    progress     called as progress(fraction, stage) on the calling thread; fraction never goes back
    cancel       a CancelToken; raising it from any thread ends the call with Cancelled
    threads      of the dense and sparse kernels; 0 takes all cores
    polish       at the end, lower the angle error with the circles as they are; takes many times as long

    One loop gives the Riemann map (section 4.3), two the annulus r < |z| < 1 (section 4.2), more the Koebe
    iteration (section 4.4). Raises InputError, TopologyError, SolverError or Cancelled.
    """
    options = _options(method, engine, outer, tolerance, max_sweeps, balance, threads, polish)
    native = _koebe.uniformize(
        as_vertices(vertices), as_triangles(triangles), options, progress, cancel or _koebe.CancelToken()
    )
    return UniformizeResult(native)


def boundary_loops(triangles: Any, vertex_count: int | None = None) -> list[np.ndarray]:
    """Boundary loops as int32 arrays of vertices, in order with the surface on the left; lowest vertex first.

    Raises TopologyError for a mesh that is not manifold, orientable and connected.
    """
    faces = as_triangles(triangles)
    if faces.size == 0 or faces.min() < 0:
        raise InputError("triangles must name vertices from 0 on, and there must be one at least")
    count = int(faces.max()) + 1 if vertex_count is None else int(vertex_count)
    if faces.max() >= count:
        raise InputError(f"triangles name vertex {faces.max()} of {count}")
    return as_loops(_koebe.boundary_loops(faces, count))


def disk_map(vertices: Any, triangles: Any) -> np.ndarray:
    """The Riemann map of a surface with one boundary loop by shrinking disks (paper, section 4.3).

    Returns (V, 2) float64 points of the closed unit disk.
    """
    return _koebe.disk_map(as_vertices(vertices), as_triangles(triangles))


def annulus_map(vertices: Any, triangles: Any, backend: str = "harmonic") -> tuple[np.ndarray, float]:
    """The map of a surface with two boundary loops to the annulus r < |z| < 1 (paper, section 4.2).

    backend   'harmonic': by a holomorphic 1-form. 'yamabe': by the discrete Yamabe flow to a flat cylinder, with
              edges flipped on the way; the two agree to the order of the discretization
    Returns (V, 2) float64 points and r. The longer loop goes to the unit circle. Raises SolverError if the flow does
    not converge.
    """
    chosen = _choice(_koebe.AnnulusBackend, "backend", backend)
    return _koebe.annulus_map(as_vertices(vertices), as_triangles(triangles), chosen)


def fill_holes(
    vertices: Any, triangles: Any, loops: Sequence[int] | None = None, fair: bool = False
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fill boundary loops.

    loops   ranks in the list that boundary_loops gives; None for all of them
    fair    False: fans around the loops' mass centres (paper, section 4.4). True: triangles as long as those around
            the hole, on a surface that continues its curvature [Liepa 2003; Botsch and Kobbelt 2004], by CGAL
    Returns vertices (V + K, 3), triangles (F', 3) and a patch label per face: -1 input, k the loop filled.
    """
    ranks = None if loops is None else [int(k) for k in loops]
    return _koebe.fill_holes(as_vertices(vertices), as_triangles(triangles), ranks, bool(fair))


def harmonic_map(
    vertices: Any, triangles: Any, fixed: Any, values: Any, uniform: bool = False
) -> np.ndarray:
    """The map into the plane of least Dirichlet energy with given values at some vertices (paper, equation 2).

    fixed    (B,) vertices whose values are given
    values   (B, 2) their values
    uniform  True: every triangle counts as equilateral, so that a disk whose boundary goes to a convex curve has no
             flips [Tutte 1963]. False: the lengths in space count
    Returns (V, 2) float64.
    """
    positions, faces, points = as_vertices(vertices), as_triangles(triangles), as_planar(values)
    chosen = [int(v) for v in fixed]
    if len(chosen) != len(points) or not chosen:
        raise InputError(f"there are {len(points)} values for {len(chosen)} fixed vertices")
    if min(chosen) < 0 or max(chosen) >= len(positions):
        raise InputError(f"fixed must name vertices from 0 to {len(positions) - 1}")
    return _koebe.harmonic_map(positions, faces, chosen, points, bool(uniform))


def distortion(vertices: Any, triangles: Any, uv: Any) -> dict[str, Any]:
    """Angle error, Beltrami coefficient, area distortion, conformal energy and flips of any UV map.

    uv   (V, 2) points of the unit disk, x + iy
    """
    positions, faces, points = as_vertices(vertices), as_triangles(triangles), as_planar(uv)
    if points.shape[0] != positions.shape[0]:
        raise InputError(f"uv has {points.shape[0]} rows for {positions.shape[0]} vertices")
    return json.loads(_koebe.distortion(positions, faces, points))
