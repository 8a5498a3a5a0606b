"""docs/labs.md: every block runs, one after the other, and gives what the page says."""

import re
import shutil
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]


def test_the_blocks_of_the_page_run(tmp_path, monkeypatch):
    page = (ROOT / "docs" / "labs.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == 5
    (tmp_path / "blend_samples").mkdir()
    for name in ("face.obj", "surprised.obj"):
        shutil.copy(ROOT / "blend_samples" / name, tmp_path / "blend_samples")
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, "docs/labs.md", "exec"), names)
    assert (tmp_path / "face.vtu").stat().st_size > 0
    assert np.array_equal(names["again"].uv, names["neutral"].uv)
    assert names["places"].fitted and names["moved"].shape == (names["neutral"].vertices,)
    assert (tmp_path / "modules.csv").read_text().startswith("label,r_1,y_2,r_2,x_3,y_3,r_3\nneutral,0.")
    assert np.array_equal(names["results"][1].uv, names["surprised"].uv)
