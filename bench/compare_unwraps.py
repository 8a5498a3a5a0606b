# SPDX-License-Identifier: GPL-3.0-or-later
"""The unwraps that bench/compare.py sets side by side: vertices and triangles in, corner UVs (F, 3, 2) and seconds of
processor time out.

Nobody places a seam: each does what one click does. Blender's unwraps then cut closed surfaces nowhere.
"""

import math
import sys
import time
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "build" / "python"))


def timed(compute):
    """The result, and the processor time of all threads: what else the machine does counts little."""
    begin = time.process_time()
    result = compute()
    return result, time.process_time() - begin


def in_edit_mode(unwrap):
    """An operator of Blender on all of a mesh. Its time alone is taken."""

    def run(vertices, triangles):
        bpy.ops.wm.read_factory_settings(use_empty=True)
        mesh = bpy.data.meshes.new("Model")
        mesh.from_pydata(vertices.tolist(), [], triangles.tolist())
        obj = bpy.data.objects.new("Model", mesh)
        bpy.context.scene.collection.objects.link(obj)
        bpy.context.view_layer.objects.active = obj
        obj.select_set(True)
        mesh.uv_layers.new()
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
        seconds = timed(unwrap)[1]
        bpy.ops.object.mode_set(mode="OBJECT")
        uv = np.empty(2 * len(mesh.loops), np.float32)
        mesh.uv_layers.active.data.foreach_get("uv", uv)
        if len(mesh.polygons) != len(triangles):
            raise ValueError("Blender merges two faces of the same vertices")
        return uv.reshape(-1, 3, 2), seconds

    return run


def xatlas_charts(vertices, triangles):
    import xatlas

    (_, indices, uvs), seconds = timed(
        lambda: xatlas.parametrize(vertices.astype(np.float32), triangles.astype(np.uint32)))  # fmt: skip
    return uvs[indices], seconds


def one_map(vertices, triangles):
    import koebe

    result, seconds = timed(lambda: koebe.uniformize(vertices, triangles, cut=True))
    return (result.uv if result.uv.ndim == 3 else result.uv[triangles]), seconds


def in_parts(vertices, triangles):
    import koebe

    result, seconds = timed(lambda: koebe.parts(vertices, triangles))
    return result.uv, seconds


UNWRAPS = {
    "Smart UV": in_edit_mode(lambda: bpy.ops.uv.smart_project(angle_limit=math.radians(66.0), island_margin=0.001)),
    "Unwrap, Angle Based": in_edit_mode(lambda: bpy.ops.uv.unwrap(method="ANGLE_BASED", margin=0.001)),
    "Unwrap, Conformal": in_edit_mode(lambda: bpy.ops.uv.unwrap(method="CONFORMAL", margin=0.001)),
    "Unwrap, Minimum Stretch": in_edit_mode(lambda: bpy.ops.uv.unwrap(method="MINIMUM_STRETCH", margin=0.001)),
    "xatlas": xatlas_charts,
    "ours, one map": one_map,
    "ours, in parts": in_parts,
}
