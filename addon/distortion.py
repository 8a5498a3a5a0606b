# SPDX-License-Identifier: GPL-3.0-or-later
"""How far the UVs of a surface are from its shape, face by face, and in which colour that is shown. No bpy."""

import numpy as np

from .surface import areas, signed_areas

ANGLE, AREA = "angle", "area"
# What the ends of the legend stand for: degrees from 0, and doublings of the texel density to either side of 0.
ANGLE_END, AREA_END = 10.0, 2.0
# sRGB colours at equal steps of the legend: for the angle as Blender's own stretch display, blue is good and red is
# bad; for the area blue has few texels, red has many.
ANGLE_RAMP = np.array(
    [(0.11, 0.27, 0.75), (0.10, 0.66, 0.78), (0.36, 0.76, 0.30), (0.96, 0.83, 0.20), (0.85, 0.15, 0.12)]
)
AREA_RAMP = np.array(
    [(0.13, 0.30, 0.70), (0.53, 0.70, 0.90), (0.93, 0.93, 0.91), (0.95, 0.66, 0.50), (0.72, 0.12, 0.14)]
)
NOT_MAPPED = (0.35, 0.35, 0.35)  # faces without an area in the UVs


def both_areas(surface, uv):
    """Area in space and signed area in the UVs (C, 2) of each triangle (T,)."""
    in_space = areas(surface.positions, surface.corner_vertex[surface.triangle_corners])
    return in_space, signed_areas(uv, surface.triangle_corners)


def texel_density(surface, uv):
    """Lengths in the UVs (C, 2) over lengths in space, in the mean over the selected faces' area; 0 without UVs."""
    chosen = surface.selected[surface.triangle_face]
    in_space, in_plane = (values[chosen].sum() for values in both_areas(surface, uv))
    return float(np.sqrt(abs(in_plane) / in_space)) if in_space > 0.0 else 0.0


def face_values(surface, uv, kind):
    """Distortion of each face (P,), NaN for those whose UVs have no area.

    ANGLE: the mean difference, in degrees, of the triangles' angles on the surface and in the UVs (C, 2).
    AREA: the logarithm to base 2 of the texel density over its mean, so that 1 means twice as many texels per length.
    """
    in_space, in_plane = both_areas(surface, uv)
    values = np.full(len(in_space), np.nan)
    mapped = (np.abs(in_plane) > 0.0) & (in_space > 0.0)
    if kind == ANGLE:
        corners = surface.triangle_corners[mapped]
        on_surface = _angles(surface.positions[surface.corner_vertex], corners)
        difference = on_surface - _angles(uv.astype(np.float64), corners)
        values[mapped] = np.degrees(np.abs(difference).mean(axis=1))
    else:
        mean = np.abs(in_plane[mapped]).sum() / max(in_space[mapped].sum(), np.finfo(float).tiny)
        values[mapped] = 0.5 * np.log2(np.abs(in_plane[mapped]) / in_space[mapped] / mean)
    return _mean_over_faces(surface, values, in_space)


def colors(values, kind):
    """sRGB colours (n, 3) of distortions (n,)."""
    where = values / ANGLE_END if kind == ANGLE else 0.5 + 0.5 * values / AREA_END
    ramp = ANGLE_RAMP if kind == ANGLE else AREA_RAMP
    stops = np.linspace(0.0, 1.0, len(ramp))
    found = np.stack([np.interp(where, stops, channel) for channel in ramp.T], axis=1)
    found[np.isnan(values)] = NOT_MAPPED
    return found


def linear(srgb):
    """Linear values of sRGB ones."""
    return np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)


def legend(kind):
    """Title, and (place from 0 to 1, text) of the marks."""
    if kind == ANGLE:
        return "Angle error", [(0.0, "0°"), (0.5, f"{ANGLE_END / 2:.0f}°"), (1.0, f"{ANGLE_END:.0f}°")]
    return "Texel density", [(0.0, "1/4"), (0.25, "1/2"), (0.5, "1"), (0.75, "2"), (1.0, "4")]


def _angles(points, corners):
    """Angles (m, 3) of triangles in space or in the plane."""
    sides = [np.linalg.norm(points[corners[:, i - 1]] - points[corners[:, i - 2]], axis=1) for i in range(3)]
    cosines = [
        (sides[i - 1] ** 2 + sides[i - 2] ** 2 - sides[i] ** 2) / (2.0 * sides[i - 1] * sides[i - 2]) for i in range(3)
    ]
    return np.arccos(np.clip(np.stack(cosines, axis=1), -1.0, 1.0))


def _mean_over_faces(surface, values, weight):
    known = ~np.isnan(values)
    face, count = surface.triangle_face[known], len(surface.face_size)
    total = np.bincount(face, weight[known], minlength=count)
    summed = np.bincount(face, weight[known] * values[known], minlength=count)
    return np.divide(summed, total, out=np.full(count, np.nan), where=total > 0.0)
