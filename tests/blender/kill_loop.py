#!/usr/bin/env python3
"""Kill batch runs at random moments, and look at what is left. Not part of the test suite: it takes minutes.

Usage: kill_loop.py blender|PYTHON_WITH_BPY [COUNT] [BATCH.PY]       the add-on's batch.py, built or installed

Every run replaces an older OUT.blend and an older report. After each kill both must be the older or the new ones,
whole: the report parses, the .blend opens and has the UV layer. Says how many of each there were.
"""

import json
import os
import random
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SAMPLES = ROOT / "blend_samples"
LOOK = """
import bpy, sys
for path in sys.argv[sys.argv.index("--") + 1:]:
    bpy.ops.wm.open_mainfile(filepath=path)
    meshes = [obj.data for obj in bpy.data.objects if obj.type == "MESH"]
    assert meshes and all("Koebe" in mesh.uv_layers for mesh in meshes), path
print("ALL WHOLE")
"""


def command(host, script, opened, *arguments):
    in_blender = Path(host).name.startswith("blender")
    words = [host, "-b", *opened, "--python-exit-code", "1", "-P", script] if in_blender else [host, script, *opened]
    return [*map(str, words), "--", *map(str, arguments)]


def main():
    host, count = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60
    noise = random.Random(time.time_ns())
    script = Path(sys.argv[3]) if len(sys.argv) > 3 else ROOT / "addon" / "batch.py"
    with tempfile.TemporaryDirectory() as folder:
        loop(host, script, count, noise, Path(folder))


def loop(host, script, count, noise, folder):
    source = SAMPLES / "perforated_panel.blend"
    out, report = folder / "out.blend", folder / "out.json"
    words = command(host, script, [source], "--output", out, "--report", report)
    for _ in range(2):  # the first may have to unpack the native module
        began = time.monotonic()
        first = subprocess.run(words, capture_output=True, text=True)
        assert first.returncode == 0, first.stdout + first.stderr
        whole = time.monotonic() - began
    kept, tally = [], {"killed": 0, "finished": 0, "old": 0, "new": 0, "new without report": 0, "left over": 0}
    for number in range(count):
        older = b"older " + os.urandom(100)
        out.write_bytes(older)
        report.write_bytes(older)
        process = subprocess.Popen(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        # Half of the moments are near the end, where the files are written.
        time.sleep(noise.uniform(0.0, whole) if number % 2 else noise.uniform(0.7, 1.05) * whole)
        process.kill()
        tally["finished" if process.wait() == 0 else "killed"] += 1
        new = out.read_bytes() != older
        tally["new" if new else "old"] += 1
        if new:
            kept.append(folder / f"kept-{number}.blend")
            out.rename(kept[-1])
        if report.read_bytes() == older:
            tally["new without report"] += new
        else:
            assert new and json.loads(report.read_text())["exit_code"] == 0, f"run {number}: a report without an output"
        for path in folder.glob(".koebe-*"):
            tally["left over"] += 1
            path.unlink()
        assert {path.name for path in folder.iterdir()} <= {"out.blend", "out.json", *(path.name for path in kept)}
    look = folder / "look.py"
    look.write_text(LOOK)
    looked = subprocess.run(command(host, look, [], *kept), capture_output=True, text=True)
    assert "ALL WHOLE" in looked.stdout, looked.stdout + looked.stderr
    print(f"{count} runs of {whole:.1f} s in {host}: {tally}")


if __name__ == "__main__":
    main()
