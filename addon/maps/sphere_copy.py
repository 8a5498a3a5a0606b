# SPDX-License-Identifier: GPL-3.0-or-later
"""Mapped surfaces as spheres in space: the same faces, with each island on its own sphere."""

import dataclasses

import numpy as np

from .spheres import SphereOutcome

GAP = 0.1  # between two spheres, over the radius of the second


@dataclasses.dataclass(frozen=True)
class SphereCopy:
    """The islands of a surface on spheres: n vertices, p faces, c corners.

    points         (n, 3) in the surface's unit of length; the first sphere touches the plane x = 0 from the right, the
                   others follow along x
    corner_vertex  (c,) vertex of each corner
    corners        (c,) corner of the surface
    faces          (p,) face of the surface
    face_size      (p,) number of corners
    """

    points: np.ndarray
    corner_vertex: np.ndarray
    corners: np.ndarray
    faces: np.ndarray
    face_size: np.ndarray


def sphere_copy(outcome: SphereOutcome) -> SphereCopy:
    """The mapped islands of a surface. Each sphere has the area of its island."""
    surface, at, count = outcome.task.surface, 0.0, 0
    points, vertices = [], []
    for one in outcome.mapped:
        radius = float(np.sqrt(one.island.areas.sum() / (4.0 * np.pi)))
        points.append(radius * one.result.points + np.array([at + radius, 0.0, 0.0]))
        vertices.append(count + one.island.corner_vertex)
        at += (2.0 + GAP) * radius
        count += len(one.island.vertices)
    faces = np.concatenate([one.island.faces for one in outcome.mapped])
    return SphereCopy(
        np.concatenate(points), np.concatenate(vertices),
        np.concatenate([one.island.corners for one in outcome.mapped]), faces, surface.face_size[faces],
    )  # fmt: skip
