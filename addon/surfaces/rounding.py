# SPDX-License-Identifier: GPL-3.0-or-later
"""Rounds UV coordinates to 32 bits without turning triangles over.

Along a rim with neighbours s apart, a triangle of three of them is s²/2 high. The solver leaves enough height for the
unit square, but an island that is turned and shrunk is rounded anew.
"""

import itertools
from collections.abc import Container

import numpy as np

from .triangles import flipped_triangles, longest_edges, signed_areas

# UV units: a shorter edge is at most a dozen steps of a 32-bit number near 1, so a triangle without a longer edge
# cannot be drawn. As in the native report.
RESOLUTION = 1e-6
MOST = 500  # number of triangles to repair
REACH = 3  # units in the last place that a coordinate may move
STEPS = sorted(itertools.product(range(-REACH, REACH + 1), repeat=2), key=lambda step: step[0] ** 2 + step[1] ** 2)


def rounded(
    points: np.ndarray, triangles: np.ndarray, held: Container[int] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 2) in 32 bits, and which triangles (m, 3) are then flipped.

    If rounding turns a triangle over, one of its vertices moves to the nearest neighbour in the grid of 32-bit numbers
    where all triangles around it are right. The vertices `held` do not move.
    """
    uv = points.astype(np.float32)
    flipped = flipped_triangles(triangles, uv)
    some = flipped[: 4 * MOST]
    turned = some[_worth_it(points, triangles[some])]
    if not 0 < len(turned) <= MOST:
        return uv, flipped
    near = np.zeros(len(points), dtype=bool)
    near[triangles[turned]] = True
    around: dict[int, list[list[int]]] = {}
    for corners in triangles[near[triangles].any(axis=1)].tolist():
        for vertex in corners:
            around.setdefault(vertex, []).append(corners)
    for t in turned:
        _turn_back(uv, triangles[t].tolist(), around, held)
    return uv, flipped_triangles(triangles, uv)


def _worth_it(points: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Which triangles (k, 3) are right before rounding, and large enough to be drawn."""
    return (signed_areas(points, triangles) > 0.0) & (longest_edges(points[triangles]) >= RESOLUTION)


def _turn_back(
    uv: np.ndarray, corners: list[int], around: dict[int, list[list[int]]], held: Container[int]
) -> None:
    """Move one corner of a triangle by the fewest units in the last place that turn it back."""
    if _area(uv, corners) > 0.0:
        return
    for step in STEPS[1:]:
        for vertex in (one for one in corners if one not in held):
            before = uv[vertex].copy()
            uv[vertex] = before + np.array(step, dtype=np.float32) * np.spacing(np.abs(before))
            if all(_area(uv, triangle) > 0.0 for triangle in around[vertex]):
                return
            uv[vertex] = before


def _area(uv: np.ndarray, corners: list[int]) -> float:
    """Twice the signed area of one triangle, in 64 bits."""
    (ax, ay), (bx, by), (cx, cy) = (uv[vertex].tolist() for vertex in corners)
    return (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
