"""The public functions: arrays checked, options made native, results wrapped."""

from collections.abc import Callable, Sequence
from typing import Any, Literal, overload

import numpy as np

from ._arrays import as_indices, as_loops, as_points, as_surface, as_triangles
from ._cut_result import CutResult
from ._meshes import is_mesh, read_mesh
from ._native import _koebe
from ._options import callback, choice, flag, outer_loop, positive, share, sweep, token, vertex, whole
from ._result import Source, UniformizeResult, with_origin
from .errors import InputError, OptionError, SolverError, TopologyError

Progress = Callable[[float, str], Any]


def _set_mesh_engine(
    options: "_koebe.UniformizeOptions", partners: Any, schedule: Any, metric: Any, annulus: Any, record_steps: Any
) -> None:
    mesh = options.mesh
    mesh.partners = choice(partners, "partners", _koebe.Partners)
    mesh.schedule = sweep(schedule, "schedule")
    mesh.metric = choice(metric, "metric", _koebe.Metric)
    mesh.annulus = choice(annulus, "annulus", _koebe.AnnulusBackend)
    mesh.record_steps = flag(record_steps, "record_steps")
    if options.engine != _koebe.Engine.mesh:
        asked = {
            "partners": partners != "fixed",
            "schedule": schedule is not None,
            "metric": metric != "first",
            "annulus": annulus != "harmonic",
            "record_steps": record_steps,
        }
        if any(asked.values()):
            name = next(name for name, is_asked in asked.items() if is_asked)
            raise OptionError(f"{name} is an option of engine='mesh'")
    if mesh.partners == _koebe.Partners.changing and (options.method != _koebe.Method.gk or mesh.schedule):
        raise OptionError("partners change with method='gk' alone, and without a schedule")
    if mesh.annulus == _koebe.AnnulusBackend.yamabe and mesh.metric == _koebe.Metric.first:
        raise OptionError("annulus='yamabe' needs metric='planar' or 'reflected'")


def solver_options(
    method: Any, engine: Any, outer: Any, tolerance: Any, max_sweeps: Any, balance: Any, threads: Any, polish: Any,
    center: Any, point: Any, most_lost: Any,
) -> "_koebe.UniformizeOptions":
    options = _koebe.UniformizeOptions()
    options.method = choice(method, "method", _koebe.Method)
    options.engine = choice(engine, "engine", _koebe.Engine)
    options.balance = choice(balance, "balance", _koebe.Balance)
    options.outer, options.outer_vertex = outer_loop(outer)
    options.tolerance = positive(tolerance, "tolerance")
    options.max_sweeps = whole(max_sweeps, "max_sweeps", least=1)
    options.most_lost = share(most_lost, "most_lost")
    options.threads = whole(threads, "threads", least=0)
    options.polish = flag(polish, "polish")
    options.center, options.point = vertex(center, "center"), vertex(point, "point")
    if center is not None and balance != "none":
        raise OptionError("center and balance exclude each other: both choose the automorphism of the disk")
    return options


@overload
def uniformize(vertices: Any, triangles: Any = None, *, cut: Literal[True], **options: Any) -> CutResult: ...
@overload
def uniformize(
    vertices: Any, triangles: Any = None, *, cut: Literal[False] = False, **options: Any
) -> UniformizeResult: ...
def uniformize(  # type: ignore[misc]  # whose options the two above do not name
    vertices: Any,
    triangles: Any = None,
    *,
    method: str = "gk",
    engine: str = "condensed",
    outer: str | int = "auto",
    tolerance: float = 1e-6,
    max_sweeps: int = 50,
    most_lost: float = _koebe.most_lost_area,
    balance: str = "none",
    progress: Progress | None = None,
    cancel: "_koebe.CancelToken | None" = None,
    threads: int = 0,
    polish: bool = False,
    center: int | None = None,
    point: int | None = None,
    importance: Any = None,
    partners: str = "fixed",
    schedule: Sequence[Sequence[int]] | None = None,
    metric: str = "first",
    annulus: str = "harmonic",
    record_steps: bool = False,
    cut: bool = False,
) -> UniformizeResult | CutResult:
    """Map a surface of genus 0 with boundary loops conformally to the unit disk, every loop on a round circle.

    vertices     (V, 3) float32 or float64, any unit, any order, read-only accepted, never modified
    triangles    (F, 3) int32 or int64, counter-clockwise seen from outside
    In place of both: a PyVista PolyData or UnstructuredGrid, a trimesh Trimesh or a meshio Mesh, with triangles,
    quadrilaterals or polygons; the result's to_mesh() gives the same kind back, with UVs and fields
    method       'gk': two loops a step (paper, section 4.4, second algorithm); 'ck': one loop a step, all others filled
                 (section 1.2); 'against-outer': one hole a step, the outer loop never filled (section 4.4, first one)
    engine       'condensed': boundary angles alone (default); 'mesh': the paper's patches as real triangles
    outer        the loop on the unit circle: 'auto', 'longest', or a vertex of it
    tolerance    stop when the circles move by less in a sweep, a length in the unit disk
    max_sweeps   then stop with converged = False
    most_lost    share of the surface's area that may have no area as stored before a warning comes first that says so
    balance      'none', or 'area': the disk automorphism with the least area distortion
    progress     called as progress(fraction, stage) on the calling thread; fraction never goes back
    cancel       a CancelToken; raising it from any thread ends the call with Cancelled
    threads      of the dense and sparse kernels; 0 takes all cores
    polish       at the end, lower the angle error with the circles as they are; takes up to three times the map
    center       a vertex inside the surface that goes to 0; not together with balance
    point        a vertex of a boundary loop that goes to 1; its loop is the one on the unit circle. Both together leave
                 no freedom (paper, section 4.3); center alone turns nothing, point alone only turns
    importance   with balance='area': (V,) numbers from 0 to 1. The balance takes the surface for 4^w times as large in
                 length where its importance is w, so that it gets more texels there. Equal ones change nothing
    cut          open, cut and split in the UVs what cannot be mapped as it is: closed surfaces, handles, edges of three
                 faces, one-sided surfaces, several components, degenerate and duplicate faces. Gives a CutResult, whose
                 uv are the corners' (F, 3, 2) in [0, 1]^2. A vertex named by outer, center, point is of one piece

    With engine='mesh', the paper's own choices:
    partners     'fixed', or 'changing': with 'gk' each sweep pairs the loops another way (Fig. 4)
    schedule     the loops that each step of a sweep opens, as places in the result's `loops`: pairs, with 'ck' single
                 ones; None: the method's own order
    metric       each step's: 'first', the surface's; 'planar', of the last step's image, as in print; 'reflected', that
                 after the reflection tau in a circle inside a hole
    annulus      'harmonic': 1-forms (section 4.2); 'yamabe': the discrete Yamabe flow (abstract)
    record_steps keep each step's own image: `step_maps`

    One loop gives the Riemann map (section 4.3), two the annulus r < |z| < 1 (section 4.2), more the Koebe
    iteration (section 4.4). Ctrl-C ends the call at once, as it does in all functions here.
    Raises InputError (OptionError for an option, which is a ValueError too), TopologyError, SolverError, Cancelled, or
    MemoryError.
    """
    options = solver_options(
        method, engine, outer, tolerance, max_sweeps, balance, threads, polish, center, point, most_lost
    )
    _set_mesh_engine(options, partners, schedule, metric, annulus, record_steps)
    progress, cancel = callback(progress, "progress"), token(cancel, "cancel")
    if flag(cut, "cut") and (schedule is not None or record_steps):
        raise OptionError("cut excludes schedule and record_steps: they are about the loops of one surface")
    source = surface_of(vertices, triangles, degenerate=cut)
    options.importance = importance_of(importance, balance, len(source.vertices))
    chosen = {
        "method": method, "engine": engine, "outer": outer if isinstance(outer, str) else int(outer),
        "tolerance": options.tolerance, "max_sweeps": options.max_sweeps,
        "most_lost": options.most_lost, "balance": balance,
        "threads": options.threads, "polish": options.polish,
        "center": None if center is None else options.center, "point": None if point is None else options.point,
        "partners": partners, "schedule": sweep(schedule, "schedule") or None, "metric": metric, "annulus": annulus,
        "record_steps": options.mesh.record_steps,
    }  # fmt: skip
    if importance is not None:
        chosen["importance"] = True
    if cut:
        polygon = polygons_of(None, source)
        made = _koebe.uniformize_with_cuts(source.vertices, source.triangles, polygon, options, progress, cancel)
        report = with_origin(made.report(), source, {**chosen, "cut": True})
        return CutResult(report, made.uv, np.array(made.flipped_faces), source)
    native = _koebe.uniformize(source.vertices, source.triangles, options, progress, cancel)
    report = with_origin(native.report(), source, chosen)
    return UniformizeResult(report, native.uv, np.array(native.flipped_faces), native.step_maps, source)


def importance_of(values: Any, balance: str, count: int) -> np.ndarray:
    """(V,) of the vertices, or none."""
    if values is None:
        return np.zeros(0)
    if balance != "area":
        raise OptionError("importance is of the balance: it needs balance='area'")
    array = np.asarray(values)
    if array.shape != (count,) or array.dtype.kind not in "fiu":
        raise InputError(f"importance must be ({count},) real numbers, not {array.shape} {array.dtype}")
    wrong = np.flatnonzero(~((array >= 0) & (array <= 1)))
    if len(wrong):
        raise InputError(f"{len(wrong)} vertices have an importance not from 0 to 1", wrong.tolist(), "vertices")
    return array.astype(np.float64)


def polygons_of(given: Any, source: Source) -> np.ndarray:
    """(F,) int32: polygons' numbers as given, or as the mesh has them; empty where each triangle is one by itself."""
    if given is None:
        return np.zeros(0, np.int32) if source.polygon is None else source.polygon
    numbers, count = np.asarray(given), len(source.triangles)
    if numbers.shape != (count,) or numbers.dtype.kind not in "iu":
        raise InputError(f"polygon must be ({count},) integers, not {numbers.shape} {numbers.dtype}")
    return np.unique(numbers, return_inverse=True)[1].astype(np.int32)


def surface_of(vertices: Any, triangles: Any, degenerate: bool = False) -> Source:
    """The surface as arrays, of a mesh of another package too."""
    if not is_mesh(vertices):
        if triangles is None:
            raise InputError("there are no triangles: give them too, or a mesh of PyVista, trimesh, meshio or nibabel")
        return Source(*as_surface(vertices, triangles, degenerate=degenerate))
    if triangles is not None:
        raise TypeError("a mesh has its own faces: give no triangles")
    polygons = read_mesh(vertices)
    positions = as_points(np.asarray(polygons.vertices, dtype=np.float64), "vertices", 3)
    corners = polygons.corners
    if len(corners) and not 0 <= corners.min() <= corners.max() < len(positions):
        raise InputError("faces of the mesh name a vertex that does not exist")
    faces, polygon = _koebe.triangulate(positions, corners.astype(np.int32), polygons.begin.astype(np.int32))
    return Source(*as_surface(positions, faces), vertices, polygons, polygon)


def boundary_loops(triangles: Any, *, vertex_count: int | None = None) -> list[np.ndarray]:
    """Boundary loops as int32 arrays of vertices, in order with the surface on the left; lowest vertex first.

    vertex_count    of the mesh; without it any number is a vertex
    Raises InputError, and TopologyError for a mesh that is not manifold, orientable and connected.
    """
    count = None if vertex_count is None else whole(vertex_count, "vertex_count", least=1)
    faces = as_triangles(triangles, count)
    if faces.max() < faces.size:
        return as_loops(_koebe.boundary_loops(faces, int(faces.max()) + 1))
    # Few of the numbers are used: their count shall decide on the memory, not the greatest.
    used, faces = np.unique(faces, return_inverse=True)
    try:
        loops = _koebe.boundary_loops(faces.reshape(-1, 3).astype(np.int32), len(used))
    except TopologyError as error:
        if error.kind != "disconnected":  # that one lists faces
            error.elements = used[list(error.elements)].tolist()
        raise
    return [used[loop] for loop in loops]


def disk_map(vertices: Any, triangles: Any) -> np.ndarray:
    """The Riemann map of a surface with one boundary loop by shrinking disks (paper, section 4.3).

    Returns (V, 2) float64 points of the closed unit disk.
    """
    return _koebe.disk_map(*as_surface(vertices, triangles))


def annulus_map(vertices: Any, triangles: Any, *, backend: str = "harmonic") -> tuple[np.ndarray, float]:
    """The map of a surface with two boundary loops to the annulus r < |z| < 1 (paper, section 4.2).

    backend   'harmonic': by a holomorphic 1-form. 'yamabe': by the discrete Yamabe flow to a flat cylinder, with
              edges flipped on the way; the two agree to the order of the discretization
    Returns (V, 2) float64 points of the unit disk and r, a length in it. The longer loop goes to the unit circle.
    Raises SolverError if the flow does not converge.
    """
    chosen = choice(backend, "backend", _koebe.AnnulusBackend)
    return _koebe.annulus_map(*as_surface(vertices, triangles), chosen)


def fill_holes(
    vertices: Any, triangles: Any, *, loops: Sequence[int] | None = None, fair: bool = False
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Fill boundary loops.

    loops   ranks in the list that boundary_loops gives; None for all of them
    fair    False: fans around the means of the loops' vertices (paper, section 4.4). True: triangles as long as those
            around the hole, on a surface that continues its curvature [Liepa 2003; Botsch and Kobbelt 2004], by CGAL
    Returns vertices (V + K, 3), triangles (F', 3) and a patch label per face: -1 input, k the loop filled.
    Lengths are in the input's unit.
    """
    positions, faces = as_surface(vertices, triangles)
    ranks = None if loops is None else as_indices(loops, "loops", faces.size, "loops")
    return _koebe.fill_holes(positions, faces, ranks, flag(fair, "fair"))


def harmonic_map(
    vertices: Any, triangles: Any, fixed: Any, values: Any, *, uniform: bool = False
) -> np.ndarray:
    """The map into the plane of least Dirichlet energy with given values at some vertices (paper, equation 2).

    fixed    (B,) vertices whose values are given
    values   (B, 2) their values
    uniform  True: every triangle counts as equilateral, so that a disk whose boundary goes to a convex curve has no
             flips [Tutte 1963]. False: the lengths in space count
    Returns (V, 2) float64, in the values' unit.
    """
    positions, faces = as_surface(vertices, triangles)
    chosen = as_indices(fixed, "fixed", len(positions), "vertices")
    if not len(chosen):
        raise InputError("there must be one fixed vertex at least")
    points = as_points(values, "values", 2, len(chosen))
    return _koebe.harmonic_map(positions, faces, chosen, points, flag(uniform, "uniform"))


def distortion(vertices: Any, triangles: Any, uv: Any) -> dict[str, Any]:
    """Angle error, Beltrami coefficient, area distortion, conformal energy and flips of any UV map.

    uv   (V, 2) points of the unit disk, x + iy
    Angles are in degrees, the energy in areas of the disk, all else has no unit.
    """
    positions, faces = as_surface(vertices, triangles)
    report = _koebe.distortion(positions, faces, as_points(uv, "uv", 2, len(positions)))
    if not _is_finite(report):
        raise SolverError("the distortion is beyond floating point: scale the surface, or the map, to about 1")
    return report


def _is_finite(report: Any) -> bool:
    """Whether no number of a report is missing: what is not finite has no JSON."""
    return all(map(_is_finite, report.values())) if isinstance(report, dict) else report is not None
