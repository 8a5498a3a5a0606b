# SPDX-License-Identifier: GPL-3.0-or-later
"""Map the objects of a .blend file without a window.

    blender -b IN.blend --python-exit-code 1 -P batch.py -- --output OUT.blend --report OUT.json [options]
    python batch.py IN.blend -- --output OUT.blend --report OUT.json [options]     (with the bpy module)

Exit code: 0 done, 1 the native module is missing or something broke, 2 wrong usage,
3 a mesh cannot be mapped (no OUT), 4 not converged (OUT is written).
OUT and the report are written to temporary files and renamed: each is whole or absent.
"""

import argparse
import importlib.util
import json
import os
import sys
import uuid
from pathlib import Path

import bpy

HERE = Path(__file__).resolve().parent
PACKAGE = "koebe_uv_batch"  # a name of its own: another copy of the add-on may be enabled

DONE, NOT_INSTALLED, USAGE, UNMAPPABLE, NOT_CONVERGED = range(5)


def load_package():
    """Import the add-on that this script is part of, installed or not, without registering it."""
    spec = importlib.util.spec_from_file_location(
        PACKAGE, HERE / "__init__.py", submodule_search_locations=[str(HERE)]
    )
    package = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = package
    spec.loader.exec_module(package)


load_package()

from koebe_uv_batch import job as koebe_job  # noqa: E402
from koebe_uv_batch import native, options, report, transfer  # noqa: E402


def parse(arguments):
    """The command line's options. Exits with code 2 if they are wrong."""
    default = options.Options()
    parser = argparse.ArgumentParser(prog="batch.py", description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, metavar="OUT.blend")
    parser.add_argument("--report", type=Path, metavar="OUT.json")
    parser.add_argument("--objects", metavar="A,B,...", help="default: all meshes of the scene")
    parser.add_argument("--method", choices=options.METHODS, default=default.method)
    parser.add_argument("--engine", choices=options.ENGINES, default=default.engine)
    parser.add_argument("--outer", type=outer_loop, default=default.outer, metavar="auto|longest|VERTEX")
    parser.add_argument("--tolerance", type=float, default=default.tolerance)
    parser.add_argument("--max-sweeps", type=int, default=default.max_sweeps)
    parser.add_argument("--balance", choices=options.BALANCES, default=default.balance)
    parser.add_argument("--polish", action=argparse.BooleanOptionalAction, default=default.polish)
    parser.add_argument("--threads", type=int, default=default.threads, help="0: all cores")
    parser.add_argument("--upright", action=argparse.BooleanOptionalAction, default=default.upright)
    parser.add_argument("--tube", choices=options.TUBES, default=default.tube)
    parser.add_argument("--layer", default=default.layer, help="UV layer to write")
    parser.add_argument("--placement", choices=options.PLACEMENTS, default=default.placement)
    parser.add_argument("--margin", type=float, default=default.margin, help="between islands, in UV units")
    parser.add_argument("--checker", action=argparse.BooleanOptionalAction, default=default.checker)
    parser.add_argument("--checker-size", type=float, default=default.checker_size, metavar="SQUARES")
    parser.add_argument("--checker-even", action=argparse.BooleanOptionalAction, default=default.checker_even)
    values = vars(parser.parse_args(arguments))
    output, report_file, objects = (values.pop(name) for name in ("output", "report", "objects"))
    for file in (output, report_file):
        if file is not None and not file.absolute().parent.is_dir():
            parser.error(f"there is no folder {file.absolute().parent}")
    try:
        chosen = options.Options(**values)
    except options.OptionError as error:
        parser.error(str(error))
    return output, report_file, objects, chosen


def outer_loop(text):
    """The value of --outer."""
    if text in ("auto", "longest"):
        return text
    if not text.isdigit():
        raise argparse.ArgumentTypeError(f"{text!r} is not auto, longest or a vertex index")
    return int(text)


def mesh_objects(names):
    """The mesh objects of the scene, or those named. Exits with code 2 if one is missing."""
    if names is None:
        found = [obj for obj in bpy.context.scene.objects if obj.type == "MESH"]
        return found or fail(USAGE, "the scene has no mesh objects")
    found = []
    for name in names.split(","):
        obj = bpy.data.objects.get(name)
        if obj is None or obj.type != "MESH":
            fail(USAGE, f"there is no mesh object named {name!r}")
        found.append(obj)
    return found


def fail(code, message):
    """Say why on stderr and end."""
    print(f"koebe: {message}", file=sys.stderr, flush=True)
    sys.exit(code)


def leave_edit_mode(objects):
    """A file may have been saved in Edit Mode."""
    for obj in objects:
        if obj.mode != "OBJECT":
            bpy.context.view_layer.objects.active = obj
            bpy.ops.object.mode_set(mode="OBJECT")


def write_whole(path, write):
    """Let `write(temporary)` make a file beside `path`, then rename it."""
    path = path.absolute()
    # No file of that name may exist yet: Blender would keep it as a backup.
    temporary = path.with_name(f".{path.stem}-{uuid.uuid4().hex}{path.suffix}")
    try:
        write(str(temporary))
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def save_blend(path):
    """Save the open file there."""
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, check_existing=False)


def save_json(path, content):
    """Save plain values there."""
    Path(path).write_text(json.dumps(content, indent=1) + "\n", encoding="utf-8")


def run(output, report_file, names, chosen):
    """Map, save, report; return the exit code."""
    source = bpy.data.filepath
    objects = mesh_objects(names)
    leave_edit_mode(objects)
    bpy.context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
    try:
        job = koebe_job.Job(objects, chosen)
    except native.NativeError as error:
        fail(NOT_INSTALLED, error)
    except transfer.TransferError as error:
        fail(UNMAPPABLE, error)
    if chosen.placement == "keep":
        job.read_old_uv()
    job.compute()

    failed = [outcome for outcome in job.outcomes if outcome.failed]
    if failed:
        code = UNMAPPABLE
    elif all(outcome.converged for outcome in job.outcomes):
        code = DONE
    else:
        code = NOT_CONVERGED
    if code != UNMAPPABLE:
        job.write()
        write_whole(output, save_blend)
    if report_file is not None:
        content = {
            "input": source,
            "output": None if code == UNMAPPABLE else str(output),
            "layer": chosen.layer,
            "exit_code": code,
            "objects": [entry for outcome in job.outcomes for entry in report.entries(outcome)],
        }
        write_whole(report_file, lambda path: save_json(path, content))
    for outcome in job.outcomes:
        if outcome.mapped:
            print(report.result_line(outcome), flush=True)
        if outcome.failed:
            print(f"koebe: {report.failure_line(outcome)}", file=sys.stderr, flush=True)
    return code


def main():
    """Entry point of Blender's -P and of a plain Python with the bpy module."""
    before, _, after = (list(part) for part in partition(sys.argv, "--"))
    chosen = parse(after)
    if not bpy.app.binary_path:
        if len(before) != 2:
            fail(USAGE, "usage: python batch.py IN.blend -- --output OUT.blend [options]")
        try:
            bpy.ops.wm.open_mainfile(filepath=str(Path(before[1]).absolute()))
        except RuntimeError as error:
            fail(USAGE, str(error).strip())
    if not bpy.data.filepath:
        fail(USAGE, "no .blend file is open: blender -b IN.blend -P batch.py -- --output OUT.blend [options]")
    return run(*chosen)


def partition(items, mark):
    """What is before the first mark, the mark, what is after it."""
    if mark not in items:
        return items, [], []
    at = items.index(mark)
    return items[:at], [mark], items[at + 1 :]


if __name__ == "__main__":
    sys.exit(main())
