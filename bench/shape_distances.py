#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Distances between the conformal modules of surfaces, as a Markdown table.

    bench/shape_distances.py [MESH ...] [--any-outer] [--command build/koebe]

By default expressions, meshes and cuts of one face, which blend_samples/make_obj.py makes into out/shapes/: the table
of docs/shapes.md. Making them needs NumPy.
"""

import argparse
import itertools
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
MADE = ROOT / "out" / "shapes"
# Folder: options of blend_samples/make_obj.py. Each makes the face and the surprised face.
FORMS = {"plain": [], "finer": ["--cells", "80"], "cut": ["--cut", "0.85"]}


def parse(words=None):
    """The command line's options."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("meshes", nargs="*", type=Path)
    parser.add_argument("--any-outer", action="store_true", help="any loop may correspond to any other")
    parser.add_argument("--command", type=Path, default=ROOT / "build" / "koebe")
    options = parser.parse_args(words)
    options.meshes = options.meshes or made_faces()
    if len(options.meshes) < 2:
        sys.exit("shape_distances: there are no two meshes to compare")
    return options


def made_faces():
    """The face, surprised, on a finer mesh, and cut more narrowly."""
    for name, words in FORMS.items():
        maker = [sys.executable, ROOT / "blend_samples" / "make_obj.py", "--output", MADE / name, *words]
        subprocess.run(list(map(str, maker)), check=True)
    for name in ("finer", "cut"):
        (MADE / name / "face.obj").replace(MADE / f"face_{name}.obj")
    for name in ("face", "surprised"):
        (MADE / "plain" / f"{name}.obj").replace(MADE / f"{name}.obj")
    return [MADE / f"{name}.obj" for name in ("face", "face_finer", "surprised", "face_cut")]


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
    print(table(options))


def table(options):
    """The distances of all pairs, in Markdown."""
    names = [mesh.stem for mesh in options.meshes]
    cells = {(name, name): "0" for name in names}
    for a, b in itertools.combinations(options.meshes, 2):
        cells[a.stem, b.stem] = cells[b.stem, a.stem] = distance(options, a, b)
    lines = ["| | " + " | ".join(names) + " |", "|" + " --- |" * (len(names) + 1)]
    lines += [f"| {a} | " + " | ".join(cells[a, b] for b in names) + " |" for a in names]
    return "\n".join(lines)


if __name__ == "__main__":
    main()
