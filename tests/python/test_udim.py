"""Parts on several UDIM tiles."""

import json
import re

import koebe
import numpy as np
import pytest
from cli_support import obj_text, succeeded, triangles_of
from test_even import covered_at_most_once


def strips(sizes):
    """Flat sheets of these sizes, side by side in space: vertices and triangles."""
    vertices, quads, count = [], [], 0
    for k, (wide, high) in enumerate(sizes):
        x, y = np.meshgrid(np.linspace(0, wide, 5), np.linspace(0, high, 5), indexing="ij")
        vertices.append(np.stack([x, y, 0.05 * x * y + 3.0 * k], axis=-1).reshape(-1, 3))
        corner = (np.arange(4)[:, None] * 5 + np.arange(4)).ravel()
        quads.append(np.stack([corner, corner + 5, corner + 6, corner + 1], axis=-1) + count)
        count += 25
    return np.concatenate(vertices), triangles_of(np.concatenate(quads))


SIZES = [(0.5 + 0.02 * k, 0.5 + 0.03 * ((5 * k) % 8)) for k in range(12)]


def tile_of_parts(result):
    """The tile of each part, checked: a part lies on one tile."""
    tiles = []
    for part in result.parts:
        at = result.uv[part["faces"]].reshape(-1, 2)
        corner = np.floor(0.5 * (at.min(axis=0) + at.max(axis=0)))
        assert (at >= corner).all() and (at <= corner + 1).all()
        tiles.append(int(corner[0] + 10 * corner[1]))
    return tiles


@pytest.mark.parametrize("tiles", [2, 9])
def test_more_tiles_give_more_texels(tiles):
    vertices, triangles = strips(SIZES)
    one = koebe.parts(vertices, triangles)
    result = koebe.parts(vertices, triangles, tiles=tiles)
    used = set(tile_of_parts(result))
    assert used == set(range(tiles)) and result.tiles == tiles and result.flipped == 0 and result.converged
    assert result.density > 0.65 * np.sqrt(tiles) * one.density
    assert covered_at_most_once(result.uv)
    a, b = result.uv[:, 1] - result.uv[:, 0], result.uv[:, 2] - result.uv[:, 0]
    assert result.coverage == pytest.approx(0.5 * np.cross(a, b).sum() / tiles, rel=1e-5)
    assert np.array_equal(koebe.parts(vertices, triangles, tiles=tiles).uv, result.uv)


def test_as_many_tiles_as_the_density_needs():
    vertices, triangles = strips(SIZES)
    one = koebe.parts(vertices, triangles)
    for times in (0.5, 1.5):
        result = koebe.parts(vertices, triangles, density=times * one.density, tiles=0)
        assert result.density == pytest.approx(times * one.density, rel=1e-4)
        assert result.tiles == 1 + max(tile_of_parts(result)) == len(set(tile_of_parts(result)))
        if result.tiles > 1:
            with pytest.raises(koebe.InputError, match="does not fit"):
                koebe.parts(vertices, triangles, density=times * one.density, tiles=max(1, result.tiles // 2))
    with pytest.raises(koebe.InputError, match="as many tiles as needed"):
        koebe.parts(vertices, triangles, tiles=0)


def test_what_does_not_fit_is_refused_with_the_largest_density_that_does():
    vertices, triangles = strips(SIZES)
    with pytest.raises(koebe.InputError, match="does not fit into 3 tiles") as refused:
        koebe.parts(vertices, triangles, density=1e5, tiles=3)
    largest = float(re.search(r"at most ([\d.e+]+) does", str(refused.value))[1])
    assert koebe.parts(vertices, triangles, density=largest, tiles=3).density == pytest.approx(largest, rel=1e-4)


def test_the_command_draws_the_tiles(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*strips(SIZES)))
    succeeded("parts", "in.obj", "out.obj", "--tiles", 11, "--json", "r.json", "--svg", "p.svg", cwd=tmp_path)
    assert json.loads((tmp_path / "r.json").read_text())["tiles"] == 11
    picture = (tmp_path / "p.svg").read_text()
    assert 'viewBox="0 0 100000 20000"' in picture and ">1011<" in picture and ">1012<" not in picture
    uv = np.array([line.split()[1:3] for line in (tmp_path / "out.obj").read_text().splitlines() if line[:3] == "vt "])
    assert uv.astype(float)[:, 1].max() > 1.0
