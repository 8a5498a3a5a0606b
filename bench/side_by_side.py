# SPDX-License-Identifier: GPL-3.0-or-later
"""Islands side by side: the add-on's computation with one thread and with all cores, in turn.

    blender -b --factory-startup --python-exit-code 1 -P bench/side_by_side.py -- [--islands N] [--faces N] [--runs N]
    python bench/side_by_side.py -- [options]                                    (with the bpy module)

The islands are those of one object, and then objects of their own. Medians of the runs, and the load of the machine:
other work takes cores away, so the ratio says something where nothing else runs. The coordinates have to be the same.
"""

import argparse
import os
import sys
import time
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "tests" / room) for room in ("blender", "python")]

import scenes  # noqa: E402
from addon_support import registered_addon  # noqa: E402


def parse():
    """The options after "--"."""
    given = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="side_by_side.py", description=__doc__.splitlines()[0])
    parser.add_argument("--islands", type=int, default=200)
    parser.add_argument("--faces", type=int, default=5000, help="triangles of each")
    parser.add_argument("--runs", type=int, default=5)
    return parser.parse_args(given)


def made(islands, faces, in_one):
    """The objects."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    vertices, polygons = scenes.panel_arrays(size=round((faces / 1.88) ** 0.5))[:2]
    vertices = np.asarray(vertices)
    if not in_one:
        return [scenes.add_object(f"Island {i}", vertices, polygons) for i in range(islands)]
    places = np.concatenate([vertices + [3.0 * i, 0.0, 0.0] for i in range(islands)])
    every = [[vertex + i * len(vertices) for vertex in face] for i in range(islands) for face in polygons]
    return [scenes.add_object("Islands", places, every)]


def seconds(objects, threads):
    """Of one computation, and its coordinates."""
    from koebe_uv.jobs.map_job import Job
    from koebe_uv.maps.options import Options

    job = Job(objects, Options(threads=threads))
    begin = time.perf_counter()
    job.compute()
    taken = time.perf_counter() - begin
    return taken, np.concatenate([one.uv.ravel() for outcome in job.outcomes for one in outcome.mapped])


def main():
    options = parse()
    registered_addon()
    print("| islands | threads: 1 | threads: all | times as fast | load |")
    print("|" + " --- |" * 5)
    for in_one in (True, False):
        objects = made(options.islands, options.faces, in_one)
        taken = {1: [], 0: []}
        for _ in range(options.runs):
            results = {threads: seconds(objects, threads) for threads in taken}
            for threads, (one, _uv) in results.items():
                taken[threads].append(one)
            if not np.array_equal(results[0][1], results[1][1]):
                sys.exit("the coordinates depend on the number of threads")
        alone, together = np.median(taken[1]), np.median(taken[0])
        where = "of one object" if in_one else "objects"
        print(f"| {options.islands} {where} | {alone:.2f} s | {together:.2f} s | {alone / together:.2f} | "
              f"{os.getloadavg()[0]:.1f} |", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()
    sys.stdout.flush()
    os._exit(0)  # the bpy module may wait for ever in its own clean-up
