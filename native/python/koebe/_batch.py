"""Maps many mesh files, each by a process of its own: the command `koebe batch`, here or on the workers of Dask."""

import contextlib
import itertools
import json
import os
import queue
import re
import subprocess
import threading
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from . import _command
from ._native import _koebe
from ._option_table import INTERRUPTED, WRONG_USAGE, rows
from ._options import listed, path_of
from ._progress import Run, Shown
from ._watched import watched
from .errors import Cancelled, KoebeError, OptionError

PathLike = str | os.PathLike[str]
Row = dict[str, Any]

_PATIENCE = 20.0  # seconds for a command that was asked to end
_BETWEEN_LOOKS = 0.1  # seconds, at a token or at tasks
_SETTLED = re.compile(r"\[(\d+)/(\d+)\] (.*?): ")  # a line of the command: [3/7] a.obj: done, 0.2 s
_FILES_OF_A_TASK = 10  # at most: a task of Dask and its command take as long as a third of a file of 5,000 faces
_TASKS_OF_A_THREAD = 8  # at least, so that the threads end at about the same time


@watched()
def batch(
    files: PathLike | Sequence[PathLike],
    output: PathLike,
    *,
    workers: int | None = None,
    time_limit: float | None = None,
    base: PathLike | None = None,
    retry: bool = False,
    scheduler: Any = None,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
    **options: Any,
) -> list[Row]:
    """Map many mesh files, each by a process of its own. Files that are done and unchanged are skipped.

    files       a mesh file, a folder (searched with its subfolders), or several of them
    output      the folder for the results: each file's name below its input folder, a report (.json) beside each, and
                the table, summary.json and summary.csv
    workers     number of files at a time; None: one for each core. With a scheduler its workers' threads decide
    time_limit  seconds for a file
    base        names are relative to this folder instead of each input folder
    retry       try failed meshes again
    scheduler   a `dask.distributed.Client`: one to ten files a task, each file on one thread (or `threads`). All
                workers must see the files and the output folder under the same paths
    progress    called as progress(fraction, name) with the share of the files that are done, and the name of the last
                one; with a scheduler with the number of files that are done
    cancel      a CancelToken: all processes end, and finished files stay. Files that workers of Dask have in hand are
                finished
    options     the command's, with _ for -: method="ck", max_sweeps=20, polish=True, format="ply",
                blender="blender"

    Returns one row for each file, by name: name, exit_code (0 done, 3 it cannot be mapped, 4 not converged), error and
    error_text (None, or the reason), seconds, faces, flipped, below_resolution, lost_area, angle_error_deg (the mean),
    warnings (their number), output, input_sha256, options, version. Any number of calls may share one output folder;
    each file is done once. Raises OptionError for a wrong call, KoebeError if the output folder cannot be written, and
    Cancelled, also if another program ended the command.

    >>> import koebe, tempfile
    >>> folder = tempfile.mkdtemp()
    >>> rows = koebe.batch(["blend_samples/face.obj", "docs/link.obj"], folder, cut=True)
    >>> [(row["name"], row["exit_code"]) for row in rows]
    [('face.obj', 0), ('link.obj', 0)]
    """
    if isinstance(files, str | os.PathLike):
        files = [files]
    inputs = [os.path.abspath(path_of(file, "files")) for file in listed(files, "files")]
    if not inputs:
        return []
    folder, run = os.path.abspath(path_of(output, "output")), Run(progress, cancel)
    # A worker of Dask has another working folder.
    common = _words({"time_limit": time_limit, "retry": retry, **options})
    named = [*inputs, *_words({"base": base and os.path.abspath(path_of(base, "base"))}), "--output", folder, *common]
    lines = _run([*named, "--list"]).splitlines()
    run.at(0.0, "list")
    if scheduler is None:
        _run([*named, *_words({"workers": workers})], run)
    else:
        _run_on_workers(scheduler, lines, ["--output", folder, *common, *_one_thread(options)], run)
        _run([*named, "--summary-only"])
    run.at(1.0, "table")
    found = {row["name"]: row for row in json.loads((Path(folder) / "summary.json").read_text("utf-8"))["files"]}
    return [found[name] for name in (line.split("\t")[1] for line in lines)]


def _run_on_workers(scheduler: Any, listed: list[str], words: list[str], run: Run) -> None:
    """Maps the listed files on the workers of Dask: each task some files of one folder, one after the other."""
    threads = sum(scheduler.ncores().values()) or len(listed)  # a cluster without workers will get some
    size = min(max(len(listed) // (_TASKS_OF_A_THREAD * threads), 1), _FILES_OF_A_TASK)
    tasks: dict[Any, int] = {}  # with the number of files
    for home, lines in itertools.groupby(sorted(listed), key=lambda line: line.split("\t")[0]):
        names = [line.split("\t")[1] for line in lines]
        for first in range(0, len(names), size):
            files = [os.path.join(home, name) for name in names[first : first + size]]
            key = f"koebe-{names[first]}-{os.urandom(8).hex()}"
            task = scheduler.submit(_run_some, [*files, "--base", home, *words], pure=False, key=key)
            tasks[task] = len(files)
    try:
        _wait(tasks, run)
        scheduler.gather(list(tasks))
    except BaseException:
        scheduler.cancel(list(tasks))
        raise


def _wait(tasks: dict[Any, int], run: Run) -> None:
    """Tells the progress until all tasks are done, or one has failed."""
    waiting, total = list(tasks), sum(tasks.values())
    while waiting and not any(task.status == "error" for task in tasks):
        before, waiting = len(waiting), [task for task in waiting if not task.done()]
        if len(waiting) == before:
            time.sleep(_BETWEEN_LOOKS)
            run.check()
            continue
        done = total - sum(tasks[task] for task in waiting)
        run.at(done / total, f"{done} of {total} files")


def _run_some(words: list[str]) -> None:
    """Maps files on a worker. The table is written once, at the end."""
    _run([*words, "--workers=1", "--no-summary"])


def _one_thread(options: dict[str, Any]) -> list[str]:
    """The words that keep a file to one thread, as other files are mapped beside it; none if the caller has said so."""
    domain = options.get("domain", "disk")
    known = rows("uniformize" if domain == "disk" else domain)
    return ["--threads=1"] if "threads" in known and options.get("threads") is None else []


def _words(options: dict[str, Any]) -> list[str]:
    """The options as words of the command. None and False are left out."""
    words = []
    for name, value in options.items():
        if value is None or value is False:
            continue
        word = f"--{name.replace('_', '-')}"
        if isinstance(value, list | tuple):
            value = ",".join(map(str, value))
        words.append(word if value is True else f"{word}={value}")
    return words


def _run(words: list[str], run: Run | None = None) -> str:
    """The output of `koebe batch` with these words. The command ends when this Python process
    ends, even if the process is killed."""
    process = subprocess.Popen(
        [str(_command.path()), "batch", "--end-with-input", *words],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", errors="replace",
    )  # fmt: skip
    with process:
        try:
            printed, complaints = _read(process, run or Run(None, None))
        except BaseException:  # Ctrl-C, a cancel, or an error of the progress
            process.terminate()
            try:
                process.wait(_PATIENCE)
            except subprocess.TimeoutExpired:
                process.kill()
            raise
    if process.returncode == INTERRUPTED:
        raise Cancelled("the run was interrupted: the same call goes on from there")
    if not printed:  # a completed run prints a line, also for failed meshes
        last = (complaints.strip().splitlines() or [f"koebe batch ended with {process.returncode}"])[-1]
        if process.returncode == WRONG_USAGE:
            raise OptionError(last.removeprefix("WrongUsage: ").removesuffix(" (see koebe --help)"))
        raise KoebeError(last)
    return printed


def _read(process: "subprocess.Popen[str]", run: Run) -> tuple[str, str]:
    """Reads all output, tells the progress, and leaves the input open: `communicate` would close it."""
    lines: queue.SimpleQueue[tuple[Any, str]] = queue.SimpleQueue()

    def pass_on(stream: Any) -> None:
        for line in stream:
            lines.put((stream, line))
        lines.put((stream, ""))

    said: dict[Any, list[str]] = {process.stdout: [], process.stderr: []}
    for stream in said:
        threading.Thread(target=pass_on, args=(stream,), daemon=True).start()
    ended = 0
    while ended < len(said):
        with contextlib.suppress(queue.Empty):
            stream, line = lines.get(timeout=_BETWEEN_LOOKS)
            said[stream].append(line)
            ended += not line
            if stream is process.stderr and (settled := _SETTLED.match(line)):
                run.at(int(settled[1]) / int(settled[2]), settled[3])
        run.check()
    process.wait()
    return "".join(said[process.stdout]), "".join(said[process.stderr])
