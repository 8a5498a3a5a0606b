"""Results do not change, and are equal if they say the same."""

import copy
import pickle

import koebe
import numpy as np
import pytest

FACE, OTHER = koebe.example("face"), koebe.example("surprised")
MAPS = {
    "uniformize": lambda mesh: koebe.uniformize(mesh),
    "cut": lambda mesh: koebe.uniformize(mesh, cut=True),
    "parts": lambda mesh: koebe.parts(mesh),
    "sphere": lambda mesh: koebe.sphere_map(mesh),
    "ring": lambda mesh: koebe.ring_map(mesh),
    "fit": lambda mesh: koebe.fit_circles(mesh, [(0, -0.4), (-0.35, 0.3), (0.35, 0.3)], [0.2, 0.15, 0.15]),
    "correspondence": lambda mesh: koebe.transfer(koebe.uniformize(mesh), koebe.uniformize(FACE)),
    "family": lambda mesh: koebe.family([koebe.uniformize(mesh), koebe.uniformize(FACE)]),
    "conformal": lambda mesh: koebe.uniformize(mesh).conformal,
}


@pytest.mark.parametrize("kind", MAPS)
def test_equal_inputs_give_equal_results(kind, tmp_path):
    make = MAPS[kind]
    one, again, other = make(FACE), make(FACE), make(OTHER)
    assert one == again and one is not again
    assert one != other and one != kind and one == copy.deepcopy(one) == pickle.loads(pickle.dumps(one))
    if hasattr(one, "save"):
        one.save(tmp_path / "one.npz")
        assert koebe.load(tmp_path / "one.npz") == one and len({one, again, other}) == 2


def test_one_entry_of_a_list_makes_a_difference():
    shapes = [koebe.uniformize(FACE), koebe.uniformize(OTHER)]
    assert koebe.family(shapes, labels=["a", "b"]) == koebe.family(shapes, labels=["a", "b"])
    assert koebe.family(shapes, labels=["a", "b"]) != koebe.family(shapes, labels=["a", "c"])


@pytest.mark.parametrize("kind", MAPS)
def test_a_result_does_not_change(kind):
    one = MAPS[kind](FACE)
    name = "modules" if kind == "family" else "uv"
    with pytest.raises(AttributeError):
        setattr(one, name, np.zeros(3))
    with pytest.raises(AttributeError):
        delattr(one, name)
