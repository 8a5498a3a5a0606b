"""The scripts that `make demo` draws parts with run on the add-on as it is."""

import json
import os
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
BLENDER = os.environ.get("BLENDER", "blender")

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("sample", ["hand", "mug"])
def test_parts_are_drawn_and_told(tmp_path, sample):
    picture, report = tmp_path / "parts.png", tmp_path / "report.json"
    words = [BLENDER, "-b", ROOT / "blend_samples" / f"{sample}.blend", "--factory-startup", "--python-exit-code", "1"]
    words += ["-P", ROOT / "scripts" / "parts_picture.py", "--", "--output", picture, "--report", report]
    done = subprocess.run([*words, "--size", "64x32", "--samples", "1"], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
    figures = json.loads(report.read_text())
    assert figures["parts"] > 1 and figures["flipped"] == 0
    assert picture.stat().st_size > 0
