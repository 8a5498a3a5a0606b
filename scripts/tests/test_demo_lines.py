"""What `make demo` prints, and its filter of grain."""

import importlib
import json
import sys
import types
from pathlib import Path

import demo
import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
FACTS = {
    "loops": [{"roundness": 1e-13}], "faces": 8064, "sweeps": 1, "angle_error_deg": {"mean": 0.3}, "flipped": 0,
    "seconds": {"total": 0.1}, "converged": True,
}  # fmt: skip


@pytest.mark.parametrize("flipped", [0, 3])
def test_a_line_is_printed_as_each_sample_ends(monkeypatch, capsys, tmp_path, flipped):
    printed = []

    def run(_, script, words, blend=None):
        if script.name == "batch.py":
            printed.append(capsys.readouterr().out)
            Path(words[3]).write_text(json.dumps({"objects": [{**FACTS, "flipped": flipped}]}))

    monkeypatch.setattr(demo, "run_script", run)
    words = ["--only", "bowl", "bowl", "--blender", "true", "--output", str(tmp_path)]
    monkeypatch.setattr(sys, "argv", ["demo.py", *words])
    assert demo.main() == bool(flipped)
    first, second = printed
    assert demo.LEGEND in first and "map, s" in first and "bowl" not in first
    verdict = "bowl.png  NOT AS EXPECTED" if flipped else "bowl.png"
    assert second.startswith("bowl") and second.rstrip().endswith(verdict)


def test_patterns_come_last_and_a_fault_is_told(monkeypatch, capsys, tmp_path):
    def run(_, script, words, blend=None):
        if words[0].stem == "lift_rows":
            raise demo.DemoError("no room")

    monkeypatch.setattr(demo, "run_script", run)
    monkeypatch.setattr(demo, "show_samples", lambda *_: [])
    monkeypatch.setattr(sys, "argv", ["demo.py", "--blender", "true", "--output", str(tmp_path)])
    assert demo.main() == 1
    told = capsys.readouterr()
    assert told.out.count("lift") == 4 and told.err == "lift_rows: no room\n"


def test_the_filter_of_grain_keeps_the_edges_of_a_surface(monkeypatch):
    monkeypatch.setitem(sys.modules, "bpy", types.ModuleType("bpy"))
    grain = importlib.import_module("grain")
    monkeypatch.delitem(sys.modules, "grain")
    left = np.arange(64) < 32
    truth = np.broadcast_to(np.where(left, 0.4, 1.0)[None, :, None], (64, 64, 3)).astype(np.float32)
    normal = np.where(left[None, :, None], (1.0, 0.0, 0.0), (0.0, 0.0, 1.0)) * np.ones((64, 1, 1))
    noisy = truth * np.random.default_rng(1).uniform(0.8, 1.2, truth.shape).astype(np.float32)
    smoothed = grain.smooth(noisy, normal, np.ones((64, 64), np.float32))
    assert np.abs(smoothed - truth).mean() < 0.15 * np.abs(noisy - truth).mean()
    assert np.abs(smoothed[:, 31:33] - truth[:, 31:33]).max() < 0.06
