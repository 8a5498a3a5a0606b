"""Flat patterns: true to size in the written files, whole, apart, and refused where they cannot be."""

import json

import koebe
import numpy as np
import pytest
import random_models
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, succeeded
from cli_support import koebe as command
from pattern_files import crossings, dxf_entities, enclosed, inside, lengths, require_sound, svg_page


def grid(points, around=False):
    """Vertices and triangles of points (m, n, 3); `around` joins the last row with the first."""
    m, n = points.shape[:2]
    i, k = (one.ravel() for one in np.meshgrid(np.arange(m if around else m - 1), np.arange(n - 1), indexing="ij"))
    a, b, c, d = i * n + k, (i + 1) % m * n + k, (i + 1) % m * n + k + 1, i * n + k + 1
    return points.reshape(-1, 3), np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])


def rolled_panel(width=120.0, height=80.0, turn=4.0):
    """A panel of this size rolled to a part of a cylinder: chords have the panel's width in all."""
    t, z = np.linspace(0, 1, 41), np.linspace(0, height, 21)
    step = turn / 40
    radius = width / 40 / (2 * np.sin(step / 2))
    t, z = np.meshgrid(t, z, indexing="ij")
    return grid(np.stack([radius * np.cos(turn * t), radius * np.sin(turn * t), z], -1))


def cone(radius=50.0, height=90.0, around=48, rings=20):
    """A closed cone without its base: its tip is a vertex of the surface."""
    angle, share = np.meshgrid(2 * np.pi * np.arange(around) / around, np.linspace(1, 1 / rings, rings), indexing="ij")
    points = np.stack([radius * share * np.cos(angle), radius * share * np.sin(angle), height * (1 - share)], -1)
    vertices, triangles = grid(points, around=True)
    last = np.arange(around) * rings + rings - 1
    tip = np.stack([last, np.roll(last, -1), np.full(around, len(vertices))], 1)
    return np.concatenate([vertices, [[0, 0, height]]]), np.concatenate([triangles, tip])


def oloid(radius=40.0, n=61):
    """Half an oloid, between its two arcs: each point t of one circle is joined with the point of the other circle
    where the tangent plane touches it (Dirnboeck and Stachel 1997). The strip's flat triangles are split twice."""
    share = np.linspace(-1, 1, n + 2)[1:-1]  # of the arc of the second circle, there and back
    t = 2 * np.pi / 3 * np.sign(share) * np.sqrt(np.abs(share))
    first = np.stack([np.sin(t), -0.5 - np.cos(t), 0 * t], 1)
    second = np.stack([0 * t, 0.5 - np.cos(t) / (1 + np.cos(t)), np.sqrt(1 + 2 * np.cos(t)) / (1 + np.cos(t))], 1)
    vertices, triangles = grid(radius * np.stack([first, second], 1))
    for _ in range(2):
        vertices, triangles = split(vertices, triangles)
    return vertices, triangles


def split(vertices, triangles):
    """Each triangle cut in four."""
    sides = np.sort(np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges, number = np.unique(sides, axis=0, return_inverse=True)
    x, y, z = len(vertices) + number.reshape(3, -1)
    a, b, c = triangles.T
    finer = [np.stack(corners, 1) for corners in ((a, x, z), (x, b, y), (z, y, c), (x, y, z))]
    return np.concatenate([vertices, vertices[edges].mean(axis=1)]), np.concatenate(finer)


def edges_on_surface(vertices, triangles, result, points):
    """The surface's lengths of a written outline's edges, and their flat lengths; points as the sheet has them."""
    corners, owner = result.uv.reshape(-1, 2), np.asarray(triangles).ravel()
    nearest = [int(np.argmin(((corners - point) ** 2).sum(axis=1))) for point in points]
    assert np.abs(corners[nearest] - points).max() < 1e-9
    place = vertices[owner[nearest]]
    return np.linalg.norm(np.roll(place, -1, axis=0) - place, axis=1), lengths(points)


@pytest.mark.parametrize("make", [rolled_panel, cone, oloid])
def test_a_developable_surface_is_true_to_a_thousandth_of_a_millimetre_in_the_files(make):
    vertices, triangles = make()
    result = koebe.flatten(vertices, triangles, page="none")
    require_sound(result)
    assert len(result.pieces) == 1
    (size, lines, _), (polylines, _, _) = svg_page(result.svg[0]), dxf_entities(result.dxf)
    drawn = [line.points for line in lines if line.kind == "cut"]
    flipped = [[0, size[1]] - points * [-1, 1] for points in drawn]  # y up
    for outlines in (flipped, [points for layer, _, points in polylines if layer == "CUT"]):
        assert len(outlines) == 1
        on_surface, flat = edges_on_surface(vertices, triangles, result, outlines[0])
        assert np.abs(on_surface - flat).max() < 1e-3
    a, b = (vertices[triangles[:, k]] - vertices[triangles[:, 0]] for k in (1, 2))
    area = 0.5 * np.linalg.norm(np.cross(a, b), axis=1).sum()
    assert abs(enclosed(outlines[0]) - area) < 1e-3 * np.sqrt(area)
    assert result.stretch_percent["max"] < 1e-2
    ends = vertices[triangles]
    for k in range(3):  # all edges of all faces
        flat = np.linalg.norm(result.uv[:, k] - result.uv[:, (k + 1) % 3], axis=1)
        assert np.abs(flat - np.linalg.norm(ends[:, k] - ends[:, (k + 1) % 3], axis=1)).max() < 1e-3


def test_a_rolled_panel_is_a_rectangle_and_a_cone_a_sector():
    result = koebe.flatten(*rolled_panel(), page="none")
    assert sorted(result.pieces[0]["size_mm"]) == pytest.approx([80, 120], abs=1e-3)
    vertices, triangles = cone()
    result = koebe.flatten(vertices, triangles, page="none")
    assert result.darts == 1 and len(result.seams) == 1 and result.seams[0]["pieces"] == [1, 1]
    slant = np.hypot(50, 90)
    assert result.seams[0]["length_mm"] == pytest.approx(slant, abs=1e-6)
    assert result.seams[0]["lengths_mm"] == pytest.approx([slant, slant], abs=1e-3)
    tip = result.uv[(np.asarray(triangles) == len(vertices) - 1)][0]
    rim = result.uv[np.isin(triangles, np.flatnonzero(vertices[:, 2] == 0))]
    assert np.abs(np.linalg.norm(rim - tip, axis=1) - slant).max() < 1e-3


@pytest.mark.parametrize("units, factor", [("mm", 1), ("cm", 10), ("m", 1000), ("in", 25.4)])
def test_units(units, factor):
    vertices, triangles = rolled_panel()
    result = koebe.flatten(vertices / factor, triangles, units=units, page="none")
    assert sorted(result.pieces[0]["size_mm"]) == pytest.approx([80, 120], abs=1e-3)


def test_a_face_divided_at_a_junction_is_measured_whole():
    """A plate whose long edge has a vertex of other faces in its middle: it is flat, and has these faces only."""
    vertices = np.array([[0, 0], [2, 0], [2, 1], [0, 1], [1, 0], [0, -1], [1, -1], [2, -1]], float)
    triangles = np.array([[0, 1, 2], [0, 2, 3], [0, 5, 4], [5, 6, 4], [4, 6, 1], [6, 7, 1]], np.int32)
    result = koebe.flatten(np.column_stack([50 * vertices, 0 * vertices[:, 0]]), triangles)
    assert result.stretch_percent["max"] < 1e-6
    assert sorted(f for piece in result.pieces for f in piece["faces"]) == list(range(len(triangles)))


def test_pages_share_pieces_or_are_tiled():
    vertices, triangles = rolled_panel()
    one = koebe.flatten(vertices, triangles, page="A4")
    assert (one.pages, one.page_mm) == (1, [210, 297])
    require_sound(one)
    tiled = koebe.flatten(3 * vertices, triangles, page="A4")
    assert [tiled.sheets[0][name] for name in ("columns", "rows")] in ([2, 2], [3, 1], [1, 3], [2, 1], [1, 2])
    require_sound(tiled)
    frame = np.array([210 - 24, 297 - 24])
    assert tiled.sheets[0]["size_mm"] == [tiled.sheets[0]["columns"] * frame[0], tiled.sheets[0]["rows"] * frame[1]]
    pages = [svg_page(text) for text in tiled.svg]
    (first, *rest) = [next(line.points for line in lines if line.kind == "cut") for _, lines, _ in pages]
    columns = tiled.sheets[0]["columns"]
    for k, points in enumerate(rest, 1):  # frames laid edge to edge join the outline
        assert np.abs(points - (first - frame * [k % columns, k // columns])).max() < 1e-9
    joints = [text for page in tiled.svg for text in page.split(">") if "–" in text]
    assert len(joints) == 2 * (tiled.pages - 1 if 1 in (columns, tiled.sheets[0]["rows"]) else 4)
    wide = koebe.flatten(3 * vertices, triangles, page="400x400")
    assert (wide.pages, wide.page_mm) == (1, [400, 400])


def test_an_allowance_is_a_line_at_its_distance_outside():
    vertices, triangles = rolled_panel()
    result = koebe.flatten(vertices, triangles, page="none", allowance=10)
    require_sound(result, allowance=10)
    polylines, _, _ = dxf_entities(result.dxf)
    (cut,), (seam,) = ([points for layer, _, points in polylines if layer == name] for name in ("CUT", "SEAM"))
    assert crossings(cut, seam) == 0 and all(inside(point, [cut]) for point in seam)
    assert np.ptp(cut, axis=0) == pytest.approx(np.ptp(seam, axis=0) + 20, abs=1e-2)
    assert enclosed(cut) == pytest.approx(120 * 80 + 2 * 10 * 200 + 100 * np.pi, rel=1e-3)


def test_both_sides_of_a_seam_have_its_number_and_their_notches_are_one_point_of_the_surface():
    vertices, triangles = random_models.ball(4)
    result = koebe.flatten(60 * vertices, triangles, page="none")
    require_sound(result)
    assert len(result.pieces) >= 2
    marks = [(line.piece, line.points[0]) for line in svg_page(result.svg[0])[1] if line.kind == "mark"]
    assert len(marks) >= 2 * len(result.seams)
    height = svg_page(result.svg[0])[0][1]
    at, faces = [], np.asarray(triangles)
    for _, point in marks:
        point = np.array([point[0], height - point[1]])
        best = (np.inf, None)
        for k in range(3):
            a, b = result.uv[:, k], result.uv[:, (k + 1) % 3]
            along = b - a
            share = np.clip(((point - a) * along).sum(1) / (along**2).sum(1), 0, 1)
            off = np.linalg.norm(a + share[:, None] * along - point, axis=1)
            f = int(off.argmin())
            if off[f] < best[0]:
                p, q = vertices[faces[f, k]], vertices[faces[f, (k + 1) % 3]]
                best = (off[f], p + share[f] * (q - p))
        assert best[0] < 1e-9
        at.append(60 * best[1])
    at = np.array(at)
    twins = [np.sort(np.linalg.norm(at - point, axis=1))[1] for point in at]
    assert max(twins) < 1e-6


def test_the_stretch_is_measured():
    vertices, triangles = random_models.ball(4)
    result = koebe.flatten(60 * vertices, triangles, page="none", darts=0.0)
    worst, total, sums = 0.0, 0.0, 0.0
    for face, uv in zip(60 * vertices[np.asarray(triangles)], result.uv):
        a, b = face[1] - face[0], face[2] - face[0]
        length = np.linalg.norm(a)
        flat = np.array([[length, a @ b / length], [0, np.linalg.norm(np.cross(a, b)) / length]])
        values = np.linalg.svd(np.stack([uv[1] - uv[0], uv[2] - uv[0]], 1) @ np.linalg.inv(flat), compute_uv=False)
        stretch, area = max(values[0] - 1, 1 - values[1]), np.linalg.det(flat) / 2
        worst, total, sums = max(worst, stretch), total + area, sums + area * stretch
    assert result.stretch_percent["max"] == pytest.approx(100 * worst, rel=1e-6)
    assert result.stretch_percent["mean"] == pytest.approx(100 * sums / total, rel=1e-6)
    darts = koebe.flatten(60 * vertices, triangles, page="none", darts=1.0)
    assert darts.darts > 0 and darts.stretch_percent["mean"] < result.stretch_percent["mean"]


@pytest.mark.parametrize("seed", [0, pytest.param(1, marks=pytest.mark.slow), pytest.param(2, marks=pytest.mark.slow)])
@pytest.mark.parametrize("kind", random_models.KINDS)
def test_random_models(kind, seed):
    vertices, triangles = random_models.make(kind, seed)
    size = np.ptp(vertices, axis=0).max()
    allowance = 5.0 * (seed % 2)
    page = ("none", "A4", "A3")[seed]
    result = koebe.flatten(300 / size * vertices, triangles, page=page, allowance=allowance)
    require_sound(result, allowance)


def test_the_command_writes_what_the_package_returns(tmp_path):
    vertices, triangles = rolled_panel()
    source = tmp_path / "in.obj"
    source.write_text(obj_text(3 * vertices, triangles), encoding="utf-8")
    result = koebe.flatten(3 * vertices, triangles, page="A4", allowance=6)
    done = succeeded("flatten", source, tmp_path / "out.svg", "--allowance", 6, "--json", tmp_path / "out.json")
    assert f"1 piece on {result.pages} pages" in done.stdout
    files = ["out.svg", *(f"out-{k}.svg" for k in range(2, result.pages + 1))]
    assert [(tmp_path / name).read_text(encoding="utf-8") for name in files] == result.svg
    assert command("flatten", source, tmp_path / "out.dxf", "--allowance", 6).returncode == 0
    assert (tmp_path / "out.dxf").read_text(encoding="ascii") == result.dxf
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted([*files, "in.obj", "out.dxf", "out.json"])
    report = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert report["pages"] == result.pages and report["stretch_percent"] == result.stretch_percent
    assert report["pieces"] == result.pieces and report["seams"] == result.seams


def test_bad_input_is_refused_and_leaves_no_file(tmp_path):
    vertices, triangles = rolled_panel()
    source = tmp_path / "in.obj"
    source.write_text(obj_text(vertices, triangles), encoding="utf-8")
    for words in (["--units", "feet"], ["--page", "A9"], ["--page", "10x10"], ["--page", "210xNaN"], ["--page", ""],
                  ["--allowance", "-1"], ["--allowance", "nan"]):  # fmt: skip
        done = command("flatten", source, tmp_path / "out.svg", *words)
        assert done.returncode == USAGE and words[0] in done.stderr, words
    for name in ("out.obj", "out", "out.pdf"):
        assert command("flatten", source, tmp_path / name).returncode == USAGE
    for units in (1e-6, 1e9):  # too small to be cut out, too large
        source.write_text(obj_text(units * vertices, triangles), encoding="utf-8")
        done = command("flatten", source, tmp_path / "out.svg")
        assert done.returncode == CANNOT_BE_MAPPED and "InputError" in done.stderr and "units" in done.stderr
    source.write_text(obj_text(100 * vertices, triangles), encoding="utf-8")
    done = command("flatten", source, tmp_path / "out.svg")
    assert done.returncode == CANNOT_BE_MAPPED and "pages" in done.stderr
    source.write_text(obj_text(3 * vertices, triangles), encoding="utf-8")
    (tmp_path / "out-2.svg").mkdir()  # a page that cannot be written
    assert command("flatten", source, tmp_path / "out.svg").returncode == CANNOT_BE_MAPPED
    assert sorted(path.name for path in tmp_path.iterdir()) == ["in.obj", "out-2.svg"]
    for wrong in ({"units": "feet"}, {"page": "A9"}, {"allowance": -1.0}, {"allowance": 101}):
        with pytest.raises(koebe.OptionError):
            koebe.flatten(vertices, triangles, **wrong)
    for wrong in ({"units": 1}, {"page": 4}, {"allowance": "wide"}):
        with pytest.raises(TypeError):
            koebe.flatten(vertices, triangles, **wrong)
    with pytest.raises(koebe.InputError):
        koebe.flatten(vertices * np.nan, triangles)


def test_specks_are_left_out_and_named():
    vertices, triangles = rolled_panel()
    both = np.concatenate([vertices, 1e-4 * vertices]), np.concatenate([triangles, triangles + len(vertices)])
    result = koebe.flatten(*both, page="none")
    assert len(result.pieces) == 1
    (warning,) = result.warnings
    assert warning.kind == "left_out" and list(warning.elements) == list(range(len(triangles), 2 * len(triangles)))
    assert (result.part[len(triangles) :] == -1).all()
