"""What the tests of koebe batch share: folders of meshes, and files of Blender that stand for meshes that behave badly.

A script in Blender's place does what such a file says.
"""

import contextlib
import json
import os
import signal
import subprocess
import sys
import time

import pytest
from cli_support import COMMAND, koebe, new_program, obj_text, off_text, perforated

TETRAHEDRON = off_text([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
# A program in Blender's place: it does what the first word of the file says, and notes that it ran.
STAND_IN = """#!{python}
import json, os, signal, sys, time
words = sys.argv
source, at = words[2], words.index("--")
option = lambda name: words[words.index(name, at) + 1]
with open(source + ".runs", "a") as runs:
    runs.write(f"{{os.getpid()}}\\n")
what, *rest = open(source).read().split()
code = 0
if what == "sleep":
    time.sleep(float(rest[0]))
elif what == "endless":
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    while True:
        time.sleep(1)
elif what == "wait":  # for the one that started it to end
    sys.stdin.buffer.read()
    sys.exit(130)
elif what == "signal":
    os.kill(os.getpid(), int(rest[0]))
elif what == "exit":
    code = int(rest[0])
elif what == "refuse":  # without a report
    print("koebe: as it says", file=sys.stderr)
    sys.exit(int(rest[0]))
report = {{"objects": [], "exit_code": code}}
if code == 3:
    report["error"] = {{"name": "TransferError", "reason": "as it says"}}
else:
    open(option("--output"), "w").write(f"a result of {{source}}")
open(option("--report"), "w").write(json.dumps(report))
sys.exit(code)
"""


@pytest.fixture
def library(tmp_path):
    """Four surfaces, two of them in a folder, one that is closed, one that is no mesh."""
    folder = tmp_path / "library"
    (folder / "masks").mkdir(parents=True)
    for i, name in enumerate(("a", "b", "masks/c", "masks/d")):
        (folder / f"{name}.obj").write_text(obj_text(*perforated(10 + i)))
    (folder / "closed.off").write_text(TETRAHEDRON)
    (folder / "broken.ply").write_text("ply\n")
    (folder / "notes.txt").write_text("no mesh")
    (folder / ".hidden.obj").write_text("no mesh")
    return folder


@pytest.fixture
def blends(tmp_path):
    """A maker of .blend files that say what the program in Blender's place does, and that program."""
    program = new_program(tmp_path / "stand_in", STAND_IN.format(python=sys.executable))
    folder = tmp_path / "blends"
    folder.mkdir()

    class Blends:
        path = folder
        words = (folder, "--blender", program)

        def __init__(self, **files):
            for name, text in files.items():
                (folder / f"{name}.blend").write_text(text)

        @staticmethod
        def runs(name):
            file = folder / f"{name}.blend.runs"
            return [int(line) for line in file.read_text().split()] if file.exists() else []

    return Blends


def batch(*words, **options):
    return koebe("batch", *words, **options)


def as_from_a_terminal():
    """A run of the tests in the background, or under nohup, ignores signals, and its children would too."""
    for number in (signal.SIGINT, signal.SIGHUP):
        signal.signal(number, signal.SIG_DFL)


def start(*words, before=as_from_a_terminal):
    """A started batch; `before` is called in it first."""
    return subprocess.Popen([COMMAND, "batch", *map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                            text=True, preexec_fn=before)  # fmt: skip


def rows(folder):
    """The table, by name."""
    return {row["name"]: row for row in json.loads((folder / "summary.json").read_text())["files"]}


def until(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def is_alive(process):
    with contextlib.suppress(ProcessLookupError):
        os.kill(process, 0)
        with open(f"/proc/{process}/stat") as status:
            return status.read().rpartition(")")[2].split()[0] != "Z"
    return False
