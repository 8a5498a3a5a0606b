# SPDX-License-Identifier: GPL-3.0-or-later
"""Times Blender's own conformal unwrap of one mesh: once for each line on standard input, seconds on standard output.

    blender -b --factory-startup --python-exit-code 1 -P bench/blender_unwrap.py -- MESH.obj

The operator alone: reading the mesh, selecting it and entering Edit Mode are not timed. Each line of the answer begins
with "seconds".
"""

import sys
import time

import bpy
import numpy as np


def read_obj(path):
    """Positions and triangles of an OBJ file."""
    positions, triangles = [], []
    with open(path) as lines:
        for line in lines:
            words = line.split()
            if words[:1] == ["v"]:
                positions.append([float(x) for x in words[1:4]])
            elif words[:1] == ["f"]:
                triangles.append([int(word.split("/")[0]) - 1 for word in words[1:]])
    return positions, triangles


def main():
    positions, triangles = read_obj(sys.argv[sys.argv.index("--") + 1])
    mesh = bpy.data.meshes.new("bench")
    mesh.from_pydata(positions, [], triangles)
    mesh.uv_layers.new()
    obj = bpy.data.objects.new("bench", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    for _ in sys.stdin:
        start = time.perf_counter()
        bpy.ops.uv.unwrap(method="CONFORMAL", fill_holes=True, margin=0.0)
        print("seconds", time.perf_counter() - start, flush=True)
    bpy.ops.object.mode_set(mode="OBJECT")
    uv = np.empty(2 * len(mesh.loops), np.float32)
    mesh.uv_layers.active.data.foreach_get("uv", uv)
    assert np.ptp(uv) > 0.1, "nothing was unwrapped"


main()
