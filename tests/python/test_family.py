"""Many shapes with their loops in one order."""

import csv

import koebe
import numpy as np
import pytest
from cli_support import perforated, triangles_of, triangulated_plate

HOLES = np.array([(0.3, 0.3, 0.17), (0.75, 0.35, 0.08), (0.4, 0.72, 0.12)])  # no symmetry to mistake


def shape(change, order=(0, 1, 2)):
    return koebe.uniformize(*triangulated_plate(24, (HOLES + change)[list(order)]))


RNG = np.random.default_rng(5)
SHAPES = [shape(0.01 * RNG.standard_normal((3, 3))) for _ in range(5)]


def test_the_distances_are_a_metric():
    found = koebe.family(SHAPES)
    distances = found.distances
    assert found.modules.shape == (5, 6) and found.columns == koebe.module_names(4)
    assert np.allclose(distances, distances.T) and (np.diag(distances) == 0).all() and (distances + np.eye(5) > 0).all()
    assert (distances[:, :, None] <= distances[:, None, :] + distances.T[None, :, :] + 1e-12).all()


def test_the_loops_correspond_whatever_their_numbers():
    # Where the holes are tells which is which: of each shape the loop that covers the same place.
    found = koebe.family(SHAPES, order=[0, 2, 1, 3])

    def place(result, loop):
        return result.surface[0][result.loops[loop], :2].mean(axis=0)

    assert found.orders[0].tolist() == [0, 2, 1, 3]
    for number, result in enumerate(SHAPES):
        for mine, other in zip(found.orders[0], found.orders[number], strict=True):
            assert np.linalg.norm(place(SHAPES[0], mine) - place(result, other)) < 0.15
        assert np.allclose(found.modules[number], koebe.conformal_module(result, order=found.orders[number]))
    again = koebe.family(SHAPES, orders=found.orders)
    assert np.array_equal(again.modules, found.modules)
    last = koebe.family(SHAPES, reference=4, order=found.orders[4])
    assert np.array_equal(last.orders[0], found.orders[0])


def test_a_table_for_other_programs(tmp_path):
    found = koebe.family(SHAPES, labels=["a", "b,c", 'd"', "é", "5"])
    found.to_csv(tmp_path / "modules.csv")
    with (tmp_path / "modules.csv").open(newline="", encoding="utf-8") as file:
        head, *rows = csv.reader(file)
    assert head == ["label", *found.columns] and [row[0] for row in rows] == found.labels
    assert np.array_equal(np.array([row[1:] for row in rows], dtype=float), found.modules)


@pytest.mark.parametrize(
    ("arguments", "says"),
    [
        ({"results": []}, "no shapes"),
        ({"labels": ["a"]}, "1 labels for 5"),
        ({"reference": 5}, "reference must be"),
        ({"order": [0, 1]}, "each of the 4 loops once"),
        ({"order": [0, 1, 2, 2]}, "twice"),
        ({"orders": [[0, 1, 2, 3]]}, "1 orders for 5"),
        ({"order": [0, 1, 2, 3], "orders": [[0, 1, 2, 3]] * 5}, "one order, or"),
    ],
)
def test_what_is_no_family(arguments, says):
    with pytest.raises(koebe.InputError, match=says):
        koebe.family(**{"results": SHAPES, **arguments})
    with pytest.raises(koebe.InputError, match="shape 1 has 3 loops"):
        vertices, quads = perforated(24, HOLES[:2])
        koebe.family([SHAPES[0], koebe.uniformize(vertices, triangles_of(quads).astype(np.int32))])
