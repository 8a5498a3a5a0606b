"""Planar domains to ten digits: exact answers, conformal invariance, proved bounds, and rims that cannot be mapped."""

import json
import math
from types import SimpleNamespace

import koebe
import numpy as np
import pytest
from cli_support import succeeded
from koebe import _koebe, _option_table
from test_certified import grid, ratio, square_in_square
from test_cli import CANNOT_BE_MAPPED, USAGE
from test_cli import koebe as command

SQUARE = np.array([-1 - 1j, 1 - 1j, 1 + 1j, -1 + 1j])
L_SHAPE = np.array([0, 2, 2 + 1j, 1 + 1j, 1 + 2j, 2j])


def circle(center, radius):
    return {"circle": {"center": [center.real, center.imag], "radius": radius}}


def fourier(coefficients, lowest=0):
    return {"fourier": {"lowest": lowest, "coefficients": np.asarray(coefficients, complex)}}


def pairs(z):
    return np.stack([np.real(z), np.imag(z)], axis=1)


def images(found, z):
    return found(z) @ [1, 1j]


def cross_ratio(a, b, c, d):
    return (a - c) * (b - d) / ((a - d) * (b - c))


def quadrilateral(found, corners):
    """The modulus of a quadrilateral from the images of its corners on the unit circle."""
    a, b, c, d = images(found, np.asarray(corners, complex))
    m = 1 - 1 / cross_ratio(a, b, c, d).real
    return ratio(min(max(m, 0.0), 1.0))


def agrees(found, module):
    """The numbers are within the errors that are said, and these are small."""
    assert found.converged and found.error <= 1e-10
    assert (abs(found.module - module) <= found.module_errors + 1e-13).all()


def test_square_in_square():
    found = koebe.planar([2 * SQUARE, SQUARE])
    agrees(found, [math.exp(-2 * math.pi / square_in_square())])


@pytest.mark.parametrize("offset", [0.0, 0.6, 0.97])
def test_concentric_circles_moved(offset):
    """A Moebius map of the ring r < |z| < 1, near the outer circle as well."""
    r = 0.3
    ends = [(sign * r - offset) / (1 - offset * sign * r) for sign in (1, -1)]
    found = koebe.planar([circle(0j, 1.0), circle(complex(sum(ends) / 2), (ends[0] - ends[1]) / 2)])
    agrees(found, [r])


def test_circle_domain_is_its_own_map():
    centers, radii = np.array([0j, 0.05 + 0.1j, 0.4 - 0.5j, -0.6 + 0.2j]), np.array([1, 0.2, 0.15, 0.1])
    found = koebe.planar([circle(3 * c + 1j, 3 * r) for c, r in zip(centers, radii, strict=True)])
    agrees(found, koebe.conformal_module(SimpleNamespace(centers=pairs(centers), radii=radii)))


def test_confocal_ellipses():
    """z = w + 1 / w takes circles round 0 to ellipses with the same foci."""
    rims = [fourier([1 / r, 0, r], -1) for r in (3.0, 1.2)]
    agrees(koebe.planar(rims), [1.2 / 3.0])


def test_quadrilaterals():
    """The corners of a rectangle and of a symmetric L have images with a known cross-ratio."""
    for sides in (1.0, 1.7):
        rectangle = SQUARE.real * sides + 1j * SQUARE.imag
        found = koebe.planar([rectangle])
        assert found.converged
        assert quadrilateral(found, rectangle) in (pytest.approx(sides, rel=1e-9), pytest.approx(1 / sides, rel=1e-9))
    found = koebe.planar([L_SHAPE])
    assert quadrilateral(found, L_SHAPE[[0, 1, 3, 5]]) == pytest.approx(1.0, abs=1e-9)


def test_conformal_invariance():
    """The image of a domain under a polynomial that is one to one there has the same module."""
    holes = [([0.3, 0.15, 0, 0.03], 0), ([-0.4 + 0.3j, 0.1, 0.02j], 0)]
    bent = []
    for coefficients, lowest in [([1], 1), *holes]:
        z = np.array(coefficients, complex)
        square = np.convolve(z, z)
        all_terms = np.zeros(12, complex)
        all_terms[lowest + 2 : lowest + 2 + len(z)] += z
        all_terms[2 * lowest + 2 : 2 * lowest + 2 + len(square)] += (0.3 - 0.1j) * square
        bent.append(fourier(all_terms, -2))
    plain = koebe.planar([fourier(*rim) for rim in ([[1], 1], *holes)])
    agrees(koebe.planar(bent), plain.module)


def test_order_direction_and_place_do_not_matter():
    rims = [3 * SQUARE, 0.5 * SQUARE + 1, [-1 - 1j, -0.2 - 1.5j, -1j], 1.8j + 0.4 * L_SHAPE]
    found = koebe.planar(rims)
    moved = koebe.planar([np.asarray(rim)[::-1] * 1e-3j + 7 for rim in (rims[1], rims[0], rims[2], rims[3])])
    assert moved.rims.tolist() == [1, 0, 2, 3]
    agrees(moved, found.module)
    assert found == koebe.planar(rims)


def test_within_proved_bounds():
    """Three loops: a square plate with two square holes, cut into triangles exactly."""
    holes = [(1, 1, 3, 3), (5, 4, 6, 7)]
    vertices, faces = grid(8, lambda i, j: not any((a <= i) & (i < c) & (b <= j) & (j < d) for a, b, c, d in holes))
    vertices = np.column_stack([vertices, np.zeros(len(vertices))])
    proved = koebe.certified_moduli(vertices, faces, width=1e-2)
    found = koebe.planar(
        [4 * SQUARE + 4 + 4j, *([a + 1j * b, c + 1j * b, c + 1j * d, a + 1j * d] for a, b, c, d in holes)]
    )
    order = found.rims[proved.module_loops]  # loops are numbered by their lowest vertices, as the rims are
    assert found.converged and order[0] == 0
    numbers = koebe.conformal_module(found, order=proved.module_loops)
    for number, (low, high) in zip(numbers, proved.module.values(), strict=True):
        assert low <= number <= high


def test_map_and_inverse():
    rims = [3 * SQUARE, 0.5 * SQUARE + 1, 1.2j + 0.4 * L_SHAPE - 1]
    found = koebe.planar(rims)
    # Corners and other places of the rims go to the circles.
    for k, rim in enumerate(rims):
        rim = np.asarray(rim)
        t = np.array([0.0, 1e-9, 1e-4, 0.3, 0.5])
        z = (rim[:, None] * (1 - t) + np.roll(rim, -1)[:, None] * t).ravel()
        at = found.rims.tolist().index(k)
        off = abs(images(found, z) - found.centers[at] @ [1, 1j]) - found.radii[at]
        assert abs(off).max() < 1e-9
    random = np.random.default_rng(1)
    w = random.uniform(-1, 1, (200, 2)) @ [1, 1j]
    free = abs(w) < 1
    for center, radius in zip(found.centers[1:], found.radii[1:], strict=True):
        free &= abs(w - center @ [1, 1j]) > radius
    z = found.inverse(w[free]) @ [1, 1j]
    assert abs(images(found, z) - w[free]).max() < 1e-12
    # Analytic: the mean over a small circle is the value in its middle.
    around = z[:, None] + 1e-4 * np.exp(2j * np.pi * np.arange(8) / 8)
    inside = abs(w[free]) < 0.9
    mean = images(found, around[inside].ravel()).reshape(-1, 8).mean(axis=1)
    assert abs(mean - w[free][inside]).max() < 1e-10


@pytest.mark.parametrize(
    "rims, elements",
    [
        ([2 * SQUARE, SQUARE + 1.5], [0, 1]),  # crosses
        ([2 * SQUARE, SQUARE + 1], [0, 1]),  # touches
        ([2 * SQUARE, 0.5 * SQUARE + 5], [1]),  # outside
        ([3 * SQUARE, 2 * SQUARE, SQUARE], [2]),  # in a hole
        ([[-1 - 1j, 1 + 1j, 1 - 1j, -1 + 1j]], [0]),  # meets itself
        ([np.array([0j, 1, 2, 1])], [0]),  # no area
        ([2 * SQUARE, [0, 1, 1 + 1j, 1, 1j]], [1]),  # a spike
        ([2 * SQUARE, [0, 1 + 0.001j, 1 - 0.001j]], [1]),  # too sharp
        ([[0, np.nan, 1j]], []),
        ([2 * SQUARE, {"circle": {"center": [0, 0], "radius": -1}}], []),
        ([], []),
    ],
)
def test_refusals(rims, elements):
    with pytest.raises(koebe.InputError) as refused:
        koebe.planar(rims)
    assert sorted(refused.value.elements) == elements


def test_too_near_is_refused_or_said():
    """A gap of 1e-7: no answer that claims more than it has."""
    try:
        found = koebe.planar([2 * SQUARE, SQUARE + 1 - 1e-7])
    except koebe.SolverError as error:
        assert error.elements
    else:
        assert found.converged or found.error > 1e-10


def test_a_thin_slit_is_refused_early():
    stages = []
    with pytest.raises(koebe.SolverError) as refused:
        koebe.planar([3 * SQUARE, [-1, 1, 1 + 0.005j, -1 + 0.005j]], progress=lambda _, stage: stages.append(stage))
    assert refused.value.elements == [1]
    assert stages and "resolution 2" not in stages


def test_options_are_the_tables():
    row = _option_table.rows("planar")
    native = _koebe.PlanarOptions()
    assert (native.tolerance, native.max_sweeps) == (row["tolerance"].default, row["max_sweeps"].default)
    for name, wrong in (("tolerance", 0.0), ("max_sweeps", 0)):
        with pytest.raises(koebe.OptionError, match=name):
            koebe.planar([SQUARE], **{name: wrong})


def test_a_rough_map_takes_places_on_its_rims():
    rims = [4 * SQUARE, SQUARE - 1.6, 1.2 * SQUARE + 0.8]
    found = koebe.planar(rims, max_sweeps=5)
    assert not found.converged and found.error > 1e-7
    sides = [rim + (np.roll(rim, -1) - rim) * share for rim in rims for share in np.linspace(0.05, 0.95, 9)]
    images = found(np.concatenate(sides)) @ [1, 1j]
    off = np.abs(np.abs(images[:, None] - found.centers @ [1, 1j]) - found.radii).min(axis=1)
    assert off.max() <= 1.001 * found.error  # rims are sampled


def test_places_off_the_domain():
    found = koebe.planar([2 * SQUARE, SQUARE])
    with pytest.raises(koebe.InputError) as refused:
        found([[1.5, 0], [0, 0], [3, 0]])
    assert refused.value.elements == [1, 2]
    with pytest.raises(koebe.InputError):
        found.inverse([[0, 0]])


def test_command(tmp_path):
    """JSON and SVG give the same as Python; rims of an SVG are closed paths, and lengths are the drawing's."""
    corners = [[-2, -2], [2, -2], [2, 2], [-2, 2]]
    file = tmp_path / "ring.json"
    file.write_text(json.dumps({"rims": [{"points": corners}, circle(0.5j, 0.7)]}))
    (tmp_path / "points.json").write_text("[[1.5, 0.25]]")
    done = succeeded("planar", file, "--points", tmp_path / "points.json")
    report = json.loads(done.stdout)
    found = koebe.planar(file)
    assert report["module"] == found.module.tolist() and report["errors"] == found.module_errors.tolist()
    assert report["images"] == found([[1.5, 0.25]]).tolist()
    (tmp_path / "back.json").write_text(json.dumps(report["images"]))
    back = json.loads(command("planar", file, "--inverse", tmp_path / "back.json").stdout)
    assert back["preimages"][0] == pytest.approx([1.5, 0.25], abs=1e-12)

    drawing = tmp_path / "ring.svg"
    drawing.write_text(
        '<svg xmlns="http://www.w3.org/2000/svg"><path d="M-2-2H2V2H-2Z"/><path d="M-1-1H1V1H-1Z"/></svg>'
    )
    agrees(koebe.planar(drawing), [math.exp(-2 * math.pi / square_in_square())])

    file.write_text('{"rims": [{"polygon": []}]}')
    refused = command("planar", file)
    assert refused.returncode == CANNOT_BE_MAPPED and "polygon" in refused.stderr
    assert command("planar", file, "--tolerance", "0").returncode == USAGE


def test_slits_of_the_command_are_pythons(tmp_path):
    file = tmp_path / "plate.json"
    file.write_text(json.dumps({"rims": [circle(0j, 3.0), circle(1 + 0j, 0.5), circle(-1 + 0.5j, 0.7)]}))
    done = succeeded("planar", file, "--slits", "parallel", "--pole", "0", "-1.5", "--slit-angle", "30")
    report = json.loads(done.stdout)["slits"]
    found = koebe.planar(file, slits="parallel", pole=(0, -1.5), slit_angle=30)
    assert [rim["begin"] for rim in report["rims"]] == pairs(found.slits[:, 0]).tolist()
    assert np.allclose(np.angle(np.diff(found.slits)), math.pi / 6, atol=1e-9) and found.slit_error <= 1e-10
    radii = abs(koebe.planar(file, slits="circular").slits)
    assert command("planar", file, "--slits", "parallel").returncode == CANNOT_BE_MAPPED
    assert np.ptp(radii, axis=1).max() < 1e-10 and radii[0, 0] == 1.0 and (radii[1:] < 1.0).all()
