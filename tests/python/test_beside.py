"""New islands beside those that stay: whether a new one lies over another, whatever else lies over itself."""

import koebe
import numpy as np
import pytest
from addon_support import named_module

beside, surfaces = named_module("beside"), named_module("surface")
SQUARE = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)


def squares(places):
    """A surface of squares that are apart in space, the last two joined along an edge, and its UVs."""
    count = len(places)
    positions = np.concatenate([np.pad(SQUARE + [3 * k, 0], ((0, 0), (0, 1))) for k in range(count)])
    corner = np.arange(4 * count).reshape(-1, 4)
    corner[-1, [0, 3]] = corner[-2, [1, 2]]
    pairs = np.sort(np.stack([corner.ravel(), np.roll(corner, -1, axis=1).ravel()], axis=1), axis=1)
    edges, corner_edge = np.unique(pairs, axis=0, return_inverse=True)
    start = 4 * np.arange(count, dtype=np.int32)
    triangles = (start[:, None] + [[0, 1, 2, 0, 2, 3]]).reshape(-1, 3).astype(np.int32)
    surface = surfaces.Surface(
        positions, corner.ravel().astype(np.int32), corner_edge.ravel().astype(np.int32), start,
        np.full(count, 4, np.int32), np.zeros(len(edges), bool), np.ones(count, bool), triangles,
        np.repeat(np.arange(count), 2),
    )  # fmt: skip
    return surface, np.concatenate([SQUARE + place for place in places]).astype(np.float32)


@pytest.mark.parametrize("folded", [False, True])
@pytest.mark.parametrize(
    ("first", "second", "over"),
    [((5, 0), (7, 0), False), ((5, 0), (5.3, 0.2), True), ((5, 0), (0.4, 0.1), True), ((0.2, 0.3), (7, 0), True)],
)
def test_new_islands_are_told_apart_from_an_island_that_lies_over_itself(first, second, over, folded):
    # The first two squares are new islands. The last two stay: a strip, whose second half may lie on the first one.
    surface, uv = squares([first, second, (0, 0), (1, 0)])
    if folded:
        uv[12:] = uv[[9, 8, 11, 10]]
    assert beside.new_overlaps(koebe, surface, uv, np.arange(8)) == over
