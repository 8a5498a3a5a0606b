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


def main():
    bpy.ops.wm.obj_import(filepath=sys.argv[sys.argv.index("--") + 1])
    mesh = bpy.context.view_layer.objects.active.data
    mesh.uv_layers.new()
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
