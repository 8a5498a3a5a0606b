"""Takes points of one closed surface to another, through their maps to the sphere."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ._options import flag
from ._report_entries import Warning
from ._sphere import SphereMap
from ._transfer_carry import carried, landmark_pairs
from .errors import InputError, SolverError

_CELLS = 48  # squares along an edge of the cube on which vertices are looked up
_ROTATIONS = 4000  # tried for fields: 9 degrees apart
_SAMPLES = 600  # vertices at which fields are compared in the search
_FINE = 1500  # and in the last steps
_BEST = 4  # rotations from which the search goes on


@dataclass(frozen=True)
class SphereCorrespondence:
    """A point of closed surface a for each vertex of closed surface b.

    faces       (V_b,) int32 triangle of a that holds the point
    weights     (V_b, 3) its barycentric coordinates there: at least 0, sum 1
    points      (V_b, 3) the point in space, in a's unit
    alignment   (4, 4) Lorentz matrix L of the Moebius map that lays b's sphere over a's: x goes to y / t with
                (t, y) = L (1, x). A rotation has L[0, 0] = 1
    misses_deg  (n,) how far each landmark misses its partner on the sphere, degrees
    similarity  correlation of the two fields after the alignment, by area on b, or None
    warnings    list of Warning
    A vertex of b without a face corresponds to nothing: its face is -1, all else NaN.
    """

    faces: np.ndarray
    weights: np.ndarray
    points: np.ndarray
    alignment: np.ndarray
    misses_deg: np.ndarray
    similarity: float | None
    triangles: np.ndarray
    count: int
    warnings: list[Warning] = field(default_factory=list)

    def __repr__(self) -> str:
        angle = np.degrees(np.arccos(np.clip(0.5 * (np.trace(_rotation_of(self.alignment)) - 1.0), -1.0, 1.0)))
        told = ""
        if len(self.misses_deg):
            told = f", {len(self.misses_deg)} landmarks miss by up to {self.misses_deg.max():.3g} deg"
        like = "" if self.similarity is None else f", fields correlate by {self.similarity:.3g}"
        return f"<koebe.SphereCorrespondence {len(self.points)} points, turned by {angle:.3g} deg{told}{like}>"

    def __call__(self, directions: Any) -> np.ndarray:
        """The points (n, 3) of a's sphere at points (n, 3) of b's sphere."""
        return _applied(self.alignment, np.asarray(directions, np.float64))

    def carry(self, field: Any, *, labels: bool | None = None) -> np.ndarray:
        """Values (V_b,) or (V_b, k) at b's vertices of a field at a's vertices, as Correspondence.carry."""
        return carried(field, self.triangles, self.faces, self.weights, self.count, labels)


def sphere_transfer(
    a: SphereMap,
    b: SphereMap,
    landmarks: Sequence[tuple[Any, Any]] | None,
    fields: tuple[Any, Any] | None,
    moebius: bool,
) -> SphereCorrespondence:
    """The correspondence by the Moebius map, or the rotation, that fits landmarks or fields best."""
    for name, one in (("a", a), ("b", b)):
        if len(one.loops):
            raise InputError(f"{name} has {len(one.loops)} holes: transfer takes spheres of closed surfaces, and disks")
        if one.on_sphere["flipped"]:
            raise InputError(f"the map of {name} to the sphere is not one to one: no point is sure")
    if landmarks is not None and fields is not None:
        raise InputError("give landmarks, or fields, not both")
    located = _Located(a)
    pairs = landmark_pairs(landmarks)
    on_a, on_b = (_directions(one, [pair[side] for pair in pairs]) for side, one in enumerate((a, b)))
    free, similarity = flag(moebius, "moebius"), None
    if fields is not None:
        matrix, similarity = _by_fields(located, b, fields, free)
    elif not pairs:
        matrix = np.eye(4)
    elif free and len(pairs) < 3:
        raise InputError("a Moebius map needs three landmarks at least")
    else:
        matrix = _by_landmarks(on_b, on_a, free)
    used = b._source.used
    faces, weights = np.full(b.vertex_count, -1, np.int32), np.full((b.vertex_count, 3), np.nan)
    faces[used], weights[used] = located.at(_applied(matrix, b.points[used]))
    points = np.einsum("vk,vkc->vc", weights, a.vertices[a.triangles[faces]])
    cosines = np.einsum("nc,nc->n", _applied(matrix, on_b), on_a) if pairs else np.zeros(0)
    misses = np.degrees(np.arccos(np.clip(cosines, -1.0, 1.0)))
    return SphereCorrespondence(faces, weights, points, matrix, misses, similarity, a.triangles, a.vertex_count)


def _directions(result: SphereMap, places: list[Any]) -> np.ndarray:
    """(n, 3) points on the sphere of vertices, or of the vertices nearest to points in space."""
    found = np.zeros((len(places), 3))
    vertices = result.vertices[result._source.used]
    numbers = np.flatnonzero(result._source.used)
    for number, place in enumerate(places):
        if isinstance(place, (int, np.integer)) and not isinstance(place, bool):
            if not 0 <= place < result.vertex_count or not np.isfinite(result.points[place]).all():
                raise InputError(f"landmark {number} is no vertex of the surface: {place}", [number], "landmarks")
            found[number] = result.points[place]
            continue
        position = np.asarray(place, np.float64)
        if position.shape != (3,) or not np.isfinite(position).all():
            raise InputError(f"landmark {number} is neither a vertex nor a point (x, y, z)", [number], "landmarks")
        found[number] = result.points[numbers[((vertices - position) ** 2).sum(axis=1).argmin()]]
    return found


class _Located:
    """Where points lie among the triangles of a sphere: a walk from a vertex nearby."""

    def __init__(self, a: SphereMap) -> None:
        self.triangles, self.points = a.triangles, a.points
        edges = self.triangles[:, [1, 2, 2, 0, 0, 1]].reshape(-1, 2)  # edge k is opposite to corner k
        key = np.sort(edges, axis=1) @ np.array([len(self.points), 1], np.int64)
        order = np.argsort(key, kind="stable")
        partner = np.empty(len(key), np.int64)
        partner[order[0::2]], partner[order[1::2]] = order[1::2], order[0::2]
        self.across = (partner // 3).reshape(-1, 3)
        corner = self.points[self.triangles]
        self.normals = np.stack([np.cross(corner[:, (k + 1) % 3], corner[:, (k + 2) % 3]) for k in range(3)], axis=1)
        cell = _cells(corner.sum(axis=1))
        self.first = np.zeros(6 * _CELLS * _CELLS, np.int64)
        self.first[:] = -1
        self.first[cell] = np.arange(len(self.triangles))
        filled = np.flatnonzero(self.first >= 0)
        empty = np.flatnonzero(self.first < 0)
        self.first[empty] = self.first[filled[np.minimum(np.searchsorted(filled, empty), len(filled) - 1)]]

    def at(self, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The triangles (n,) that hold points on the sphere, and the weights (n, 3) of their corners."""
        here = self.first[_cells(places)]
        sides = np.einsum("nkc,nc->nk", self.normals[here], places)
        walking = np.flatnonzero(sides.min(axis=1) < 0.0)
        random = np.random.default_rng(0)
        for step in range(4 * int(np.sqrt(len(self.triangles))) + 200):
            if not len(walking):
                break
            side = sides[walking]
            if step % 4 == 3:  # a walk in a circle ends by chance
                side = np.where(side < 0.0, -random.random(side.shape), 1.0)
            here[walking] = self.across[here[walking], side.argmin(axis=1)]
            sides[walking] = np.einsum("nkc,nc->nk", self.normals[here[walking]], places[walking])
            walking = walking[sides[walking].min(axis=1) < 0.0]
        for n in walking:  # on an edge, by rounding, or lost: the best of all triangles
            every = self.normals @ places[n]
            least = every.min(axis=1) / np.maximum(np.abs(every).max(axis=1), np.finfo(float).tiny)
            facing = np.einsum("fc,c->f", self.points[self.triangles].sum(axis=1), places[n]) > 0.0
            here[n] = np.where(facing, least, -np.inf).argmax()
            sides[n] = every[here[n]]
            if least[here[n]] < -1e-6:
                raise SolverError("a point of the sphere lies in no triangle")
        weights = np.maximum(sides, 0.0)
        return here.astype(np.int32), weights / weights.sum(axis=1, keepdims=True)


def _cells(places: np.ndarray) -> np.ndarray:
    """The square of a cube round the sphere that each direction goes through."""
    axis = np.abs(places).argmax(axis=1)
    rows = np.arange(len(places))
    long = places[rows, axis]
    two = [places[rows, (axis + k) % 3] / np.where(long == 0.0, 1.0, np.abs(long)) for k in (1, 2)]
    u, v = (np.clip(((one + 1.0) * 0.5 * _CELLS).astype(int), 0, _CELLS - 1) for one in two)
    return ((2 * axis + (long < 0.0)) * _CELLS + u) * _CELLS + v


def _applied(matrix: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The images (n, 3), unit vectors."""
    images = matrix[0, 0] + places @ matrix[0, 1:], matrix[1:, 0] + places @ matrix[1:, 1:].T
    moved = images[1] / images[0][:, None]
    return moved / np.linalg.norm(moved, axis=1, keepdims=True)


def _near_identity(six: np.ndarray) -> np.ndarray:
    """The Lorentz matrix exp(G): a turn by the vector six[:3] and a boost by six[3:]."""
    generator = np.zeros((4, 4))
    x, y, z = six[:3]
    generator[1:, 1:] = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]]
    generator[0, 1:] = generator[1:, 0] = six[3:]
    halvings = max(0, int(np.ceil(np.log2(max(np.abs(generator).sum(), 1e-300)))) + 4)
    small, term, total = generator / 2.0**halvings, np.eye(4), np.eye(4)
    for k in range(1, 14):
        term = term @ small / k
        total = total + term
    for _ in range(halvings):
        total = total @ total
    return total


def _rotation_of(matrix: np.ndarray) -> np.ndarray:
    """The rotation next to a Lorentz matrix's block of space."""
    u, _, v = np.linalg.svd(matrix[1:, 1:])
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))]) @ v


def _turned(rotation: np.ndarray) -> np.ndarray:
    matrix = np.eye(4)
    matrix[1:, 1:] = rotation
    return matrix


def _by_landmarks(source: np.ndarray, target: np.ndarray, free: bool) -> np.ndarray:
    """The rotation of least squares [Kabsch 1976], or the Moebius map of least squares, by Newton's method."""
    u, _, v = np.linalg.svd(target.T @ source)
    matrix = _turned(u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))]) @ v)
    if not free:
        return matrix
    damping, unit = 1e-3, 1e-6
    misses = (_applied(matrix, source) - target).ravel()
    for _ in range(200):
        slopes = [(_applied(_near_identity(unit * e) @ matrix, source) - target).ravel() - misses for e in np.eye(6)]
        jacobian = np.array(slopes).T / unit
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(normal + damping * np.eye(6), -jacobian.T @ misses)
        tried = _near_identity(step) @ matrix
        after = (_applied(tried, source) - target).ravel()
        if after @ after < misses @ misses:
            gain = misses @ misses - after @ after
            matrix, misses, damping = tried, after, max(damping / 10.0, 1e-15)
            if gain < 1e-15 * (1.0 + after @ after):
                break
        elif damping > 1e6:
            break
        else:
            damping *= 10.0
    return matrix


def _by_fields(located: _Located, b: SphereMap, fields: Any, free: bool) -> tuple[np.ndarray, float]:
    """The map of greatest correlation of the fields, and the correlation. All rotations are tried, then small steps."""
    if not isinstance(fields, (tuple, list)) or len(fields) != 2:
        raise InputError("fields must be a pair: values at a's vertices and at b's")
    on_a, on_b = (np.asarray(values, np.float64) for values in fields)
    for name, values, count in (("a", on_a, len(located.points)), ("b", on_b, b.vertex_count)):
        if values.shape != (count,):
            raise InputError(f"the field of {name} must be ({count},), not {values.shape}")
    values_a, known_a = np.nan_to_num(on_a), np.isfinite(on_a)
    corners = b.vertices[b.triangles]
    area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1)
    weight = np.bincount(b.triangles.ravel(), np.repeat(area, 3), minlength=b.vertex_count)
    weight[~np.isfinite(on_b)] = 0.0
    if not weight.any() or not known_a.any():
        raise InputError("the fields have no values")
    random = np.random.default_rng(0)
    sample = random.choice(len(weight), min(_FINE, int((weight > 0).sum())), False, weight / weight.sum())
    there, wanted = b.points[sample], on_b[sample]

    def similarity(matrix: np.ndarray, count: int, quick: bool = False) -> float:
        places = _applied(matrix, there[:count])
        if quick:  # the value at a corner of a triangle nearby
            near = located.triangles[located.first[_cells(places)], 0]
            found, known = values_a[near], known_a[near]
        else:
            faces, weights = located.at(places)
            near = located.triangles[faces]
            found, known = (weights * values_a[near]).sum(axis=1), known_a[near].all(axis=1)
        return _correlation(found[known], wanted[:count][known])

    start = [_turned(_rotation(quaternion)) for quaternion in _quaternions(_ROTATIONS)]
    start.append(np.eye(4))
    scores = [similarity(matrix, _SAMPLES, quick=True) for matrix in start]
    best = [start[k] for k in np.argsort(scores)[::-1][:_BEST]]
    climbed = [_climbed(lambda m: similarity(m, _SAMPLES), matrix, 3, 0.1, 0.02) for matrix in best]
    matrix = max(climbed, key=lambda m: similarity(m, len(there)))
    matrix = _climbed(lambda m: similarity(m, len(there)), matrix, 6 if free else 3, 0.05, 5e-4)
    return matrix, similarity(matrix, len(there))


def _correlation(x: np.ndarray, y: np.ndarray) -> float:
    if len(x) < 3:
        return -1.0
    x, y = x - x.mean(), y - y.mean()
    size = np.sqrt((x @ x) * (y @ y))
    return float(x @ y / size) if size > 0.0 else -1.0


def _climbed(
    score: Callable[[np.ndarray], float], matrix: np.ndarray, directions: int, step: float, least: float
) -> np.ndarray:
    """From here to where no step of this size makes the score greater: a search by a pattern."""
    best = score(matrix)
    while step > least:
        moves = [_near_identity(sign * step * np.eye(6)[k]) @ matrix for k in range(directions) for sign in (1.0, -1.0)]
        scores = [score(move) for move in moves]
        if max(scores) > best:
            best, matrix = max(scores), moves[int(np.argmax(scores))]
        else:
            step *= 0.5
    return matrix


def _quaternions(count: int) -> np.ndarray:
    """Rotations that lie evenly [Alexa 2022, Super-Fibonacci spirals]."""
    s = np.arange(count) + 0.5
    phi, psi = np.sqrt(2.0), 1.533751168755204288118041
    inner, outer = np.sqrt(s / count), np.sqrt(1.0 - s / count)
    a, b = 2.0 * np.pi * s / phi, 2.0 * np.pi * s / psi
    return np.stack([inner * np.sin(a), inner * np.cos(a), outer * np.sin(b), outer * np.cos(b)], axis=1)


def _rotation(quaternion: np.ndarray) -> np.ndarray:
    x, y, z, w = quaternion
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip
