# SPDX-License-Identifier: GPL-3.0-or-later
"""Our maps beside Blender's unwraps and xatlas, on models that nobody placed a seam on: docs/comparison.md.

    python bench/compare.py [--models NAME,…] [--again] [--write]     with the modules bpy and xatlas: `make compare`

Each map is made by a process of its own, ended after LIMIT seconds of processor time. Leaves out/compare/maps/, a file
of figures and the UVs of each map, and out/compare/*.json and *.jpg, one a model. A map whose figures are there is
done: a run that was ended goes on, and --again measures anew. --write puts the tables of all models that are done, and
the pictures, into docs/.
"""

import argparse
import json
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, str(Path(__file__).resolve().parent))

ROOT = Path(__file__).resolve().parent.parent
OUT, PAGE, IMAGES = ROOT / "out" / "compare", ROOT / "docs" / "comparison.md", ROOT / "docs" / "images"
MAPS = OUT / "maps"
LIMIT = 240  # seconds of processor time of one map
BEGIN, END = "<!-- the table of `make compare` -->", "<!-- its end -->"
HEAD = ["unwrap", "islands", "seams / √area", "density, 5 to 95 %", "area within a factor 3", "angle error", "flips",
        "faces lost", "overlap", "seconds"]  # fmt: skip
SUMMARY = ["unwrap", "models done", *HEAD[1:6], "models with flips", "with faces lost", "with overlap", "seconds"]
# In docs/: of what is this project's own or Blender's.
PICTURED = ("Suzanne", "torus", "face_five_holes", "character", "hand", "mug", "closed_head")


def parse():
    parser = argparse.ArgumentParser(prog="compare.py", description=__doc__.splitlines()[0])
    parser.add_argument("--models", type=lambda text: text.split(","))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--one", nargs=3, metavar=("MODEL", "UNWRAP", "FILE"), help=argparse.SUPPRESS)
    return parser.parse_args()


def map_one(model, unwrap, path):
    """Make one map in this process and leave its figures in a file, its UVs beside it."""
    import compare_models
    import numpy as np
    import uv_measures
    from compare_unwraps import UNWRAPS

    vertices, triangles = compare_models.arrays(model)
    try:
        uv, seconds = UNWRAPS[unwrap](vertices, triangles)
        facts = {**uv_measures.measure(vertices, triangles, uv), "seconds": seconds}
        np.savez_compressed(path.with_suffix(".npz"), vertices=vertices, triangles=triangles, uv=uv.astype("f4"))
    except Exception as error:
        facts = {"error": f"{type(error).__name__}: {error}"}
    path.write_text(json.dumps({**facts, "faces": len(triangles)}), encoding="utf-8")


def mapped_beside(model, unwrap, again):
    """The figures of one map: those that are there, or of one that a process of its own makes."""
    path = MAPS / f"{model}, {unwrap}.json"
    if again or not path.exists():
        draft = path.with_suffix(".draft.json")
        draft.unlink(missing_ok=True)
        words = [sys.executable, __file__, "--one", model, unwrap, str(draft)]
        with (OUT / "log.txt").open("ab") as log:
            code = subprocess.run(words, stdout=log, stderr=log, check=False, preexec_fn=limited).returncode
        if not draft.exists():
            late = code in (-9, -24)  # SIGKILL, SIGXCPU
            facts = {"error": f"not done after {LIMIT} s" if late else "the process ended without a word"}
            draft.write_text(json.dumps(facts), encoding="utf-8")
        if draft.with_suffix(".npz").exists():
            draft.with_suffix(".npz").replace(path.with_suffix(".npz"))
        draft.replace(path)
    return json.loads(path.read_text(encoding="utf-8"))


def limited():
    resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT + 5))


def cells(facts):
    """A row as it is printed."""
    if "error" in facts:
        return [facts["error"][:110], *[""] * (len(HEAD) - 2)]
    spread = f"{facts['spread']:.1f}" if facts["spread"] < 1000.0 else f"{facts['spread']:.0e}"
    return [f"{facts['islands']:,}", f"{facts['seams']:.1f}", spread, f"{100.0 * facts['even']:.0f} %",
            f"{facts['angle']:.1f}°", f"{facts['flips']:,}", f"{facts['lost']:,}",
            f"{100.0 * facts['overlap']:.1f} %", f"{facts['seconds']:.2f}"]  # fmt: skip


def table(model, rows):
    """One model's table as Markdown."""
    faces = next((row["faces"] for row in rows.values() if "faces" in row), 0)
    lines = [f"### {model}, {faces:,} triangles", "", "| " + " | ".join(HEAD) + " |", "|" + " --- |" * len(HEAD)]
    lines += ["| " + " | ".join([unwrap, *cells(facts)]) + " |" for unwrap, facts in rows.items()]
    return "\n".join(lines) + "\n"


def summary(rows_of):
    """All models in one table: medians, and how many maps have a fault. @param rows_of model -> unwrap -> figures"""
    lines = [f"### {len(rows_of)} models", "", "| " + " | ".join(SUMMARY) + " |", "|" + " --- |" * len(SUMMARY)]
    for unwrap in next(iter(rows_of.values())):
        done = [rows[unwrap] for rows in rows_of.values() if "error" not in rows[unwrap]]
        islands, seams, spread, even, angle, seconds = (
            statistics.median(facts[key] for facts in done)
            for key in ("islands", "seams", "spread", "even", "angle", "seconds")
        )
        faulty = [
            sum(facts[key] > most for facts in done) for key, most in (("flips", 0), ("lost", 0), ("overlap", 0.001))
        ]
        cells = [unwrap, len(done), f"{islands:,.0f}", f"{seams:.1f}", f"{spread:.1f}", f"{100.0 * even:.0f} %",
                 f"{angle:.1f}°", *faulty, f"{seconds:.2f}"]  # fmt: skip
        lines.append("| " + " | ".join(map(str, cells)) + " |")
    return "\n".join(lines) + "\n"


def measured(model, again):
    """Measure a model by all unwraps, and leave its file and its picture."""
    import compare_picture
    from compare_unwraps import UNWRAPS

    rows = {unwrap: mapped_beside(model, unwrap, again) for unwrap in UNWRAPS}
    compare_picture.draw({unwrap: MAPS / f"{model}, {unwrap}.npz" for unwrap in UNWRAPS}, OUT / f"{model}.jpg")
    (OUT / f"{model}.json").write_text(json.dumps(rows, indent=1) + "\n", encoding="utf-8")


def write(models):
    """Tables and pictures into docs/, of those of the models that are done."""
    done = [model for model in models if (OUT / f"{model}.json").exists()]
    rows_of = {model: json.loads((OUT / f"{model}.json").read_text(encoding="utf-8")) for model in done}
    tables = [summary(rows_of), *(table(model, rows) for model, rows in rows_of.items())]
    for model in {*done} & {*PICTURED}:
        (IMAGES / f"compare_{model}.jpg").write_bytes((OUT / f"{model}.jpg").read_bytes())
    before, rest = PAGE.read_text(encoding="utf-8").split(BEGIN)
    PAGE.write_text(f"{before}{BEGIN}\n\n" + "\n".join(tables) + f"\n{END}{rest.split(END)[1]}", encoding="utf-8")


def main():
    options = parse()
    if options.one:
        map_one(options.one[0], options.one[1], Path(options.one[2]))
        sys.stdout.flush()
        os._exit(0)  # the bpy module may wait for ever in its own clean-up
    import compare_models

    MAPS.mkdir(parents=True, exist_ok=True)
    for model in options.models or compare_models.names():
        if options.again or not (OUT / f"{model}.json").exists():
            measured(model, options.again)
            print(table(model, json.loads((OUT / f"{model}.json").read_text(encoding="utf-8"))), flush=True)
    if options.write:
        write(compare_models.names())
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
