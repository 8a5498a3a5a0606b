"""Texel density of parts: given as pixels per unit, and reported."""

import json
import re

import koebe
import numpy as np
import pytest
from cli_support import cells, obj_text, succeeded, triangles_of
from cli_support import koebe as command


def sheet(length=3.0, n=6, bend=0.0):
    """A sheet of this length, a unit wide, rolled without stretching if it is bent."""
    x, y = np.meshgrid(np.linspace(0.0, length, n * 3 + 1), np.linspace(0.0, 1.0, n + 1), indexing="ij")
    at = np.stack([np.sin(bend * x) / bend if bend else x, y, np.cos(bend * x) / bend if bend else 0 * x], axis=-1)
    return at.reshape(-1, 3), triangles_of(cells(3 * n, n)[:, [0, 3, 2, 1]])


def densities(vertices, triangles, uv, pixels):
    """Pixels per unit in each triangle."""
    in_plane = np.abs(np.cross(uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]))
    a, b, c = (vertices[triangles[:, k]] for k in range(3))
    return pixels * np.sqrt(in_plane / np.linalg.norm(np.cross(b - a, c - a), axis=1))


@pytest.mark.parametrize(("density", "pixels"), [(100.0, 1024), (7.5, 64), (400.0, 2048)])
@pytest.mark.parametrize("scale", [1.0, 1e-4, 1e4])
def test_parts_have_the_density_that_is_asked_for(density, pixels, scale):
    vertices, triangles = sheet(bend=0.7)
    result = koebe.parts(vertices * scale, triangles, density=density / scale, pixels=pixels)
    found = densities(vertices * scale, triangles, result.uv, pixels)
    assert np.median(found) == pytest.approx(density / scale, rel=1e-3)
    assert result.density == pytest.approx(density / scale, rel=1e-4)
    assert result.uv.min() >= 0.0 and result.uv.max() <= 1.0 and result.flipped == 0
    assert result.options["density"] == density / scale and result.options["pixels"] == pixels


def test_without_one_the_report_has_the_density_that_was_reached():
    vertices, triangles = sheet()
    result = koebe.parts(vertices, triangles, pixels=1000, margin=8.0 / 2.048)
    found = densities(vertices, triangles, result.uv, 1000)
    assert result.density == pytest.approx(np.median(found), rel=1e-5)
    assert koebe.parts(10.0 * vertices, triangles).density == pytest.approx(result.density * 0.2048, rel=1e-4)
    assert np.array_equal(koebe.parts(vertices, triangles, pixels=500, margin=4.0 / 2.048).uv, result.uv)


@pytest.mark.parametrize("bend", [0.0, 0.5])
def test_what_does_not_fit_is_refused_with_the_largest_density_that_does(bend):
    vertices, triangles = sheet(bend=bend)
    with pytest.raises(koebe.InputError, match="density of 5000 pixels per unit does not fit") as refused:
        koebe.parts(vertices, triangles, density=5000.0)
    largest = float(re.search(r"at most ([\d.e+]+) does", str(refused.value))[1])
    assert 300.0 < largest < 2048.0
    result = koebe.parts(vertices, triangles, density=largest)
    assert result.density == pytest.approx(largest, rel=1e-4)
    with pytest.raises(koebe.InputError, match="does not fit"):
        koebe.parts(vertices, triangles, density=1.001 * largest)
    assert result.density == pytest.approx(koebe.parts(vertices, triangles).density, rel=1e-3)


def test_two_meshes_get_one_density():
    small, large = sheet(length=1.0), sheet(length=3.0)
    uvs = [koebe.parts(*mesh, density=150.0).uv for mesh in (small, large)]
    found = [np.median(densities(*mesh, uv, 2048)) for mesh, uv in zip((small, large), uvs, strict=True)]
    assert found[0] == pytest.approx(found[1], rel=1e-4)


def test_the_command_has_it(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*sheet()))
    succeeded("parts", "in.obj", "out.obj", "--density", "90", "--pixels", "512", "--json", "r.json", cwd=tmp_path)
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["density"] == pytest.approx(90.0, rel=1e-4) and report["options"]["pixels"] == 512
    refused = command("parts", "in.obj", "no.obj", "--density", "1e9", cwd=tmp_path)
    assert refused.returncode == 3 and "does not fit into the square: at most" in refused.stderr
    assert not (tmp_path / "no.obj").exists()
