#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Map every sample in Blender, draw it, and compare with blend_samples/expected.json; then lift patterns. Standard
library only.

    scripts/demo.py [--dense] [--only NAME ...] [--blender PROGRAM] [--output DIR]

Leaves DIR/NAME.blend, NAME.json and NAME.png, and prints a line as each picture is done. --blender takes Blender or a
Python with the bpy module. Exit code: 0 all as expected, 1 something is not.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "blend_samples"
LOOK = ("--checker-size", "48")
LIFTS = ("lift", "lift_sphere", "lift_rows")
LEGEND = """\
roundness    largest distance of a rim's vertex from its circle, over the radius
angle error  mean change of the angles of the faces
cuts         length of the cuts, over the root of the surface's area
density      texels a length at 95 % of the area over those at 5 %: 1 is even
lost         faces too small for 32-bit UVs
map, all     seconds of the map alone; with Blender's start and the picture
"""
# Heading, and how a figure of the reports is written.
TIMES = {"map, s": ("seconds", ".2f"), "all, s": ("all", ".0f")}
FACES = {"faces": ("faces", ",d"), "angle error, °": ("angle_error", ".3f"), "flips": ("flipped", "d")}
DISKS = {"loops": ("loops", "d"), "sweeps": ("sweeps", "d"), "roundness": ("roundness", ".1e"), **FACES, **TIMES}
PARTS = {"parts": ("parts", "d"), "cuts": ("cut_length", ".1f"), "density": ("density", ".1f"), **FACES,
         "lost": ("below_resolution", "d"), **TIMES}  # fmt: skip


class DemoError(Exception):
    """A step of one sample failed; the message says why."""


def parse():
    """The command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dense", action="store_true", help="also the sample that is made on the spot")
    parser.add_argument("--only", nargs="+", metavar="NAME")
    parser.add_argument("--blender", default=os.environ.get("BLENDER", "blender"), metavar="PROGRAM")
    parser.add_argument("--output", type=Path, default=ROOT / "out", metavar="DIR")
    return parser.parse_args()


def run_script(program, script, arguments, blend=None):
    """Run a script in Blender, or under a Python that has the bpy module; raise DemoError if it fails."""
    if Path(program).name.startswith("python"):
        command = [program, script, *([blend] if blend else [])]
    else:
        command = [program, "--background", *([blend] if blend else ["--factory-startup"])]
        command += ["--python-exit-code", "1", "--python", script]
    # Debian's Blender takes the Python library that belongs to the first python3 on the PATH.
    environment = {**os.environ, "PATH": os.pathsep.join(["/usr/bin", os.environ.get("PATH", "")])}
    command = [*map(str, command), "--", *map(str, arguments)]
    result = subprocess.run(command, capture_output=True, text=True, env=environment)
    if result.returncode:
        tail = (result.stderr.strip() or result.stdout.strip()).splitlines()[-5:]
        raise DemoError("\n".join([f"{script.name} ended with exit code {result.returncode}", *tail]))


def map_sample(name, options):
    """Map and draw one sample; return the figures as a dict."""
    source = SAMPLES / f"{name}.blend"
    if not source.exists():
        source = options.output / "samples" / f"{name}.blend"
        make = ["--output", source.parent, "--only", name]
        run_script(options.blender, SAMPLES / "make_samples.py", make)
    mapped, report, picture = (options.output / f"{name}.{kind}" for kind in ("blend", "json", "png"))
    run_script(options.blender, ROOT / "addon" / "batch.py", ["--output", mapped, "--report", report, *LOOK], source)
    run_script(options.blender, ROOT / "scripts" / "render_uv.py", ["--output", picture], mapped)
    islands = json.loads(report.read_text(encoding="utf-8"))["objects"]
    if len(islands) != 1:
        raise DemoError(f"{len(islands)} islands instead of one")
    return summary(islands[0])


def unwrap_sample(name, options):
    """Unwrap one sample to parts and draw it; return the figures as a dict."""
    mapped, report, picture = (options.output / f"{name}.{kind}" for kind in ("blend", "json", "png"))
    words = ["--output", picture, "--report", report, "--blend", mapped]
    run_script(options.blender, ROOT / "scripts" / "parts_picture.py", words, SAMPLES / f"{name}.blend")
    return json.loads(report.read_text(encoding="utf-8"))


def part_complaints(found, expected):
    """What of the parts is not as expected.json wants it, one line each."""
    exact = ("triangles", "flipped")
    lines = [f"{key}: {found[key]}, not {expected[key]}" for key in exact if found[key] != expected[key]]
    for key, bound in (("parts", "max_parts"), ("density", "max_density"), ("angle_error", "max_mean_angle_error_deg")):
        if not found[key] <= expected[bound]:
            lines.append(f"{key}: {found[key]:.3g} is over {bound} {expected[bound]}")
    return lines


def summary(result):
    """The numbers of the table, and whether the map is done."""
    return {
        "converged": result["converged"],
        "loops": len(result["loops"]),
        "triangles": result["faces"],
        "sweeps": result["sweeps"],
        "roundness": max(loop["roundness"] for loop in result["loops"]),
        "angle_error": result["angle_error_deg"]["mean"],
        "flipped": result["flipped"],
        "seconds": result["seconds"]["total"],
    }


def complaints(found, expected):
    """What is not as expected.json wants it, one line each."""
    lines = [] if found["converged"] else ["not converged"]
    for key in ("loops", "triangles", "flipped"):
        if found[key] != expected[key]:
            lines.append(f"{key}: {found[key]}, not {expected[key]}")
    for key, bound in (("angle_error", "max_mean_angle_error_deg"), ("roundness", "max_roundness")):
        if not found[key] <= expected[bound]:
            lines.append(f"{key}: {found[key]:.3g} is over {bound} {expected[bound]}")
    return lines


def print_row(name, cells, columns, end):
    """A line of a table: the name, a cell for each heading, and what stands behind them."""
    width = max(map(len, LIFTS + tuple(path.stem for path in SAMPLES.glob("*.blend"))))
    line = "  ".join([name.ljust(width), *(cell.rjust(max(7, len(head))) for cell, head in zip(cells, columns))])
    print(f"{line}  {end}".rstrip(), flush=True)


def shown(path):
    """The path as one would type it here."""
    return os.path.relpath(path) if path.is_relative_to(Path.cwd()) else str(path)


def show_samples(names, samples, options):
    """Map samples of one kind, and print a line as each is done. Returns what is wrong, one line each."""
    in_parts = "max_parts" in samples[names[0]]
    columns, problems = (PARTS if in_parts else DISKS), []
    print_row("in parts" if in_parts else "in a disk", columns, columns, "picture")
    for name in names:
        begin = time.monotonic()
        try:
            found = unwrap_sample(name, options) if in_parts else map_sample(name, options)
            wrong = (part_complaints if in_parts else complaints)(found, samples[name])
        except DemoError as error:
            problems.append(f"{name}: {error}")
            continue
        problems += [f"{name}: {line}" for line in wrong]
        found |= {"faces": samples[name]["faces"], "all": time.monotonic() - begin}
        cells = [format(found[key], form) for key, form in columns.values()]
        verdict = "  NOT AS EXPECTED" if wrong else ""
        print_row(name, cells, columns, shown(options.output / f"{name}.png") + verdict)
    print()
    return problems


def show_lifts(options):
    """Draw patterns on surfaces. Returns what is wrong, one line each."""
    print_row("patterns", ["all, s"], ["all, s"], "picture")
    for name in LIFTS:
        begin, picture = time.monotonic(), options.output / f"{name}.jpg"
        try:
            run_script(options.blender, ROOT / "scripts" / "lift_picture.py", [picture, 8])
        except DemoError as error:
            return [f"{name}: {error}"]
        print_row(name, [f"{time.monotonic() - begin:.0f}"], ["all, s"], shown(picture))
    return []


def main():
    options = parse()
    options.blender = shutil.which(options.blender) or sys.exit(f"demo: there is no program {options.blender!r}")
    samples = json.loads((SAMPLES / "expected.json").read_text(encoding="utf-8"))["samples"]
    names = options.only or [name for name, one in samples.items() if options.dense or not one["dense"]]
    options.output = options.output.absolute()
    options.output.mkdir(parents=True, exist_ok=True)
    print(LEGEND)
    problems = []
    for in_parts in (False, True):
        mine = [name for name in names if ("max_parts" in samples[name]) == in_parts]
        problems += show_samples(mine, samples, options) if mine else []
    problems += [] if options.only else show_lifts(options)
    for line in problems:
        print(line, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
