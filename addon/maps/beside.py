# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the new islands of selected faces beside the islands of the other faces, which stay where they are."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..layers.distortion import both_areas
from ..layers.packing import fit_placement
from ..layers.uv_density import mean_density
from ..surfaces.surface import Island, Surface
from ..surfaces.triangles import signed_areas
from ..surfaces.uv_islands import uv_islands, vertex_uv
from .outcomes import Task

SAMPLES = 1000  # middles of triangles that are looked up, where islands lie over themselves
SAME_SIZE = 0.995  # share of the wanted size that counts as all of it
NO_ROOM = "no room beside the islands of the other faces: the new ones lie to the right of the UV square"
PINNED_OVER = "islands with pins lie over each other, or over other islands"
OVER = "it lies over the islands of the other faces"


@dataclasses.dataclass(frozen=True)
class Beside:
    """UVs (m, 2) of the new corners. @param share of the size that they should have"""

    uv: np.ndarray
    share: float
    has_room: bool = True

    @property
    def remark(self) -> str:
        """What to watch out for, or empty."""
        if not self.has_room:
            return NO_ROOM
        if self.share >= SAME_SIZE:
            return ""
        return f"the free room beside the other islands takes the new ones at {100.0 * self.share:.0f} % of their size"


def put_beside(
    koebe: ModuleType,
    task: Task,
    corners: np.ndarray,
    uv: np.ndarray,
    margin: float,
    pixels: int,
    keep_size: bool = False,
    cancel: Any = None,
) -> Beside | None:
    """The new islands in the free room of the UV square, at the texel density of the islands that stay, or smaller.

    corners, uv  (m,), (m, 2) of the new islands. Their relative sizes and their form stay
    margin       in pixels of a texture with this side
    keep_size    they have the size that is wanted

    None if nothing is in the way: no face beside them has an area in the UVs. Raises koebe.Cancelled.
    """
    if task.rest is None:
        return None
    surface, triangles = task.surface, task.surface.triangle_corners
    layer = task.rest.astype(np.float64)
    layer[corners] = uv
    is_new = np.zeros(len(layer), dtype=bool)
    is_new[corners] = True
    new = is_new[triangles].all(axis=1)
    area = both_areas(surface, layer)[1]
    stays = ~new & np.isfinite(area) & (area != 0.0)
    if not stays.any() or not new.any():
        return None
    if not keep_size:
        layer[corners] *= _density(task, layer, stays) / _density(task, layer, new)
    chosen = new | stays
    # The new islands have vertices of their own, so that none is taken for a part of an island that stays.
    count = len(surface.positions)
    vertices = surface.corner_vertex[triangles] + count * new[:, None]
    try:
        made = koebe.pack(
            np.concatenate([surface.positions, surface.positions]), vertices[chosen], uv=layer[triangles[chosen]],
            polygon=surface.triangle_face[chosen], locked=stays[chosen], margin=margin, pixels=pixels, cancel=cancel,
        )  # fmt: skip
    except koebe.InputError:  # there is no free room
        right = max(1.0, float(np.ceil(layer[triangles[stays], 0].max())))
        place = layer[corners]
        return Beside(place - place.min(axis=0) + (right, 0.0), 1.0, has_room=False)
    layer[triangles[chosen]] = made.uv
    return Beside(layer[corners], made.scale)


def _density(task: Task, layer: np.ndarray, chosen: np.ndarray) -> float:
    """The mean density of some triangles (T,) bool."""
    surface = task.surface
    some = dataclasses.replace(
        surface, selected=np.ones_like(surface.selected), triangle_corners=surface.triangle_corners[chosen],
        triangle_face=surface.triangle_face[chosen],
    )  # fmt: skip
    return mean_density(some, layer)


def in_place(task: Task, corners: np.ndarray, uv: np.ndarray) -> np.ndarray | None:
    """Each new island where its faces lay in the layer: the same middle, size and turn, as well as a similarity can.

    If they lay in several islands, it goes where the largest of them was.

    corners, uv  (m,), (m, 2) of the new islands

    None if an island had no place.
    """
    if task.old_uv is None:
        return None
    layer = np.full(task.old_uv.shape, np.nan)
    layer[corners] = uv
    is_new = np.zeros(len(layer), dtype=bool)
    is_new[corners] = True
    surface = dataclasses.replace(task.surface, selected=is_new[task.surface.face_start])
    for island in uv_islands(surface, layer):
        at = _largest_place(task.surface, island, task.old_uv)
        placement = fit_placement(layer[at], task.old_uv[at].astype(np.float64))
        if placement is None:
            return None
        layer[island.corners] = placement.apply(layer[island.corners])
    return layer[corners]


def _largest_place(surface: Surface, island: Island, old_uv: np.ndarray) -> np.ndarray:
    """The corners of an island that lay in the largest of its old islands."""
    inside = np.zeros(len(surface.face_size), dtype=bool)
    inside[island.faces] = True
    old = uv_islands(dataclasses.replace(surface, selected=inside), old_uv)
    if len(old) < 2:
        return island.corners
    largest = max(old, key=lambda one: np.abs(signed_areas(vertex_uv(one, old_uv), one.triangles)).sum())
    return largest.corners


def new_overlaps(koebe: ModuleType, surface: Surface, layer: np.ndarray, corners: np.ndarray) -> bool:
    """Whether the new islands lie over each other, or over islands that stay.

    layer    (C, 2) of all UVs; NaN where there is no island
    corners  (m,) of the new islands

    False, too, if only islands that stay lie over each other, or an island over itself.
    """
    is_new = np.zeros(len(layer), dtype=bool)
    is_new[corners] = True
    area = both_areas(surface, layer.astype(np.float64))[1]
    there = np.isfinite(area) & (area != 0.0)
    others = there & ~is_new[surface.triangle_corners].all(axis=1)

    def overlap(chosen: np.ndarray, together: bool) -> bool:
        at = surface.triangle_corners[chosen]
        faces = surface.triangle_face[chosen]
        made = koebe.pack(
            surface.positions, surface.corner_vertex[at], uv=layer[at].astype(np.float64),
            polygon=np.zeros_like(faces) if together else faces, locked=np.ones(len(faces), dtype=bool),
        )  # fmt: skip
        return bool(made.overlaps)

    if not overlap(there, True):
        return False
    if overlap(there, False) or (others.any() and overlap(others, True)):
        return _new_lies_over(surface, layer.astype(np.float64), there, ~others)
    return True


def _new_lies_over(surface: Surface, layer: np.ndarray, there: np.ndarray, new: np.ndarray) -> bool:
    """Whether the middle of a triangle lies in a triangle of another island, and one of the two is new.

    there, new  (T,) bool. Of many triangles some stand for all
    """
    of_face = np.full(len(surface.face_size), -1)
    inside = np.zeros(len(of_face), dtype=bool)
    inside[surface.triangle_face[there]] = True
    for number, island in enumerate(uv_islands(dataclasses.replace(surface, selected=inside), layer)):
        of_face[island.faces] = number
    own, new = of_face[surface.triangle_face[there]], new[there]
    corners = layer[surface.triangle_corners[there]]
    low, high = corners.min(axis=1), corners.max(axis=1)
    for t in np.unique(np.linspace(0, len(own) - 1, SAMPLES, dtype=np.int64)):
        middle = corners[t].mean(axis=0)
        near = np.flatnonzero((own != own[t]) & ((low < middle) & (middle < high)).all(axis=1) & (new | new[t]))
        to = corners[near] - middle
        sides = np.stack([to[:, k, 0] * to[:, k - 2, 1] - to[:, k, 1] * to[:, k - 2, 0] for k in range(3)])
        if ((sides > 0.0).all(axis=0) | (sides < 0.0).all(axis=0)).any():
            return True
    return False
