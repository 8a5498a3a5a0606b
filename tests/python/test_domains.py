"""Maps to flat tori and cylinders: against exact solutions, in exact arithmetic, and under random damage."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_rows, same_as_package, succeeded, write_obj
from cli_support import koebe as run
from domain_surfaces import damaged, holed_ring, holed_torus, opened_slit_ring, renumbered

GRID = 2.0**24


def grid_points(tile):
    """Corners as whole numbers: what the tile is on."""
    points = np.rint(tile.uv * GRID).astype(np.int64)
    assert np.array_equal(points / GRID, tile.uv) and np.array_equal(tile.uv.astype(np.float32), tile.uv)
    return points


def turned_back(tile, triangles):
    """Corners and triangles with the faces in one orientation."""
    corners, faces = grid_points(tile), triangles.copy()
    corners[tile.turned] = corners[tile.turned][:, [0, 2, 1]]
    faces[tile.turned] = faces[tile.turned][:, [0, 2, 1]]
    return corners, faces


def cross(a, b):
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]


def assert_tile(tile, triangles, rims=0):
    """One to one as stored, in whole numbers: faces upright, both sides of each edge alike, and the areas those of the
    cell; converged says so."""
    corners, faces = turned_back(tile, triangles)
    assert corners.min() >= 0 and corners.max() <= GRID
    areas = cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (areas <= 0).sum() == tile.flipped == len(tile.flipped_faces)
    edges = {}
    for corner, face in zip(corners, faces, strict=True):
        for k in range(3):
            a, b = face[k], face[(k + 1) % 3]
            edges[a, b] = corner[(k + 1) % 3] - corner[k], corner[k]
    covered = areas.sum()
    periods = np.rint(tile.periods * GRID).astype(np.int64)
    for (a, b), (step, origin) in edges.items():
        if (b, a) not in edges:
            continue
        back, other = edges[b, a]
        assert np.array_equal(step, -back)
        lattice = np.linalg.lstsq(periods.T, other - origin - step, rcond=None)[0]
        assert np.array_equal(np.rint(lattice).astype(np.int64) @ periods, other - origin - step)
    following = {a: (b, step, origin) for (a, b), (step, origin) in edges.items() if (b, a) not in edges}
    cell = 2 * cross(*periods) if len(periods) == 2 else 0
    for k, loop in enumerate(tile.loops):
        at, twice, under = np.zeros(2, np.int64), 0, 0
        v = loop["vertices"][0]
        height = following[v][2][1]
        for _ in loop["vertices"]:
            v, step, _ = following[v]
            twice += cross(at, at + step)
            under += step[0] * (2 * height + 2 * at[1] + step[1])
            at = at + step
        if k < rims:
            assert at.tolist() == ([1, -1][k] * periods[0]).tolist()
            cell -= under
        else:
            assert not at.any()
            covered -= twice
    if tile.converged:
        assert tile.flipped == tile.below_resolution
        assert covered == cell


def circles_of(tile):
    """Centers and radii of a torus's holes with the shortest period as 1, the smallest hole first at 0."""
    unit = complex(*tile.periods[0])
    circles = sorted(((complex(*loop["center"]) / unit, loop["radius"] / abs(unit)) for loop in tile.loops),
                     key=lambda circle: circle[1])  # fmt: skip
    return [(center - circles[0][0], radius) for center, radius in circles]


def on_torus(difference, tau):
    """The shortest of the copies of a vector."""
    return min(abs(difference + p + q * tau) for p in range(-3, 4) for q in range(-3, 4))


def torus_error(steps):
    vertices, triangles, height, exact = holed_torus(steps)
    tile = koebe.torus_map(vertices, triangles)
    assert tile.converged and not tile.flipped and not tile.warnings
    assert_tile(tile, triangles)
    tau = -1 / height  # reduced: the height is the shortest period
    turned = sorted((((x + 1j * y) / height, r / abs(height)) for x, y, r in exact), key=lambda circle: circle[1])
    expected = [(center - turned[0][0], radius) for center, radius in turned]
    found = circles_of(tile)
    errors = [abs(tile.modulus - tau)]
    errors += [abs(radius / r - 1) for (_, radius), (_, r) in zip(found, expected, strict=True)]
    # A torus turned by half is the same one: either sign of the periods will do.
    pairs = [(c, e) for (c, _), (e, _) in zip(found, expected, strict=True)]
    errors.append(min(max(on_torus(sign * c - e, tau) for c, e in pairs) for sign in (1, -1)))
    return max(errors)


def assert_second_order(error_of, first, falls_by, coarsest=6):
    errors = [error_of(steps) for steps in (coarsest, 2 * coarsest, 4 * coarsest)]
    assert errors[0] < first
    assert errors[0] / errors[1] > falls_by and errors[1] / errors[2] > falls_by


@pytest.mark.slow
def test_a_torus_of_revolution_is_mapped_with_second_order():
    assert_second_order(torus_error, first=8e-3, falls_by=3.6)


def test_a_closed_torus_has_its_modulus():
    vertices, triangles, _, _ = holed_torus(16, holes={})
    tile = koebe.torus_map(vertices, triangles)
    assert_tile(tile, triangles)
    assert tile.sweeps == 0 and tile.loops == []
    assert abs(tile.modulus - 4j / 3) < 1e-3


def test_the_modulus_does_not_depend_on_numbers_and_frame():
    vertices, triangles, _, _ = holed_torus(6)
    first = koebe.torus_map(vertices, triangles)
    other = koebe.torus_map(*renumbered(vertices, triangles)[:2])
    assert abs(first.modulus - other.modulus) < 1e-5
    assert np.allclose(sorted(r for _, r in circles_of(first)), sorted(r for _, r in circles_of(other)), atol=1e-5)


def rims(triangles, flat, height):
    """A vertex of each rim of a ring whose places in the cylinder are known."""
    loops = koebe.boundary_loops(triangles)
    return [int(next(loop[0] for loop in loops if np.allclose(flat[loop][:, 1], v))) for v in (0.0, height)]


HOLES = {(1, 0): ((0.5, 0.5), 0.3), (3, 1): ((0.5, 0.6), 0.25)}


def ring_error(steps):
    vertices, triangles, height, flat, (centers, radii) = holed_ring(steps, holes=HOLES)
    outer, inner = rims(triangles, flat, height)
    tile = koebe.ring_map(vertices, triangles, outer=outer, inner=inner)
    assert tile.converged and not tile.flipped and not tile.warnings
    assert_tile(tile, triangles, rims=2)
    found = sorted((loop["radius"], complex(*loop["center"])) for loop in tile.loops[2:])
    expected = sorted(zip(radii, centers, strict=True))
    errors = [abs(tile.modulus.imag / height - 1)]
    errors += [abs(r / e - 1) for (r, _), (e, _) in zip(found, expected, strict=True)]
    errors.append(abs(found[0][1] / found[1][1] - expected[0][1] / expected[1][1]))
    return max(errors)


@pytest.mark.slow
def test_a_round_annulus_with_round_holes_is_unrolled_with_second_order():
    assert_second_order(ring_error, first=2e-2, falls_by=3.4)


def slit_error(steps, upright):
    vertices, triangles, height, middle, half = opened_slit_ring(steps, upright)
    found = []
    loops = koebe.boundary_loops(triangles)
    # The slit is the loop in the middle of the sphere's equator; the rims are told by the size of their places.
    slit = min(range(3), key=lambda k: np.ptp(vertices[loops[k]][:, 2]))
    others = [int(loops[k][0]) for k in range(3) if k != slit]
    for outer, inner in (others, others[::-1]):
        tile = koebe.ring_map(
            vertices, triangles, outer=outer, inner=inner, holes="radial" if upright else "concentric"
        )
        assert tile.converged and not tile.flipped and not tile.warnings
        assert_tile(tile, triangles, rims=2)
        ends = np.array(tile.loops[2]["slit"]) / tile.periods[0, 0]
        place = abs(ends[:, 1].mean() - middle.imag) / height
        length = abs(np.abs(ends[1] - ends[0]).max() / 2 / half - 1)
        found.append(max(abs(tile.modulus.imag / height - 1), place, length))
    return min(found)  # upside down the slit lies elsewhere


@pytest.mark.slow
@pytest.mark.parametrize("upright", [False, True], ids=["concentric", "radial"])
def test_a_slit_is_found_with_second_order(upright):
    assert_second_order(lambda steps: slit_error(steps, upright), first=2e-2, falls_by=3.4, coarsest=8)


@pytest.mark.parametrize("holes", ["circles", "concentric", "radial"])
def test_a_ring_of_two_loops_is_the_same_whatever_becomes_of_holes(holes):
    vertices, triangles, height, flat, _ = holed_ring(16)
    outer, inner = rims(triangles, flat, height)
    tile = koebe.ring_map(vertices, triangles, outer=outer, inner=inner, holes=holes)
    assert_tile(tile, triangles, rims=2)
    assert abs(tile.modulus.imag / height - 1) < 1e-3
    on_rim = np.isin(triangles, [v for loop in tile.loops[:2] for v in loop["vertices"]])
    levels = np.unique(tile.uv[on_rim][:, 1])
    assert len(levels) == 2  # straight to the last bit


def pipe(levels, radius=lambda s: 1.0, bend=None, around=12):
    """Rings of vertices at these arc lengths, round a straight axis or one of radius `bend`: vertices, triangles."""
    s, angle = np.meshgrid(levels, 2 * np.pi * np.arange(around) / around, indexing="ij")
    r = radius(s)
    points = np.stack([r * np.cos(angle), r * np.sin(angle), s], axis=-1)
    if bend:
        out, turn = bend + points[..., 0], s / bend
        points = np.stack([out * np.cos(turn), out * np.sin(turn), points[..., 1]], axis=-1)
    a = np.arange(len(levels) - 1)[:, None] * around + np.arange(around)
    b = a - np.arange(around) + (np.arange(around) + 1) % around
    faces = np.concatenate([np.stack([a, b, b + around], -1), np.stack([a, b + around, a + around], -1)])
    return points.reshape(-1, 3), faces.reshape(-1, 3).astype(np.int32)


def uneven(length, count, seed=3):
    """Levels from 0 to a length whose steps differ up to ten times."""
    steps = np.random.default_rng(seed).uniform(1, 10, count)
    return np.concatenate([[0.0], np.cumsum(steps) / steps.sum()]) * length


GIRTH = 24 * np.sin(np.pi / 12)  # of a prism of 12 sides round the unit circle
# A prism unrolls to its own rectangle. A cone of slope k: ln(R / r) sqrt(1 + k^2) / 2 pi k. On a torus the metric over
# (R + r cos v)^2 is flat: half a turn is pi sqrt(R^2 - r^2) / 2 pi r.
PIPES = {
    "12 girths": (pipe(uneven(12 * GIRTH, 150)), 12.0, 1e-7),
    "1,000 girths": (pipe(uneven(1000 * GIRTH, 400)), 1000.0, 1e-6),
    "a tiny rim": (pipe(40 - np.geomspace(40, 1e-3, 120), lambda s: (40 - s) / 4, around=32),
                   np.log(4e4) * 17**0.5 / (2 * np.pi), 2e-2),
    "half a turn": (pipe(np.linspace(0, 8 * np.pi, 200), bend=8, around=32), np.pi * 63**0.5 / (2 * np.pi), 2e-2),
}  # fmt: skip


@pytest.mark.parametrize("name", PIPES)
def test_a_tube_of_any_length_has_its_modulus(name):
    (vertices, triangles), modulus, error = PIPES[name]
    for first, second in ((0, -1), (-1, 0)):
        loops = koebe.boundary_loops(triangles)
        tile = koebe.ring_map(vertices, triangles, outer=int(loops[first][0]), inner=int(loops[second][0]))
        assert tile.converged and not tile.flipped and not tile.warnings
        assert_tile(tile, triangles, rims=2)
        assert tile.modulus.imag == pytest.approx(modulus, rel=error)


def test_a_long_tube_with_a_hole_has_its_modulus_or_has_not_converged():
    for girths in (2, 6, 12, 40):
        vertices, triangles = pipe(np.linspace(0, girths * GIRTH, 12 * girths))
        tile = koebe.ring_map(vertices, np.delete(triangles, len(triangles) // 4, axis=0))
        assert not tile.converged or tile.modulus.imag == pytest.approx(girths, rel=0.05)


def test_needles_have_their_modulus_or_have_not_converged():
    for length, rings, taper in ((100, 20, 12), (1500, 20, 12), (1500, 100, 12), (100, 5, 12), (100, 20, 15)):
        levels = np.linspace(0, length, rings)
        r = np.exp(-taper * levels / length)
        modulus = (np.hypot(np.diff(r), np.diff(levels)) * np.log(r[1:] / r[:-1]) / np.diff(r)).sum() / (2 * np.pi)
        tile = koebe.ring_map(*pipe(levels, lambda s, r=r: r[:, None]))
        # The needle has 12 sides: its modulus is 1 % more than that of the cones round it.
        assert not tile.converged or tile.modulus.imag == pytest.approx(modulus, rel=0.1)


def test_slits_lie_along_one_line_to_the_last_bit():
    vertices, triangles, _, _, _ = holed_ring(8, holes=HOLES)
    for holes, axis in (("concentric", 1), ("radial", 0)):
        tile = koebe.ring_map(vertices, triangles, holes=holes)
        for loop in tile.loops[2:]:
            places = tile.uv[np.isin(triangles, loop["vertices"])][:, axis]
            places = np.remainder(places, tile.periods[0, 0]) if axis == 0 else places
            assert np.unique(places).size == 1
            assert abs(loop["slit"][0][axis] - loop["slit"][1][axis]) < 1e-12


@pytest.mark.parametrize("seed", range(24))
def test_random_surfaces_are_mapped_or_refused(seed):
    random = np.random.default_rng(seed)
    kind = ["torus", "circles", "concentric", "radial"][seed % 4]
    holes = {}
    for _ in range(random.integers(0, 5)):
        radius = random.uniform(0.08, 0.4)
        center = random.uniform(radius + 0.05, 0.95 - radius, 2)
        holes[int(random.integers(0, 4)), int(random.integers(0, 2))] = (tuple(center), radius)
    steps = int(random.integers(3, 9))
    surface = holed_torus(steps, holes=holes) if kind == "torus" else holed_ring(steps, holes=holes)
    vertices, triangles = damaged(random, *surface[:2])
    before = vertices.copy(), triangles.copy()
    try:
        if kind == "torus":
            assert_tile(koebe.torus_map(vertices, triangles), triangles)
        else:
            assert_tile(koebe.ring_map(vertices, triangles, holes=kind), triangles, rims=2)
    except koebe.KoebeError as error:
        assert str(error)
    assert np.array_equal(vertices, before[0], equal_nan=True) and np.array_equal(triangles, before[1])


def test_a_tile_that_is_off_by_one_step_is_seen():
    vertices, triangles, _, _ = holed_torus(4)
    tile = koebe.torus_map(vertices, triangles)
    assert_tile(tile, triangles)
    vars(tile)["uv"] = tile.uv.copy()
    tile.uv[7, 1, 0] += 1 / GRID
    with pytest.raises(AssertionError):
        assert_tile(tile, triangles)


def sphere():
    corners = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float)
    faces = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4), (1, 0, 5), (2, 1, 5), (3, 2, 5), (0, 3, 5)]
    return corners, np.array(faces, np.int32)


def test_what_is_no_torus_and_no_ring_is_refused():
    for genus_zero in (sphere(), holed_ring(3)[:2]):
        with pytest.raises(koebe.TopologyError, match="handles") as caught:
            koebe.torus_map(*genus_zero)
        assert caught.value.kind == "genus"
    with pytest.raises(koebe.TopologyError, match="1 handle:") as caught:
        koebe.ring_map(*holed_torus(3)[:2])
    assert caught.value.kind == "genus"
    corners, faces = sphere()
    with pytest.raises(koebe.TopologyError, match="two boundary loops") as caught:
        koebe.ring_map(corners, faces[1:])
    assert caught.value.kind == "closed"
    vertices, triangles, height, flat, _ = holed_ring(4)
    outer, _ = rims(triangles, flat, height)
    with pytest.raises(koebe.InputError, match="lie on one loop"):
        koebe.ring_map(vertices, triangles, outer=outer, inner=outer)
    inside = int(np.flatnonzero(~np.isin(np.arange(len(vertices)), np.concatenate(koebe.boundary_loops(triangles))))[0])
    with pytest.raises(koebe.InputError, match="lies on no boundary loop"):
        koebe.ring_map(vertices, triangles, inner=inside)
    with pytest.raises(koebe.OptionError):
        koebe.ring_map(vertices, triangles, holes="square")


def quads(n, m, closed):
    """A torus of revolution, or a tube, of quadrilaterals: vertices, quadrilaterals, triangles, polygon."""
    s, t = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    u, v = 2 * np.pi * s / n, 2 * np.pi * t / m
    if closed:  # lines that no cut follows
        u, v = u + 0.4 * np.sin(2 * v + u), v + 0.4 * np.sin(2 * u)
    if closed:
        vertices = np.stack([(3 + np.cos(v)) * np.cos(u), (3 + np.cos(v)) * np.sin(u), np.sin(v)], 2)
    else:
        vertices = np.stack([np.cos(u), np.sin(u), 0.3 * t + 0.2 * np.cos(u)], 2)
    at = np.arange(n * m).reshape(n, m)
    right, up, both = np.roll(at, -1, 0), np.roll(at, -1, 1), np.roll(at, -1, (0, 1))
    faces = np.stack([at, right, both, up], 2)[:, : m if closed else m - 1].reshape(-1, 4).astype(np.int32)
    return vertices.reshape(-1, 3), faces, faces[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3), np.repeat(range(len(faces)), 2)


@pytest.mark.parametrize("closed", [True, False], ids=["torus", "ring"])
@pytest.mark.parametrize("seed", range(6))
def test_polygons_stay_whole(closed, seed):
    random = np.random.default_rng(seed)
    vertices, faces, triangles, polygon = quads(*random.integers(5, 30, 2), closed)
    order = random.permutation(len(triangles))
    triangles, polygon = triangles[order], polygon[order]
    function = koebe.torus_map if closed else koebe.ring_map
    torn = []
    for given in (None, polygon):
        tile = function(vertices, triangles, polygon=given)
        assert tile.converged
        assert_tile(tile, triangles, rims=0 if closed else 2)
        places = {}
        for number, face, uv in zip(polygon, triangles, grid_points(tile).tolist(), strict=True):
            for v, at in zip(face, uv, strict=True):
                places.setdefault((number, v), set()).add(tuple(at))
        torn.append(max(map(len, places.values())) > 1)
    assert torn[1] is False
    if seed == 0:
        assert torn[0] is True, "the cut goes round all of them by chance"


def test_the_command_tears_no_polygon(tmp_path):
    vertices, faces, _, _ = quads(17, 9, True)
    write_obj(tmp_path / "in.obj", vertices, faces)
    succeeded("torus", "in.obj", "out.obj", "--json", "out.json", cwd=tmp_path)
    lines = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
    corners = [[int(word.split("/")[1]) - 1 for word in words[1:]] for words in lines if words and words[0] == "f"]
    periods = np.array(json.loads((tmp_path / "out.json").read_text())["periods"])
    points = obj_rows(tmp_path / "out.obj", "vt")[corners]
    areas = 0.5 * cross(points[:, 2] - points[:, 0], points[:, 3] - points[:, 1])
    assert (areas > 0).all() and abs(areas.sum() - cross(*periods)) < 1e-9


@pytest.mark.parametrize("command", ["torus", "ring"])
def test_the_command_says_what_python_says(command, tmp_path):
    surface = holed_torus(5)[:2] if command == "torus" else holed_ring(5, holes=HOLES)[:2]
    write_obj(tmp_path / "in.obj", *surface)
    done = succeeded(command, "in.obj", "out.obj", "--json", "out.json", "--svg", "out.svg", cwd=tmp_path)
    assert "modulus" in done.stdout and "0 flipped" in done.stdout
    tile = koebe.torus_map(*surface) if command == "torus" else koebe.ring_map(*surface)
    assert same_as_package(json.loads((tmp_path / "out.json").read_text()), tile)
    assert np.isin(np.unique(tile.uv.reshape(-1, 2), axis=0), obj_rows(tmp_path / "out.obj", "vt")).all()
    assert (tmp_path / "out.svg").read_text().startswith("<svg")
    refused = run("ring" if command == "torus" else "torus", "in.obj", "no.obj", cwd=tmp_path)
    assert refused.returncode == CANNOT_BE_MAPPED and "TopologyError" in refused.stderr
    assert not (tmp_path / "no.obj").exists()
