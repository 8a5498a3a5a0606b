"""Each refusal of a surface names elements, and nothing depends on where a surface lies."""

from functools import partial

import koebe
import numpy as np
import pytest
from cli_support import koebe as command
from cli_support import obj_text, perforated, triangles_of

POINTS, QUADS = perforated(12)
TRIANGLES = triangles_of(QUADS)
BALL = np.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
FACES = np.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
ONE_POINT, LINE = np.ones_like(POINTS), POINTS * [1.0, 0.0, 0.0]
MAPS = {
    "uniformize": koebe.uniformize, "parts": koebe.parts, "ring": koebe.ring_map, "torus": koebe.torus_map,
    "sphere": koebe.sphere_map, "schottky": koebe.schottky_map, "flatten": koebe.flatten,
    "lift": partial(koebe.lift, perforate=True), "certified": koebe.certified_moduli,
}  # fmt: skip
SURFACES = {
    "closed": (BALL, FACES),
    "plate": (POINTS, TRIANGLES),
    "one point": (ONE_POINT, TRIANGLES),
    "line": (LINE, TRIANGLES),
}


@pytest.mark.parametrize("surface", SURFACES)
@pytest.mark.parametrize("kind", MAPS)
def test_a_refusal_names_elements_of_the_surface(kind, surface):
    vertices, triangles = SURFACES[surface]
    try:
        MAPS[kind](vertices, triangles)
    except koebe.KoebeError as error:
        count = len(vertices) if error.of in ("vertices", "edges") else len(triangles)
        assert error.of in ("vertices", "edges", "faces") and len(error.elements), error
        assert set(error.elements) <= set(range(count))


def test_a_surface_without_area_lists_its_faces():
    with pytest.raises(koebe.InputError, match="the surface has no area") as caught:
        koebe.parts(LINE, TRIANGLES)
    assert caught.value.of == "faces" and sorted(caught.value.elements) == [*range(len(TRIANGLES))]


def test_a_misspelt_option_names_the_nearest_one(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(POINTS, TRIANGLES))
    for word, nearest in (("--toleranse=1", "--tolerance"), ("--metod", "--method")):
        told = command("uniformize", tmp_path / "in.obj", tmp_path / "out.obj", word)
        name = word.split("=")[0]
        assert told.stderr.startswith(f"WrongUsage: koebe uniformize has no option {name}: did you mean {nearest}? (")
    told = command("uniformize", tmp_path / "in.obj", tmp_path / "out.obj", "--xyzzy")
    assert told.stderr == "WrongUsage: koebe uniformize has no option --xyzzy (see koebe --help)\n"


FAR = np.array([0.0, 2.0**18, -(2.0**17)])  # with coordinates in steps of 2^-20 the sums are exact


@pytest.mark.parametrize("kind", ["uniformize", "cut", "parts", "ring", "sphere", "flatten"])
def test_a_surface_far_from_the_origin_has_the_same_map(kind):
    make = {**MAPS, "cut": lambda *surface: koebe.uniformize(*surface, cut=True)}[kind]
    near = np.round(POINTS * 2**20) / 2**20
    here, there = make(near, TRIANGLES), make(near + FAR, TRIANGLES)
    assert np.abs(here.corner_uv - there.corner_uv).max() <= 1e-6 * max(1.0, np.abs(here.corner_uv).max())


def test_a_plate_far_from_the_origin_is_no_line(addon):
    are_flat = addon("maps.mapping")._are_flat
    assert not are_flat(POINTS + FAR, TRIANGLES) and not are_flat(1e-3 * POINTS + [0, 2e5, 0], TRIANGLES)
    assert are_flat(LINE, TRIANGLES) and are_flat(ONE_POINT, TRIANGLES)


def test_the_dial_and_the_command_have_one_default_price(addon):
    parts, table = addon("maps.parts"), addon("maps.option_table")
    assert parts.price_of(table.ROWS["evenness"].default) == table.solver_default("parts", "price") == 0.03
    assert parts.price_of(0.0) > parts.price_of(0.5) > parts.price_of(1.0)
    assert parts.darts_of(0.015, table.ROWS["evenness"].default) == 0.015
    assert parts.darts_of(0.02, 0.0) < parts.darts_of(0.02, 0.5) < parts.darts_of(0.02, 1.0)
    assert parts.darts_of(0.5, 1.0) == 1.0 and parts.darts_of(0.0, 1.0) == 0.0


def long_tube(seed):
    """A rough tube of 9 to 27 radii, with diagonals, holes and a comb at its end at random: vertices and triangles."""
    rng = np.random.default_rng(seed)
    around, length = int(rng.integers(5, 16)), rng.uniform(9, 27)
    along, end, teeth = int(length * around / 6), rng.uniform(0.3, 1.5), int(rng.integers(0, 4) * (rng.random() < 0.5))
    angle, twist, rows = 2 * np.pi * np.arange(around) / around, rng.uniform(0, 2), []
    for t in np.arange(along + 1) / along:
        radius = (1 + (end - 1) * t) * (1 + 0.045 * rng.standard_normal(around) * (rng.random() < 0.5))
        shift = 0.1 * rng.standard_normal(around) * length / along * (rng.random() < 0.5)
        turned = angle + twist * t
        rows.append(np.column_stack([radius * np.cos(turned), radius * np.sin(turned), length * t + shift]))
    a = (np.arange(along)[:, None] * around + np.arange(around)).ravel()
    b = (np.arange(along)[:, None] * around + (np.arange(around) + 1) % around).ravel()
    quads = np.stack([a, b, b + around, a + around], axis=1)
    other = np.array([rng.random() >= 0.5 for _ in quads])[:, None]
    triangles = triangles_of(np.where(other, np.roll(quads, -1, axis=1), quads))
    keep = np.ones(len(triangles), bool)
    for _ in range(rng.integers(0, 3)):
        keep[rng.integers(2 * around, max(2 * around + 1, len(triangles) - 2 * around))] = False
    row, place = np.divmod(np.arange(len(quads)), around)
    keep[np.repeat((place % 3 == 0) & (row >= along - min(teeth, along - 2)), 2)] = False
    return np.vstack(rows), triangles[keep]


@pytest.mark.parametrize("seed, even", [(1082, 0.3), (1107, 0.967), (1002, 0.0)])
def test_vertices_of_the_smallest_circles_lie_on_them_or_are_listed(seed, even):
    vertices, triangles = long_tube(seed)
    used, triangles = np.unique(triangles, return_inverse=True)
    result = koebe.uniformize(vertices[used], triangles.reshape(-1, 3), even=even)
    for loop, off, center, radius in zip(result.loops, result.off_circle, result.centers, result.radii, strict=True):
        away = abs(np.linalg.norm(result.uv[loop] - center, axis=1) - radius)
        assert (away[~np.isin(loop, off)] <= 1e-6 * radius + 4e-15).all()
