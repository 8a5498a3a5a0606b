"""The public functions: they check arrays, make options native and wrap results."""

import warnings
from collections.abc import Mapping, Sequence
from typing import Any, Literal, overload

import numpy as np

from .._arrays import as_indices, as_loops, as_points, as_triangles
from .._native import _koebe
from .._option_table import rows
from .._options import callback, filled, flag, number, number_of, takes, token, vertex_weights, whole
from .._report_entries import Warning
from .._signatures import UniformizeOptions, Unpack
from .._types import Floats, Ints
from ..errors import InputError, OptionError, SolverError, TopologyError
from .cut_result import CutResult
from .input import is_surface, points_at_vertices, polygons_of, surface_of
from .result import UniformizeResult
from .source import Source, with_origin


def _check_mesh_engine(chosen: Mapping[str, Any], given: Mapping[str, Any]) -> None:
    if chosen["engine"] != "mesh":
        for name, row in rows("uniformize").items():
            if row.of_mesh_engine and given[name] != row.given:
                raise OptionError(f"{name} needs engine='mesh'")
    if chosen["partners"] == "changing" and (chosen["method"] != "gk" or chosen["schedule"]):
        raise OptionError("changing partners need method='gk' and no schedule")
    if chosen["metric"] == "reflected-last" and chosen["method"] == "ck":
        raise OptionError("metric='reflected-last' is not for method='ck'")
    if chosen["annulus"] == "yamabe" and chosen["metric"] == "first":
        raise OptionError("annulus='yamabe' needs metric='planar' or 'reflected'")


def solver_options(of: str, given: Mapping[str, Any]) -> tuple["_koebe.UniformizeOptions", dict[str, Any]]:
    """The native options of `uniformize` or of a sequence, and these options for a report."""
    options, said = filled(of, _koebe.UniformizeOptions(), given)
    if options.center >= 0 and said.get("balance", "none") != "none":
        raise OptionError("center and balance exclude each other: both choose the centre of the disk")
    return options, said


@overload
def uniformize(
    vertices: Any, triangles: Any = None, *, cut: Literal[True], **options: "Unpack[UniformizeOptions]"
) -> CutResult: ...
@overload
def uniformize(
    vertices: Any, triangles: Any = None, *, cut: Literal[False] = False, **options: "Unpack[UniformizeOptions]"
) -> UniformizeResult: ...
@overload
def uniformize(
    vertices: Any, triangles: Any = None, *, cut: bool, **options: "Unpack[UniformizeOptions]"
) -> UniformizeResult | CutResult: ...
@takes("uniformize", polygon=None, progress=None, cancel=None)
def uniformize(
    vertices: Any, triangles: Any = None, *, cut: bool = False, **given: "Unpack[UniformizeOptions]"
) -> "UniformizeResult | CutResult":
    """Map a surface of genus 0 with boundary loops conformally to the unit disk, every loop on a round circle.

    vertices     (V, 3) float32, float64 or whole numbers, any unit, any order, read-only accepted, never modified
    triangles    (F, 3) whole numbers of any width, counter-clockwise seen from outside. In place of both, here and for
                 every surface: a pair (vertices, triangles); the path of a mesh file, as text or PathLike: OBJ, OFF,
                 PLY, STL, GLB, and by other packages GIfTI, VTK and FreeSurfer's surfaces; a PyVista PolyData or
                 UnstructuredGrid, a trimesh Trimesh, a meshio Mesh or a nibabel GiftiImage. Files and meshes may have
                 quadrilaterals and polygons. For a mesh, the result's to_mesh()
                 gives the same kind back, with UVs and fields
    {options}
    mask         (V,) bool: faces with a vertex where it is True are left out, as if they were not there. Vertices keep
                 their numbers, and their values are NaN where no face is left. Faces are numbered without those left
                 out: the result's `source_face` has their numbers in the input. koebe.read_region reads masks
    polygon      (F,) integers: triangles of one number are one polygon. If it is convex on the surface, it is convex in
                 the UVs, or the warning concave_polygons has one of its triangles. Cuts do not part it. None: the
                 polygons of the file or mesh
    progress     called as progress(fraction, stage) on the calling thread; fraction never falls. None: a bar in a
                 terminal or a notebook after a second. False: nothing
    cancel       a CancelToken; raising it from any thread ends the call with Cancelled

    With cut=True the result is a CutResult, whose uv belong to corners: (F, 3, 2) in [0, 1]^2. A vertex named by outer,
    center, point counts for one piece. center and point together leave no freedom (paper, section 4.3); center alone
    does not turn the map, point alone only turns it; center and balance exclude each other. 'gk' is the second
    algorithm of the paper's section 4.4, 'against-outer' the first; 'ck' is the algorithm of section 1.2. One loop
    gives the Riemann map (section 4.3), two the annulus r < |z| < 1 (section 4.2), more the Koebe iteration (section
    4.4). Ctrl-C ends the call at once, as in all functions here.
    Raises InputError (OptionError for an option, also a ValueError), TopologyError, SolverError, Cancelled, or
    MemoryError.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> result
    <koebe.UniformizeResult 2309 vertices, 4 loops, 2 sweeps, angle error 0.886 deg, 0 flipped>
    >>> print(result.uv.shape, result.radii.round(2))
    (2309, 2) [1.   0.13 0.09 0.09]

    A closed surface has no map to the disk, so it is cut first:

    >>> koebe.uniformize("docs/link.obj")
    Traceback (most recent call last):
    ...
    koebe.errors.TopologyError: genus 1: the surface has a handle; ...
    >>> koebe.uniformize("docs/link.obj", cut=True).handles_cut
    1
    """
    options, chosen = solver_options("uniformize", {"cut": cut, **given})
    _check_mesh_engine(chosen, given)
    progress, cancel = callback(given["progress"], "progress"), token(given["cancel"], "cancel")
    if not chosen.pop("cut"):
        cut = False
    elif options.mesh.schedule or options.mesh.record_steps:
        raise OptionError("cut excludes schedule and record_steps: both name the loops of one surface")
    source = surface_of(vertices, triangles, degenerate=cut, mask=given["mask"], weld=chosen["weld"])
    source.name_mapped_vertices(options)
    options.importance = importance_of(given["importance"], chosen, len(source.vertices))
    polygon = polygons_of(given["polygon"], source)
    if cut:
        made = source.call(_koebe.uniformize_with_cuts, polygon, options, progress, cancel)
        report = with_origin(made.report(), source, {**chosen, "cut": True})
        return CutResult(report, made, source)
    native = source.call(_koebe.uniformize, options, progress, cancel)
    source.call(_koebe.make_polygons_convex, native, polygon, True, cancel)
    return UniformizeResult(with_origin(native.report(), source, chosen), native, source)


def importance_of(values: Any, chosen: Mapping[str, Any], count: int) -> Floats:
    """(V,) importance of the vertices, or empty."""
    if values is not None and chosen.get("balance") != "area" and not chosen.get("even"):
        raise OptionError("importance needs even above 0, or balance='area': it weighs them")
    return vertex_weights("importance", values, count)


def boundary_loops(
    vertices: Any = None, triangles: Any = None, *, vertex_count: int | None = None, mask: Any = None
) -> list[Ints]:
    """Boundary loops as int32 arrays of vertices, in order with the surface on the left; lowest vertex first.

    vertices, triangles    as for `uniformize`, or triangles (F, 3) alone
    vertex_count    of the mesh; without it any number is a vertex
    mask            (V,) bool: faces with a vertex where it is True are left out
    Faces that do not have the orientation of the others give a koebe.Warning.
    Raises InputError, and TopologyError for a mesh that is not manifold, orientable and connected.

    >>> import koebe
    >>> [len(loop) for loop in koebe.boundary_loops("blend_samples/face.obj")]  # rim, mouth, eyes
    [172, 29, 21, 21]
    """
    count = None if vertex_count is None else whole(vertex_count, "vertex_count", least=1)
    if triangles is None:
        vertices, triangles = None, vertices
    if vertices is not None:
        source = surface_of(vertices, triangles, mask=mask)
    elif is_surface(triangles):
        source = surface_of(triangles, mask=mask)
    elif mask is None:
        source = Source(np.zeros((0, 3)), as_triangles(triangles, count))
    else:
        source = surface_of(np.zeros((len(mask), 3)), triangles, mask=mask)
    faces = source.triangles
    if faces.max() < faces.size:
        return as_loops(source.call(_loops_of, faces, int(faces.max()) + 1))
    # Few of the numbers are used: memory must depend on their count, not on the greatest number.
    used, numbers = np.unique(faces, return_inverse=True)
    try:
        loops = source.call(_loops_of, numbers.reshape(-1, 3).astype(np.int32), len(used))
    except TopologyError as error:
        if error.kind != "disconnected":  # this error lists faces
            error.elements = used[list(error.elements)].tolist()
        raise
    return [used[loop] for loop in loops]


def _loops_of(_: Floats, __: Floats, faces: Ints, count: int) -> Any:
    loops = _koebe.boundary_loops(faces, count)
    _warn(_koebe.surface_warnings(faces, count), 4)
    return loops


def _warn(entries: list[dict[str, Any]], level: int = 2) -> None:
    """Python warnings of a function without a report. level: how far up its caller is."""
    for entry in entries:
        warnings.warn(Warning(entry), stacklevel=level + 1)


def _warn_turned(source: Source) -> None:
    _warn(_koebe.surface_warnings(source.triangles, len(source.vertices)), 3)


def disk_map(vertices: Any, triangles: Any = None, *, mask: Any = None) -> Floats:
    """The Riemann map of a surface with one boundary loop by shrinking disks (paper, section 4.3).

    Returns (V, 2) float64 points of the closed unit disk.

    >>> import koebe, numpy as np
    >>> vertices, triangles, label = koebe.fill_holes("blend_samples/face.obj", loops=[1, 2, 3])
    >>> points = koebe.disk_map(vertices, triangles)
    >>> (rim,) = koebe.boundary_loops(triangles)
    >>> bool(np.allclose(np.linalg.norm(points[rim], axis=1), 1.0))
    True
    """
    source = surface_of(vertices, triangles, mask=mask)
    points = source.outside_nan(source.call(_koebe.disk_map))
    _warn_turned(source)
    return points


def annulus_map(
    vertices: Any, triangles: Any = None, *, backend: str = "harmonic", mask: Any = None
) -> tuple[Floats, float]:
    """The map of a surface with two boundary loops to the annulus r < |z| < 1 (paper, section 4.2).

    backend   'harmonic': by a holomorphic 1-form. 'yamabe': by the discrete Yamabe flow to a flat cylinder, with
              edges flipped on the way; the two agree to the order of the discretization
    Returns (V, 2) float64 points of the unit disk and r, a length in it. The longer loop goes to the unit circle.
    Raises SolverError if the flow does not converge.

    >>> import koebe
    >>> vertices, triangles, label = koebe.fill_holes("blend_samples/face.obj", loops=[2, 3])  # the eyes
    >>> points, radius = koebe.annulus_map(vertices, triangles)
    >>> print(f"{radius:.3f}")
    0.153
    """
    chosen = number_of(backend, "backend", rows("uniformize")["annulus"].words)
    source = surface_of(vertices, triangles, mask=mask)
    points, radius = source.call(_koebe.annulus_map, chosen)
    _warn_turned(source)
    return source.outside_nan(points), radius


def fill_holes(
    vertices: Any,
    triangles: Any = None,
    *,
    loops: Sequence[int] | None = None,
    fair: bool = False,
    mask: Any = None,
    weld: float | None = None,
) -> tuple[Floats, Ints, Ints]:
    """Fill boundary loops.

    loops   indices in the list that boundary_loops returns; None for all loops
    fair    False: fans around the means of the loops' vertices (paper, section 4.4). True: triangles as long as those
            around the hole, on a surface that continues its curvature [Liepa 2003; Botsch and Kobbelt 2004], by CGAL
    weld    distance of vertices that are joined to find the loops, as for `parts`
    Returns vertices (V + K, 3), triangles (F', 3) and a label per face: -1 in the input, k in the patch of loop k.
    Faces of the input stay as they are. Patches have the orientation of most faces; the other faces give a
    koebe.Warning. Lengths are in the input's unit.

    >>> import koebe
    >>> vertices, triangles, label = koebe.fill_holes("blend_samples/face.obj", loops=[1, 2, 3])
    >>> print(len(koebe.boundary_loops(triangles)), (label >= 0).sum())  # one new triangle for each edge of a hole
    1 71
    """
    given = source = surface_of(vertices, triangles, mask=mask)
    if weld is not None:
        source = surface_of(vertices, triangles, mask=mask, weld=number(weld, rows("parts")["weld"]))
    ranks = None if loops is None else as_indices(loops, "loops", source.triangles.size, "loops")
    points, faces, label, found = source.call(_koebe.fill_holes, ranks, flag(fair, "fair"))
    _warn(found)
    own = len(source.triangles)
    return (
        points, np.concatenate([given.triangles, faces[own:]]),
        np.concatenate([np.full(len(given.triangles), -1, label.dtype), label[own:]]),
    )  # fmt: skip


def harmonic_map(
    vertices: Any,
    triangles: Any = None,
    fixed: Any = None,
    values: Any = None,
    *,
    uniform: bool = False,
    mask: Any = None,
) -> Floats:
    """The map into the plane of least Dirichlet energy with given values at some vertices (paper, equation 2).

    fixed    (B,) vertices whose values are given
    values   (B, 2) their values
    uniform  True: every triangle counts as equilateral, so that a disk whose boundary goes to a convex curve has no
             flips [Tutte 1963]. False: the lengths in space count
    Returns (V, 2) float64, in the values' unit.

    Round a square, with its middle free:

    >>> import koebe
    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.3, 0.4, 0]]
    >>> faces = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]
    >>> corners = [[-1, -1], [1, -1], [1, 1], [-1, 1]]
    >>> middle = koebe.harmonic_map(square, faces, [0, 1, 2, 3], corners, uniform=True)[4]
    >>> bool(abs(middle).max() < 1e-12)
    True
    """
    source = surface_of(vertices, triangles, mask=mask)
    chosen = as_indices(fixed, "fixed", len(source.vertices), "vertices")
    if not len(chosen):
        raise InputError("at least one vertex must be fixed")
    points = as_points(values, "values", 2, len(chosen))
    return source.outside_nan(source.call(_koebe.harmonic_map, chosen, points, flag(uniform, "uniform")))


def weld(vertices: Any, distance: float = 0.0) -> Ints:
    """Find vertices that lie close together, as the option `weld` joins them.

    distance   in the vertices' unit, at least 0. 0: vertices at the same place
    Returns (V,) int32: for each vertex the vertex that it is joined to, an earlier one or itself. In their order, each
    joins the nearest one that was kept before it within the distance, or is kept.

    >>> import koebe
    >>> koebe.weld([[0, 0, 0], [1, 0, 0], [0, 0, 0.01]], 0.1).tolist()
    [0, 1, 0]
    """
    return _koebe.weld(as_points(vertices, "vertices", 3), number(distance, rows("parts")["weld"]))


def distortion(vertices: Any, triangles: Any = None, uv: Any = None, *, mask: Any = None) -> dict[str, Any]:
    """Angle error, Beltrami coefficient, area distortion, conformal energy and flips of any UV map.

    uv   (V, 2) points of the unit disk, x + iy
    Angles are in degrees, the energy in areas of the disk, all else has no unit.

    >>> import koebe
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> report = koebe.distortion("blend_samples/face.obj", uv=result.uv)
    >>> print(f"{report['angle_error_deg']['mean']:.2f} degrees, {report['flipped']} flipped")
    0.89 degrees, 0 flipped
    """
    source = surface_of(vertices, triangles, mask=mask)
    points = points_at_vertices(uv, "uv", source)
    report = source.call(_koebe.distortion, points)
    if not _is_finite(report):
        raise SolverError("the distortion is beyond floating point: scale the surface, or the map, to about 1")
    return report


def _is_finite(report: Any) -> bool:
    """Whether all numbers of a report are finite: JSON has no others."""
    return all(map(_is_finite, report.values())) if isinstance(report, dict) else report is not None
