"""Coordinates of a circle domain, and measures of a map at each vertex and face. NumPy only."""

from typing import Any

import numpy as np

from ._arrays import as_points
from ._types import Floats, Whole
from .errors import InputError


def disk_to_uv(points: Any) -> Floats:
    """Compute UVs (n, 2) in [0, 1]^2 of points (n, 2) of the unit disk: u = (1 + x) / 2, v = (1 + y) / 2.

    >>> import koebe
    >>> koebe.disk_to_uv([[0, 0], [1, 0]])
    array([[0.5, 0.5],
           [1. , 0.5]])
    """
    return 0.5 * (1.0 + as_points(points, "points", 2))


def uv_to_disk(uv: Any) -> Floats:
    """Compute points (n, 2) of the unit disk at UVs (n, 2): the inverse of disk_to_uv. Radius 1 is UVs' 1/2.

    >>> import koebe
    >>> koebe.uv_to_disk([[0.5, 0.5], [1, 0.5]])
    array([[0., 0.],
           [1., 0.]])
    """
    given = as_points(uv, "uv", 2)
    if (np.abs(given) > 0.25 * np.finfo(float).max).any():
        raise InputError("uv have a number beyond floating point")
    return 2.0 * given - 1.0


def log_scale(vertices: Floats, triangles: Whole, uv: Floats) -> Floats:
    """(V,) log of the map's scale at each vertex, disk lengths per surface length: half the log of the ratio of the
    areas of the faces around it. NaN at unused vertices, and where an area vanishes."""
    return log_scale_of_corners(vertices, triangles, uv[triangles])


def log_scale_of_corners(vertices: Floats, triangles: Whole, uv: Floats) -> Floats:
    """The same for UVs (F, 3, 2) of corners."""
    on_surface, in_disk = (
        _around(triangles, len(vertices), np.abs(areas(corners))) for corners in (vertices[triangles], uv)
    )
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = 0.5 * np.log(in_disk / on_surface)
    return np.where(np.isfinite(scale), scale, np.nan)


def face_angle_error_deg(vertices: Floats, triangles: Whole, uv: Floats) -> Floats:
    """(F,) mean |angle in the UVs - angle on the surface| of each face's corners, degrees; NaN without area."""
    with np.errstate(divide="ignore", invalid="ignore"):
        error = np.degrees(np.abs(_angles(vertices[triangles]) - _angles(uv[triangles])).mean(axis=1))
    return np.where(areas(vertices[triangles]) > 0.0, error, np.nan)


def _angles(corners: Floats) -> Floats:
    """(F, 3) angles of triangles (F, 3, d)."""
    sides = np.linalg.norm(np.roll(corners, -1, axis=1) - corners, axis=2)  # from each corner to the next
    here, before, across = sides, np.roll(sides, 1, axis=1), np.roll(sides, -1, axis=1)
    return np.arccos(np.clip((here**2 + before**2 - across**2) / (2.0 * here * before), -1.0, 1.0))


def areas(corners: Floats) -> Floats:
    """(F,) areas of triangles (F, 3, d) in space or, signed, in the plane."""
    a, b, c = (corners[:, k] for k in range(3))
    if corners.shape[2] == 2:
        (ux, uy), (vx, vy) = (b - a).T, (c - a).T
        return 0.5 * (ux * vy - uy * vx)
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def _around(triangles: Whole, vertex_count: int, values: Floats) -> Floats:
    return np.asarray(np.bincount(triangles.ravel(), np.repeat(values, 3), minlength=vertex_count), np.float64)
