# SPDX-License-Identifier: GPL-3.0-or-later
"""Vertices that lie close together, joined in a surface and not in its mesh."""

import dataclasses
from types import ModuleType

import numpy as np

from .surface import Surface, next_corners


def joined(koebe: ModuleType, surface: Surface, distance: float) -> tuple[Surface, np.ndarray]:
    """The surface with vertices joined that lie within a distance, and the vertex (V,) that each one is joined to.

    Edges with the same ends are one, which is a seam if one of them was. A face that would name a vertex twice is not
    selected any more.
    """
    first = koebe.weld(surface.positions, distance)
    vertex = first[surface.corner_vertex].astype(np.int32)
    ends = np.sort(np.stack([vertex, vertex[next_corners(surface)]]).astype(np.int64), axis=0)
    _, one, number = np.unique(ends[0] * len(first) + ends[1], return_index=True, return_inverse=True)
    edge = surface.corner_edge[one[number]]
    seam = surface.seam.copy()
    seam[edge[surface.seam[surface.corner_edge]]] = True
    face = np.repeat(np.arange(len(surface.face_size)), surface.face_size)
    order = np.lexsort((vertex, face))
    twice = (np.diff(face[order]) == 0) & (np.diff(vertex[order]) == 0)
    selected = surface.selected.copy()
    selected[face[order][1:][twice]] = False
    return (
        dataclasses.replace(surface, corner_vertex=vertex, corner_edge=edge, seam=seam, selected=selected), first
    )  # fmt: skip
