"""Rims taken for smooth curves, or for the polygons that they are: two modules of one mesh, and which of them it is."""

import json
import math

import koebe
import numpy as np
import pytest
from cli_support import USAGE, obj_text, triangles_of
from cli_support import koebe as command
from koebe._native import _koebe
from koebe.labs.shapes import mapped_surface
from planar_oracle import confocal, confocal_rims, matched, plate_rims
from planar_oracle import plate as oracle_plate
from test_certified import square_in_square
from test_module_error import round_domain

HOLES = [(0.45, 0.25, 0.18), (-0.4, 0.35, 0.2), (-0.1, -0.5, 0.15)]


def square_ring(n):
    """The ring between a square and the square half as large in its middle: vertices and triangles."""
    t = np.linspace(-2.0, 2.0, 4 * n + 1)
    points = np.stack([a.ravel() for a in np.meshgrid(t, t)] + [np.zeros(len(t) ** 2)], axis=1)
    corner = (np.arange(4 * n)[:, None] * len(t) + np.arange(4 * n)).ravel()
    quads = np.stack([corner, corner + 1, corner + len(t) + 1, corner + len(t)], axis=1)
    quads = quads[abs(points[quads].mean(axis=1)).max(axis=1) > 1.0]
    used, quads = np.unique(quads, return_inverse=True)
    return points[used], triangles_of(quads.reshape(-1, 4))


def round_plate(n):
    z, triangles = round_domain(n, HOLES[:2], 0.3)
    return np.column_stack([z.real, z.imag, 0.0 * z.real]), triangles


@pytest.fixture(scope="module")
def plate():
    return koebe.uniformize(*round_plate(22))


def test_the_polyhedrons_module_is_exact():
    ring = koebe.uniformize(*square_ring(2))
    exact = math.exp(-2.0 * math.pi / square_in_square())
    found, bar = (f(ring, rims="polygonal")[0] for f in (koebe.conformal_module, koebe.module_error))
    assert abs(found - exact) <= bar < 1e-3 < abs(koebe.conformal_module(ring)[0] - exact)


def test_it_lies_in_the_proved_enclosures(plate):
    found = koebe.conformal_module(plate, rims="polygonal")
    enclosed = koebe.certified_moduli(*plate.surface, width=1e-3)
    order = [koebe.boundary_loops(plate.triangles)[k].min() for k in enclosed.module_loops]
    assert enclosed.rims == "polygonal" and order == [loop.min() for loop in plate.loops]
    slack = koebe.module_error(plate, rims="polygonal")
    for number, bar, (low, high) in zip(found, slack, enclosed.module.values(), strict=True):
        assert low - bar <= number <= high + bar


def test_extrapolated_circles_are_those_of_the_smooth_domain():
    """Smooth rims against koebe.planar, on a ring; corners stay corners."""
    for mesh, rims, share in ((confocal, confocal_rims, 0.05), (oracle_plate, plate_rims, 0.5)):
        exact = koebe.planar(rims())
        result = koebe.uniformize(*mesh(64), tolerance=1e-9)
        order = matched(result, exact)
        smooth, extrapolated = (
            abs(koebe.conformal_module(result, order=order, rims=kind) - exact.module).max()
            for kind in ("smooth", "extrapolated")
        )
        assert extrapolated < share * smooth
        assert extrapolated < koebe.module_error(result, order=order, rims="extrapolated").max() < smooth


def test_five_loops_have_one_too():
    z, triangles = round_domain(20, [*HOLES, (0.45, -0.4, 0.12)], 0.3)
    result = koebe.uniformize(np.column_stack([z.real, z.imag, 0.0 * z.real]), triangles)
    smooth, polygonal = (koebe.conformal_module(result, rims=rims) for rims in ("smooth", "polygonal"))
    assert 1e-4 < abs(smooth - polygonal).max() < 0.02


def test_a_forecast_tells_the_difference(plate):
    names = koebe.module_names(3)
    radii = [k for k, name in enumerate(names) if name[0] == "r"]
    smooth, polygonal = (koebe.conformal_module(plate, rims=rims)[radii] for rims in ("smooth", "polygonal"))
    forecast = _koebe.polygonal_changes(mapped_surface(plate))
    assert forecast[0] == 0.0 and np.allclose(forecast[1:], polygonal / smooth - 1.0, rtol=0.3, atol=1e-3)
    with pytest.warns(koebe.Warning, match="as polygons"):
        koebe.module_error(plate)


def test_one_option_chooses_everywhere(plate):
    other = koebe.uniformize(*round_plate(24))
    found = koebe.family([plate, other], rims="polygonal")
    assert found.rims == "polygonal" and koebe.family([plate, other]).rims == plate.rims == "smooth"
    assert np.array_equal(found.modules[0], koebe.conformal_module(plate, rims="polygonal"))
    distance = koebe.module_distance(plate, other, rims="polygonal")
    assert distance == koebe.match_loops(plate, other, rims="polygonal")[2] <= found.distances[0, 1] + 1e-12
    with pytest.raises(koebe.OptionError, match="rims must be one of smooth, polygonal"):
        koebe.conformal_module(plate, rims="round")
    with pytest.raises(TypeError, match="need a result of uniformize"):
        koebe.conformal_module(found, rims="polygonal")


def test_the_commands_say_which(tmp_path):
    paths = [tmp_path / "a.obj", tmp_path / "b.obj"]
    for path, n in zip(paths, (2, 3), strict=True):
        path.write_text(obj_text(*square_ring(n)))
    smooth, polygonal = (
        json.loads(command("module", paths[0], "--rims", rims).stdout) for rims in ("smooth", "polygonal")
    )
    assert (smooth["rims"], polygonal["rims"]) == ("smooth", "polygonal") and "errors" not in smooth
    found = koebe.conformal_module(koebe.uniformize(*square_ring(2)), rims="polygonal")
    assert np.allclose(polygonal["module"], found, atol=1e-6) and len(polygonal["errors"]) == 1
    told = [[one["kind"] for one in report["warnings"]] for report in (smooth, polygonal)]
    assert "coarse_mesh" in told[0] and "coarse_mesh" not in told[1]
    assert json.loads(command("module", paths[0], "--certified").stdout)["rims"] == "polygonal"
    compared = command("compare", *paths, "--rims", "polygonal").stdout
    assert compared.startswith("distance ") and compared.endswith(" (polygonal rims)\n")
    refused = command("compare", *paths, "--rims", "polygonal", "--teichmueller")
    assert refused.returncode == USAGE and "smooth" in refused.stderr
    command("module", tmp_path, "--rims", "polygonal", "--csv", tmp_path / "table.csv")
    assert (tmp_path / "table.csv").read_text().count(",polygonal rims") == 2
