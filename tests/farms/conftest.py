"""What the tests of farms share: a library of surfaces, what one run makes of it, and how results compare."""

import subprocess
import sys
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))
from cli_support import COMMAND, contents, koebe, obj_text, perforated  # noqa: E402,F401

FILES = 40
HOLES = ((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))


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
