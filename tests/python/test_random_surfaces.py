"""Random surfaces whose maps once broke a promise (`make reliability` names them), and a few of each kind."""

import sys
from pathlib import Path

import koebe
import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "bench"))
import promises  # noqa: E402
import random_surfaces  # noqa: E402


@pytest.mark.parametrize("kind", random_surfaces.KINDS)
def test_a_few_of_each_kind_keep_their_promises(kind):
    for seed in range(2000, 2005):
        surface = random_surfaces.make(kind, seed)
        if surface is not None:
            assert promises.broken(surface[1], koebe.uniformize(*surface)) == [], seed


def test_the_polish_is_undone_where_a_loop_would_cross_itself():
    vertices, triangles = random_surfaces.make("grid", 335)
    polished = koebe.uniformize(vertices, triangles, polish=True)
    assert polished.converged and promises.broken(triangles, polished) == []


def test_faces_that_were_turned_are_no_flips():
    vertices, triangles = random_surfaces.make("uneven", 409)
    result = koebe.uniformize(vertices, triangles, method="ck")
    assert [len(w.elements) for w in result.warnings if w.kind == "reoriented_faces"] == [2]
    assert promises.broken(triangles, result) == []


def test_a_warning_takes_the_numbers_of_a_larger_mesh():
    vertices, triangles = random_surfaces.make("uneven", 409)
    (turned,) = (w for w in koebe.uniformize(vertices, triangles).warnings if w.kind == "reoriented_faces")
    first, second = turned.elements
    moved = turned.renumbered([1000 - face for face in range(len(triangles))])
    assert moved.elements == [1000 - second, 1000 - first] and moved.kind == turned.kind
    assert moved.text == turned.text.replace(f"the first face is {first}", f"the first face is {1000 - second}")
    assert moved.text != turned.text
