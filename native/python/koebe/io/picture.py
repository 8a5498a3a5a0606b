"""Small pictures of results, as notebooks show them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from .._types import Bools, Floats, Whole
from .corner_mesh import doubled

_SIDE, _MARGIN = 160, 2  # pixels
_MOST_EDGES = 6000  # 100 kB of SVG
_MOST_POINTS = 2000
_BARS = 24  # of a histogram


def outline_svg(triangles: Whole, corners: Floats, side: float, drawn: Bools) -> str:
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


def _outline(triangles: Whole, corners: Floats) -> Floats:
    """(E, 2, 2) the edges of triangles whose two ends no other triangle has in the same places."""
    count = int(triangles.max(initial=-1)) + 1
    _, own, _ = doubled(triangles, corners, count)
    edges = np.sort(np.stack([own, np.roll(own, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    _, first, times = np.unique(edges[:, 0] * (edges.max(initial=0) + 1) + edges[:, 1], True, return_counts=True)
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2).reshape(-1, 2, 2)[np.sort(first[times == 1])]
    return ends[np.isfinite(ends).all(axis=(1, 2))]


def flat(corners: Floats) -> Floats:
    """Triangles (n, 3, 2), or those in space seen along their shortest axis."""
    if corners.shape[2] == 2 or not len(corners):
        return corners[..., :2]
    points = corners.reshape(-1, 3) - corners.mean(axis=(0, 1))
    return np.asarray((points @ np.linalg.svd(points, full_matrices=False)[2][:2].T).reshape(-1, 3, 2))


def histogram(values: Any) -> Floats:
    """(n, 2) bars from 0 to the counts of values, those that are finite; as many as there are labels, or 24."""
    known = np.asarray(values, np.float64).ravel()
    known = known[np.isfinite(known)]
    counts = np.histogram(known, bins=_BARS)[0] if len(known) else np.zeros(0)
    return np.column_stack([np.zeros(len(counts)), counts]).astype(np.float64)


def drawing_svg(drawing: Mapping[str, Any]) -> str:
    """A drawing of Result._drawing as SVG; nothing of an empty one."""
    if "corners" in drawing:
        given = np.asarray(drawing["corners"], np.float64)
        given = given[np.isfinite(given).all(axis=(1, 2))]
        corners = flat(given)
        if given.shape[2] == 3:  # a closed surface has no outline
            return drawing_svg({"points": np.unique(corners.reshape(-1, 2), axis=0)})
        corners = corners - corners.min(axis=(0, 1), initial=np.inf)
        number = np.unique(given.reshape(3 * len(given), -1), axis=0, return_inverse=True)[1]
        side = float(corners.max(initial=0.0)) or 1.0
        return outline_svg(number.reshape(-1, 3), corners, side, np.ones(len(given), bool))
    if "values" in drawing:
        drawing = {"bars": histogram(drawing["values"])}
    marks = ""
    if "circles" in drawing:
        low, high = np.array([-1.02, -1.02]), np.array([1.02, 1.02])
        for k, ((x, y), radius) in enumerate(zip(*drawing["circles"], strict=True)):
            fill = "#e8eef7" if k == 0 else "#fff"
            marks += f'<circle cx="{x:.6g}" cy="{-y:.6g}" r="{radius:.6g}" fill="{fill}"/>'
    elif "points" in drawing:
        points = np.asarray(drawing["points"], np.float64)
        points = points[np.isfinite(points).all(axis=1)]
        points = points[:: max(1, -(-len(points) // _MOST_POINTS))]
        low, high = points.min(axis=0, initial=np.inf), points.max(axis=0, initial=-np.inf)
        dot = 0.004 * float((high - low).max()) if len(points) else 0.0
        marks = "".join(f'<circle cx="{x:.6g}" cy="{-y:.6g}" r="{dot or 0.1:.3g}"/>' for x, y in points.tolist())
    elif len(bars := np.asarray(drawing.get("bars", ()), np.float64)):
        low, high = np.array([0.0, 0.0]), np.array([1.0, 1.0])
        begin, end = min(0.0, float(bars.min())), max(0.0, float(bars.max()))
        wide, tall = 1.0 / len(bars), 1.0 / ((end - begin) or 1.0)
        for k, (a, b) in enumerate(((bars - begin) * tall).tolist()):
            left, across = (k + 0.1) * wide, 0.8 * wide
            marks += f'<rect x="{left:.4g}" y="{-b:.6g}" width="{across:.4g}" height="{b - a:.6g}" fill="#1d4e89"/>'
    if not marks:
        return ""
    room = 0.02 * (float((high - low).max()) or 1.0)
    (x, y), (width, height) = low - room, high - low + 2.0 * room
    return (
        f'<svg width="{_SIDE}" height="{_SIDE}" viewBox="{x:.6g} {-y - height:.6g} {width:.6g} {height:.6g}" '
        f'stroke="#1d4e89" stroke-width="{0.3 * room:.3g}">{marks}</svg>'
    )
