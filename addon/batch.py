# SPDX-License-Identifier: GPL-3.0-or-later
"""Map the objects of a .blend file without a window.

    blender -b IN.blend --python-exit-code 1 -P batch.py -- --output OUT.blend --report OUT.json [options]
    blender -b --python-exit-code 1 -P batch.py -- IN.blend --output OUT.blend --report OUT.json [options]
    python batch.py IN.blend -- --output OUT.blend --report OUT.json [options]     (with the bpy module)
    blender -b --python-exit-code 1 -P batch.py -- A.blend FOLDER ... --output FOLDER [options]

The last form maps a library: every file by a Blender of its own; files that are done and unchanged are skipped. It is
the command `koebe batch --blender` of the native module, and has its exit codes.

Exit code: 0 done, 1 the native module is missing or something failed, 2 wrong usage, 3 the file cannot be read or an
object cannot be mapped (no OUT), 4 not converged, or too much of the area lost (OUT is written, lost objects keep their
UVs), 130 interrupted (nothing is written). OUT and the report are written to temporary files and renamed: each is
complete or absent. There is a report with 0, 3 and 4, and if the native module is missing. With 3 its `error` says why.
"""

import concurrent.futures
import importlib
import importlib.util
import os
import shutil
import signal
import subprocess
import sys
import traceback
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
PACKAGE = "koebe_uv_batch"  # another copy of the add-on may be enabled

POLL_SECONDS = 0.05  # delay until a signal is obeyed during a computation
PATIENCE_SECONDS = 10.0  # time to wait for the next checkpoint then


def load_package() -> None:
    """Import the add-on that this script is part of, installed or not, without registering it."""
    spec = importlib.util.spec_from_file_location(PACKAGE, HERE / "__init__.py", submodule_search_locations=[str(HERE)])
    assert spec is not None and spec.loader is not None
    package = importlib.util.module_from_spec(spec)
    sys.modules[PACKAGE] = package
    spec.loader.exec_module(package)


for name in {"SIGXFSZ", "SIGPIPE"} & set(dir(signal)):  # a file or a pipe that takes no more is an error, not the end
    signal.signal(getattr(signal, name), signal.SIG_IGN)
load_package()

from koebe_uv_batch.headless.exit_and_signals import (  # noqa: E402
    BROKEN,
    DONE,
    INTERRUPTED,
    NOT_CONVERGED,
    UNMAPPABLE,
    USAGE,
    Signals,
    Stop,
    drop_what_cannot_be_printed,
    refusal,
    say,
    tell,
)

SIGNALS = Signals()  # before bpy, which as a module takes a second to load

import bpy  # noqa: E402
from koebe_uv_batch.blender.errors import TransferError  # noqa: E402
from koebe_uv_batch.blender.mesh_object import MeshObject  # noqa: E402
from koebe_uv_batch.headless.arguments import IN_BLENDER, WITH_BPY, Request, parse  # noqa: E402
from koebe_uv_batch.headless.files import Target, is_same, save_json, write_all  # noqa: E402
from koebe_uv_batch.headless.flag_names import in_flags  # noqa: E402
from koebe_uv_batch.headless.objects import chosen_objects, in_their_places, leave_edit_mode  # noqa: E402
from koebe_uv_batch.jobs import native_package  # noqa: E402
from koebe_uv_batch.jobs.job_of_domain import job_type  # noqa: E402
from koebe_uv_batch.jobs.map_job import Job  # noqa: E402
from koebe_uv_batch.jobs.parts_job import PartsJob  # noqa: E402
from koebe_uv_batch.jobs.sequence_job import SequenceJob  # noqa: E402
from koebe_uv_batch.maps import wording  # noqa: E402
from koebe_uv_batch.solver.errors import NativeError  # noqa: E402
from koebe_uv_batch.surfaces.stored import LostAreaError  # noqa: E402

OUT_OF_MEMORY = Stop(UNMAPPABLE, "this needs more memory than there is", "OutOfMemory")


def main() -> int:
    """Entry point of Blender's -P and of plain Python with the bpy module. Returns the exit code."""
    try:
        return run()
    except Stop as stop:
        tell(stop.reason)
        return stop.code
    except Exception:
        traceback.print_exc()
        return BROKEN
    finally:
        drop_what_cannot_be_printed()


def run() -> int:
    """Read, map, save, report; return the exit code. Raises Stop if there is nothing to report on."""
    request, sources = request_and_sources()
    if request.ends_with_input:
        SIGNALS.watch_input()
    if len(sources) > 1 or os.path.isdir(sources[0]):
        return map_library(request, sources)
    source = os.path.abspath(sources[0])
    output, report_file = targets(request, source)
    content = {"input": source, "output": None, "layer": request.options.layer, "exit_code": None, "objects": []}
    job = None
    try:
        open_source(source)
        refuse_what_is_read([file for file in (output, report_file) if file is not None])
        job = map_objects(request)
        code = exit_code(job)
        content["objects"] = [entry for outcome in job.outcomes for entry in job.entries(outcome)]
        if code == UNMAPPABLE:
            content["error"] = wording.run_error(job.outcomes)
    except (Stop, MemoryError) as error:
        stop = error if isinstance(error, Stop) else OUT_OF_MEMORY
        # One of several files gets a report even without the requested objects.
        if stop.code not in (BROKEN, UNMAPPABLE) and not (stop.code == USAGE and request.ends_with_input):
            raise
        tell(stop.reason)
        code = stop.code
        content.update(error={"name": stop.name, "reason": stop.reason}, objects=stop.objects)
    content["exit_code"] = code
    if code not in (DONE, NOT_CONVERGED):
        output = None
    else:
        content["output"] = request.output
    save(output, report_file, content)
    if job is not None:
        tell_outcomes(job)
    return code


def request_and_sources() -> tuple[Request, list[str]]:
    """The request, and the given paths."""
    at = sys.argv.index("--") if "--" in sys.argv else len(sys.argv)
    request = parse(sys.argv[at + 1 :])
    sources = [bpy.data.filepath] if bpy.app.binary_path else sys.argv[1:at]
    sources = [source for source in (*sources, *request.sources) if source]
    opened = len(sources) - len(request.sources)
    if not sources or (opened and len(sources) > 1):
        what = "no IN.blend" if not sources else f"more than one IN.blend: {', '.join(sources)}"
        usage = IN_BLENDER if bpy.app.binary_path else WITH_BPY
        raise Stop(USAGE, f"{what}; usage: {usage}")
    return request, sources


def map_library(request: Request, sources: list[str]) -> int:
    """Map many files by the native module's command, each in a Blender of its own; return its exit code."""
    if not bpy.app.binary_path:
        raise Stop(USAGE, "several files and folders need Blender's program: koebe batch --blender PROGRAM")
    if request.report is not None:
        raise Stop(USAGE, "--report works with one file: the reports of several files are beside the results")
    try:
        native_package.load()
        command = importlib.import_module("koebe._command").path()
    except NativeError as error:
        raise Stop(BROKEN, error, "NativeError") from error
    words = [str(command), "batch", "--end-with-input", *sources, "--output", request.output, *request.library.batch]
    words += ["--blender", bpy.app.binary_path, "--blender-script", str(HERE / "batch.py")]
    words += [f"--blender-argument={word}" for word in request.library.each]
    process = subprocess.Popen(words, stdin=subprocess.PIPE)
    while True:
        try:
            return process.wait(POLL_SECONDS)
        except subprocess.TimeoutExpired:
            if SIGNALS.came:
                process.terminate()  # it ends its processes, and keeps finished files


def targets(request: Request, source: str) -> tuple[Target, Target | None]:
    """The files to write, of which the second may be None."""
    output = Target(request.output, scratch=request.ends_with_input)
    if output.direct:
        raise Stop(USAGE, f"--output {request.output} is not a file, so it cannot be replaced")
    if request.report is None:
        return output, None
    for other, what in ((source, "the input"), (output.path, "the output")):
        if is_same(request.report, other):
            raise Stop(USAGE, f"--report {request.report} is {what}")
    return output, Target(request.report)


def open_source(source: str) -> None:
    """Open the file, unless Blender has. Refuse files of a newer Blender, which read with losses or crash."""
    if not bpy.data.filepath:
        try:
            bpy.ops.wm.open_mainfile(filepath=source)
        except RuntimeError as error:
            reason = str(error).strip().removeprefix("Error: ")
            raise Stop(UNMAPPABLE, f"{source} cannot be read: {reason}", "FileError") from None
    if bpy.data.version[:2] > bpy.app.version[:2]:
        by, this = (".".join(map(str, version[:2])) for version in (bpy.data.version, bpy.app.version))
        reason = f"{source} was saved by Blender {by}, and this is {this}: data would be lost"
        raise Stop(UNMAPPABLE, reason, "FileError")
    SIGNALS.obey()


def refuse_what_is_read(files: list[Target]) -> None:
    """Refuse to write onto a library, an image or another file that the .blend reads."""
    for path in bpy.utils.blend_paths(absolute=True):
        for file in files:
            if os.path.exists(path) and is_same(path, file.path):
                raise Stop(USAGE, f"{file.given} is a file that the input uses")


def map_objects(request: Request) -> Job:
    """The job after its run, with results written into the open file unless an object failed."""
    objects = chosen_objects(request.names)
    leave_edit_mode(objects)
    with in_their_places(objects):
        job = new_job(objects, request)
        check_vertices(job)
        if request.options.placement == "keep":
            job.read_old_uv()
        read_shapes(job)
        compute(job)
        if exit_code(job) != UNMAPPABLE:
            try:
                job.write()
            except TransferError as error:
                raise Stop(UNMAPPABLE, error, "TransferError") from error
    SIGNALS.obey()
    return job


def read_shapes(job: Job) -> None:
    """Read the frames of a sequence."""
    if not isinstance(job, SequenceJob):
        return
    try:
        for _ in job.read_shapes(bpy.context):
            SIGNALS.obey()
    except TransferError as error:
        raise Stop(UNMAPPABLE, error, "TransferError") from error


def new_job(objects: list[MeshObject], request: Request) -> Job:
    """A job on all the objects, or the reasons why some cannot be mapped."""
    without_faces = [obj.name for obj in objects if len(obj.data.polygons) == 0]
    if without_faces and (request.names is not None or len(without_faces) == len(objects)):
        raise refusal(dict.fromkeys(without_faces, "it has no faces"))
    try:
        return job_of(objects, request)
    except NativeError as error:
        raise Stop(BROKEN, error, "NativeError") from error
    except TransferError as error:
        raise refusal(reasons(objects, request) or {"all objects": str(error)}) from error


def job_of(objects: list[MeshObject], request: Request) -> Job:
    """A job on all the objects. Raises NativeError and TransferError."""
    if request.sequence is not None:
        return SequenceJob(objects, request.options, request.sequence)
    if request.parts is not None:
        return PartsJob(objects, request.options, request.parts)
    if request.domain is None:
        return Job(objects, request.options)
    return job_type(request.domain)(objects, request.options, request.domain)


def reasons(objects: list[MeshObject], request: Request) -> dict[str, str]:
    """The reasons why objects cannot be mapped, by name."""
    found = {}
    for obj in objects:
        try:
            if len(obj.data.polygons):
                job_of([obj], request)
        except TransferError as error:
            found[obj.name] = str(error).removeprefix(f"{obj.name}: ")
    return found


def check_vertices(job: Job) -> None:
    """Refuse vertex numbers that the mesh does not have."""
    for option in ("outer", "center", "point"):
        vertex = getattr(job.options, option)
        for task in job.tasks if isinstance(vertex, int) else ():
            if not (task.surface.corner_vertex == vertex).any():
                raise Stop(USAGE, f"--{option} {vertex}: {task.name!r} has no face at a vertex of that number")


def compute(job: Job) -> None:
    """Run the job on a thread, so that signals act at once. It ends at its next checkpoint, or is abandoned."""
    future = concurrent.futures.ThreadPoolExecutor(max_workers=1).submit(job.compute)
    while not concurrent.futures.wait([future], POLL_SECONDS).done:
        if SIGNALS.came:
            job.cancel_token.cancel()
            if not concurrent.futures.wait([future], PATIENCE_SECONDS).done:
                tell("interrupted: nothing was written")
                shutil.rmtree(bpy.app.tempdir, ignore_errors=True)
                os._exit(INTERRUPTED)
    SIGNALS.obey()
    future.result()


def exit_code(job: Job) -> int:
    """The exit code of a finished job."""
    errors = [one.error for outcome in job.outcomes for one in outcome.failed]
    if not all(isinstance(error, LostAreaError) for error in errors):
        return UNMAPPABLE
    return DONE if not errors and all(outcome.converged for outcome in job.outcomes) else NOT_CONVERGED


def save(output: Target | None, report_file: Target | None, content: dict[str, Any]) -> None:
    """Save the open file and the report, each of which may be None. If the report exists, the output does, too."""
    makers = {output: save_blend, report_file: lambda path: save_json(path, content)}
    makers.pop(None, None)
    write_all(makers, SIGNALS.obey)


def save_blend(path: str) -> None:
    """Save the open file there, uncompressed: with compression Blender does not notice a full disk."""
    bpy.ops.wm.save_as_mainfile(filepath=path, copy=True, check_existing=False, compress=False)


def tell_outcomes(job: Job) -> None:
    """Print the objects' result lines, and the reasons of failed objects."""
    for outcome in job.outcomes:
        if outcome.mapped:
            say(in_flags(job.line(outcome)), sys.stdout)
        if outcome.failed:
            tell(wording.failure_line(outcome))


if __name__ == "__main__":
    sys.exit(main())
