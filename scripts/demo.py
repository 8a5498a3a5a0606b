#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Map every sample in Blender, draw it, and compare with blend_samples/expected.json. Standard library only.

    scripts/demo.py [--dense] [--only NAME ...] [--blender PROGRAM] [--output DIR]

Leaves DIR/NAME.blend, NAME.json and NAME.png, and prints one table. --blender takes Blender or a Python with the
bpy module. Exit code: 0 all as expected, 1 something is not.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SAMPLES = ROOT / "blend_samples"
LOOK = ("--checker-size", "48")
PART_COLUMNS = ("in parts", "parts", "faces", "cuts", "density", "angle error", "flips", "lost", "seconds", "")
COLUMNS = ("sample", "loops", "faces", "sweeps", "roundness", "angle error", "flips", "seconds", "")


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
    """Map and draw one sample; return the solver's result as a dict."""
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
    return islands[0]


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


def part_row(name, faces, found, verdict):
    """One line of the table of parts as strings."""
    return (
        name, str(found["parts"]), f"{faces:,}", f"{found['cut_length']:.1f}", f"{found['density']:.1f}",
        f"{found['angle_error']:.3f}°", str(found["flipped"]), str(found["below_resolution"]),
        f"{found['seconds']:.2f}", verdict,
    )  # fmt: skip


def summary(result):
    """The numbers of the table."""
    return {
        "loops": len(result["loops"]),
        "triangles": result["faces"],
        "sweeps": result["sweeps"],
        "roundness": max(loop["roundness"] for loop in result["loops"]),
        "angle_error": result["angle_error_deg"]["mean"],
        "flipped": result["flipped"],
        "seconds": result["seconds"]["total"],
    }


def complaints(found, result, expected):
    """What is not as expected.json wants it, one line each."""
    lines = [] if result["converged"] else ["not converged"]
    for key in ("loops", "triangles", "flipped"):
        if found[key] != expected[key]:
            lines.append(f"{key}: {found[key]}, not {expected[key]}")
    for key, bound in (("angle_error", "max_mean_angle_error_deg"), ("roundness", "max_roundness")):
        if not found[key] <= expected[bound]:
            lines.append(f"{key}: {found[key]:.3g} is over {bound} {expected[bound]}")
    return lines


def row(name, faces, found, verdict):
    """One line of the table as strings."""
    return (
        name,
        str(found["loops"]),
        f"{faces:,}",
        str(found["sweeps"]),
        f"{found['roundness']:.1e}",
        f"{found['angle_error']:.3f}°",
        str(found["flipped"]),
        f"{found['seconds']:.2f}",
        verdict,
    )


def print_table(columns, rows):
    """Aligned columns, the first and the last to the left."""
    widths = [max(len(line[i]) for line in [columns, *rows]) for i in range(len(columns))]
    last = len(columns) - 1
    for line in [columns, tuple("-" * width for width in widths), *rows]:
        cells = (cell.ljust(w) if i in (0, last) else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths)))
        print("  ".join(cells).rstrip())


def main():
    options = parse()
    options.blender = shutil.which(options.blender) or sys.exit(f"demo: there is no program {options.blender!r}")
    samples = json.loads((SAMPLES / "expected.json").read_text(encoding="utf-8"))["samples"]
    names = options.only or [name for name, one in samples.items() if options.dense or not one["dense"]]
    options.output = options.output.absolute()
    options.output.mkdir(parents=True, exist_ok=True)
    rows, part_rows, problems = [], [], []
    for name in names:
        print(f"{name} ...", file=sys.stderr, flush=True)
        in_parts = "max_parts" in samples[name]
        try:
            result = unwrap_sample(name, options) if in_parts else map_sample(name, options)
        except DemoError as error:
            problems.append(f"{name}: {error}")
            continue
        if in_parts:
            wrong = part_complaints(result, samples[name])
            problems += [f"{name}: {line}" for line in wrong]
            part_rows.append(part_row(name, samples[name]["faces"], result, "FAILED" if wrong else "ok"))
            continue
        found = summary(result)
        wrong = complaints(found, result, samples[name])
        problems += [f"{name}: {line}" for line in wrong]
        rows.append(row(name, samples[name]["faces"], found, "FAILED" if wrong else "ok"))
    for columns, lines in ((COLUMNS, rows), (PART_COLUMNS, part_rows)):
        if lines:
            print_table(columns, lines)
    for line in problems:
        print(line, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
