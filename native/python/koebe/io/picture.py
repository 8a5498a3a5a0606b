"""Small pictures of maps, as notebooks show them: the outlines of what lies in the UVs."""

import numpy as np

from .corner_mesh import doubled

_SIDE, _MARGIN = 160, 2  # pixels
_MOST_EDGES = 6000  # 100 kB of SVG


def outline_svg(triangles: np.ndarray, corners: np.ndarray, side: float, drawn: np.ndarray) -> str:
    """The edges at which a map ends or is cut, as SVG.

    corners  (F, 3, 2) places of the triangles' corners   side   of the map's square, in the unit of the corners
    drawn    (F,) bool, the triangles that are in the map
    """
    ends = _outline(triangles[drawn], corners[drawn])
    ends = ends[:: max(1, -(-len(ends) // _MOST_EDGES))]
    known = ends.reshape(-1, 2) if len(ends) else np.array([[0.0, 0.0], [side, side]])
    low, high = np.minimum(known.min(axis=0), 0.0), np.maximum(known.max(axis=0), 0.0)
    size = np.maximum(high - low, 1e-3 * max(side, (high - low).max()))
    scale = (_SIDE - 2 * _MARGIN) / size.max()
    pixels = np.round(_MARGIN + scale * (ends - low) * [1.0, -1.0] + scale * np.array([0.0, size[1]]), 1)
    path = "".join(f"M{a:g} {b:g}L{c:g} {d:g}" for a, b, c, d in pixels.reshape(-1, 4).tolist())
    width, height = (int(np.ceil(scale * length)) + 2 * _MARGIN for length in size)
    return (
        f'<svg width="{width}" height="{height}" viewBox="0 0 {width} {height}" fill="none" stroke="#1d4e89" '
        f'stroke-width="0.8"><path d="{path}"/></svg>'
    )


def _outline(triangles: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """(E, 2, 2) the edges of triangles whose two ends no other triangle has in the same places."""
    count = int(triangles.max(initial=-1)) + 1
    _, own, _ = doubled(triangles, corners, count)
    edges = np.sort(np.stack([own, np.roll(own, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    _, first, times = np.unique(edges[:, 0] * (edges.max(initial=0) + 1) + edges[:, 1], True, return_counts=True)
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 2)[np.sort(first[times == 1])]
    return ends[np.isfinite(ends).all(axis=(1, 2))]
