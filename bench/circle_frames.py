# SPDX-License-Identifier: GPL-3.0-or-later
"""How long a frame takes while circles are dragged: read, map, written into the UV layer, evaluated by Blender.

    scripts/in_own_home.sh blender bench/circle_frames.py dist/koebe_uv-VERSION.zip [VERTICES]

Without a window: what the graphics card does comes on top. Prints medians in milliseconds.
"""

import importlib
import sys
import time
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "blender")]

import scenes  # noqa: E402
from install_and_test import install  # noqa: E402

FRAMES = 25


def timed(call):
    """What a call takes, in milliseconds, and what it gives."""
    start = time.perf_counter()
    result = call()
    return 1e3 * (time.perf_counter() - start), result


def frames(job, domain, moebius):
    """Median times of a frame: of all of it, and of what is not Blender's evaluation."""
    whole, own = [], []
    for angle in 2.0 * np.pi * np.arange(FRAMES) / FRAMES:
        moved = moebius.dragged(0.2j, 0.5 * np.exp(1j * angle))
        mine, _ = timed(lambda moved=moved: job.show(domain, job.image_of(domain, moved)))
        theirs, _ = timed(bpy.context.view_layer.update)
        whole.append(mine + theirs)
        own.append(mine)
    return np.median(whole), np.median(own)


def main():
    package, *rest = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    module = install(package)
    size = int((int(rest[0] if rest else 100_000) / 0.854) ** 0.5)  # vertices of a panel: about 0.854 size²
    obj = scenes.add_panel(size=size)
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False)
    koebe = importlib.import_module(f"{module}.jobs.native_package").load()
    moebius = importlib.import_module(f"{module}.maps.moebius")
    press, job = timed(lambda: importlib.import_module(f"{module}.jobs.moebius_job").MoebiusJob(koebe, obj))
    whole, own = frames(job, job.domains[0], moebius)
    job.put_back()
    release, _ = timed(lambda: bpy.ops.uv.koebe_moebius(center=(0.3, 0.1)))
    bpy.ops.object.mode_set(mode="EDIT")
    leave, _ = timed(lambda: bpy.ops.object.mode_set(mode="OBJECT"))
    enter, _ = timed(lambda: bpy.ops.object.mode_set(mode="EDIT"))
    print(f"Blender {bpy.app.version_string}, {len(obj.data.vertices)} vertices, {len(obj.data.loops)} corners, ms: "
          f"frame {whole:.1f} (of it {own:.1f} before Blender's evaluation; median of {FRAMES}), press {press:.0f}, "
          f"operator {release:.0f}, Edit Mode left {leave:.0f} and entered {enter:.0f}")  # fmt: skip


main()
