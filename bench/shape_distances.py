#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between the conformal modules of surfaces, as a Markdown table. Standard library only.

    bench/shape_distances.py [MESH ...] [--any-outer] [--command build/koebe]

By default the expressions and cuts of one head among the meshes beside the project. The tables of docs/shapes.md.
"""

import argparse
import itertools
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
HEADS = ROOT.parent / "shared" / "meshes" / "good"


def parse():
    """The command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--any-outer", action="store_true", help="any loop may correspond to any other")
    parser.add_argument("--command", type=Path, default=ROOT / "build" / "koebe")
    options = parser.parse_args()
    options.meshes = options.meshes or sorted(HEADS.glob("ict_*"))
    if len(options.meshes) < 2:
        sys.exit("shape_distances: there are no two meshes to compare")
    return options


def distance(options, a, b):
    """What `koebe compare` says, as it is to stand in the table."""
    words = [options.command, "compare", a, b, *(["--any-outer"] if options.any_outer else [])]
    run = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    if not run.stdout:
        return run.stderr.split(":")[0]
    number = f"{float(run.stdout.split()[1]):.2g}"
    return number if run.returncode == 0 else f"{number}, not converged"


def main():
    options = parse()
    names = [mesh.stem for mesh in options.meshes]
    cells = {(name, name): "0" for name in names}
    for a, b in itertools.combinations(options.meshes, 2):
        cells[a.stem, b.stem] = cells[b.stem, a.stem] = distance(options, a, b)
    print("| |", " | ".join(names), "|")
    print("|", " | ".join(["---"] * (len(names) + 1)), "|")
    for a in names:
        print(f"| {a} |", " | ".join(cells[a, b] for b in names), "|")


if __name__ == "__main__":
    main()
