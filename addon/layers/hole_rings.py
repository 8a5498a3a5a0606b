# SPDX-License-Identifier: GPL-3.0-or-later
"""Rings of faces around the holes of a circle domain: between circles that grow by a ratio, concentric to the hole."""

import numpy as np

from ..surfaces.moebius import own_center, to_middle
from ..surfaces.surface import Surface
from .circle_domain import CircleDomain

SMOOTHINGS = 4  # passes that take single faces back which stick out of their ring


def ring_edges(surface: Surface, domain: CircleDomain, hole: int, rings: int, ratio: float) -> np.ndarray:
    """The edges between the rings around a hole, by the hole's number from 1 on.

    A Möbius map brings the hole to the middle of the disk. There the circles are concentric to the hole and to the rim.
    Each is larger than the last by `ratio`. A face belongs to the ring in which its middle lies.
    """
    loop, island = domain.loops[hole], domain.island
    moved = to_middle(own_center(loop.center, loop.radius))
    _, radius = moved.circle(loop.center, loop.radius)
    with np.errstate(divide="ignore"):
        level = np.log(np.abs(moved.apply(domain.points)) / radius) / np.log(ratio)
    face, edge = _corner_faces(surface)[island.corners], surface.corner_edge[island.corners]
    count = len(surface.face_size)
    sums = np.bincount(face, weights=np.maximum(level, 0.0)[island.corner_vertex], minlength=count)
    band = np.clip(np.floor(sums / np.maximum(surface.face_size, 1)), 0, rings).astype(np.int64)
    here, there, crossed = _neighbours(face, edge, len(surface.seam))
    for _ in range(SMOOTHINGS):
        if not _smooth(band, here, there, surface.face_size):
            break
    return crossed[band[here] != band[there]]


def _corner_faces(surface: Surface) -> np.ndarray:
    return np.repeat(np.arange(len(surface.face_size)), surface.face_size)


def _neighbours(face: np.ndarray, edge: np.ndarray, edges: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Faces at both sides of each edge that has two, and the edges."""
    low, high = np.full(edges, np.iinfo(np.int64).max), np.full(edges, -1)
    np.minimum.at(low, edge, face)
    np.maximum.at(high, edge, face)
    crossed = np.flatnonzero((high >= 0) & (low != high))
    return low[crossed], high[crossed], crossed


def _smooth(band: np.ndarray, here: np.ndarray, there: np.ndarray, size: np.ndarray) -> bool:
    """Move the faces that have more than half of their edges at the ring further in into that ring. Whether any has
    moved."""
    inward = np.bincount(here[band[there] < band[here]], minlength=len(band))
    inward += np.bincount(there[band[here] < band[there]], minlength=len(band))
    out = 2 * inward > size
    band[out] -= 1
    return bool(out.any())
