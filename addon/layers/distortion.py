# SPDX-License-Identifier: GPL-3.0-or-later
"""The distortion of a surface's UVs, face by face."""

import numpy as np

from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import areas, density_ratio, signed_areas

ANGLE, AREA = "angle", "area"


def both_areas(surface: Surface, uv: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Area in space and signed area in the UVs (C, 2) of each triangle (T,)."""
    in_space = areas(surface.positions, surface.corner_vertex[surface.triangle_corners])
    return in_space, signed_areas(uv, surface.triangle_corners)


def texel_figures(island: Island, uv: np.ndarray) -> dict[str, float]:
    """Evenness and coverage of an island with UVs (n, 2) at its vertices, named as in the report."""
    in_plane = np.abs(signed_areas(uv, island.triangles))
    return {"density": density_ratio(island.areas, in_plane), "coverage": float(in_plane.sum())}


def texel_density(surface: Surface, uv: np.ndarray) -> float:
    """Mean length in the UVs (C, 2) over length in space, over the selected faces' area; 0 without UVs."""
    chosen = surface.selected[surface.triangle_face]
    in_space, in_plane = (values[chosen].sum() for values in both_areas(surface, uv))
    return float(np.sqrt(abs(in_plane) / in_space)) if in_space > 0.0 else 0.0


def face_values(surface: Surface, uv: np.ndarray, kind: str) -> np.ndarray:
    """Distortion of each face (P,), NaN for faces without area in the UVs.

    ANGLE: the mean difference, in degrees, of the triangles' angles on the surface and in the UVs (C, 2). AREA: the
    logarithm to base 2 of the texel density over its mean, so that 1 means twice as many texels per length.
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


def _angles(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Angles (m, 3) of triangles in space or in the plane."""
    sides = [np.linalg.norm(points[corners[:, i - 1]] - points[corners[:, i - 2]], axis=1) for i in range(3)]
    cosines = [
        (sides[i - 1] ** 2 + sides[i - 2] ** 2 - sides[i] ** 2) / (2.0 * sides[i - 1] * sides[i - 2]) for i in range(3)
    ]
    return np.arccos(np.clip(np.stack(cosines, axis=1), -1.0, 1.0))


def _mean_over_faces(surface: Surface, values: np.ndarray, weight: np.ndarray) -> np.ndarray:
    known = ~np.isnan(values)
    face, count = surface.triangle_face[known], len(surface.face_size)
    total = np.bincount(face, weight[known], minlength=count)
    summed = np.bincount(face, weight[known] * values[known], minlength=count)
    return np.divide(summed, total, out=np.full(count, np.nan), where=total > 0.0)
