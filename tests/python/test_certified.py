"""Bounds of capacities and moduli that are proved: on surfaces whose numbers are known exactly."""

import json
import math
from decimal import Decimal, localcontext

import koebe
import numpy as np
import pytest
from cli_support import succeeded
from test_cli import CANNOT_BE_MAPPED, NOT_CONVERGED, USAGE, obj_text
from test_cli import koebe as command

# Folds of a strip 5 long that have whole coordinates: 3² + 4² = 5².
FOLDS = np.array([(5, 0), (3, 4), (4, 3), (3, -4), (4, -3)])


def ellipk(m):
    """The complete elliptic integral K of the parameter m = k², by the arithmetic-geometric mean."""
    a, b = 1.0, math.sqrt(1.0 - m)
    while abs(a - b) > 1e-15 * a:
        a, b = (a + b) / 2, math.sqrt(a * b)
    return math.pi / (a + b)


def ratio(m):
    """K(k) / K'(k), the capacity of a half-plane between [0, m] and [1, inf), no flux through the rest of the line."""
    return ellipk(m) / ellipk(1.0 - m)


HALF = 2.0 - math.sqrt(2.0)  # sn²(K / 2) for k² = 1/2: the square [0, 1]² maps to the half-plane by sn²
SLIT_SQUARE = 4.0 * ratio(HALF)  # a square of side 2 with a slit of length 1 in the middle, along the sides
TEICHMUELLER = 2.0 * ratio(HALF / 2.0)  # a square in two layers, joined at three sides, slit on half of the third


def square_in_square():
    """Capacity between a square and the square half as large in its middle (Bowman 1953, as in Betsakos, Samuelsson and
    Vuorinen 2004)."""

    def inverse_mu(y):  # of (pi / 2) K'(r) / K(r), falling
        low, high = 0.0, 1.0
        for _ in range(200):
            middle = (low + high) / 2
            value = math.pi / 2 / ratio(middle * middle) if 0 < middle < 1 else 0.0
            low, high = (middle, high) if value > y else (low, middle)
        return low

    c = (1 - 0.5) / (1 + 0.5)
    u, v = inverse_mu(math.pi * c / 2), inverse_mu(math.pi / (2 * c))
    return 8.0 * ratio(((u - v) / (u + v)) ** 4)


def grid(size, inside=lambda i, j: True):
    """Points (i, j) and the triangles of the cells that are inside, their diagonals from (i, j) to (i + 1, j + 1)."""
    n = size + 1
    points = np.array([(i, j) for j in range(n) for i in range(n)], float)
    cells = [j * n + i for j in range(size) for i in range(size) if inside(i, j)]
    faces = [face for a in cells for face in ((a, a + 1, a + n + 1), (a, a + n + 1, a + n))]
    return points, np.array(faces)


def folded(points, rng):
    """The sheet in space, folded along the columns of its grid, 5 to the unit; flat without random numbers."""
    columns = int(points[:, 0].max())
    steps = FOLDS[rng.integers(0, len(FOLDS), columns)] if rng else FOLDS[np.zeros(columns, int)]
    places = np.vstack([(0, 0), np.cumsum(steps, axis=0)])[points[:, 0].astype(int)]
    return np.column_stack([places[:, 0], 5 * points[:, 1], places[:, 1]]).astype(float)


def doubled(points, faces, vertex, above):
    """The mesh opened at a vertex: faces above the slit get a vertex of their own."""
    faces = faces.copy()
    for face in faces:
        if above(points[face].mean(axis=0)):
            face[face == vertex] = len(points)
    return np.vstack([points, points[vertex]]), faces


def ring(rng=None):
    points, faces = grid(4, lambda i, j: not (1 <= i < 3 and 1 <= j < 3))
    return folded(points, rng), faces


def ring_with_slit(rng=None):
    """The same shape with a slit on its diagonal: a symmetry, along which flux runs."""
    points, faces = grid(16, lambda i, j: not (4 <= i < 12 and 4 <= j < 12))
    points, faces = doubled(points, faces, 2 * 17 + 2, lambda p: p[1] > p[0])
    return folded(points, rng), faces


def slit_square(rng=None):
    points, faces = doubled(*grid(4), 2 * 5 + 2, lambda p: p[1] > 2)
    return folded(points, rng), faces


def pillow(rng=None):
    """Two layers of a square 4 wide, joined at the left, at the right, and at the bottom from 2 to 4."""
    points, faces = grid(4)
    faces[(faces[:, 0] == 3) & (points[faces].max(axis=1)[:, 1] == 1)] = (3, 4, 8), (4, 9, 8)  # no edge across a corner
    other = np.arange(len(points))
    apart = [k for k, (i, j) in enumerate(points) if 0 < i < 4 and (j > 0 or i < 2)]
    other[apart] = len(points) + np.arange(len(apart))
    return folded(np.vstack([points, points[apart]]), rng), np.vstack([faces, other[faces][:, ::-1]])


def prism(rng):
    """A panel rolled round a random polygon, with inner vertices at random heights on its edges, and its capacity."""
    sides, rows = int(rng.integers(3, 12)), int(rng.integers(1, 5))
    corners = rng.normal(size=(sides, 2)) * 10.0 ** rng.uniform(-3, 3)
    height = 10.0 ** rng.uniform(-2, 2)
    heights = np.sort(rng.uniform(0.1, 0.9, (rows - 1, sides)), axis=0) * height
    z = np.vstack([np.zeros(sides), heights, np.full(sides, height)])
    vertices = np.column_stack([np.tile(corners, (rows + 1, 1)), z.ravel()])
    faces = []
    for i in range(rows):
        for j in range(sides):
            a, b = i * sides + j, i * sides + (j + 1) % sides
            c, d = b + sides, a + sides
            faces += [(a, b, c), (a, c, d)] if rng.random() < 0.5 else [(a, b, d), (b, c, d)]
    with localcontext() as context:
        context.prec = 60
        girth = Decimal(0)
        for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            girth += sum((Decimal(float(y)) - Decimal(float(x))) ** 2 for x, y in zip(p, q, strict=True)).sqrt()
        return vertices, np.array(faces), girth / Decimal(height)


def holds(pair, exact, rounding=1e-13):
    """Whether a pair encloses a number that is itself known to some rounding."""
    return pair[0] <= exact * (1 + rounding) and exact * (1 - rounding) <= pair[1]


def test_a_square_in_a_square():
    exact = square_in_square()
    assert exact == pytest.approx(10.2340925693681, abs=1e-11)  # as printed in the literature
    found = koebe.certified_moduli(*ring(), width=1e-6)
    assert found.converged and found.width <= 1e-6 and found.condensers == [([1], [0])]
    assert holds(found.capacities[0], exact)
    assert holds(found.modulus, 1 / exact)
    assert holds(found.module["r_1"], math.exp(-2 * math.pi / exact)) and not found.warnings
    coarse = koebe.certified_moduli(*ring())
    assert coarse.converged and coarse.face_count == 24 and coarse.levels == 1 and coarse.width > 0.1
    assert holds(coarse.capacities[0], exact)


@pytest.mark.parametrize(("surface", "exact"), [(slit_square, SLIT_SQUARE), (pillow, TEICHMUELLER)])
def test_slits(surface, exact):
    found = koebe.certified_moduli(*surface(), width=1e-6)
    assert found.converged and holds(found.capacities[0], exact)


@pytest.mark.parametrize("radius", [0.3, 0.5, 0.8])
def test_a_groetzsch_ring_lies_between_polygons(radius):
    """The disk with a slit from 0 to r has the capacity 2 pi / mu(r). A larger domain has a smaller capacity."""
    exact = 4 * ratio(radius**2)
    count, bounds = 64, []
    for size in (1.0, 1.0 / math.cos(math.pi / count)):
        angles = 2 * np.pi * np.arange(count) / count
        # The slit's ends and both sides of its middle, each joined to a part of the polygon.
        slit = [(radius, 0), (radius / 2, 0), (0, 0), (radius / 2, 0)]
        points = np.vstack([size * np.column_stack([np.cos(angles), np.sin(angles)]), slit])
        at = [0, count // 8, 3 * count // 8, 5 * count // 8, 7 * count // 8]
        part = np.searchsorted(at[1:], np.arange(count), side="right") % 4
        faces = [(k, (k + 1) % count, count + part[k]) for k in range(count)]
        faces += [(edge, count + (k + 1) % 4, count + k) for k, edge in enumerate(at[1:])]
        found = koebe.certified_moduli(np.column_stack([points, np.zeros(len(points))]), faces, width=1e-3)
        assert found.converged
        bounds.append(found.capacities[0])
    inside, outside = bounds
    assert outside[0] <= exact <= inside[1]
    assert inside[1] - outside[0] < 0.01 * exact


def test_no_flux_runs_through_the_other_loops():
    """A slit along the flux changes nothing if it is free, but much if it is held."""
    surface = ring_with_slit()
    loops = koebe.boundary_loops(surface[1])
    assert [len(loop) for loop in loops] == [64, 4, 32]
    free = koebe.certified_moduli(*surface, width=1e-6, between=[([0], [2]), ([2], [0])])
    assert free.converged and free.modulus is None and free.condensers == [([0], [2]), ([2], [0])]
    assert holds(free.capacities[0], square_in_square()) and holds(free.capacities[1], square_in_square())
    held = koebe.certified_moduli(*surface, width=1e-3, between=[([0, 1], [2]), ([0], [1, 2])])
    assert held.capacities[:, 0].min() > square_in_square() + 0.3


def test_a_ring_with_radial_slits_has_the_certified_modulus():
    surface = ring_with_slit(np.random.default_rng(3))
    found = koebe.certified_moduli(*surface, width=1e-4, between=[([0], [2])])
    height = koebe.ring_map(*surface, holes="radial").modulus.imag
    assert height == pytest.approx(1 / found.capacities[0].mean(), rel=5e-3)


@pytest.mark.slow
def test_the_width_falls_with_the_square_of_the_number_of_faces():
    """Quadratic functions, and faces cut where the corners need it."""
    runs = [koebe.certified_moduli(*ring(), width=width) for width in (1e-2, 1e-4, 1e-6)]
    pairs = list(zip(runs, runs[1:], strict=False))
    slopes = [math.log(b.width / a.width) / math.log(b.face_count / a.face_count) for a, b in pairs]
    assert max(slopes) < -1.7
    for coarse, fine in zip(runs, runs[1:], strict=False):
        assert coarse.capacities[0, 0] <= fine.capacities[0, 0] <= fine.capacities[0, 1] <= coarse.capacities[0, 1]


def test_rolled_panels():
    rng = np.random.default_rng(34)
    for _ in range(50):
        vertices, faces, exact = prism(rng)
        found = koebe.certified_moduli(vertices, faces)
        assert Decimal(found.capacities[0, 0]) <= exact <= Decimal(found.capacities[0, 1])
        assert found.capacities[0, 1] - found.capacities[0, 0] < 1e-8 * float(exact)


@pytest.mark.slow
@pytest.mark.parametrize("count", [40, pytest.param(1000, marks=pytest.mark.long)])
def test_developable_surfaces(count):
    rng = np.random.default_rng(2026)
    known = [(ring, square_in_square()), (slit_square, SLIT_SQUARE), (pillow, TEICHMUELLER)]
    for k in range(count):
        if k % 2:
            vertices, faces, exact = prism(rng)
            found = koebe.certified_moduli(vertices, faces)
            assert Decimal(found.capacities[0, 0]) <= exact <= Decimal(found.capacities[0, 1]), k
        else:
            surface, exact = known[k // 2 % 3]
            vertices, faces = surface(rng)
            vertices *= 2.0 ** rng.integers(-40, 40)
            found = koebe.certified_moduli(vertices, faces, width=10 ** rng.uniform(-6, -2))
            assert found.converged and holds(found.capacities[0], exact), k


@pytest.mark.slow
def test_the_capacities_of_more_loops():
    """All loops held: a surface with n loops has n (n - 1) / 2 numbers, and unions of loops follow from them."""
    points, faces = grid(12, lambda i, j: (i, j) not in {(2, 2), (8, 3), (5, 8)})
    found = koebe.certified_moduli(folded(points, np.random.default_rng(5)), faces, width=1e-3)
    assert [high for _, high in found.condensers] == [[0], [1], [2], [3], [0, 1], [0, 2], [0, 3]]
    assert found.modulus is None
    low, high = found.capacities.T
    # C(0,1) + C(0,2) + C(0,3) = the sum of all single loops', as the rows of the fluxes sum to 0.
    assert low[4:].sum() <= high[:4].sum() and low[:4].sum() <= high[4:].sum()
    assert high.max() - low.min() > 1


@pytest.mark.parametrize("holes", [{(2, 2), (8, 3), (8, 4)}, {(3, 3), (7, 2), (7, 3), (5, 7), (6, 7)}])
def test_the_circles_of_three_and_four_loops(holes):
    """Folded at random and numbered anew, it is the same surface; the iteration's circles are near to these."""
    rng = np.random.default_rng(len(holes))
    points, faces = grid(12, lambda i, j: (i, j) not in holes)
    vertices = folded(points, rng)
    wide, found = (koebe.certified_moduli(vertices, faces, width=width) for width in (1e-2, 1e-3))
    assert found.converged and not found.warnings and list(found.module) == koebe.module_names(len(found.module_loops))
    order = rng.permutation(len(vertices))
    again = koebe.certified_moduli(folded(points, rng)[np.argsort(order)], order[faces], width=1e-3)
    near = koebe.conformal_module(koebe.uniformize(vertices, faces))
    for (name, pair), value in zip(found.module.items(), near, strict=True):
        assert 0 < pair[1] - pair[0] <= 1e-3 and abs(pair[0] - value) < 0.05
        for other in (wide, again):
            assert max(pair[0], other.module[name][0]) <= min(pair[1], other.module[name][1])


def test_more_loops_have_bounds_of_their_capacities_alone():
    points, faces = grid(12, lambda i, j: (i, j) not in {(2, 2), (8, 3), (4, 8), (9, 9)})
    found = koebe.certified_moduli(folded(points, None), faces)
    assert [one.kind for one in found.warnings] == ["not_enclosed"] and found.module == {} and found.module_loops == []
    assert len(found.capacities) == 15


def test_a_disk_has_no_capacity():
    found = koebe.certified_moduli(*grid_in_space(2), width=1e-3)
    assert found.converged and found.capacities.shape == (0, 2) and found.condensers == [] and found.modulus is None


def grid_in_space(size):
    points, faces = grid(size)
    return folded(points, None), faces


def test_the_bounds_do_not_depend_on_the_unit_the_place_and_the_numbers():
    vertices, faces = ring(np.random.default_rng(1))
    found = koebe.certified_moduli(vertices, faces, width=1e-4)
    for changed in (vertices * 2.0**-700, vertices * 2.0**900, vertices + 1e6):
        again = koebe.certified_moduli(changed, faces, width=1e-4)
        assert again.converged and holds(again.capacities[0], square_in_square())
    assert np.array_equal(koebe.certified_moduli(vertices, faces, width=1e-4, threads=1).capacities, found.capacities)
    order = np.random.default_rng(2).permutation(len(vertices))
    again = koebe.certified_moduli(vertices[np.argsort(order)], order[faces], width=1e-4)
    assert holds(again.capacities[0], square_in_square())


def test_a_limit_is_reported_and_its_bounds_hold():
    found = koebe.certified_moduli(*ring(), width=1e-6, max_faces=2000)
    assert not found.converged and found.face_count <= 2000 and found.width > 1e-6
    assert holds(found.capacities[0], square_in_square())
    never = koebe.certified_moduli(*ring(), width=1e-30, max_faces=20000)
    assert not never.converged and holds(never.capacities[0], square_in_square())


def test_errors():
    vertices, faces = ring()
    with pytest.raises(koebe.InputError, match="no area") as error:
        koebe.certified_moduli(np.vstack([vertices, [2.5, 0, 0]]), [(0, len(vertices), 1), *faces])
    assert error.value.elements == [0]
    for between, match in (
        ([], "at least one"),
        ([([0], [])], "at 0 and a loop at 1"),
        ([([0], [0])], "twice"),
        ([([0], [2])], "not there"),
        ([([0], [-1])], "must name"),
        ([3], "pairs"),
        (["01"], "between"),
    ):
        with pytest.raises((koebe.InputError, TypeError), match=match):
            koebe.certified_moduli(vertices, faces, between=between)
    with pytest.raises(koebe.TopologyError, match="closed"):
        koebe.certified_moduli(np.eye(4)[:, :3], [(0, 1, 2), (0, 3, 1), (0, 2, 3), (1, 3, 2)])


def test_the_command(tmp_path):
    vertices, faces = ring()
    path = tmp_path / "ring.obj"
    path.write_text(obj_text(vertices, faces))
    done = succeeded("module", path, "--certified", "--width", "1e-4")
    report = json.loads(done.stdout)
    assert report["converged"] and report["input"] == "ring.obj"
    python = koebe.certified_moduli(vertices, faces, width=1e-4).to_dict()
    assert python.pop("options") == {"width": 1e-4, "max_faces": 300000, "weld": None}
    assert report == {**python, "input": "ring.obj", "warnings": []}
    assert set(report["modulus"]) == set(report["r_1"]) == {"lower", "upper"} and report["loops"] == [0, 1]
    stopped = command("module", path, "--certified", "--width", "1e-6", "--max-faces", "100")
    assert stopped.returncode == NOT_CONVERGED and not json.loads(stopped.stdout)["converged"]
    exchanged = json.loads(command("module", path, "--certified", "--between", "0/1").stdout)["capacities"]
    assert [(one["low"], one["high"]) for one in exchanged] == [([0], [1])]
    for wrong in (["--width", "1e-3"], ["--certified", "--tolerance", "1"], ["--certified", "--between", "01"]):
        assert command("module", path, *wrong).returncode == USAGE
    assert command("module", path, "--certified", "--between", "0/2").returncode == CANNOT_BE_MAPPED


def test_a_face_without_area_is_named_as_in_the_file(tmp_path):
    vertices, faces = ring()
    path = tmp_path / "ring.obj"
    quad, rest = "f 1 2 7 6\n", faces[2:]  # the first cell as one polygon
    assert {*faces[:2].ravel()} == {0, 1, 5, 6}
    text = obj_text(np.vstack([vertices, [2.5, 0, 0]]), [*rest, (0, len(vertices), 1)])
    path.write_text(text.replace("f ", quad + "f ", 1))
    done = command("module", path, "--certified")
    assert done.returncode == CANNOT_BE_MAPPED and f"[{len(rest) + 1}]" in done.stderr
