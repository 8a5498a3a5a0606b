"""Veins of made atria, as the notebook atrium.ipynb makes them, but spread more: which is which is known."""

import json
from pathlib import Path

import koebe
import numpy as np

NOTEBOOK = Path(__file__).resolve().parents[2] / "docs" / "atrium.ipynb"


def makers():
    """The functions scan and surface of the notebook."""
    cells = ["".join(cell["source"]) for cell in json.loads(NOTEBOOK.read_text(encoding="utf-8"))["cells"]]
    names = {}
    exec(next(cell for cell in cells if "def scan" in cell).replace("normal(0, 0.05, V", "normal(0, 0.12, V"), names)
    exec(next(cell for cell in cells if "def surface" in cell).partition("random = ")[0], names)
    return names["scan"], names["surface"]


def test_veins_that_circles_confuse_are_matched_by_areas():
    scan, surface = makers()
    random, shapes, veins = np.random.default_rng(7), [], []
    while len(shapes) < 3:
        field, axes = scan(random, 0.0)
        shape = koebe.uniformize(surface(field, axes))
        ways = np.array([shape.vertices[loop].mean(axis=0) for loop in shape.loops[1:]])
        ways /= np.linalg.norm(ways, axis=1, keepdims=True)
        if sorted((ways @ axes.T).argmax(axis=1)) == [0, 1, 2, 3]:
            shapes.append(shape)
            veins.append((ways @ axes.T).argmax(axis=1))
    for one, other in ((2, 0), (1, 0)):
        found = koebe.family([shapes[one], shapes[other]])
        match = found.match(0, 1)[1:] - 1
        assert np.array_equal(veins[one], veins[other][match]) and found.margins[1] > 0.3
    circles = koebe.match_loops(shapes[2], shapes[0])
    assert not np.array_equal(veins[2], veins[0][circles.match[1:] - 1]) and circles.margin > 0.3
