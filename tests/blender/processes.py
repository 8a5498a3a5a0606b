"""Processes of their own: a Blender, or a Python with bpy, that runs a script."""

import importlib
import os
import signal
import subprocess
import sys
from pathlib import Path

import bpy
import pytest

# Starts the add-on's package from a folder, under a name of its own, and loads the native module.
LOAD = """
import importlib.util, os, sys
folder = os.environ["ADDON"]
spec = importlib.util.spec_from_file_location("probe", folder + "/__init__.py", submodule_search_locations=[folder])
sys.modules["probe"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sys.modules["probe"])
from probe.jobs import native_package
from probe.solver.errors import NativeError
try:
    koebe = native_package.load()
    koebe.CancelToken()
    print("LOADED", koebe.__file__, flush=True)
except NativeError as error:
    print("REFUSED", error, flush=True)
"""


def command(script, opened=()):
    """The words that run a script after the file is opened, with an exception as exit code 1."""
    if bpy.app.binary_path:
        return [bpy.app.binary_path, "-b", *map(str, opened), "--python-exit-code", "1", "-P", str(script)]
    return [sys.executable, str(script), *map(str, opened)]


def environment(**changes):
    """This process's environment with changes; no byte code is left in the folders under test."""
    return {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", **{name: str(value) for name, value in changes.items()}}


def as_from_a_terminal():
    """Where this run itself is in the background, or under nohup, it ignores signals, and its children would too."""
    for name in ("SIGINT", "SIGHUP", "SIGQUIT"):
        if hasattr(signal, name):
            signal.signal(getattr(signal, name), signal.SIG_DFL)


def start(script, folder, opened=(), arguments=(), before=as_from_a_terminal, **changes):
    """A started process with its output in pipes, as text; `before` is called in it first."""
    words = [*command(script, opened), *(["--", *map(str, arguments)] if arguments else [])]
    return subprocess.Popen(
        words, cwd=folder, env=environment(**changes), text=True, errors="surrogateescape",
        preexec_fn=before if os.name == "posix" else None, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
    )  # fmt: skip


def finish(process, seconds=300):
    """Wait for it: exit code, standard output, standard error."""
    out, err = process.communicate(timeout=seconds)
    return process.returncode, out, err


def own_lines(err):
    """What batch.py has written to standard error, among Blender's own lines, which depend on the machine."""
    return [line for line in err.splitlines() if line.startswith("koebe: ")]


def open_terminal():
    """Both ends of a pseudo-terminal; without one, as in a bare container, the test is skipped."""
    try:
        return os.openpty()
    except OSError as error:
        pytest.skip(f"no pseudo-terminal here: {error}")


# Runs batch.py with one of its functions changed by {patch}, which has the module as `batch`.
PATCHED = """
import importlib.util, os, signal, sys, time
spec = importlib.util.spec_from_file_location("batch", {script!r})
batch = importlib.util.module_from_spec(spec)
spec.loader.exec_module(batch)
def after(owner, name, act):
    function = getattr(owner, name)
    def changed(*args, **more):
        result = function(*args, **more)
        act()
        return result
    setattr(owner, name, changed)
{patch}
sys.exit(batch.main())
"""


def start_batch(addon_name, folder, *arguments, source=None, patch=None, **changes):
    """A started process that runs the installed batch.py on a file, by default the one that is open here."""
    script = Path(importlib.import_module(addon_name).__file__).with_name("batch.py")
    if source is None:
        source = folder / "in.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(source), copy=True)
    if patch is not None:
        text = PATCHED.format(script=str(script), patch=patch)
        script = folder.parent / f"{folder.name}-patched.py"
        script.write_text(text)
    return start(script, folder, [source] if source else [], arguments, **changes)


def run_batch(*arguments, **options):
    """The same, ended: exit code, standard output, standard error."""
    return finish(start_batch(*arguments, **options))
