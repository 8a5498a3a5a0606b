#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the fast tests see a mistake: each mutant is one changed line, built and tested, and taken back.

    bench/mutants.py [--only N,N,...] [--slow]

A mutant is killed where one of the fast tests, native or Python, fails (`make check`). With --slow the slow tests run
on the mutants that survive. It works in the checkout itself, which must have no changes, and
takes one to three minutes a mutant. Prints a table; exit 1 if one survives.
"""

import argparse
import os
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# file, the line's part, what takes its place
MUTANTS = [
    (
        "native/surface/quality/take_verdict.cpp",
        "distortion.lost_area > policy.most_lost",
        "distortion.lost_area >= 0.0",
    ),
    ("native/surface/quality/verdict.cpp", "all.lost / all.area", "0.5 * all.lost / all.area"),
    ("native/base/circles/moebius.cpp", "std::conj(a) * z.array()", "a * z.array()"),
    (
        "native/disk/iteration/convergence.cpp",
        "circle_change(before_sweep, after) < tolerance",
        "circle_change(before_sweep, after) > tolerance",
    ),
    ("native/disk/iteration/convergence.cpp", "radius_change * radius_change", "0.0 * radius_change"),
    ("native/disk/foldover/repair_effort.cpp", "steps < fewest_steps ? 0", "steps < fewest_steps ? 1000"),
    ("native/disk/opened/disk_packing.cpp", "other = radii[j] + radius", "other = radii[j]"),
    ("native/surface/surface/mirror.cpp", "away < near || (away == near && i < found)", "away <= near"),
    (
        "native/labs/shape/conformal_module.cpp",
        "std::norm(arm) - circle.radius * circle.radius",
        "std::norm(arm) + circle.radius * circle.radius",
    ),
    (
        "native/domains/sphere/sphere_check.cpp",
        "orientation(middle, to, from) <= 0",
        "orientation(middle, to, from) < -1",
    ),
    (
        "native/base/planar/boundary_crossings.cpp",
        "(areas[k] > 0.0) == (outer > 0.0)",
        "(areas[k] > 0.0) != (outer > 0.0)",
    ),
    (
        "native/base/linear/filled_laplacian.cpp",
        "is_filled_ = true;\n    cholesky_.refactorize(blocks(disks, 0));",
        "cholesky_.refactorize(blocks(disks, 0));",
    ),
    ("native/base/linear/factor/analysis.cpp", "l.rank[v] >= inner_count", "l.rank[v] >= 0"),
    ("native/making/lift/solid.cpp", "{b, a, count + source[a]}", "{a, b, count + source[a]}"),
    ("native/making/lift/meeting_faces.cpp", "way.dot(p - from) > rounding", "way.dot(p - from) > -rounding"),
    ("native/making/lift/sphere_sheets.cpp", "sizes[part[f]] > sizes[largest]", "sizes[part[f]] < sizes[largest]"),
    ("native/atlas/parts/twins.cpp", "twins[k]->mirrored ? -std::conj(other.up) : other.up", "other.up"),
    ("native/atlas/packing/tile_packing.cpp", "tiles_[fullest()].packing.scale", "tiles_[0].packing.scale"),
    ("native/atlas/darts/through_cuts.cpp", "price_.of(length, splits(from.end, to.end))", "price_.of(length, false)"),
    ("native/labs/certified/capacities.cpp", "shared = loop >= 0 && !fixed_[i]", "shared = false"),
    ("native/labs/bending/circle_path.cpp", "least = std::min(least, std::abs(centers[k] - centers[j]) / wanted);", ""),
    ("native/labs/bending/bent_domain.cpp", "k == 0 ? here : next, k == 0 ? next : here", "here, next"),
    ("native/surface/canonical/corner_map.h", "mesh.name_faces(result.turned);", ""),
    ("native/surface/quality/shared_warnings.cpp", "if (!other.empty())", "if (other.empty())"),
    ("native/disk/embedding/filled_map.cpp", "kept = run_once_round(image_of(0), 1)", "kept = true"),
    ("native/apps/cli/commands/corner_map.h", "result.turned = filed_faces(input.triangulation, result.turned);", ""),
    ("native/base/execution/memory_limit.cpp", "if (bytes <= available) return;", "if (bytes >= 0.0) return;"),
    ("native/python/koebe/_options.py", "name not in defaults and name not in positional", "False"),
    ("native/python/koebe/maps/domain_map.py", 'options.polygon = polygons_of(given["polygon"], source)', "pass"),
    ("native/options/options.json", '{"above": 0}, "default": 0.03', '{"min": 0}, "default": 0.03'),
]

ENVIRONMENT = os.environ | {
    "CCACHE_DIR": str(ROOT / "build" / "ccache"),
    "CCACHE_SLOPPINESS": "pch_defines,time_macros",
    "PYTHONPATH": str(ROOT / "build" / "python"),
}
NATIVE = ["build/tests/native/koebe_tests", "--gtest_brief=1", "--gtest_fail_fast"]
PYTEST = ["/usr/bin/python3", "-m", "pytest", "-q", "-x", "-p", "no:cacheprovider", "tests/python"]
LIMIT = 900  # seconds: a mutant may never end


def fails(*words: str) -> bool:
    try:
        return subprocess.run(words, cwd=ROOT, env=ENVIRONMENT, capture_output=True, timeout=LIMIT).returncode != 0
    except subprocess.TimeoutExpired:
        return True


def fate(file: str, old: str, new: str, slow: bool) -> str:
    """What becomes of a mutant, whose file is as it was afterwards."""
    path = ROOT / file
    text = path.read_text(encoding="utf-8")
    if text.count(old) == 0:
        return "its line is gone"
    try:
        path.write_text(text.replace(old, new, 1), encoding="utf-8")
        if fails("ninja", "-C", "build"):
            return "does not compile"
        if fails(*NATIVE, "--gtest_filter=-*.slow_*") or fails("build/tests/native/koebe_thread_tests"):
            return "native"
        if fails(*PYTEST, "-m", "not slow"):
            return "Python"
        if slow and fails(*NATIVE, "--gtest_filter=*.slow_*"):
            return "slow native"
        return "slow Python" if slow and fails(*PYTEST, "-m", "slow") else "survives"
    finally:
        path.write_text(text, encoding="utf-8")


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="numbers of mutants, from 1")
    parser.add_argument("--slow", action="store_true", help="run the slow tests on survivors")
    options = parser.parse_args()
    if fails("git", "diff", "--quiet"):
        raise SystemExit("the checkout has changes: a mutant's file is written over")
    chosen = [int(number) for number in options.only.split(",") if number] or range(1, len(MUTANTS) + 1)
    survivors = 0
    for number in chosen:
        file, old, new = MUTANTS[number - 1]
        begin = time.monotonic()
        killer = fate(file, old, new, options.slow)
        survivors += killer == "survives"
        line = old.splitlines()[-1].strip()
        print(f"{number:2} {killer:16} {time.monotonic() - begin:5.0f} s  {file}: {line}", flush=True)
    subprocess.run(["ninja", "-C", "build"], cwd=ROOT, env=ENVIRONMENT, capture_output=True)
    return 1 if survivors else 0


if __name__ == "__main__":
    sys.exit(main())
