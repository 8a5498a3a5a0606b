"""The rotation or the Moebius map that lays one sphere over another, as a Lorentz matrix (4, 4)."""

from collections.abc import Callable
from typing import Any

import numpy as np

from .._types import Floats, Whole

_CELLS = 48  # squares along an edge of the cube on which a field is looked up
_ROTATIONS = 4000  # tried for fields: 9 degrees apart
_SAMPLES = 600  # vertices at which fields are compared in the search
_FINE = 1500  # and in the last steps
_BEST = 4  # rotations from which the search goes on


def _middles() -> Floats:
    """(6 * _CELLS^2, 3) directions: one through each square of `_cells`."""
    side, u, v = np.meshgrid(np.arange(6), *[(np.arange(_CELLS) + 0.5) * 2.0 / _CELLS - 1.0] * 2, indexing="ij")
    axis, rows, found = side.ravel() // 2, np.arange(side.size), np.empty((side.size, 3))
    found[rows, axis] = 1.0 - 2.0 * (side.ravel() % 2)
    found[rows, (axis + 1) % 3], found[rows, (axis + 2) % 3] = u.ravel(), v.ravel()
    return found / np.linalg.norm(found, axis=1, keepdims=True)


def _cells(places: Floats) -> Whole:
    """The square of a cube round the sphere that each direction goes through."""
    axis = np.abs(places).argmax(axis=1)
    rows = np.arange(len(places))
    long = places[rows, axis]
    two = [places[rows, (axis + k) % 3] / np.where(long == 0.0, 1.0, np.abs(long)) for k in (1, 2)]
    u, v = (np.clip(((one + 1.0) * 0.5 * _CELLS).astype(int), 0, _CELLS - 1) for one in two)
    return ((2 * axis + (long < 0.0)) * _CELLS + u) * _CELLS + v


def applied(matrix: Floats, places: Floats) -> Floats:
    """The images (n, 3), unit vectors."""
    images = matrix[0, 0] + places @ matrix[0, 1:], matrix[1:, 0] + places @ matrix[1:, 1:].T
    moved = images[1] / images[0][:, None]
    return moved / np.linalg.norm(moved, axis=1, keepdims=True)


def _near_identity(six: Floats) -> Floats:
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


def nearest_rotation(matrix: Floats) -> Floats:
    """The rotation (3, 3) next to a matrix, by least squares [Kabsch 1976]."""
    u, _, v = np.linalg.svd(matrix)
    return u @ np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ v))]) @ v


def _turned(rotation: Floats) -> Floats:
    matrix = np.eye(4)
    matrix[1:, 1:] = rotation
    return matrix


def by_landmarks(source: Floats, target: Floats, free: bool) -> Floats:
    """The rotation of least squares, or the Moebius map of least squares, by Newton's method."""
    matrix = _turned(nearest_rotation(target.T @ source))
    if not free:
        return matrix
    damping, unit = 1e-3, 1e-6
    misses = (applied(matrix, source) - target).ravel()
    for _ in range(200):
        slopes = [(applied(_near_identity(unit * e) @ matrix, source) - target).ravel() - misses for e in np.eye(6)]
        jacobian = np.array(slopes).T / unit
        normal = jacobian.T @ jacobian
        step = np.linalg.solve(normal + damping * np.eye(6), -jacobian.T @ misses)
        tried = _near_identity(step) @ matrix
        after = (applied(tried, source) - target).ravel()
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


def by_fields(
    look_up: Callable[[Floats, Floats], Floats],
    points: Floats,
    areas: Floats,
    fields: tuple[Floats, Floats],
    free: bool,
    report: Callable[[float], None],
) -> Floats:
    """The map of greatest correlation of the fields. All rotations are tried, then small steps.

    look_up    the values of the first fields (V_a, k) at points of the sphere
    points, areas    (V_b, 3) of the second sphere, and (V_b,)
    report     called with the share of the work that is done, and ends the work by an exception
    """
    # A sample of the second sphere, by area where its fields are known.
    weight = np.where(np.isfinite(fields[1]).any(axis=1), areas, 0.0)
    random = np.random.default_rng(0)
    sample = random.choice(len(weight), min(_FINE, int((weight > 0).sum())), False, weight / weight.sum())
    there, wanted = points[sample], fields[1][sample]
    table = look_up(fields[0], _middles())

    def similarity(matrix: Floats, count: int) -> float:
        return float(correlation(look_up(fields[0], applied(matrix, there[:count])), wanted[:count]))

    # All rotations at a few points, by a table of the first fields.
    rotations = np.concatenate([_rotations(_quaternions(_ROTATIONS)), np.eye(3)[None]])
    scores: list[float] = []
    for some in np.array_split(rotations, 40):
        report(0.5 * len(scores) / len(rotations))
        looked_up = table[_cells((there[:_SAMPLES] @ some.transpose(0, 2, 1)).reshape(-1, 3))]
        scores += correlation(looked_up.reshape(len(some), -1, wanted.shape[1]), wanted[:_SAMPLES]).tolist()
    # The best ones, by small steps.
    start = [_turned(rotation) for rotation in rotations]
    best = [start[k] for k in np.argsort(scores)[::-1][:_BEST]]
    climbed: list[Floats] = []
    for matrix in best:
        report(0.5 + 0.3 * len(climbed) / _BEST)
        climbed.append(_climbed(lambda m: similarity(m, _SAMPLES), matrix, 3, 0.1, 0.02))
    report(0.8)
    matrix = max(climbed, key=lambda m: similarity(m, len(there)))
    return _climbed(lambda m: similarity(m, len(there)), matrix, 6 if free else 3, 0.05, 5e-4)


def correlation(x: Floats, y: Floats, weights: Floats | None = None) -> Any:
    """The mean over k of the correlations of (..., n, k) and (n, k) numbers along n, where both are known; -1: none."""
    known = np.isfinite(x) & np.isfinite(y)
    share = known if weights is None else known * weights[:, None]
    share = share / np.maximum(share.sum(axis=-2, keepdims=True), np.finfo(float).tiny)
    x, y = np.where(known, x, 0.0), np.where(known, y, 0.0)
    x, y = x - (share * x).sum(axis=-2, keepdims=True), y - (share * y).sum(axis=-2, keepdims=True)
    size = np.sqrt((share * x * x).sum(axis=-2) * (share * y * y).sum(axis=-2))
    enough = (size > 0.0) & ((share > 0.0).sum(axis=-2) > 2)
    return np.where(enough, (share * x * y).sum(axis=-2) / np.where(enough, size, 1.0), -1.0).mean(axis=-1)


def _climbed(score: Callable[[Floats], float], matrix: Floats, directions: int, step: float, least: float) -> Floats:
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


def _quaternions(count: int) -> Floats:
    """Rotations that lie evenly [Alexa 2022, Super-Fibonacci spirals]."""
    s = np.arange(count) + 0.5
    phi, psi = np.sqrt(2.0), 1.533751168755204288118041
    inner, outer = np.sqrt(s / count), np.sqrt(1.0 - s / count)
    a, b = 2.0 * np.pi * s / phi, 2.0 * np.pi * s / psi
    return np.stack([inner * np.sin(a), inner * np.cos(a), outer * np.sin(b), outer * np.cos(b)], axis=1)


def _rotations(quaternions: Floats) -> Floats:
    """(n, 3, 3) of quaternions (n, 4) x, y, z, w."""
    x, y, z, w = quaternions.T
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
        [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
        [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
    ]).transpose(2, 0, 1)  # fmt: skip
