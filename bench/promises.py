# SPDX-License-Identifier: GPL-3.0-or-later
"""What a map promises, checked from its UVs and its report alone, without the library. NumPy only."""

import numpy as np

ON_CIRCLE = 2e-6  # a loop vertex that is farther from its circle must be listed
RESOLUTION = 1e-6  # faces whose longest edge is shorter are not told apart by 32-bit UVs
BLOCK = 2_000_000  # pairs of edges looked at in one go


def broken(triangles, result):
    """Names of the promises that a result breaks."""
    uv = result.uv
    if not np.isfinite(uv).all():
        return ["not finite"]
    found = []
    if np.hypot(*uv.T).max() > 1 + 1e-12:
        found.append("outside the disk")
    found += broken_circles(result.centers @ [1, 1j], result.radii)
    for loop, off, center, radius in zip(result.loops, result.off_circle, result.centers, result.radii):
        away = np.abs(np.linalg.norm(uv[loop] - center, axis=1) - radius) > ON_CIRCLE
        if set(loop[away].tolist()) - set(off.tolist()):
            found.append("off its circle and not listed")
            break
    triangles = np.array(triangles)
    for warning in result.warnings:
        if warning.kind == "reoriented_faces":
            triangles[warning.elements] = triangles[warning.elements, ::-1]
    area, longest = as_stored(uv, triangles)
    flipped = ~(area > 0)
    if flipped.sum() != result.flipped:
        found.append("flips not counted as stored")
    if (flipped & (longest >= RESOLUTION)).any():
        found.append("flipped")
    if crossings(uv, result.loops):
        found.append("loops cross")
    if any(turned_over(uv[loop]) for loop in result.loops[1:]):
        found.append("hole turned over")
    return found


def broken_circles(center, radius):
    if not (np.isfinite(radius).all() and np.isfinite(center).all() and (radius > 0).all()):
        return ["circle not positive"]
    found = []
    if (np.abs(center[1:]) + radius[1:] > 1 + 1e-9).any():
        found.append("circle not in the disk")
    gap = np.abs(center[1:, None] - center[None, 1:]) - (radius[1:, None] + radius[None, 1:]) * (1 - 1e-9)
    np.fill_diagonal(gap, 1)
    if (gap < 0).any():
        found.append("circles meet")
    return found


def as_stored(uv, triangles):
    """Twice the area, and the longest edge, of each face with u and v in [0, 1] rounded to 32 bits."""
    a, b, c = ((1 + uv) / 2).astype(np.float32).astype(float)[triangles.T]
    area = (b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]
    longest = np.max([np.linalg.norm(side, axis=1) for side in (b - a, c - b, a - c)], axis=0)
    return area, longest


def crossings(uv, loops):
    """Pairs of boundary edges that cross; edges below resolution are left out."""
    start = np.concatenate([uv[loop] for loop in loops])
    end = np.concatenate([uv[np.roll(loop, -1)] for loop in loops])
    long = np.linalg.norm(end - start, axis=1) > 2 * RESOLUTION
    start, end = start[long], end[long]
    low, high = np.minimum(start, end), np.maximum(start, end)
    count, step = 0, max(1, BLOCK // max(len(start), 1))
    for first in range(0, len(start), step):
        part = slice(first, first + step)
        near = (low[part, None] <= high[None]).all(axis=2) & (high[part, None] >= low[None]).all(axis=2)
        i, j = np.nonzero(near)
        i += first
        a, b, c, d = start[i], end[i], start[j], end[j]
        count += int(((side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)).sum())
    return count // 2


def turned_over(points):
    """Whether a hole's loop runs counterclockwise: the map covers the hole. Loops below resolution do not count."""
    x, y = (points - points[0]).T
    ahead = np.roll(points, -1, axis=0) - points
    area = (x * np.roll(y, -1) - y * np.roll(x, -1)).sum()
    return np.linalg.norm(ahead, axis=1).max() >= 2 * RESOLUTION and area > 0


def side(a, b, c):
    """On which side of the line through a and b the points c are."""
    return np.sign((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
