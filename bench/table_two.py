# SPDX-License-Identifier: GPL-3.0-or-later
"""What the paper says of its Table 2: GK is at least two times as fast as CK for the same roundness. And of section
4.4: its second algorithm converges much faster than its first. Steps and time of all three, on the surfaces of Table 1,
to the same roundness and to the same error of the circles."""

import json
import statistics
from functools import cache

import convergence
import table_surfaces
from processor_time import run_timed
from table_one import ROWS

ENGINES = {"triangles": "mesh", "boundary angles": "condensed"}
METHODS = {"CK": "ck", "first": "against-outer", "GK": "gk"}
GOALS = ("e", 1e-3, 1e-6)  # the same roundness; inversive distances within these of their limits
SAME = 1.02  # times the largest final roundness of the three counts as having reached it
LIMIT = 3600  # seconds per run
SHORT, REPEATS = 5.0, 9  # runs of fewer processor seconds are repeated, and the median counts
HEAD = [
    "size of, on", "CK: steps to e, 1e-3, 1e-6", "first algorithm", "GK", "steps, CK / GK", "time, CK / GK",
    "time, first / GK", "GK twice as fast as CK",
]  # fmt: skip


@cache
def measure(figure, engine, method):
    """The steps with the error of the circles, and the processor seconds of one step."""
    mesh = table_surfaces.file_of(ROWS[figure])
    found = run_once(mesh, ENGINES[engine], METHODS[method])
    runs = [found]
    if found["seconds"] < SHORT:
        runs += [run_once(mesh, ENGINES[engine], METHODS[method]) for _ in range(REPEATS - 1)]
    used = statistics.median(run["iterate_seconds"] / run["total_seconds"] * run["seconds"] for run in runs)
    return found | {"seconds_per_step": used / len(found["steps"])}


def run_once(mesh, engine, method):
    done, seconds = run_timed([convergence.RATES, "file", mesh, engine, method], LIMIT)
    if done is None or done.returncode:
        raise SystemExit(f"{mesh.stem}, {engine}, {method}: {done.stderr.strip() if done else 'stopped'}")
    return json.loads(done.stdout) | {"seconds": seconds}


def steps_to(found, goal, roundness):
    """Steps after which the goal is reached for good."""
    missed = [
        step["step"]
        for step in found["steps"]
        if (step["mean_roundness"] > roundness if goal == "e" else step["error"] > goal)
    ]
    return max(missed, default=0) + 1


def compared(figure, engine):
    """Steps and seconds to each goal, by method."""
    found = {method: measure(figure, engine, method) for method in METHODS}
    roundness = SAME * max(run["steps"][-1]["mean_roundness"] for run in found.values())
    steps = {method: [steps_to(run, goal, roundness) for goal in GOALS] for method, run in found.items()}
    seconds = {method: [k * found[method]["seconds_per_step"] for k in steps[method]] for method in METHODS}
    return steps, seconds


def ratios(one, other):
    return [a / b for a, b in zip(one, other)]


def verdict(found):
    """Of the claim that a time is at least twice the other, for each goal."""
    held = sum(ratio >= 2.0 for ratio in found)
    return "yes" if held == len(found) else "no" if held == 0 else "in part"


def cells(row):
    """A row: the figure and what the iteration runs on."""
    steps, seconds = compared(*row.split(", "))
    faster = ratios(seconds["CK"], seconds["GK"])

    def listed(found):
        return ", ".join(f"{ratio:.1f}" for ratio in found)

    return [
        *(", ".join(map(str, steps[method])) for method in METHODS),
        listed(ratios(steps["CK"], steps["GK"])),
        listed(faster),
        listed(ratios(seconds["first"], seconds["GK"])),
        verdict(faster),
    ]


NAMES = [
    f"{row.figure}, {engine}" for engine in ENGINES for row in sorted(ROWS.values(), key=lambda row: row.vertices)
]
