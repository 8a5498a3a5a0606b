"""Patterns on surfaces: holes counted, solids closed, and the surface between left as it is."""

import json
import struct
import zipfile
from xml.etree import ElementTree

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, succeeded, triangulated_plate
from cli_support import koebe as command
from uv_measures import signed_areas

AROUND, ROWS = 60, 20


def tube():
    """A cylinder of radius 1 and height 2."""
    angle, height = np.meshgrid(2 * np.pi * np.arange(AROUND) / AROUND, np.linspace(0, 2, ROWS + 1))
    points = np.stack([np.cos(angle), np.sin(angle), height], axis=2).reshape(-1, 3)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(ROWS), np.arange(AROUND), indexing="ij"))
    a, b = i * AROUND + j, i * AROUND + (j + 1) % AROUND
    return points, np.concatenate([np.stack([a, b, b + AROUND], 1), np.stack([a, b + AROUND, a + AROUND], 1)])


def edges_of(triangles):
    """The number of faces at each edge, and of half-edges in each direction."""
    ends = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    return np.unique(np.sort(ends, axis=1), axis=0, return_counts=True)[1], np.unique(ends, axis=0, return_counts=True)[
        1
    ]


def euler(triangles):
    return len(np.unique(triangles)) - len(edges_of(triangles)[0]) + len(triangles)


def loops_of(triangles):
    return koebe.boundary_loops(triangles, vertex_count=int(triangles.max()) + 1)


def stored_areas(uv):
    return signed_areas(uv.astype(np.float32).astype(float))


@pytest.mark.parametrize("pattern", ["circles", "hexagons", "triangles", "diamonds", "stripes", "truchet", "voronoi"])
@pytest.mark.parametrize("shape", ["ring", "disk", "parts"])
def test_each_outline_is_one_hole(pattern, shape):
    vertices, triangles = tube()
    result = koebe.lift(vertices, triangles, pattern, shape=shape, size=0.4, perforate=True)
    holes = result.outlines
    assert holes > 5 and len(loops_of(result.triangles)) == 2 + holes and euler(result.triangles) == -holes
    assert result.loops == {"before": 2, "after": 2 + holes} and result.euler == {"before": 0, "after": -holes}
    assert edges_of(result.triangles)[0].max() == 2 and edges_of(result.triangles)[1].max() == 1
    assert (stored_areas(result.uv) > 0).all()
    own = result.original >= 0
    assert (result.vertices[own] == vertices[result.original[own]]).all()
    assert len(np.unique(result.original[own])) == own.sum() > 0


def test_the_surface_between_is_the_surface():
    vertices, triangles = tube()
    result = koebe.lift(vertices, triangles, "voronoi", shape="ring", size=0.4, perforate=True)
    angle = np.arctan2(result.vertices[:, 1], result.vertices[:, 0])
    middle = (np.floor(angle * AROUND / (2 * np.pi)) + 0.5) * 2 * np.pi / AROUND  # of the facet
    off = result.vertices[:, 0] * np.cos(middle) + result.vertices[:, 1] * np.sin(middle) - np.cos(np.pi / AROUND)
    assert abs(off).max() < 1e-12


def test_the_two_sides_of_the_cut_differ_by_the_period():
    vertices, triangles = tube()
    result = koebe.lift(vertices, triangles, "hexagons", shape="ring", repeats=20, perforate=True)
    assert result.outlines % 20 == 0 and result.outlines > 20
    steps = set()
    corner = {}
    for f, face in enumerate(result.triangles.tolist()):
        for k in range(3):
            corner.setdefault(face[k], set()).add(tuple(result.uv[f, k]))
    for places in corner.values():
        if len(places) > 1:
            assert len(places) == 2
            a, b = places
            steps.add((abs(a[0] - b[0]), a[1] - b[1]))
    assert len(steps) == 1 and next(iter(steps))[1] == 0.0


@pytest.mark.parametrize("options", [{"perforate": True}, {"height": 0.05}, {"height": -0.02}])
def test_a_solid_is_closed(options):
    vertices, triangles = tube()
    result = koebe.lift(vertices, triangles, "circles", shape="ring", size=0.4, thickness=0.1, **options)
    faces, directed = edges_of(result.triangles)
    assert result.closed and (faces == 2).all() and (directed == 1).all()
    assert euler(result.triangles) == (-2 * result.outlines if "perforate" in options else 0)
    corners = result.vertices[result.triangles]
    assert np.linalg.det(corners).sum() / 6 > 0.5  # of 1.26 without holes: not inside out


def test_circles_are_even_on_the_surface():
    x, y = (k.ravel() for k in np.meshgrid(np.linspace(-1, 1, 41), np.linspace(-1, 1, 41)))
    hill = np.stack([x, y, 1.2 * np.exp(-4 * (x**2 + y**2))], 1)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(40), np.arange(40), indexing="ij"))
    a = 41 * i + j
    faces = np.concatenate([np.stack([a, a + 1, a + 42], 1), np.stack([a, a + 42, a + 41], 1)])
    result = koebe.lift(hill, faces, "circles", size=0.2, bridge=0.04, perforate=True)
    lengths = []
    for loop in loops_of(result.triangles):
        points = result.vertices[loop]
        lengths.append(np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum())
    circles = np.sort(lengths)[:-1] / (np.pi * 0.16)
    assert len(circles) > 60 and circles.max() < 1.1 and np.median(circles) > 0.75


def test_the_same_seed_gives_the_same_pattern():
    vertices, triangles = tube()
    first, again, other = (
        koebe.lift(vertices, triangles, "voronoi", shape="ring", size=0.5, seed=seed, perforate=True)
        for seed in (7, 7, 8)
    )
    assert (first.vertices == again.vertices).all() and (first.triangles == again.triangles).all()
    assert first.vertices.shape != other.vertices.shape or (first.vertices != other.vertices).any()


@pytest.mark.parametrize("pattern", ["circles", "hexagons", "truchet"])
def test_rows_follow_a_hole(pattern):
    vertices, faces = triangulated_plate(48, holes=((0.42, 0.45, 0.12),))
    (vertex,) = {int(loop[0]) for loop in loops_of(faces)} - {0}
    result = koebe.lift(vertices, faces, pattern, around=vertex, repeats=12, perforate=True)
    in_a_row = 24 if pattern == "truchet" else 12
    assert result.outlines >= in_a_row and result.outlines % in_a_row == 0  # whole rows, or none of a row
    assert len(loops_of(result.triangles)) == 2 + result.outlines
    one = koebe.lift(vertices, faces, pattern, around=vertex, repeats=12, rows=1, perforate=True)
    assert one.outlines == in_a_row < result.outlines
    with pytest.raises(koebe.InputError, match="rows are counted around a hole only"):
        koebe.lift(vertices, faces, pattern, rows=1, perforate=True)
    with pytest.raises(koebe.InputError, match="on no hole"):
        koebe.lift(vertices, faces, pattern, around=0, perforate=True)
    with pytest.raises(koebe.InputError, match="no rows"):
        koebe.lift(vertices, faces, "voronoi", around=vertex, perforate=True)
    with pytest.raises(koebe.InputError, match="around is for"):
        koebe.lift(*tube(), pattern, shape="ring", around=0, perforate=True)


def flat_ring(inner=0.3):
    """A flat ring between two circles about 0, cut in rows."""
    points, faces = tube()
    radius = inner ** (1.0 - points[:, 2] / 2.0)
    return np.column_stack([radius * points[:, 0], radius * points[:, 1], 0 * radius]), faces


def directions(result):
    """The middle (n,) of each new hole in the UVs as a complex number, and its longer axis (n,) as a unit number."""
    middles, axes = [], []
    places = np.zeros(len(result.vertices), complex)
    places[result.triangles] = (2 * result.uv - 1) @ [1, 1j]
    for loop in loops_of(result.triangles):
        if (result.original[loop] >= 0).all():
            continue  # a loop of the surface
        z = places[loop]
        middles.append(z.mean())
        values, vectors = np.linalg.eigh(np.cov(np.stack([z.real, z.imag])))
        assert values[1] > 2 * values[0]
        axes.append(complex(*vectors[:, 1]))
    return np.array(middles), np.array(axes)


@pytest.mark.parametrize(("turn", "along"), [(0, True), (180, True), (90, False), (-90, False)])
def test_stripes_follow_the_circles_of_a_hole_or_are_rays(turn, along):
    vertices, faces = flat_ring()
    result = koebe.lift(vertices, faces, "stripes", around=0, turn=turn, repeats=8 if along else 48, perforate=True)
    middles, axes = directions(result)
    assert result.outlines % (8 if along else 24) == 0 and len(axes) == result.outlines > 8
    radial = abs((axes * middles.conj() / abs(middles)).real)
    rows = 1 + (np.diff(np.sort(abs(middles))) > 0.02).sum()
    assert rows == result.outlines // (8 if along else 24) > 1
    assert (radial < 0.1).all() if along else (radial > 0.99).all()


@pytest.mark.parametrize("turn", [0, 30, 90, -45])
def test_a_lattice_turns_in_a_disk(turn):
    vertices, faces = flat_ring()
    result = koebe.lift(vertices, faces, "stripes", size=0.08, turn=turn, perforate=True)
    _, axes = directions(result)
    assert len(axes) > 8 and (abs((axes / (1j * np.exp(1j * np.radians(turn)))).real) > 0.99).all()


def test_a_turn_that_does_not_fit_is_refused():
    vertices, faces = flat_ring()
    for pattern, options, said in (
        ("stripes", {"around": 0, "turn": 45}, "stripes turn by 90 degrees"),
        ("hexagons", {"shape": "ring", "turn": 90}, "nothing else turns"),
        ("circles", {"turn": 90}, "have no turn"),
    ):
        with pytest.raises(koebe.InputError, match=said):
            koebe.lift(vertices, faces, pattern, perforate=True, **options)


@pytest.mark.parametrize("options", [
    {"perforate": True}, {"height": 0.05}, {"height": 0.05, "thickness": 0.02}, {"perforate": True, "thickness": 0.1},
], ids=str)  # fmt: skip
@pytest.mark.parametrize("shape", ["ring", "disk"])
def test_it_is_told_where_each_corner_lies_on_the_surface(shape, options):
    vertices, faces = tube()
    faces[::3] = faces[::3, [1, 2, 0]]
    result = koebe.lift(vertices, faces, "circles", shape=shape, size=0.4, **options)
    assert abs(result.weights.sum(axis=2) - 1).max() < 1e-12 and result.weights.min() >= 0
    places = np.einsum("fck,fkd->fcd", result.weights, vertices[faces[result.face]])
    moved = np.linalg.norm(places - result.vertices[result.triangles], axis=2)
    most = options.get("height", 0) + options.get("thickness", 0) / 2
    assert moved.max() < most + 1e-6
    if not result.closed:
        assert (moved[result.patch == 0] < 1e-6).all()
        one = result.weights.max(axis=2) == 1.0
        corner = faces[result.face[:, None], result.weights.argmax(axis=2)]
        own = result.original[result.triangles]
        assert (own >= 0).any() and (one & (corner == own))[own >= 0].all()


def test_holes_stay_as_they_are():
    vertices, faces = triangulated_plate(32)
    result = koebe.lift(vertices, faces, "hexagons", size=0.06, perforate=True)
    assert result.left_out["at_border"] > 0 and result.loops["before"] == 4
    (warning,) = [one for one in result.warnings if one.kind == "left_out"]
    assert "outlines of the pattern left out" in warning.text and len(warning.elements) > 0
    rims = {int(v) for loop in loops_of(faces) for v in loop}
    assert rims <= set(result.original.tolist())


def test_what_cannot_be_made_is_refused():
    vertices, triangles = tube()
    with pytest.raises(koebe.InputError, match="either perforate, or give a height"):
        koebe.lift(vertices, triangles)
    with pytest.raises(koebe.InputError, match="no pattern 'spirals'"):
        koebe.lift(vertices, triangles, "spirals", perforate=True)
    with pytest.raises(koebe.InputError, match="6 or 8 fit"):
        koebe.lift(vertices, triangles, "stripes", shape="ring", repeats=7, perforate=True)
    with pytest.raises(koebe.InputError, match="would turn over") as caught:
        koebe.lift(vertices, triangles, "circles", shape="ring", perforate=True, thickness=2.5)
    assert len(caught.value.elements) > 0
    with pytest.raises(koebe.InputError, match="sunk through"):
        koebe.lift(vertices, triangles, "circles", shape="ring", height=-0.3, thickness=0.2)
    with pytest.raises(koebe.InputError, match="no outline"):
        koebe.lift(vertices, triangles, "circles", shape="ring", size=40.0, perforate=True)


def test_a_pattern_far_too_fine_is_refused_with_the_number_of_its_outlines():
    """A strip 132,000 long and 1 wide: the size is in the unit of its vertices."""
    along = np.linspace(0, 132e3, 21)
    vertices = np.concatenate([np.stack([along, np.full(21, y), np.zeros(21)], 1) for y in (-0.5, 0.5)])
    i = np.arange(20)
    triangles = np.concatenate([np.stack([i, i + 1, i + 22], 1), np.stack([i, i + 22, i + 21], 1)])
    for size, said in ((16.7, "no outline of the pattern fits"), (0.5, r"[1-9]\d{6,} outlines are too many")):
        with pytest.raises(koebe.InputError, match=said):
            koebe.lift(vertices, triangles, "hexagons", shape="parts", perforate=True, rim="clip", size=size)


def test_the_command_writes_obj_ply_and_stl(tmp_path):
    vertices, triangles = tube()
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    options = ["--shape", "ring", "--size", "0.4", "--perforate"]
    run = succeeded("lift", "in.obj", "hexagons", "out.obj", *options, "--json", "r.json", cwd=tmp_path)
    assert "outlines cut out" in run.stdout, run.stderr
    report = json.loads((tmp_path / "r.json").read_text())
    lines = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
    points = np.array([line[1:] for line in lines if line[:1] == ["v"]], float)
    faces = [line for line in lines if line[:1] == ["f"]]
    assert report["input"] == "in.obj" and report["options"]["size"] == 0.4 and report["faces"] == len(faces)
    assert report["loops"]["after"] == 2 + report["outlines"]
    result = koebe.lift(vertices, triangles, "hexagons", shape="ring", size=0.4, perforate=True)
    assert np.array_equal(points, result.vertices)
    run = succeeded("lift", "in.obj", "hexagons", "out.stl", *options, "--thickness", "0.1", cwd=tmp_path)
    assert "closed" in run.stdout, run.stderr
    data = (tmp_path / "out.stl").read_bytes()
    (count,) = struct.unpack_from("<I", data, 80)
    assert len(data) == 84 + 50 * count
    facets = np.frombuffer(data, np.dtype([("n", "<f4", 3), ("p", "<f4", (3, 3)), ("a", "<u2")]), count, 84)
    index = np.unique(facets["p"].reshape(-1, 3), axis=0, return_inverse=True)[1].reshape(-1, 3)
    assert (edges_of(index)[0] == 2).all() and (edges_of(index)[1] == 1).all()
    sides = facets["p"][:, 1] - facets["p"][:, 0], facets["p"][:, 2] - facets["p"][:, 0]
    assert (np.einsum("fd,fd->f", np.cross(*sides), facets["n"]) >= 0).all()
    run = succeeded("lift", "in.obj", "hexagons", "out.3mf", *options, "--thickness", "0.1", cwd=tmp_path)
    assert "closed" in run.stdout, run.stderr
    with zipfile.ZipFile(tmp_path / "out.3mf") as archive:
        assert archive.testzip() is None and "[Content_Types].xml" in archive.namelist()
        model = ElementTree.fromstring(archive.read("3D/3dmodel.model"))
    core = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
    solid = koebe.lift(vertices, triangles, "hexagons", shape="ring", size=0.4, perforate=True, thickness=0.1)
    places = [[float(vertex.get(axis)) for axis in "xyz"] for vertex in model.iter(f"{core}vertex")]
    corners = [[int(face.get(name)) for name in ("v1", "v2", "v3")] for face in model.iter(f"{core}triangle")]
    assert np.array_equal(places, solid.vertices) and np.array_equal(corners, solid.triangles)
    assert command("lift", "in.obj", "hexagons", "out.ply", *options, cwd=tmp_path).returncode == 0
    assert koebe.lift(tmp_path / "out.ply", pattern="circles", size=0.1, height=0.01).outlines > 0


def test_a_refusal_leaves_no_file(tmp_path):
    vertices, triangles = tube()
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    for name, pattern, code, *options in (
        ("out.stl", "circles", CANNOT_BE_MAPPED, "--shape", "ring", "--perforate", "--thickness", "3"),
        ("out.obj", "circles", CANNOT_BE_MAPPED, "--shape", "torus", "--perforate"),
        ("out.obj", "circles", CANNOT_BE_MAPPED, "--shape", "ring"),
        ("out.obj", "spirals", USAGE, "--perforate"),
        ("out.off", "circles", USAGE, "--perforate"),
    ):
        run = command("lift", "in.obj", pattern, name, *options, cwd=tmp_path)
        assert run.returncode == code and run.stderr, (name, pattern, options)
        assert not (tmp_path / name).exists()
