"""Processes of their own: a Blender, or a Python with bpy, that runs a script."""

import os
import subprocess
import sys

import bpy

# Starts the add-on's package from a folder, under a name of its own, and loads the native module.
LOAD = """
import importlib.util, os, sys
folder = os.environ["ADDON"]
spec = importlib.util.spec_from_file_location("probe", folder + "/__init__.py", submodule_search_locations=[folder])
sys.modules["probe"] = importlib.util.module_from_spec(spec)
spec.loader.exec_module(sys.modules["probe"])
from probe import native
try:
    koebe = native.load()
    koebe.CancelToken()
    print("LOADED", koebe.__file__, flush=True)
except native.NativeError as error:
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


def start(script, folder, opened=(), arguments=(), **changes):
    """A started process with its output in pipes, as text."""
    words = [*command(script, opened), *(["--", *map(str, arguments)] if arguments else [])]
    return subprocess.Popen(
        words, cwd=folder, env=environment(**changes), text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE
    )


def finish(process, seconds=300):
    """Wait for it: exit code, standard output, standard error."""
    out, err = process.communicate(timeout=seconds)
    return process.returncode, out, err
