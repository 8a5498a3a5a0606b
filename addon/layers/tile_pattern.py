# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the periods of UVs that are a tile, from the UVs themselves, and checkers that fit them."""

import dataclasses
import math

import numpy as np

from ..surfaces.connected_components import connected_components
from ..surfaces.surface import Surface, across, next_corners

GRID = 2.0**24  # steps of UVs between 0 and 1: periods of a tile are whole numbers of them
FARTHEST = 2.0**12  # UV units between the sides of a cut
MOST_SHIFTS = 256  # distinct shifts across the cuts of a tile, which has few
SHORTEST = 1e-3  # UV units: a lattice with a shorter period cannot be a pattern's
REPEAT = 8  # squares along u until the checker repeats: two coarse ones, of 4 squares each
HALF = REPEAT // 2
SEEN = 0.02  # of a square: a smaller step is invisible
FREEDOM = 1.5  # factor by which squares may differ from the requested size in order to fit
SIZE_WEIGHT = 0.15  # weight of that factor's logarithm against the logarithm of the squares' stretch


@dataclasses.dataclass(frozen=True)
class Pattern:
    """A checker: so many squares across the UV square; or squares of side 1 after a linear map of the UVs, by rows."""

    size: float
    matrix: tuple[float, float, float, float] | None = None


def lattices_of(surface: Surface, uv: np.ndarray) -> list[np.ndarray]:
    """The shortest periods (1 or 2, 2) by which the sides of cuts in UVs (C, 2) differ, for each tile; the tile with
    the most faces first.

    A tile is a piece of the UVs whose cuts are shifts, to the last bit.
    """
    shifts, component, sizes = _shifts(surface, uv)
    order = np.argsort(component, kind="stable")
    begin = np.unique(component[order], return_index=True)[1]
    found: list[tuple[int, tuple[tuple[int, int], ...]]] = []
    for one, end in zip(begin.tolist(), [*begin[1:].tolist(), len(order)]):
        basis = _basis(np.unique(shifts[order[one:end]], axis=0))
        if basis is not None:
            found.append((int(sizes[component[order[one]]]), basis))
    return [np.array(basis) / GRID for _, basis in sorted(found, reverse=True)]


@dataclasses.dataclass(frozen=True)
class CutSides:
    """The cuts of UVs whose two sides are in the same piece.

    ends     (n, 2, 2, 2) UVs, 64 bits: the two ends of each cut, both sides of each end
    piece    (n,) the cut's piece, by the number of its first face
    of_face  (P,) the piece of each face
    """

    ends: np.ndarray
    piece: np.ndarray
    of_face: np.ndarray


def cut_sides(surface: Surface, uv: np.ndarray) -> CutSides:
    """The edges with two faces where UVs (C, 2) lie apart, but are connected elsewhere."""
    following = next_corners(surface)
    order = np.argsort(surface.corner_edge, kind="stable")
    edge = surface.corner_edge[order]
    uses = np.bincount(edge, minlength=len(surface.seam))
    first = np.flatnonzero((edge[:-1] == edge[1:]) & (uses[edge[:-1]] == 2))
    here, there = order[first], order[first + 1]
    start, end = across(surface.corner_vertex, following, here, there)
    joined = (uv[here] == uv[start]).all(axis=1) & (uv[following[here]] == uv[end]).all(axis=1)
    face = np.repeat(np.arange(len(surface.face_size), dtype=np.int32), surface.face_size)
    piece = connected_components(len(surface.face_size), face[here[joined]], face[there[joined]])
    own = ~joined & (piece[face[here]] == piece[face[there]])
    corners = np.stack([np.stack([here, start], axis=1), np.stack([following[here], end], axis=1)], axis=1)[own]
    return CutSides(uv[corners].astype(np.float64), piece[face[here[own]]], piece)


def _shifts(surface: Surface, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The shifts (n, 2) across the cuts within each piece of the UVs, if all its cuts are shifts, in grid steps; the
    pieces (n,) of these; and the piece (P,) of each face, by the number of its first face."""
    sides = cut_sides(surface, uv)
    with np.errstate(invalid="ignore"):
        at_start, at_end = (sides.ends[:, end, 0] - sides.ends[:, end, 1] for end in (0, 1))
    steps = at_start * GRID
    whole = (at_start == at_end).all(axis=1) & (steps == np.rint(steps)).all(axis=1)
    whole &= (np.abs(steps) < FARTHEST * GRID).all(axis=1)  # must also be finite
    of_piece, piece = sides.piece, sides.of_face
    is_tile = np.ones(len(surface.face_size), dtype=bool)
    is_tile[of_piece[~whole]] = False
    kept = is_tile[of_piece]
    return steps[kept].astype(np.int64), of_piece[kept], np.bincount(piece, minlength=len(piece))


def _basis(shifts: np.ndarray) -> tuple[tuple[int, int], ...] | None:
    """A reduced basis, of one or two periods, of the lattice that shifts (n, 2) generate, or None."""
    if len(shifts) > MOST_SHIFTS:
        return None
    (a, b), c = (0, 0), 0  # (a, b) and (0, c)
    for x, y in shifts.tolist():
        while x:
            q = a // x
            (a, b), (x, y) = (x, y), (a - q * x, b - q * y)
        c = math.gcd(c, y)
    one, two = (a, b), (0, c)
    if not any(one) or not any(two):
        only = one if any(one) else two
        basis: tuple[tuple[int, int], ...] = (_positive(only),)
    else:
        while True:  # Gauss
            if math.hypot(*one) > math.hypot(*two):
                one, two = two, one
            q = round((one[0] * two[0] + one[1] * two[1]) / (one[0] ** 2 + one[1] ** 2))
            if q == 0:
                break
            two = (two[0] - q * one[0], two[1] - q * one[1])
        one = _positive(one)
        if one[0] * two[1] - one[1] * two[0] < 0:
            two = (-two[0], -two[1])
        basis = (one, two)
    return basis if math.hypot(*basis[0]) >= SHORTEST * GRID else None


def _positive(vector: tuple[int, int]) -> tuple[int, int]:
    """The vector or its opposite, whichever points right, or up."""
    return vector if vector > (0, 0) else (-vector[0], -vector[1])


def fitting_pattern(periods: np.ndarray, size: float) -> Pattern:
    """The checker nearest to one with so many squares across the UV square that repeats after each of the periods (1 or
    2, 2), coarse squares included."""
    first = complex(*periods[0])
    if len(periods) == 1:
        scale = REPEAT * max(1, round(abs(first) * size / REPEAT)) / abs(first)
        turn = 1.0 if 0.0 in (first.real, first.imag) else first.conjugate() / abs(first)
        return _plain_if_so(size, np.array([scale * turn, 1j * scale * turn]))
    second = complex(*periods[1])
    inverse = np.linalg.inv(periods)  # rows: the UV axes in periods
    best, least = None, math.inf
    ideal = abs(first) * size
    for n in {max(1, round(ideal * factor / REPEAT)) for factor in np.geomspace(1.0 / FREEDOM, FREEDOM, 33)}:
        squares = REPEAT * n
        for image in _whole_near(second / first * squares):
            stretch = _stretch(inverse @ np.array([squares, image]))
            cost = math.log(stretch) + SIZE_WEIGHT * abs(math.log(squares / ideal))
            if cost < least:
                best, least = inverse @ np.array([squares, image]), cost
    assert best is not None
    return _plain_if_so(size, best)


def fits(pattern: Pattern, periods: np.ndarray) -> bool:
    """Whether a checker visibly repeats after each of the periods (k, 2)."""
    matrix = np.diag([pattern.size] * 2) if pattern.matrix is None else np.reshape(pattern.matrix, (2, 2))
    coarse = periods @ matrix.T / HALF
    whole = np.rint(coarse)
    return bool(np.abs(coarse - whole).max() < SEEN / HALF and (whole.sum(axis=1) % 2 == 0).all())


def _whole_near(wanted: complex) -> list[complex]:
    """Shifts near this one, upwards, after which the checker repeats."""
    u, v = round(wanted.real / HALF), max(1, round(wanted.imag / HALF))
    near = [(u + i, v + j) for i in (-1, 0, 1) for j in (-1, 0, 1) if v + j > 0]
    return [complex(HALF * a, HALF * b) for a, b in near if (a + b) % 2 == 0]


def _stretch(images: np.ndarray) -> float:
    """Ratio of the singular values of the linear map with these images of the axes."""
    values = np.linalg.svd(np.array([images.real, images.imag]), compute_uv=False)
    return float(values[0] / values[1])


def _plain_if_so(size: float, images: np.ndarray) -> Pattern:
    """The pattern with these images of the UV axes: a plain one if they are only scaled."""
    one, two = complex(images[0]), complex(images[1])
    if abs(two - 1j * one) < 1e-9 * abs(one) and abs(one.imag) < 1e-9 * abs(one):
        return Pattern(one.real)
    return Pattern(size, (one.real, two.real, one.imag, two.imag))
