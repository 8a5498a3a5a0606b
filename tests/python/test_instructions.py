"""A step back in speed: a command may take a tenth more instructions than instructions.json says, not more.

Valgrind counts them, with our least kernels, so that the count hardly depends on the machine. It depends on the
compiler: only what Debian 12's compiles is counted. If a change is worth its instructions, write the new count.
"""

import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
from cli_support import COMMAND, obj_text, perforated

COUNTS = json.loads(Path(__file__).with_name("instructions.json").read_text(encoding="utf-8"))  # in millions
MORE = 1.1

pytestmark = [
    pytest.mark.skipif(shutil.which("valgrind") is None, reason="there is no valgrind"),
    pytest.mark.skipif(b"GCC: (Debian 12." not in Path(COMMAND).read_bytes(), reason="another compiler"),
]


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("instructions")
    (folder / "in.obj").write_text(obj_text(*perforated()))
    (folder / "small.obj").write_text(obj_text(*perforated(12, ((0.5, 0.5, 0.2),))))
    return folder


@pytest.mark.parametrize("words", COUNTS)
def test_a_command_takes_no_more_instructions_than_before(folder, words):
    counter = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    done = subprocess.run([*counter, COMMAND, *words.split()], cwd=folder, capture_output=True, text=True, timeout=120,
                          env={**os.environ, "KOEBE_KERNELS": "sse2"}, check=False)  # fmt: skip
    assert done.returncode == 0, done.stderr
    millions = int(re.search(r"I\s+refs:\s+([\d,]+)", done.stderr)[1].replace(",", "")) / 1e6
    assert millions <= MORE * COUNTS[words], f"{millions:.1f} million instructions"
