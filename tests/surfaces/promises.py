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
    corners = ((1 + uv) / 2)[triangles]
    found += untrue(result, result.surface[0], triangles, corners)
    area, longest = as_stored(corners)
    if (~(area > 0) & (longest >= RESOLUTION)).any():
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


def untrue(report, vertices, triangles, corners, left_out=()):
    """Figures of a report that the stored UVs (F, 3, 2) of the corners do not have. Triangles as the map has them."""
    report = report if isinstance(report, dict) else report.to_dict()
    known = verdict(vertices, triangles, corners, left_out)
    found = [name for name in ("flipped", "below_resolution") if report[name] != known[name]]
    if abs(report["lost_area"] - known["lost_area"]) > 1e-9:
        found.append("lost_area")
    told, error = report["angle_error_stored_deg"], known["angle_error_stored_deg"]
    if any(abs(told[key] - error[key]) > 1e-4 for key in ("mean", "sd", "max")):
        found.append("angle_error_stored_deg")
    return found


def verdict(vertices, triangles, corners, left_out=()):
    """lost_area, angle_error_stored_deg, flipped and below_resolution of the stored UVs (F, 3, 2) of the corners."""
    space = vertices[triangles] / max(np.abs(vertices[triangles]).max(), 1e-300)
    sides = np.roll(space, -1, axis=1) - space
    full = np.linalg.norm(np.cross(sides[:, 0], -sides[:, 2]), axis=1)  # twice the area
    mapped = ~np.isin(np.arange(len(triangles)), left_out)
    area, longest = as_stored(corners)
    flipped = mapped & ~(area > 0)
    lost = flipped | (~mapped & (area == 0))
    has_angles = mapped & (full > 1e-10 * (sides**2).sum(axis=2).max(axis=1))
    error = np.abs(angles(corners.astype(np.float32).astype(float)) - angles(space))[has_angles]
    return {
        "lost_area": full[lost].sum() / full.sum() if full.sum() > 0 else 0.0,
        "angle_error_stored_deg": {
            "mean": error.mean() if error.size else 0.0,
            "sd": error.std() if error.size else 0.0,
            "max": error.max(initial=0.0),
        },
        "flipped": int(flipped.sum()),
        "below_resolution": int((flipped & (longest < RESOLUTION)).sum()),
    }


def angles(points):
    """(F, 3) degrees of the triangles (F, 3, d); right ones at a side without length."""
    ahead, back = np.roll(points, -1, axis=1) - points, np.roll(points, 1, axis=1) - points
    dot = (ahead * back).sum(axis=2)
    if points.shape[2] == 2:
        cross = np.abs(ahead[..., 0] * back[..., 1] - ahead[..., 1] * back[..., 0])
    else:
        cross = np.linalg.norm(np.cross(ahead, back), axis=2)
    return np.degrees(np.where((dot == 0) & (cross == 0), np.pi / 2, np.arctan2(cross, dot)))


def as_stored(corners):
    """Twice the area, and the longest edge, of each face (F, 3, 2) with u and v rounded to 32 bits."""
    a, b, c = corners.astype(np.float32).astype(float).swapaxes(0, 1)
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
