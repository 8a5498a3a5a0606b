"""Islands of a UV layer joined along cuts."""

import koebe
import numpy as np
import pytest
from test_even_dial import outline_crossings, upright


def sheet(n=8):
    """A bent grid of triangles."""
    side = np.linspace(-1, 1, n + 1)
    x, y = np.meshgrid(side, side, indexing="ij")
    vertices = np.stack([x, y, 0.3 * np.sin(2 * x) * y], axis=-1).reshape(-1, 3)
    at = np.arange((n + 1) ** 2).reshape(n + 1, n + 1)
    a, b, c, d = (one.ravel() for one in (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]))
    return vertices, np.concatenate([np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]).astype(np.int32)


def column(n, k):
    """The edges of a column of vertices."""
    start = k * (n + 1)
    return np.array([[start + j, start + j + 1] for j in range(n)])


def points_of(triangles, uv):
    """The UVs as a map of vertices: a vertex for each place of a vertex. Triangles and points of these."""
    keys = np.column_stack([triangles.ravel(), uv.reshape(-1, 2)])
    places, number = np.unique(keys, axis=0, return_inverse=True)
    return number.reshape(-1, 3), places[:, 1:]


@pytest.mark.parametrize("even", [None, 0.0, 0.5])
def test_the_joined_island_is_one_to_one_and_lies_where_the_larger_lay(even):
    n = 8
    vertices, triangles = sheet(n)
    cut = koebe.parts(vertices, triangles, price=100, darts=0, cuts=[*column(n, 2), *column(n, 6)])
    assert len(cut.parts) == 3
    made = koebe.sew(vertices, triangles, uv=cut.uv, edges=column(n, 2), even=even)
    assert (made.joined, made.sewn) == (2, n)
    x = vertices[triangles].mean(axis=1)[:, 0]
    stays = x > 0.5
    assert np.array_equal(made.uv[stays], cut.uv[stays]) and np.array_equal(made.island < 0, stays)
    faces, points = points_of(triangles[~stays], made.uv[~stays])
    assert len(points) == 7 * (n + 1)  # one island
    assert upright(points, faces) and outline_crossings(points, faces) == 0
    old, new = (uv[(x > -0.5) & ~stays].reshape(-1, 2) for uv in (cut.uv, made.uv))
    assert np.allclose(old.mean(axis=0), new.mean(axis=0), atol=1e-9)
    assert np.linalg.norm(old - old.mean(axis=0)) == pytest.approx(np.linalg.norm(new - new.mean(axis=0)))


@pytest.mark.parametrize("seed", range(8))
def test_random_islands_are_joined_or_refused(seed):
    rng = np.random.default_rng(seed)
    n = 8
    vertices, triangles = sheet(n)
    vertices = vertices + rng.normal(scale=0.03, size=vertices.shape)
    chosen = np.sort(rng.choice(np.arange(1, n), 3, replace=False))
    edges = np.concatenate([column(n, k) for k in chosen])
    cut = koebe.parts(vertices, triangles, price=100, darts=0, cuts=edges)
    some = edges[rng.random(len(edges)) < rng.choice([0.2, 0.6, 1.0])]  # else holes stay
    made = koebe.sew(vertices, triangles, uv=cut.uv, edges=some)
    for island in range(made.island.max() + 1):
        own = made.island == island
        faces, points = points_of(triangles[own], made.uv[own])
        assert upright(points, faces) and outline_crossings(points, faces) == 0
    assert np.array_equal(made.uv[made.island < 0], cut.uv[made.island < 0])


def test_what_would_close_is_refused():
    tetrahedron = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float), [
        [0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]  # fmt: skip
    apart = np.array([[[0, 0], [1, 0], [0, 1]]] * 4) + 3.0 * np.arange(4)[:, None, None]
    every = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    with pytest.raises(koebe.SolverError, match="cannot lie flat in one piece") as error:
        koebe.sew(*tetrahedron, uv=apart, edges=every)
    assert error.value.of == "edges" and len(error.value.elements) == 12
    made = koebe.sew(*tetrahedron, uv=apart, edges=every[:3])
    assert made.joined == 3 and made.sewn == 3


def test_wrong_calls_are_refused():
    vertices, triangles = sheet(4)
    cut = koebe.parts(vertices, triangles, price=100, darts=0, cuts=column(4, 2))
    for edges, text in (
        (column(4, 1), "no edge is a cut"), ([(0, 24)], "no edge"), ([(0, 1, 2)], "edges must be"),
        ([(0, 1)], "no edge is a cut"),  # on the boundary
    ):  # fmt: skip
        with pytest.raises(koebe.InputError, match=text):
            koebe.sew(vertices, triangles, uv=cut.uv, edges=edges)
    with pytest.raises(koebe.InputError, match="finite"):
        koebe.sew(vertices, triangles, uv=cut.uv * np.nan, edges=column(4, 2))
    with pytest.raises(koebe.InputError, match="have no area"):
        koebe.sew(vertices, triangles, uv=0.0 * cut.uv + np.repeat([0, 1], 16)[:, None, None], edges=column(4, 2))
    with pytest.raises(koebe.OptionError, match="even"):
        koebe.sew(vertices, triangles, uv=cut.uv, edges=column(4, 2), even=2)
