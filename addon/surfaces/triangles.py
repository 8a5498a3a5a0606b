# SPDX-License-Identifier: GPL-3.0-or-later
"""Areas and edges of triangles in space and in the plane, and points of the plane as complex numbers."""

from collections.abc import Iterator

import numpy as np

# Triangles per block: intermediate values then stay in the processor's cache, and need no new memory.
BLOCK = 1 << 13


def blocks(count: int) -> Iterator[slice]:
    """Slices of at most BLOCK items that cover `count` items."""
    return (slice(first, first + BLOCK) for first in range(0, count, BLOCK))


def areas(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Area (t,) of triangles in space."""
    result = np.empty(len(triangles))
    for part in blocks(len(triangles)):
        a, b, c = (positions.take(corner, axis=0) for corner in triangles[part].T)
        result[part] = spanned_areas(b - a, c - a)
    return result


def spanned_areas(one: np.ndarray, two: np.ndarray) -> np.ndarray:
    """Area (t,) of the triangles between pairs of edge vectors (t, 3)."""
    (x, y, z), (s, t, u) = one.T, two.T
    return 0.5 * np.sqrt((y * u - z * t) ** 2 + (z * s - x * u) ** 2 + (x * t - y * s) ** 2)


def signed_areas(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Area (t,) of triangles in the plane, positive if counter-clockwise, in 64 bits for any points."""
    result, z = np.empty(len(triangles)), as_complex(points)
    for part in blocks(len(triangles)):
        a, b, c = (z.take(corner) for corner in triangles[part].T)
        result[part] = 0.5 * (np.conj(b - a) * (c - a)).imag
    return result


def density_ratio(in_space: np.ndarray, in_plane: np.ndarray) -> float:
    """Texel density (a length over a length) at 95 % of the area over that at 5 %, from areas (t,) of triangles."""
    known = (in_space > 0.0) & (in_plane > 0.0)
    if not known.any():
        return 1.0
    order = np.argsort(in_plane[known] / in_space[known])
    share = np.cumsum(in_space[known][order])
    low, high = np.searchsorted(share, np.array([0.05, 0.95]) * share[-1])
    ratio = (in_plane[known] / in_space[known])[order]
    return float(np.sqrt(ratio[high] / ratio[low]))


def covered(corner_uv: np.ndarray, triangles: np.ndarray) -> float:
    """Share of the UV square that triangles (t, 3) of corners (C, 2) take."""
    return float(np.abs(signed_areas(corner_uv, triangles)).sum())


def longest_edges(corners: np.ndarray) -> np.ndarray:
    """Length (t,) of the longest edge of each triangle, given by its corners (t, 3, 2)."""
    return np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1, initial=0.0)


def as_complex(points: np.ndarray) -> np.ndarray:
    """Points (n, 2) as complex numbers (n,) of 64-bit parts."""
    return np.ascontiguousarray(points, dtype=np.float64).view(np.complex128)[:, 0]


def as_points(z: np.ndarray) -> np.ndarray:
    """Complex numbers (n,) as points (n, 2)."""
    return np.ascontiguousarray(z, dtype=np.complex128)[:, None].view(np.float64)


def flipped_triangles(triangles: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """Which triangles (m, 3) have no positive signed area in 32-bit UVs (n, 2) of the vertices."""
    return np.flatnonzero(signed_areas(uv, triangles) <= 0.0)
