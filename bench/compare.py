# SPDX-License-Identifier: GPL-3.0-or-later
"""Our maps beside Blender's unwraps, xatlas and OptCuts, on models that nobody placed a seam on: docs/comparison.md.

    python bench/compare.py [--models NAME,…] [--unwraps NAME;…] [--again] [--write]

With the modules bpy and xatlas: `make compare`. MODELS=FOLDER in the environment compares on the OBJ and OFF files of
that folder as well, OPTCUTS=PROGRAM runs that program of OptCuts.

Maps are made by processes of their own, one a model, ended after LIMIT seconds of processor time a map. Leaves
out/compare/maps/, a file of figures and the UVs of each map, and out/compare/*.jpg, one a model. A map whose figures
are there is done: a run that was ended goes on, and --again measures anew. --write puts tables and pictures into docs/,
of all models that were measured.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))

ROOT = Path(__file__).resolve().parent.parent
OUT, PAGE, IMAGES = ROOT / "out" / "compare", ROOT / "docs" / "comparison.md", ROOT / "docs" / "images"
MAPS = OUT / "maps"
LIMIT = 300  # seconds of processor time of one map
# In docs/: of what is this project's own or Blender's.
PICTURED = ("Suzanne", "torus", "face_five_holes", "hand")


def parse():
    parser = argparse.ArgumentParser(prog="compare.py", description=__doc__.splitlines()[0])
    parser.add_argument("--models", type=lambda text: text.split(","))
    parser.add_argument("--unwraps", type=lambda text: text.split(";"))
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--here", nargs=2, metavar=("MODEL", "UNWRAPS"), help=argparse.SUPPRESS)
    return parser.parse_args()


def surface(model):
    """Vertices and triangles of a model, kept in a file: only the first process of a model needs Blender for it."""
    import compare_models
    import numpy as np

    path = MAPS / f"{model}.npz"
    if not path.exists():
        vertices, triangles = compare_models.arrays(model)
        draft = path.with_suffix(f".{os.getpid()}.npz")
        np.savez_compressed(draft, vertices=vertices, triangles=triangles)
        draft.replace(path)
    data = np.load(path)
    return data["vertices"], data["triangles"]


def map_one(vertices, triangles, unwrap):
    """The figures of one map, and its UVs or None."""
    import numpy as np
    import uv_measures
    from compare_unwraps import SETTINGS, UNWRAPS

    begun = resource.getrusage(resource.RUSAGE_SELF)
    resource.setrlimit(resource.RLIMIT_CPU, (int(begun.ru_utime + begun.ru_stime) + LIMIT, resource.RLIM_INFINITY))
    try:
        uv, reported = {**UNWRAPS, **SETTINGS}[unwrap](vertices, triangles)
        facts = uv_measures.measure(vertices, triangles, uv, reported.get("texture", 1.0))
        return {**facts, **reported, "faces": len(triangles)}, np.asarray(uv, np.float32)
    except Exception as error:
        return {"error": f"{type(error).__name__}: {error}", "faces": len(triangles)}, None


def map_here(model, unwraps):
    """Make maps in this process, one after the other: of each a file of figures, and its UVs beside it."""
    import numpy as np

    for unwrap in unwraps:
        facts, uv = map_one(*surface(model), unwrap)
        path = MAPS / f"{model}, {unwrap}.json"
        if uv is not None:
            np.savez_compressed(path.with_suffix(".npz"), uv=uv)
        path.with_suffix(".draft").write_text(json.dumps(facts), encoding="utf-8")
        path.with_suffix(".draft").replace(path)


def make_beside(model, unwraps):
    """Have processes of their own make maps: one for all of them, and another for the rest where one ends."""
    while unwraps:
        with (OUT / "log.txt").open("ab") as log:
            words = [sys.executable, __file__, "--here", model, ";".join(unwraps)]
            code = subprocess.run(words, stdout=log, stderr=log, check=False).returncode
        done = [unwrap for unwrap in unwraps if (MAPS / f"{model}, {unwrap}.json").exists()]
        unwraps = [unwrap for unwrap in unwraps if unwrap not in done]
        if unwraps:
            late = code == -24  # SIGXCPU
            facts = {"error": f"not done after {LIMIT} s" if late else "the process ended without a word"}
            (MAPS / f"{model}, {unwraps.pop(0)}.json").write_text(json.dumps(facts), encoding="utf-8")


def found(model):
    """The figures of all maps of a model that are made: unwrap -> figures."""
    from compare_unwraps import SETTINGS, UNWRAPS

    files = {unwrap: MAPS / f"{model}, {unwrap}.json" for unwrap in (*UNWRAPS, *SETTINGS)}
    return {unwrap: json.loads(file.read_text(encoding="utf-8")) for unwrap, file in files.items() if file.exists()}


def write(known):
    """Tables and pictures into docs/, of all models that every unwrap has been tried on.

    @param known the models that ours was made with
    """
    import compare_front
    import compare_tables
    from compare_unwraps import SETTINGS, UNWRAPS

    others = sorted({path.stem for path in MAPS.glob("*.npz") if ", " not in path.stem} - {*known})
    needed = {*UNWRAPS, *SETTINGS} - {"OptCuts"}
    groups = {heading: {model: rows for model in models if needed <= {*(rows := found(model))}}
              for heading, models in (("development models", known), ("other models", others))}  # fmt: skip
    rows_of = {model: rows for group in groups.values() for model, rows in group.items()}
    compare_tables.write(PAGE, groups)
    compare_front.draw(rows_of, IMAGES / "compare_front.png")
    for model in {*PICTURED} & {*rows_of}:
        picture(model, UNWRAPS, IMAGES / f"compare_{model}.jpg")


def picture(model, unwraps, path):
    import compare_picture

    files = {unwrap: MAPS / f"{model}, {unwrap}.npz" for unwrap in unwraps}
    compare_picture.draw(surface(model), {unwrap: file for unwrap, file in files.items() if file.exists()}, path)


def main():
    options = parse()
    if options.here:
        map_here(options.here[0], options.here[1].split(";"))
        sys.stdout.flush()
        os._exit(0)  # the bpy module may wait for ever in its own clean-up
    import compare_models
    from compare_unwraps import SETTINGS, UNWRAPS

    MAPS.mkdir(parents=True, exist_ok=True)
    for model in options.models or [*compare_models.names(), *compare_models.unseen()]:
        wanted = [unwrap for unwrap in options.unwraps or (*UNWRAPS, *SETTINGS)
                  if unwrap != "OptCuts" or "OPTCUTS" in os.environ]  # fmt: skip
        for unwrap in wanted if options.again else []:
            (MAPS / f"{model}, {unwrap}.json").unlink(missing_ok=True)
        make_beside(model, [unwrap for unwrap in wanted if not (MAPS / f"{model}, {unwrap}.json").exists()])
        if not options.unwraps:
            picture(model, UNWRAPS, OUT / f"{model}.jpg")
        print(model, flush=True)
    if options.write:
        write(compare_models.names())
    sys.stdout.flush()
    os._exit(0)


if __name__ == "__main__":
    main()
