# SPDX-License-Identifier: GPL-3.0-or-later
"""Chooses the vertices for the centre of the disk and for its rightmost point."""

from collections.abc import Sequence

import numpy as np

from ..surfaces.errors import MapError
from ..surfaces.surface import Island
from .outcomes import Place


def centers(islands: Sequence[Island], place: Place) -> list[int | None]:
    """The vertex of each island for 0: the mesh's vertex `place`, or the vertex nearest to that place.

    A place counts for one island only. Raises nothing: `check_center` judges the vertex.
    """
    return _vertices(islands, place, rim=False)


def points(islands: Sequence[Island], place: Place) -> list[int | None]:
    """The boundary vertex of each island for 1, as in `centers`."""
    return _vertices(islands, place, rim=True)


def check_center(island: Island, vertex: int) -> None:
    """Raise MapError if it lies on the boundary."""
    if _on_rim(island)[vertex]:
        raise MapError(
            f"vertex {island.source_vertex[vertex]} cannot be the centre: it is on a boundary or a seam. "
            "Choose a vertex inside"
        )


def check_point(island: Island, vertex: int) -> None:
    """Raise MapError if it lies inside."""
    if not _on_rim(island)[vertex]:
        raise MapError(
            f"vertex {island.source_vertex[vertex]} cannot be the rim point: it is inside. "
            "Choose a vertex of a boundary"
        )


def _vertices(islands: Sequence[Island], place: Place, rim: bool) -> list[int | None]:
    if place is None:
        return [None] * len(islands)
    if isinstance(place, int):
        found = [np.flatnonzero(island.source_vertex == place) for island in islands]
        return [int(here[0]) if len(here) else None for here in found]
    nearest = [_nearest(island, place, rim) for island in islands]
    first = min(range(len(islands)), key=lambda i: nearest[i][0])
    return [vertex if i == first else None for i, (_, vertex) in enumerate(nearest)]


def _nearest(island: Island, place: np.ndarray, rim: bool) -> tuple[float, int | None]:
    """Distance and number of the island's nearest vertex on its boundary, or inside it."""
    chosen = np.flatnonzero(_on_rim(island) == rim)
    if not len(chosen):
        return np.inf, None
    away = np.linalg.norm(island.vertices[chosen] - place, axis=1)
    away[~np.isfinite(away)] = np.inf
    best = int(np.argmin(away))
    return float(away[best]), int(chosen[best])


def _on_rim(island: Island) -> np.ndarray:
    """Whether each vertex lies on an edge of only one face, or on no edge."""
    ends = np.sort(np.concatenate([island.triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges, uses = np.unique(ends, axis=0, return_counts=True)
    result = np.zeros(len(island.vertices), dtype=bool)
    result[edges[uses == 1]] = True
    return result
