"""Takes points of one closed surface to another, through their maps to the sphere."""

import os
import warnings as python_warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any, TypedDict

import numpy as np

from .._arrays import as_points, as_reals
from .._comparable import Result
from .._native import _koebe
from .._options import flag
from .._progress import Run, Watched
from .._report_entries import Warning
from .._types import Floats, Ints, Values, Whole
from ..errors import InputError, OptionError
from ..io.export import export, has_one_place_a_vertex
from ..io.formats import is_patch_name
from ..maps.carry import carried, landmark_pairs
from ..maps.figures import Beltrami
from ..maps.result import MapReport
from ..maps.source import Source
from ..maps.sphere import SphereMap
from .sphere_alignment import applied, by_fields, by_landmarks, correlation, nearest_rotation

STIFFNESS = 0.1


class SphereOptions(Watched, total=False):
    """How one sphere is laid over another, as in `transfer`."""

    moebius: bool
    bend: bool
    stiffness: float


class Bending(TypedDict):
    """How a sphere was bent over another, after the best rotation or Moebius map.

    beltrami      |mu|, mean over the surface's area and max over the faces: 0 without bending
    log_area_sd   standard deviation of the log of the area factor, by the surface's area
    similarity_before    correlation of the fields before the bending, or None
    flipped       faces that the bending has turned over: 0
    steps         Newton steps
    settled       whether the minimization ended by itself
    """

    beltrami: Beltrami
    log_area_sd: float
    similarity_before: float | None
    flipped: int
    steps: int
    settled: bool


@dataclass(frozen=True, eq=False)
class SphereCorrespondence(Result):
    """A point of closed surface a for each vertex of closed surface b.

    faces       (V_b,) int32 triangle of a that holds the point
    weights     (V_b, 3) its barycentric coordinates there: at least 0, sum 1
    points      (V_b, 3) the point in space, in a's unit
    sphere      (V_b, 3) the point on a's sphere
    alignment   (4, 4) Lorentz matrix L of the Moebius map that lays b's sphere over a's: x goes to y / t with
                (t, y) = L (1, x). A rotation has L[0, 0] = 1
    misses_deg  (n,) how far each landmark misses its partner on the sphere, degrees
    similarity  correlation of the two fields, by area on b, or None
    bending     a dict (beltrami, log_area_sd, similarity_before, flipped, steps, settled), or None with bend=False
    triangles, count    a's triangles and its number of vertices
    own_sphere, own_triangles    b's sphere, and its triangles
    warnings    list of Warning: 'not_converged' if the bending did not settle
    A vertex of b without a face corresponds to nothing: its face is -1, all else NaN.
    """

    faces: Ints
    weights: Floats
    points: Floats
    sphere: Floats
    alignment: Floats
    misses_deg: Floats
    similarity: float | None
    bending: Bending | None
    triangles: Ints
    count: int
    own_sphere: Floats
    own_triangles: Ints
    warnings: list[Warning] = field(default_factory=list)

    def __repr__(self) -> str:
        turn = nearest_rotation(self.alignment[1:, 1:])
        angle = np.degrees(np.arccos(np.clip(0.5 * (np.trace(turn) - 1.0), -1.0, 1.0)))
        bent = "" if self.bending is None else f", bent by |mu| {self.bending['beltrami']['mean']:.3g} in the mean"
        if len(self.misses_deg):
            bent += f", {len(self.misses_deg)} landmarks miss by up to {self.misses_deg.max():.3g} deg"
        like = "" if self.similarity is None else f", fields correlate by {self.similarity:.3g}"
        return f"<koebe.SphereCorrespondence {len(self.points)} points, turned by {angle:.3g} deg{bent}{like}>"

    def _drawing(self) -> dict[str, Any]:
        return {"corners": self.points[self.own_triangles]}

    def __call__(self, directions: Any) -> Floats:
        """The points (n, 3) of a's sphere at points (n, 3) of b's sphere."""
        places = as_points(directions, "directions", 3)
        if self.bending is None:
            return applied(self.alignment, places)
        faces, weights = _Located(self.own_sphere, self.own_triangles).at(places)
        there = np.einsum("nk,nkc->nc", weights, self.sphere[self.own_triangles[faces]])
        return there / np.linalg.norm(there, axis=1, keepdims=True)

    def export(self, path: str | os.PathLike[str], *, sphere: Any = None) -> None:
        """Write b's sphere, registered to a's: b's vertices on the sphere of radius 100.

        The file is complete or absent.
        path      lh.sphere.reg, rh.NAME (FreeSurfer) or NAME.surf.gii
        sphere    (V_a, 3) the points of a on another sphere round 0, such as fsaverage's own, to which b is registered
                  then; None: a's of sphere_map
        Faces that are turned over there, as stored in 32 bits, give a koebe.Warning. Needs nibabel. Raises InputError,
        OSError.
        """
        if not has_one_place_a_vertex(path) or is_patch_name(path):
            raise InputError(f"{os.fspath(path)}: a sphere is written as lh.sphere.reg or .surf.gii")
        places = self.sphere
        if sphere is not None:
            given = as_points(sphere, "sphere", 3, self.count)
            length = np.linalg.norm(given, axis=1, keepdims=True)
            middle = np.linalg.norm((given / np.maximum(length, 1e-300)).mean(axis=0))
            if not length.min() > 0.5 * length.max() or middle > 0.5:
                raise InputError("the sphere must lie round 0")
            places = self.carry(given / length)
            places = places / np.linalg.norm(places, axis=1, keepdims=True)
        corners = (np.float32(points)[self.own_triangles].astype(float) for points in (places, self.own_sphere))
        here, before = map(np.linalg.det, corners)
        if len(turned := np.flatnonzero(here * np.sign(before) <= 0.0)):
            text = f"{len(turned)} faces are turned over on the sphere; the first face is {turned[0]}"
            entry = Warning(kind="flipped", elements=turned.tolist(), text=text)
            python_warnings.warn(entry, stacklevel=2)
        source = Source(self.own_sphere, self.own_triangles)
        export(SimpleNamespace(_source=source, points=places, loops=[], uv=places), path)

    def carry(self, field: Any, *, labels: bool | None = None) -> Values:
        """Carry a field at a's vertices to b's vertices, as Correspondence.carry."""
        return carried(field, self.triangles, self.faces, self.weights, self.count, labels)


def sphere_transfer(
    a: SphereMap,
    b: SphereMap,
    landmarks: Sequence[tuple[Any, Any]] | None,
    fields: tuple[Any, Any] | None,
    moebius: bool,
    bend: bool,
    stiffness: float,
    run: Run,
) -> SphereCorrespondence:
    """The correspondence by the Moebius map, or the rotation, that fits landmarks or fields best, then bent or not."""
    for name, one in (("a", a), ("b", b)):
        if len(one.loops):
            raise InputError(f"{name} has {len(one.loops)} holes: transfer takes spheres of closed surfaces, and disks")
        if one.on_sphere["flipped"]:
            raise InputError(f"the map of {name} to the sphere is not one to one: no point is sure")
    free, bent, pairs = flag(moebius, "moebius"), flag(bend, "bend"), landmark_pairs(landmarks)
    if landmarks is not None and fields is not None and not bent:
        raise InputError("give landmarks, or fields, not both: only bend=True fits both")
    if bent and not pairs and fields is None:
        raise InputError("bend needs fields, or landmarks")
    if not (np.ndim(stiffness) == 0 and np.isfinite(stiffness) and stiffness > 0.0):
        raise OptionError(f"stiffness must be a finite number above 0, not {stiffness!r}")
    run.at(0.0, "align")
    located = _Located(a.points, a.triangles)
    on_a, on_b = (_vertices(one, [pair[side] for pair in pairs]) for side, one in enumerate((a, b)))
    both = None if fields is None else _checked(fields, a, b)
    if both is not None and len(pairs) < 3:
        part = run.part(0.0, 0.3 if bent else 0.9)
        matrix = by_fields(located.values, b.points, vertex_areas(b), both, free, lambda share: part.at(share, "align"))
    elif free and 0 < len(pairs) < 3:
        raise InputError("a Moebius map needs three landmarks at least")
    else:
        matrix = by_landmarks(b.points[on_b], a.points[on_a], free) if pairs else np.eye(4)
    used, sphere = b._source.used, np.full((b.vertex_count, 3), np.nan)
    sphere[used] = applied(matrix, b.points[used])
    bending: Bending | None = None
    if bent:
        before = None if both is None else _similarity(located, sphere, b, both)
        none = np.zeros((0, 0))
        part = run.part(0.0 if both is None or len(pairs) >= 3 else 0.3, 0.9)
        sphere, bending = _bent(a, b, sphere, both or (none, none), on_a, on_b, float(stiffness), part)
        bending |= {"similarity_before": before, "flipped": 0}  # else register_spheres has raised an error
        sphere[~used] = np.nan
    run.at(0.9, "finish")
    faces, weights = np.full(b.vertex_count, -1, np.int32), np.full((b.vertex_count, 3), np.nan)
    faces[used], weights[used] = located.at(sphere[used])
    points = np.einsum("vk,vkc->vc", weights, a.vertices[a.triangles[faces]])
    misses = np.degrees(2.0 * np.arcsin(np.clip(0.5 * np.linalg.norm(sphere[on_b] - a.points[on_a], axis=1), 0.0, 1.0)))
    similarity = None if both is None else _similarity(located, sphere, b, both)
    warnings = []
    if bending is not None and not bending["settled"]:
        text = "the bending ended before it settled: a greater stiffness settles sooner"
        warnings.append(Warning(kind="not_converged", elements=[], text=text))
        python_warnings.warn(warnings[0], stacklevel=4)
    run.at(1.0, "finish")
    return SphereCorrespondence(
        faces, weights, points, sphere, matrix, misses, similarity, bending, a.triangles, a.vertex_count, b.points,
        b.triangles, warnings,
    )  # fmt: skip


def _bent(
    a: SphereMap,
    b: SphereMap,
    sphere: Floats,
    fields: tuple[Floats, Floats],
    on_a: Whole,
    on_b: Whole,
    stiffness: float,
    run: Run,
) -> tuple[Floats, Bending]:
    """b's vertices on a's sphere after the bending, and its figures."""
    found = _koebe.register_spheres(
        a.vertices, _upright(a.points, a.triangles), _anywhere(a.points), fields[0],
        b.vertices, _upright(b.points, b.triangles), _anywhere(sphere), fields[1],
        on_b.tolist(), a.points[on_a], stiffness, run.progress, run.cancel,
    )  # fmt: skip
    return found.pop("sphere"), found


def _checked(fields: Any, a: SphereMap, b: SphereMap) -> tuple[Floats, Floats]:
    """The fields of both, (V_a, k) and (V_b, k) float64. Raises InputError."""
    if not isinstance(fields, (tuple, list)) or len(fields) != 2:
        raise InputError("fields must be a pair: values at a's vertices and at b's")
    on_a, on_b = (as_reals(values, f"the field of {name}") for name, values in zip("ab", fields, strict=True))
    for name, values, one in (("a", on_a, a), ("b", on_b, b)):
        if values.ndim not in (1, 2) or len(values) != one.vertex_count or values.size == 0:
            raise InputError(f"the field of {name} must be ({one.vertex_count},), or have columns, not {values.shape}")
    if on_a.shape[1:] != on_b.shape[1:]:
        raise InputError(f"the fields have {on_a.shape[1:]} and {on_b.shape[1:]} columns")
    on_a, on_b = on_a.reshape(len(on_a), -1), on_b.reshape(len(on_b), -1)
    for name, values, one in (("a", on_a, a), ("b", on_b, b)):
        known = np.where(np.isfinite(values), values, np.nan)[one._source.used]
        if np.isnan(known).all(axis=0).any():
            raise InputError("the fields have no values")
        if (np.nanmax(known, axis=0) - np.nanmin(known, axis=0) <= 1e-12 * np.nanmax(np.abs(known), axis=0)).any():
            raise InputError(f"the field of {name} is the same everywhere")
    return on_a, on_b


def _vertices(result: SphereMap, places: list[Any]) -> Whole:
    """(n,) vertices: as named, or nearest to points in space."""
    found = np.zeros(len(places), np.int64)
    numbers = np.flatnonzero(result._source.used)
    for number, place in enumerate(places):
        if isinstance(place, (int, np.integer)) and not isinstance(place, bool):
            if not 0 <= place < result.vertex_count or not np.isfinite(result.points[place]).all():
                raise InputError(f"landmark {number} is no vertex of the surface: {place}", [number], "landmarks")
            found[number] = place
            continue
        position = as_reals(place, f"landmark {number}")
        if position.shape != (3,) or not np.isfinite(position).all():
            raise InputError(f"landmark {number} is neither a vertex nor a point (x, y, z)", [number], "landmarks")
        found[number] = numbers[((result.vertices[numbers] - position) ** 2).sum(axis=1).argmin()]
    return found


def _anywhere(points: Floats) -> Floats:
    """The points (V, 3), with vertices that have no face at (0, 0, 1)."""
    return np.where(np.isfinite(points), points, [0.0, 0.0, 1.0])


def _upright(points: Floats, triangles: Ints) -> Ints:
    """The triangles (F, 3), those that were turned to the others' orientation with two corners exchanged."""
    a, b, c = points[triangles].transpose(1, 0, 2)
    turned = np.einsum("fk,fk->f", a, np.cross(b - a, c - a)) < 0.0
    return np.where(turned[:, None], triangles[:, [0, 2, 1]], triangles)


class _Located:
    """Where points lie among the triangles of a sphere."""

    def __init__(self, points: Floats, triangles: Ints) -> None:
        self.triangles, upright = triangles, _upright(points, triangles)
        self.turned = (upright != triangles).any(axis=1)
        self.native = _koebe.SpherePlaces(_anywhere(points), upright)

    def at(self, places: Floats) -> tuple[Ints, Floats]:
        """The triangles (n,) that hold points on the sphere, and the weights (n, 3) of their corners."""
        faces, weights = self.native.at(places)
        return faces, np.where(self.turned[faces, None], weights[:, [0, 2, 1]], weights)

    def values(self, field: Floats, places: Floats) -> Floats:
        """Fields (V, k) at points (n, 3) of the sphere: NaN beside a vertex where they are NaN."""
        faces, weights = self.at(places)
        return np.einsum("nc,nck->nk", weights, field[self.triangles[faces]])


def _similarity(located: _Located, sphere: Floats, b: SphereMap, fields: tuple[Floats, Floats]) -> float:
    """Mean correlation of the fields by area on b, with b's vertices at places (V, 3) on a's sphere."""
    used = b._source.used
    return float(correlation(located.values(fields[0], sphere[used]), fields[1][used], vertex_areas(b)[used]))


def vertex_areas(result: MapReport) -> Floats:
    """(V,) areas of the faces around each vertex, relative to each other."""
    points = result.vertices / np.abs(result.vertices).max(initial=np.finfo(float).tiny)
    a, b, c = points[result.triangles].transpose(1, 0, 2)
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return np.asarray(np.bincount(result.triangles.ravel(), np.repeat(area, 3), minlength=result.vertex_count), float)
