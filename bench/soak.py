# SPDX-License-Identifier: GPL-3.0-or-later
"""Many maps in one Blender, as in a long session: the memory must stay flat.

Usage: soak.py ZIP [COUNT]      in Blender (-b -P soak.py -- ...) or with the bpy module

Maps, with checker, distortion and undo steps, in Object Mode and in Edit Mode, of surfaces of many sizes. Prints the
resident memory at 100, 1,000 and 2,000 maps; the exit code is 1 if it grows by more than GROWTH from first to last.
"""

import gc
import sys
import time
from pathlib import Path

import bpy

ROOT = Path(__file__).resolve().parents[1]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "blender")]

GROWTH = 16.0  # MB from the first mark to the last: an image of the file that one undo step keeps is a tenth of that
MARKS = (100, 500, 1000, 1500, 2000)
SIZES = (12, 20, 32, 48, 64)


def resident_mb():
    """Resident memory of this process."""
    gc.collect()
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise RuntimeError("there is no VmRSS")


def one_map(number):
    """A map of an object, or of two, as an artist makes it."""
    import scenes

    objects = [bpy.data.objects[f"Panel {size}"] for size in SIZES]
    chosen = objects[number % len(SIZES)], objects[(number // 7) % len(SIZES)]
    scenes.select(*chosen)
    edit = number % 3 == 0
    if edit:
        bpy.ops.object.mode_set(mode="EDIT")
        bpy.ops.mesh.select_all(action="SELECT")
    answer = bpy.ops.uv.koebe_uniformize("EXEC_DEFAULT", True, checker_size=8 + number % 9)
    assert answer == {"FINISHED"}, answer
    bpy.ops.uv.koebe_distortion("EXEC_DEFAULT", True, kind=("angle", "area", "none")[number % 3])
    if number % 5 == 0:
        bpy.ops.uv.koebe_checker("EXEC_DEFAULT", True)
    if number % 10 == 0:
        bpy.ops.ed.undo()
        bpy.ops.ed.redo()
    if edit:
        bpy.ops.object.mode_set(mode="OBJECT")


def main():
    from install_and_test import install

    package, *rest = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    count = int(rest[0]) if rest else MARKS[-1]
    install(package)
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=False)
    import scenes

    for size in SIZES:
        scenes.add_panel(f"Panel {size}", size=size)
    bpy.ops.ed.undo_push(message="start")
    began, found = time.monotonic(), {}
    for number in range(1, count + 1):
        one_map(number)
        if number in MARKS or number == count:
            found[number] = resident_mb()
            seconds = time.monotonic() - began
            print(f"{number:5d} maps, {seconds:6.0f} s: {found[number]:.1f} MB resident", flush=True)
    grown = found[max(found)] - found[min(found)]
    print(f"Blender {bpy.app.version_string}: {grown:+.1f} MB from {min(found)} to {max(found)} maps", flush=True)
    return grown > GROWTH


if __name__ == "__main__":
    sys.exit(main())
