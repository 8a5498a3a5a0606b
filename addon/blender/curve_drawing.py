# SPDX-License-Identifier: GPL-3.0-or-later
"""The closed curves of a curve or text object as an SVG drawing."""

from typing import Any

import bpy
import numpy as np

from . import compat
from .errors import TransferError

KINDS = {"CURVE", "FONT"}  # of objects that are drawings


def curve_drawing(name: str) -> str:
    """The text of an SVG file with the outlines of the object of that name, as it lies in its own plane.

    Its thickness, fill and modifiers do not count. Raises TransferError.
    """
    obj = bpy.data.objects.get((name, None)) if name else None
    if obj is None or obj.type not in KINDS:
        raise TransferError("choose a curve or a text object as the pattern")
    points, edges = _polylines(obj)
    points = points[:, :2] * np.array(obj.matrix_world.to_scale()[:2])
    loops = _closed_loops(len(points), edges)
    if not loops:
        raise TransferError(f"{name}: it has no closed curve: make its curves cyclic")
    if not np.isfinite(points).all():
        raise TransferError(f"{name}: a point has a coordinate that is not a finite number")
    path = "".join("M" + "L".join(f"{x!r} {-y!r}" for x, y in points[loop].tolist()) + "Z" for loop in loops)
    return f'<svg xmlns="http://www.w3.org/2000/svg"><path fill-rule="evenodd" d="{path}"/></svg>'


def _polylines(obj: bpy.types.Object) -> tuple[np.ndarray, np.ndarray]:
    """Points (n, 3) and edges (e, 2) of the curves, in the object's space."""
    data: Any = obj.data.copy()
    probe = bpy.data.objects.new("Koebe Drawing", data)
    try:
        data.bevel_depth = data.extrude = 0.0
        data.bevel_mode, data.bevel_object, data.taper_object = "ROUND", None, None
        data.dimensions, data.fill_mode = "2D", "NONE"
        mesh = probe.to_mesh()
        if mesh is None:
            return np.zeros((0, 3)), np.zeros((0, 2), dtype=np.int32)
        points = compat.vertex_positions(mesh).astype(np.float64)
        return points, compat.read_indices(mesh.edges, "vertices", 2)
    finally:
        probe.to_mesh_clear()
        bpy.data.objects.remove(probe)
        data.id_data.user_clear()
        bpy.data.curves.remove(data)


def _closed_loops(count: int, edges: np.ndarray) -> list[list[int]]:
    """The vertices of each closed line; lines with an end or a fork are left out."""
    beside: list[list[int]] = [[] for _ in range(count)]
    for a, b in edges.tolist():
        beside[a].append(b)
        beside[b].append(a)
    seen, loops = [False] * count, []
    for first in range(count):
        line, now = [], first
        while not seen[now] and len(beside[now]) == 2:
            seen[now] = True
            line.append(now)
            now = next((other for other in beside[now] if not seen[other]), first)
        if len(line) > 2 and now == first and first in beside[line[-1]]:
            loops.append(line)
    return loops
