"""What the tests of farms share: a library of surfaces, what one run makes of it, and how results compare."""

import json
import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from cli_support import COMMAND, koebe, obj_text, perforated  # noqa: E402,F401

FILES = 40
HOLES = ((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))


def lasting(value):
    """A report without what is measured anew in each run."""
    if isinstance(value, dict):
        return {key: lasting(one) for key, one in value.items() if key not in ("seconds", "peak_memory_mb")}
    return [lasting(one) for one in value] if isinstance(value, list) else value


def contents(folder):
    """Every file of a folder of results, hidden ones too, without what is measured anew."""
    found = {}
    for path in Path(folder).rglob("*"):
        if path.is_file() and path.suffix != ".csv":
            name, content = path.relative_to(folder).as_posix(), path.read_bytes()
            found[name] = lasting(json.loads(content)) if path.suffix == ".json" else content
    return found


@pytest.fixture(scope="session")
def library(tmp_path_factory):
    """Forty surfaces of about a second each, one of them closed."""
    folder = tmp_path_factory.mktemp("library")
    (folder / "more").mkdir()
    for i in range(FILES - 1):
        place = folder / ("more" if i % 2 else "") / f"m{i:02}.obj"
        place.write_text(obj_text(*perforated(200 + i % 10, HOLES)))
    (folder / "closed.off").write_text(
        "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
    )
    return folder


@pytest.fixture(scope="session")
def undisturbed(library, tmp_path_factory):
    """The results of one run with one worker, and its seconds."""
    out = tmp_path_factory.mktemp("undisturbed")
    begin = time.monotonic()
    words = [COMMAND, "batch", str(library), "--output", str(out), "--workers", "1"]
    assert subprocess.run(words, capture_output=True, timeout=900).returncode == 3
    return out, time.monotonic() - begin


@pytest.fixture(scope="session")
def counting_command(tmp_path_factory):
    """The command, and a file that has a line for every map that was begun."""
    folder = tmp_path_factory.mktemp("counted")
    program, log = folder / "koebe", folder / "begun"
    program.write_text(f"#!/bin/sh\necho \"$2\" >>{log}\nexec {COMMAND} \"$@\"\n")
    program.chmod(0o755)
    return program, log
