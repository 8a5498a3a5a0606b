# SPDX-License-Identifier: GPL-3.0-or-later
"""Fits tiles to the periods of a repeated image, so that 32-bit UVs still differ by them to the last bit."""

import dataclasses

import numpy as np

from ..surfaces.errors import MapError

BITS = 24  # of a 32-bit float's significand
LONGEST = 1 << 12  # of a tile, in periods: a longer one leaves too few bits for each period


@dataclasses.dataclass(frozen=True)
class FittedTile:
    """A tile as 32-bit UVs store it: all coordinates are whole multiples of `grid`.

    uv       (t, 3, 2) of the triangles' corners
    periods  (k, 2), 64 bits
    move     the map from the former tile: x -> move[0] @ x + move[1]
    """

    uv: np.ndarray
    periods: np.ndarray
    grid: float
    move: tuple[np.ndarray, np.ndarray]


def fitted(uv: np.ndarray, triangles: np.ndarray, periods: np.ndarray, fit: str) -> FittedTile:
    """A tile of `koebe.torus_map` or `koebe.ring_map`, (t, 3, 2) and (k, 2), as the choice `fit` has it.

    Raises MapError if it is too long.
    """
    if fit == "inside":
        return FittedTile(uv.astype(np.float32), periods, 2.0**-BITS, (np.eye(2), np.zeros(2)))
    matrix, exact = _matrix(uv, periods, fit)
    # Take one place of each vertex, and the number of periods between it and its corners, so that they stay together.
    corner_vertex, corner_uv = triangles.ravel(), uv.reshape(-1, 2)
    vertices, first, number = np.unique(corner_vertex, return_index=True, return_inverse=True)
    number = number.reshape(-1)
    lift = np.rint(_in_periods(corner_uv - corner_uv[first][number], periods))
    places = corner_uv[first] @ matrix.T
    corners = places[number] + lift @ exact
    low, extent = corners.min(axis=0), float(np.ptp(corners, axis=0).max())
    if not extent < LONGEST:
        raise MapError("its tile is too long for Blender's UVs: choose Fit: Inside")
    grid = 2.0 ** (int(np.ceil(np.log2(extent * (1.0 + 2.0 ** (3 - BITS))))) - BITS)
    steps = np.rint(exact / grid).astype(np.int64)
    points = np.rint((places - low) / grid).astype(np.int64)[number] + lift.astype(np.int64) @ steps
    points -= (least := points.min(axis=0))
    moved = (points * grid).astype(np.float32).reshape(uv.shape)
    return FittedTile(moved, steps * grid, grid, (matrix, -low - least * grid))


def _matrix(uv: np.ndarray, periods: np.ndarray, fit: str) -> tuple[np.ndarray, np.ndarray]:
    """The linear map, and the resulting periods (k, 2), the first along u."""
    length = float(periods[0, 0])
    if not length > 1.0 / LONGEST:
        raise MapError("its tile is too long for Blender's UVs: choose Fit: Inside")
    if fit == "period":
        exact = periods / length
        exact[0] = (1.0, 0.0)
        return np.eye(2) / length, exact
    if len(periods) == 2:
        return np.linalg.inv(periods.T), np.eye(2)
    return np.diag([1.0 / length, 1.0 / float(np.ptp(uv[..., 1]))]), np.array([[1.0, 0.0]])


def _in_periods(difference: np.ndarray, periods: np.ndarray) -> np.ndarray:
    """The number (n, k) of each period in differences (n, 2)."""
    if len(periods) == 2:
        return difference @ np.linalg.inv(periods)
    return difference[:, :1] / periods[0, 0]
