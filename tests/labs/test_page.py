"""docs/labs.md and the notebooks of docs/: every block runs, and gives what the page says."""

import re
import shutil
from pathlib import Path

import koebe
import nbformat
import notebooks
import numpy as np

ROOT = Path(__file__).resolve().parents[2]


def test_the_blocks_of_the_page_run(tmp_path, monkeypatch):
    page = (ROOT / "docs" / "labs.md").read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    assert len(blocks) == 15
    (tmp_path / "blend_samples").mkdir()
    for name in ("face.obj", "surprised.obj"):
        shutil.copy(ROOT / "blend_samples" / name, tmp_path / "blend_samples")
    monkeypatch.chdir(tmp_path)
    names = {}
    for block in blocks:
        exec(compile(block, "docs/labs.md", "exec"), names)
    assert (tmp_path / "face.vtu").stat().st_size > 0
    assert np.array_equal(names["again"].uv, names["neutral"].uv)
    assert names["laid"].misses_deg.max() < 20 and np.isfinite(names["laid"].points).all()
    bent, closed = names["bent"], names["closed"]
    assert bent.misses_deg.max() < 1e-6 and bent.bending["flipped"] == 0
    assert bent.similarity > bent.bending["similarity_before"]
    assert np.array_equal(koebe.load(tmp_path / "bent.npz").sphere, bent.sphere)
    assert closed.mean.shape == names["sphere"].vertices.shape and closed.distances[0, 1] > 0
    masked, mask = names["masked"], names["mask"]
    assert 0 < mask.sum() < 500 and np.isnan(masked.uv[mask]).all() and len(masked.loops) == len(names["neutral"].loops)
    assert np.allclose(names["scale"], masked.log_scale, atol=1e-5, equal_nan=True)
    assert np.array_equal(names["region"], np.isfinite(masked.log_scale))
    assert (tmp_path / "lh.face.patch.flat").stat().st_size > 0
    assert names["places"].fitted and names["moved"].shape == (names["neutral"].vertex_count,)
    held, tip = names["held"], names["tip"]
    assert held.flipped == 0 and np.allclose(held.points[tip], names["surprised"].surface[0][tip], atol=1e-9)
    found = names["found"]
    assert found.points.shape == (2, names["neutral"].vertex_count, 3) and names["images"].shape == (2, 128, 128)
    assert np.array_equal(names["matrix"][0], names["depth"][0]) and found.margins[1] > 0.3
    assert (names["bars"] > 0).all() and names["both"].distance_errors[0, 1] > 0
    assert (tmp_path / "modules.csv").read_text().startswith("label,r_1,y_2,r_2,x_3,y_3,r_3\nneutral,0.")
    assert names["cortex"].map.flipped == 0 and names["cortex"].map.angle_error_deg["mean"] < 9.5
    assert (tmp_path / "flat_lh.gii").stat().st_size > 0
    assert np.array_equal(names["results"][1].uv, names["surprised"].uv)


def run(name, tmp_path, monkeypatch):
    """The notebook of docs/, executed, and how many pictures it shows: what it prints is what the file keeps."""
    monkeypatch.setenv("PYTHONPATH", "")
    monkeypatch.setenv("MPLBACKEND", "")
    kept = notebooks.shown(nbformat.read(ROOT / "docs" / name, as_version=4))
    notebook = notebooks.executed(name, tmp_path)
    found = notebooks.shown(notebook)
    assert [rounded(output) for output in found] == [rounded(output) for output in kept], "scripts/notebooks.py"
    return notebook, sum("image/png" in output.get("data", {}) for output in found)


def rounded(output):
    """The text of an output without the version and without last digits, which a processor may round otherwise."""
    text = output.get("text") or output["data"].get("text/plain", "")
    return re.sub(r"(\d\.\d{2})\d*", r"\1", re.sub(r"0x[0-9a-f]+|\b\d+\.\d+\.\d+\b", "", text))


def test_the_tutorial_runs(tmp_path, monkeypatch):
    assert run("tutorial.ipynb", tmp_path, monkeypatch)[1] == 3
    assert (tmp_path / "modules.csv").read_text().startswith("label,r_1")


def test_the_study_of_atria_finds_the_bulge_that_it_made(tmp_path, monkeypatch):
    notebook, pictures = run("atrium.ipynb", tmp_path, monkeypatch)
    assert pictures == 3
    said = notebook.cells[-2].outputs[0]["data"]["text/plain"]
    *place, p = (float(number) for number in re.findall(r"-?\d+\.\d+", said))
    assert np.linalg.norm(np.array(place) - (0, 8, 19)) < 8 and p <= 0.05  # mm, on the roof


def test_the_cortex_lies_flatter_than_freesurfers(tmp_path, monkeypatch):
    notebook, pictures = run("cortex.ipynb", tmp_path, monkeypatch)
    ours, theirs = (
        [float(number) for number in re.findall(r"\d+\.\d+|\d+(?= flipped)", line)]
        for line in notebook.cells[6].outputs[0]["text"].splitlines()
    )
    assert pictures == 1 and ours[2] == 0 and ours[0] < 0.65 * theirs[0] and ours[1] < 0.5 * theirs[1]
    assert (tmp_path / "flat_lh.gii").stat().st_size > 0
