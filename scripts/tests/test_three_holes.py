"""docs/three_holes.ipynb, the method from nothing: it runs, prints what it shows, and finds the map of the command."""

import json
import re
from pathlib import Path

import numpy as np
import pytest
import three_holes
from cli_support import koebe as command

ROOT = Path(__file__).resolve().parents[2]
NOTEBOOK = json.loads(three_holes.NOTEBOOK.read_text(encoding="utf-8"))
CODE = [cell for cell in NOTEBOOK["cells"] if cell["cell_type"] == "code"]
NUMBER = re.compile(r"-?\d+\.?\d*")
LINES = 66  # of NumPy, at most


@pytest.fixture(scope="module")
def run():
    return three_holes.run(NOTEBOOK)


def shown(cell):
    return "".join("".join(output["text"]) for output in cell["outputs"])


def rows_of(obj):
    """Points, and faces and loops by their points: the order of the points follows the last bit of the outlines."""
    rows = [line.split() for line in obj.splitlines()]
    points = [tuple(row[1:]) for row in rows if row[0] == "v"]
    named = [[points[int(i) - 1] for i in row[1:]] for row in rows if row[0] in "fl"]
    return sorted(points), sorted(row[k:] + row[:k] for row in named for k in [row.index(min(row))])


def same(one, other):
    """The same words, and numbers that differ by one in the last printed digit at most."""
    if NUMBER.sub("", one.replace("-", "")).split() != NUMBER.sub("", other.replace("-", "")).split():
        return False
    for a, b in zip(NUMBER.findall(one), NUMBER.findall(other)):
        digits = min(len(text.partition(".")[2]) for text in (a, b))
        if abs(float(a) - float(b)) > 1.01 * 10.0**-digits * ("." in a):
            return False
    return True


def test_it_prints_what_it_shows(run):
    assert [cell["execution_count"] for cell in CODE] == list(range(1, len(CODE) + 1))
    for cell, text in zip(CODE, run[0]):
        assert same(text, shown(cell)), text
    assert not same("a 0.123 4", "a 0.125 4") and not same("a 0.123 4", "a 0.123 5") and not same("a 1.0", "b 1.0")


def test_the_map_is_that_of_the_command(run, tmp_path):
    report = tmp_path / "report.json"
    words = ("--tolerance", "1e-12", "--quiet", "--json", report)
    assert command("uniformize", three_holes.MESH, tmp_path / "out.obj", *words).returncode == 0
    loops = json.loads(report.read_text())["loops"]
    names = run[1]
    for loop, own in zip(loops, names["loops"]):
        assert sorted(loop["vertices"]) == sorted(own)
    circles = names["circles"]
    turn = complex(*loops[1]["center"]) / circles[1][0]
    assert abs(abs(turn) - 1.0) < 1e-8
    for loop, (center, radius) in zip(loops, circles):
        assert abs(complex(*loop["center"]) - turn * center) < 1e-8 and abs(loop["radius"] - radius) < 1e-8
    uv = np.array([line.split()[1:] for line in (tmp_path / "out.obj").read_text().splitlines() if line[:3] == "vt "])
    places = (2.0 * uv.astype(float) - 1.0) @ [1.0, 1.0j]
    assert np.abs(places - turn * names["uv"]).max() < 1e-8


def test_it_is_short():
    """Lines of NumPy: not those that print, nor the comparison with the package."""
    cells = ["".join(cell["source"]) for cell in CODE]
    lines = "\n".join(text for text in cells if not text.startswith("# print") and "import koebe" not in text)
    counted = [line for line in lines.splitlines() if line.strip() and "# print" not in line]
    assert len(counted) <= LINES and max(map(len, counted)) <= 120


def test_the_files_are_what_the_script_makes(run):
    assert three_holes.PICTURE.read_text(encoding="utf-8") == three_holes.picture(run[1])
    if three_holes.table_surfaces.MESHER.exists():
        assert rows_of(three_holes.MESH.read_text(encoding="ascii")) == rows_of(
            three_holes.obj_text(*three_holes.make_mesh())
        )
