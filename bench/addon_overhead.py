# SPDX-License-Identifier: GPL-3.0-or-later
"""What the add-on costs beside the native call: seconds per 100,000 faces, as a Markdown table and JSON.

    blender -b [IN.blend] --factory-startup --python-exit-code 1 -P bench/addon_overhead.py -- [--faces N] [--runs N]
    python bench/addon_overhead.py -- [options]                                  (with the bpy module)

Every mesh object of the file, or without one a bent panel of quads with holes, goes through the operator: the time
of the operator less the time inside the native call, median of the runs. The bound is on the main thread's processor
time, which other work on the machine changes less.

Rows: one island; the same kept in its place; two islands, cut along a seam; and the first two in Edit Mode. There
Blender has to bring the mesh's arrays up to date and, to take UVs back in one go, to leave the mode and enter it again.
The column "Blender's own" is the time of just that, with nothing between, in turn with the runs. Where it alone is over
the bound, the bound is on what is beside it. Exit code 1 if a row is over the bound.
"""

import argparse
import json
import os
import sys
import time
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
BOUND = 0.15  # seconds per 100,000 faces
sys.path[:0] = [str(ROOT / "tests" / room) for room in ("blender", "python")]

from addon_support import registered_addon  # noqa: E402


def parse():
    """The options after "--"."""
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="addon_overhead.py", description=__doc__.splitlines()[0])
    parser.add_argument("--faces", type=int, default=150_000)
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--profile", action="store_true", help="also where the time goes")
    return parser.parse_args(given)


def made_panel(faces):
    """A panel with about so many faces."""
    import scenes

    return scenes.add_panel(size=round((faces / 0.94) ** 0.5))


def now():
    """Seconds on the wall and of this thread's processor time."""
    return np.array([time.perf_counter(), time.thread_time()])


class NativeClock:
    """Counts the seconds inside `koebe.uniformize`."""

    def __init__(self, koebe):
        self.seconds = np.zeros(2)
        self._call = koebe.uniformize
        koebe.uniformize = self

    def __call__(self, *arguments, **options):
        start = now()
        try:
            return self._call(*arguments, **options)
        finally:
            self.seconds += now() - start


def overhead(clock, runs, **options):
    """Medians over the runs: wall and processor seconds beside the native call, wall seconds of the native call, and
    processor seconds of an empty change of mode."""
    beside, native, empty = [], [], []
    for _ in range(runs):
        clock.seconds[:] = 0.0
        start = now()
        bpy.ops.uv.koebe_uniformize(tolerance=1e-4, **options)
        beside.append(now() - start - clock.seconds)
        native.append(clock.seconds[0])
        empty.append(empty_change(bpy.context.object))
    return *np.median(beside, axis=0), np.median(native), np.median(empty)


def empty_change(obj):
    """Processor seconds of what Blender does for anybody who reads and writes a mesh in Edit Mode."""
    if obj.mode != "EDIT":
        return 0.0
    start = now()
    obj.update_from_editmode()
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.mode_set(mode="EDIT")
    return (now() - start)[1]


def mark_seam(mesh, on):
    """Cut the mesh in two along x = 0, or take the seams away."""
    right = np.empty(3 * len(mesh.polygons), dtype=np.float32)
    mesh.polygons.foreach_get("center", right)
    right = np.repeat(right[::3] > 0.0, [len(face.edge_keys) for face in mesh.polygons])
    edge = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.loops.foreach_get("edge_index", edge)
    sides = np.zeros((2, len(mesh.edges)), dtype=bool)
    sides[right.astype(int), edge] = True
    mesh.edges.foreach_set("use_seam", sides.all(axis=0) & on)


ROWS = (
    ("OBJECT", "one island", {}),
    ("OBJECT", "in place", {"placement": "keep"}),
    ("OBJECT", "a seam", {}),
    ("EDIT", "one island", {}),
    ("EDIT", "in place", {"placement": "keep"}),
)


def measure(obj, clock, runs):
    """The rows for one object."""
    for other in bpy.context.view_layer.objects:
        other.select_set(other == obj)
    bpy.context.view_layer.objects.active = obj
    faces = len(obj.data.polygons)
    rows = []
    for mode, case, options in ROWS:
        mark_seam(obj.data, case == "a seam")
        bpy.ops.object.mode_set(mode=mode)
        if mode == "EDIT":
            bpy.ops.mesh.select_all(action="SELECT")
        wall, cpu, native, empty = (x * 1e5 / faces for x in overhead(clock, runs, **options))
        bpy.ops.object.mode_set(mode="OBJECT")
        judged = cpu - empty if empty > BOUND else cpu
        rows.append(
            {"object": obj.name, "faces": faces, "mode": mode, "case": case, "native": native, "wall": wall, "cpu": cpu,
             "empty": empty, "judged": judged}
        )  # fmt: skip
    return rows


def main():
    options = parse()
    clock = NativeClock(registered_addon())
    meshes = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"] if bpy.data.filepath else []
    rows = [row for obj in meshes or [made_panel(options.faces)] for row in measure(obj, clock, options.runs)]
    print("Seconds per 100,000 faces.")
    print("| object | faces | mode | case | native | beside | of them processor | Blender's own | judged |")
    print("|" + " --- |" * 9)
    line = "| {object} | {faces:,} | {mode} | {case} | {native:.2f}" + 4 * " | {:.3f}" + " |"
    for row in rows:
        print(line.format(*(row[key] for key in ("wall", "cpu", "empty", "judged")), **row))
    out = ROOT / "out" / "bench" / "addon_overhead.json"
    out.parent.mkdir(parents=True, exist_ok=True)
    out.write_text(json.dumps({"blender": bpy.app.version_string, "bound": BOUND, "rows": rows}, indent=1) + "\n")
    if options.profile:
        profile()
    return int(any(row["judged"] > BOUND for row in rows))


def profile():
    """The functions beside the native call that take longest."""
    import cProfile
    import pstats

    profiler = cProfile.Profile()
    profiler.runcall(bpy.ops.uv.koebe_uniformize, tolerance=1e-4)
    pstats.Stats(profiler).sort_stats("tottime").print_stats(18)


if __name__ == "__main__":
    code = main()
    sys.stdout.flush()
    os._exit(code)  # the bpy module may wait for ever in its own clean-up
