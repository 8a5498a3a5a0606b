"""Tiles brought to periods of an image, and checkers that fit periods. Without Blender."""

import dataclasses

import koebe
import numpy as np
import pytest
from addon_support import named_module
from domain_surfaces import holed_ring, holed_torus
from test_moebius import surface_of

tile_fit, tile_pattern = named_module("tile_fit"), named_module("tile_pattern")
flipped_corners = named_module("stored").flipped_corners


def random_lattice(random):
    """A reduced basis in a tile that fills the square, as the package has them."""
    while True:
        tau = complex(random.uniform(-0.5, 0.5), np.exp(random.uniform(-0.2, 2.0)))
        if abs(tau) >= 1.0:
            break
    length = 1.0 / max(1.0 + abs(tau.real), tau.imag)
    return np.rint(np.array([[length, 0.0], [length * tau.real, length * tau.imag]]) * 2**24) / 2**24


def matrix_of(pattern):
    return np.diag([pattern.size] * 2) if pattern.matrix is None else np.reshape(pattern.matrix, (2, 2))


def colors(points):
    """Of the fine and the coarse checker, at points (n, 2) in squares."""
    fine, coarse = (np.floor(points / size).astype(int).sum(axis=1) % 2 for size in (1, 4))
    return fine + 2 * coarse


@pytest.mark.parametrize("seed", range(40))
def test_a_checker_is_the_same_after_every_period(seed):
    random = np.random.default_rng(seed)
    periods = random_lattice(random)
    if seed % 2:  # turned, or of a cylinder
        turn = np.exp(1j * random.uniform(0, 6))
        periods = periods @ np.array([[turn.real, turn.imag], [-turn.imag, turn.real]])
    if seed % 5 == 0:
        periods = periods[:1]
    size = float(random.choice([8.0, 20.0, 32.0, 100.0]))
    pattern = tile_pattern.fitting_pattern(periods, size)
    assert tile_pattern.fits(pattern, periods)
    matrix = matrix_of(pattern)
    points = random.uniform(0, 1, (2000, 2))
    lattice = np.array([[1, 0], [0, 1], [2, -1], [-3, 5]])[:, : len(periods)] @ periods
    squares = points @ matrix.T
    clear = (np.abs(squares - np.rint(squares)) > 1e-6).all(axis=1)  # of the lines
    for shift in lattice:
        assert np.array_equal(colors(squares)[clear], colors((points + shift) @ matrix.T)[clear])
    assert not tile_pattern.fits(dataclasses.replace(pattern, size=pattern.size * 1.003, matrix=None), periods * 0.777)
    values = np.linalg.svd(matrix, compute_uv=False)
    squares_along = np.linalg.norm(periods[0]) * size
    assert values[0] / values[1] < 1.0 + 8.0 / max(squares_along, 8.0)
    assert np.linalg.det(matrix) > 0.0
    if squares_along > 16.0:
        assert 1 / 1.6 < np.sqrt(values[0] * values[1]) / size < 1.6


def lattice_error(found, expected):
    """Whether two bases generate one lattice: each is whole in the other."""
    if found.shape != expected.shape:
        return np.inf
    both = [np.linalg.lstsq(a.T, b.T, rcond=None)[0] for a, b in ((found, expected), (expected, found))]
    return max(np.abs(one - np.rint(one)).max() for one in both)


@pytest.mark.parametrize("fit", ["inside", "period", "square"])
@pytest.mark.parametrize("kind", ["torus", "ring"])
def test_periods_are_read_off_the_uvs(kind, fit):
    if kind == "torus":
        vertices, triangles, _, _ = holed_torus(5)
        result = koebe.torus_map(vertices, triangles)
    else:
        vertices, triangles, *_ = holed_ring(5, holes={(1, 0): ((0.5, 0.5), 0.3)})
        result = koebe.ring_map(vertices, triangles)
    tile = tile_fit.fitted(result.uv, triangles, result.periods, fit)
    surface = surface_of(vertices, triangles)
    uv = tile.uv.reshape(-1, 2)
    (found,) = tile_pattern.lattices_of(surface, uv)
    assert lattice_error(found, tile.periods) < 1e-12
    corners = np.flatnonzero(triangles.ravel() == triangles[0, 0])
    spoilt = uv.copy()
    spoilt[corners[0]] += np.float32(2**-10)  # a cut whose sides are no shift
    assert tile_pattern.lattices_of(surface, spoilt) == []
    for wrong in (np.nan, np.inf, 1e30):
        spoilt[corners[0]] = wrong
        assert tile_pattern.lattices_of(surface, spoilt) == []


@pytest.mark.parametrize("fit", ["period", "square"])
@pytest.mark.parametrize("seed", range(8))
def test_a_fitted_tile_is_the_map_of_the_tile(seed, fit):
    random = np.random.default_rng(seed)
    vertices, triangles, _, _ = holed_torus(int(random.integers(3, 8)))
    vertices = vertices * np.exp(random.normal(0, 0.4, 3))
    result = koebe.torus_map(vertices, triangles)
    tile = tile_fit.fitted(result.uv, triangles, result.periods, fit)
    matrix, offset = tile.move
    assert np.abs(result.uv @ matrix.T + offset - tile.uv).max() < 2 * tile.grid
    assert np.array_equal(tile.periods[0], (1.0, 0.0))
    steps = tile.uv.astype(float) / tile.grid
    assert np.array_equal(steps, np.rint(steps)) and steps.max() <= 2**24 and steps.min() == 0.0
    assert np.array_equal(flipped_corners(tile.uv, np.array(result.turned, int)), result.flipped_faces)


def test_a_tile_that_is_too_long_is_refused():
    uv = np.array([[[0, 0], [1e-5, 0], [0, 1]], [[1e-5, 0], [1e-5, 1], [0, 1.0]]])
    for fit in ("period", "square"):
        with pytest.raises(named_module("errors").MapError, match="too long"):
            tile_fit.fitted(uv, np.array([[0, 1, 2], [1, 3, 2]]), np.array([[1e-5, 0.0]]), fit)


def test_flipped_triangles_are_counted_with_their_direction():
    uv = np.array([[[0, 0], [1, 0], [0, 1]], [[0, 0], [0, 1], [1, 0]], [[0, 0], [1, 1], [0.5, 0.5]]], np.float32)
    assert flipped_corners(uv, np.zeros(0, int)).tolist() == [1, 2]
    assert flipped_corners(uv, np.array([0, 1])).tolist() == [0, 2]


@pytest.mark.parametrize("handles, loops, domain, offer", [
    (0, 0, "torus", "parts"), (0, 1, "torus", "parts"), (0, 2, "torus", "ring"), (2, 0, "torus", "schottky parts"),
    (1, 3, "ring", "torus"), (2, 2, "ring", "schottky parts"), (0, 0, "ring", "parts"), (0, 1, "ring", "parts"),
    (1, 0, "sphere", "torus"), (1, 2, "sphere", "torus"), (2, 1, "sphere", "schottky parts"),
    (0, 0, "schottky", "sphere"), (0, 1, "schottky", "uniformize"), (0, 3, "schottky", "uniformize"),
])  # fmt: skip
def test_what_is_no_such_domain_is_offered_another(handles, loops, domain, offer):
    domains = named_module("domain_table")
    with pytest.raises(named_module("domain").DomainError, match="this surface has") as caught:
        domains.DOMAINS[domain].check(handles, loops)
    assert caught.value.offer == tuple(offer.split())
    domains.DOMAINS["torus"].check(1, loops)
    domains.DOMAINS["ring"].check(0, 2 + loops)
    domains.DOMAINS["sphere"].check(0, loops)
    domains.DOMAINS["schottky"].check(1 + handles, loops)
