# SPDX-License-Identifier: GPL-3.0-or-later
"""The unwraps that bench/compare.py sets side by side: vertices and triangles in, corner UVs (F, 3, 2) out, and the
processor seconds with what else the unwrap itself reports.

Nobody places a seam: each does what one click does. Blender's unwraps then cut closed surfaces nowhere.
"""

import math
import os
import resource
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "build" / "python"))


def timed(compute):
    """The result, and the processor time of all threads: what else the machine does counts little."""
    begin = time.process_time()
    result = compute()
    return result, {"seconds": time.process_time() - begin}


def in_edit_mode(unwrap):
    """An operator of Blender on all of a mesh. Its time alone is taken."""

    def run(vertices, triangles):
        import bpy

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
        facts = timed(lambda: unwrap(bpy.ops.uv))[1]
        bpy.ops.object.mode_set(mode="OBJECT")
        uv = np.empty(2 * len(mesh.loops), np.float32)
        mesh.uv_layers.active.data.foreach_get("uv", uv)
        if len(mesh.polygons) != len(triangles):
            raise ValueError("Blender merges two faces of the same vertices")
        return uv.reshape(-1, 3, 2), facts

    return run


def xatlas_charts(vertices, triangles):
    import xatlas

    def generate():
        atlas = xatlas.Atlas()
        atlas.add_mesh(vertices.astype(np.float32), triangles.astype(np.uint32))
        atlas.generate()
        return atlas

    atlas, facts = timed(generate)
    _, indices, uvs = atlas[0]
    size = np.array([atlas.width, atlas.height], float)  # its UVs are shares of the sides of its own rectangle
    return (uvs * size / size.max())[indices], {**facts, "texture": float(size.min() / size.max())}


def optcuts(vertices, triangles):
    """The program of OptCuts in its headless mode, with the options of its README: for one component without faults."""
    with tempfile.TemporaryDirectory() as folder:
        model = Path(folder) / "model.obj"
        write_obj(model, vertices, triangles)
        words = [os.environ["OPTCUTS"], "100", str(model), "0.999", "1", "0", "4.1", "1", "0"]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        done = subprocess.run(words, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
        found = list(Path(folder).glob("output/*/finalResult_mesh.obj"))
        if not found:
            if done.returncode in (-9, -24):
                raise TimeoutError("not done in time")
            raise RuntimeError(done.stdout.decode(errors="replace").strip().splitlines()[-1][:80])
        return corner_uvs(found[0], len(triangles)), {"seconds": seconds}


def write_obj(path, vertices, triangles):
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    lines += [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]
    path.write_text("\n".join(lines) + "\n")


def corner_uvs(path, faces):
    """UVs of the corners in an OBJ file of triangles, longest side 1."""
    words = [line.split() for line in path.read_text().splitlines()]
    uvs = np.array([line[1:3] for line in words if line[:1] == ["vt"]], float)
    corners = np.array([[int(word.split("/")[1]) - 1 for word in line[1:4]] for line in words if line[:1] == ["f"]])
    if len(corners) != faces:
        raise ValueError("other faces came out than went in")
    uv = uvs[corners] - uvs.min(axis=0)
    return uv / uv.max()


def one_map(vertices, triangles):
    import koebe

    result, facts = timed(lambda: koebe.uniformize(vertices, triangles, cut=True))
    return (result.uv if result.uv.ndim == 3 else result.uv[triangles]), facts


def in_parts(**options):
    """Ours in parts, at the more even end of the dial. "converged" is False where the command ends with exit code 4."""
    options = {"price": 0.0037, "darts": 0.2, **options}

    def run(vertices, triangles):
        import koebe

        result, facts = timed(lambda: koebe.parts(vertices, triangles, **options))
        return result.uv, {**facts, "converged": bool(result.converged)}

    return run


UNWRAPS = {
    "Smart UV": in_edit_mode(lambda uv: uv.smart_project(angle_limit=math.radians(66.0), island_margin=0.001)),
    "Unwrap, Angle Based": in_edit_mode(lambda uv: uv.unwrap(method="ANGLE_BASED", margin=0.001)),
    "Unwrap, Conformal": in_edit_mode(lambda uv: uv.unwrap(method="CONFORMAL", margin=0.001)),
    "Unwrap, Minimum Stretch": in_edit_mode(lambda uv: uv.unwrap(method="MINIMUM_STRETCH", margin=0.001)),
    "xatlas": xatlas_charts,
    "OptCuts": optcuts,
    "ours, one map": one_map,
    "ours, in parts": in_parts(),
}
# Other settings of ours: what the front is drawn from, and what the goals may choose from.
SETTINGS = {
    "--darts 0": in_parts(darts=0.0),
    "--darts 0.05": in_parts(darts=0.05),
    "--darts 0.5": in_parts(darts=0.5),
    "--loops round": in_parts(loops="round"),
    "--even 0.1 --darts 0.07": in_parts(even=0.1, darts=0.07),
    "--price 0.015": in_parts(price=0.015),
}
