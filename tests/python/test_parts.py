"""Parts: the package's function and the command, on the same surfaces."""

import json

import koebe
import numpy as np
import pytest
import random_models
import random_surfaces
import uv_measures
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, perforated, read_corners, succeeded
from cli_support import koebe as command


def finger(around=24, rings=40):
    """A tube open below, with half a sphere on top: vertices and quadrilaterals, triangles at the tip."""
    angle = 2 * np.pi * np.arange(around) / around
    profile = [(1.0, 0.25 * k) for k in range(rings)]
    top = 0.25 * rings
    profile += [(np.cos(t), top + np.sin(t)) for t in np.linspace(0, np.pi / 2, around // 4, endpoint=False)]
    vertices = [(r * np.cos(a), r * np.sin(a), h) for r, h in profile for a in angle] + [(0, 0, top + 1)]
    faces = []
    for k in range(len(profile) - 1):
        for i in range(around):
            j = (i + 1) % around
            faces.append([k * around + i, k * around + j, (k + 1) * around + j, (k + 1) * around + i])
    last = (len(profile) - 1) * around
    faces += [[last + i, last + (i + 1) % around, len(vertices) - 1] for i in range(around)]
    return np.array(vertices), faces


def triangulated(faces):
    return np.array([[f[0], f[k], f[k + 1]] for f in faces for k in range(1, len(f) - 1)])


def ring(around, along, turn, thick):
    """A torus of quadrilaterals, or less than a whole turn of one: a bent pipe."""
    closed = turn == 1.0
    circles = along if closed else along + 1
    a, b = np.meshgrid(
        2 * np.pi * turn * np.arange(circles) / along, 2 * np.pi * np.arange(around) / around, indexing="ij"
    )
    far = 1 + thick * np.cos(b)
    vertices = np.stack([far * np.cos(a), far * np.sin(a), thick * np.sin(b)], -1).reshape(-1, 3)
    faces = [
        [(i + di) % circles * around + (j + dj) % around for di, dj in ((0, 0), (1, 0), (1, 1), (0, 1))]
        for i in range(along)
        for j in range(around)
    ]
    return vertices, faces


@pytest.mark.parametrize(
    "around, along, turn, thick", [(12, 48, 1.0, 0.25), (8, 24, 1.0, 0.25), (24, 64, 1.0, 0.25), (8, 48, 0.5, 0.12)]
)
def test_a_torus_and_a_bent_pipe_are_equal_rectangles(around, along, turn, thick):
    vertices, faces = ring(around, along, turn, thick)
    triangles = triangulated(faces)
    result = koebe.parts(vertices, triangles, polygon=np.repeat(np.arange(len(faces)), 2))
    assert result.converged and result.flipped == 0
    sizes = []
    for k in range(len(result.parts)):
        uv = result.uv[result.part == k]
        low, high = uv.reshape(-1, 2).min(0), uv.reshape(-1, 2).max(0)
        e, g = uv[:, 1] - uv[:, 0], uv[:, 2] - uv[:, 0]
        assert np.abs(e[:, 0] * g[:, 1] - e[:, 1] * g[:, 0]).sum() / 2 == pytest.approx((high - low).prod(), rel=1e-5)
        sizes.append(np.sort(high - low))
    assert 1 <= len(sizes) <= 4
    assert np.allclose(sizes, sizes[0], rtol=2 / along + 1e-4)


VERTICES, FACES = finger()
TRIANGLES = triangulated(FACES)


def test_a_finger_is_a_tube_and_a_cap():
    result = koebe.parts(VERTICES, TRIANGLES)
    assert [part["kind"] for part in result.parts] == ["tube", "disk"]
    assert result.uv.shape == (len(TRIANGLES), 3, 2) and result.uv.dtype == np.float64
    assert (result.uv >= 0).all() and (result.uv <= 1).all()
    assert sorted(np.concatenate([part["faces"] for part in result.parts])) == list(range(len(TRIANGLES)))
    assert all((result.part[part["faces"]] == k).all() for k, part in enumerate(result.parts))
    assert (uv_measures.signed_areas(result.uv.astype(np.float32).astype(float)) > 0).all()
    assert result.flipped == 0 and len(result.flipped_faces) == 0
    assert result.density_ratio_5_95 < 2 and result.even_area > 0.99
    assert 0 < result.slit_length < result.cut_length
    assert "2 parts" in repr(result)


def test_another_meshing_makes_the_same_parts():
    other = triangulated([face[1:] + face[:1] for face in FACES])  # the other diagonal of each quadrilateral
    moved = VERTICES + 0.005 * np.random.default_rng(1).normal(size=VERTICES.shape)
    first, second = koebe.parts(VERTICES, TRIANGLES), koebe.parts(moved, other)
    assert [part["kind"] for part in second.parts] == [part["kind"] for part in first.parts]
    a, b = VERTICES[TRIANGLES[:, 1]] - VERTICES[TRIANGLES[:, 0]], VERTICES[TRIANGLES[:, 2]] - VERTICES[TRIANGLES[:, 0]]
    area = np.linalg.norm(np.cross(a, b), axis=1)
    assert area[first.part == second.part].sum() > 0.97 * area.sum()


def test_the_report_is_true_of_the_uvs():
    result = koebe.parts(VERTICES, TRIANGLES)
    stored = result.uv.astype(np.float32).astype(float)
    a, b = (VERTICES[TRIANGLES[:, k]] - VERTICES[TRIANGLES[:, 0]] for k in (1, 2))
    surface = 0.5 * np.linalg.norm(np.cross(a, b), axis=1)
    u = 0.5 * np.log(uv_measures.signed_areas(stored) / surface)
    order = np.argsort(u)
    below = np.cumsum(surface[order]) / surface.sum()
    low, high = (u[order][np.searchsorted(below, share)] for share in (0.05, 0.95))
    assert result.density_ratio_5_95 == pytest.approx(np.exp(high - low), rel=1e-6)
    assert result.coverage == pytest.approx(uv_measures.signed_areas(stored).sum(), rel=1e-9)

    seams = 0.0
    sides = {}
    for f, face in enumerate(TRIANGLES):
        for k in range(3):
            v, w = face[k], face[(k + 1) % 3]
            ends = {v: tuple(result.uv[f, k]), w: tuple(result.uv[f, (k + 1) % 3])}
            other = sides.setdefault((min(v, w), max(v, w)), ends)
            if other != ends:
                seams += np.linalg.norm(VERTICES[v] - VERTICES[w])
    assert result.cut_length == pytest.approx(seams / np.sqrt(surface.sum()), rel=1e-9)


def test_price_and_cut():
    assert len(koebe.parts(VERTICES, TRIANGLES, price=50.0).parts) == 1
    two = np.concatenate([TRIANGLES, TRIANGLES + len(VERTICES)])
    both = np.concatenate([VERTICES, VERTICES + 5.0])
    assert len(koebe.parts(both, two).parts) == 4
    with pytest.raises(koebe.TopologyError) as caught:
        koebe.parts(both, two, cut=False)
    assert caught.value.kind == "disconnected"
    for price in (0.0, -1.0, float("nan"), float("inf")):
        with pytest.raises(koebe.OptionError):
            koebe.parts(VERTICES, TRIANGLES, price=price)
    for wrong in ({"price": "low"}, {"cut": 1}, {"round_cuts": "yes"}, {"progress": 3}, {"cancel": True}):
        with pytest.raises(TypeError):
            koebe.parts(VERTICES, TRIANGLES, **wrong)


def test_boundaries_are_round_where_that_is_asked_for():
    vertices, faces = finger(around=48, rings=1)
    options = ({"loops": "free"}, {"loops": "round"}, {})
    free, circle, unasked = (koebe.parts(vertices, triangulated(faces), even=0.3, **loops) for loops in options)
    assert np.array_equal(unasked.uv, free.uv)
    assert len(circle.parts) == 1 and circle.darts > 0 and free.darts > 0
    assert max(circle.parts[0]["off_round"]) < 1e-6 and max(free.parts[0]["off_round"]) > 1e-2


def test_cuts_are_round_where_that_is_asked_for(tmp_path):
    # Two heights in turn round each ring: no cut is straight.
    rough = VERTICES + [0, 0, 0.06] * (np.arange(len(VERTICES)) % 2 * (VERTICES[:, 2] > 0.5))[:, None]
    free, straight = (
        koebe.parts(rough, TRIANGLES, round_cuts=held, darts=0.0, loops="round") for held in (False, True)
    )
    assert np.array_equal(free.part, straight.part) and len(free.parts) == 2
    assert max(off for part in straight.parts for off in part["off_round"]) < 1e-4
    assert max(off for part in free.parts for off in part["off_round"]) > 1e-2
    assert free.angle_error_deg["mean"] < straight.angle_error_deg["mean"]
    source, report = tmp_path / "in.obj", tmp_path / "out.json"
    source.write_text(obj_text(rough, TRIANGLES), encoding="utf-8")
    words = (source, tmp_path / "out.obj", "--round-cuts", "--darts", "0", "--json", report)
    assert command("parts", *words).returncode == 0
    filed = json.loads(report.read_text(encoding="utf-8"))
    assert [part["off_round"] for part in filed["parts"]] == [part["off_round"] for part in straight.parts]


def bumpy_sphere(seed, rings=18, around=36):
    """A closed surface, its vertices at random distances from the middle."""
    polar, turn = np.pi * np.arange(1, rings) / rings, 2 * np.pi * np.arange(around) / around
    x, y = np.outer(np.sin(polar), np.cos(turn)), np.outer(np.sin(polar), np.sin(turn))
    ring = np.stack([x, y, np.outer(np.cos(polar), np.ones(around))], -1).reshape(-1, 3)
    vertices = np.concatenate([[[0, 0, 1.0]], ring, [[0, 0, -1.0]]])
    i, j = np.arange(around), (np.arange(around) + 1) % around
    last, end = 1 + (rings - 2) * around, len(vertices) - 1
    faces = [np.stack([0 * i, 1 + i, 1 + j], -1), np.stack([last + i, 0 * i + end, last + j], -1)]
    for k in range(rings - 2):
        p, q = 1 + k * around + i, 1 + k * around + j
        faces += [np.stack([p, p + around, q + around], -1), np.stack([p, q + around, q], -1)]
    distance = 1 + np.random.default_rng(seed).normal(size=len(vertices)) * 0.2
    return vertices * distance[:, None], np.concatenate(faces)


@pytest.mark.parametrize("seed", [pytest.param(3, marks=pytest.mark.slow), 7])
def test_a_border_that_moved_may_part_neighbours(seed):
    """Many small parts: with seed 7 two that were neighbours are none when the turn comes to their border."""
    vertices, faces = bumpy_sphere(seed)
    result = koebe.parts(vertices, faces, price=0.0001)
    assert len(result.parts) > 3 and result.flipped == result.below_resolution
    assert (result.part >= 0).all()


def test_parts_of_a_few_faces_are_merged():
    # A rough surface, of which a part of 4 faces was cut off.
    vertices, triangles = random_surfaces.make("grid", 26)
    result = koebe.parts(vertices, triangles)
    assert len(result.parts) > 2 and min(len(part["faces"]) for part in result.parts) >= 8
    assert result.flipped == 0


def test_degenerate_faces_are_taken():
    more = np.concatenate([TRIANGLES, [[0, 0, 1]], TRIANGLES[:1]])
    result = koebe.parts(VERTICES, more)
    assert list(result.part[-2:]) == [-1, -1]
    assert [warning.kind for warning in result.warnings] == ["collapsed_faces"]
    assert result.warnings[0].elements == [len(TRIANGLES), len(TRIANGLES) + 1]
    with pytest.raises(koebe.InputError):
        koebe.parts(VERTICES, more, cut=False)


def test_its_stages_have_names():
    seen = set()
    koebe.parts(VERTICES, TRIANGLES, progress=lambda fraction, stage: seen.add(stage))
    assert {"topology", "split", "pack"} <= seen


@pytest.mark.parametrize("model", ["large", "small", "hard"])
def test_cuts_are_sketched_on_edges_before_they_are_made(model):
    if model == "hard":
        corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], dtype=float)
        quads = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
        vertices, triangles = corners, triangulated(quads)
    else:
        vertices, faces = finger(72, 120) if model == "large" else (VERTICES, FACES)
        triangles = triangulated(faces)
    order = np.random.default_rng(5).permutation(len(vertices))  # numbers are the input's
    vertices, triangles = vertices[order], np.argsort(order)[triangles]
    sketch, seen = koebe.CutSketch(), []
    result = koebe.parts(
        vertices, triangles, sketch=sketch,
        progress=lambda fraction, stage: seen.append(sketch.take()) if stage in ("even", "pack") else None,
    )  # fmt: skip
    early = seen[0]
    assert early.dtype == np.int32 and early.shape[1:] == (2,) and len(early) > 5
    edges = {(min(a, b), max(a, b)) for f in triangles for a, b in zip(f, np.roll(f, 1))}
    cuts = {(min(a, b), max(a, b)) for a, b in early.tolist()}
    assert cuts <= edges
    faces, corners = uv_measures.edge_pairs(triangles)
    ends = result.uv[faces[:, :, None], corners]
    apart = (ends[:, 0] != ends[:, 1]).any(axis=(1, 2))
    made = set(map(tuple, np.sort(triangles[faces[:, :1], corners[:, 0]][apart], axis=1).tolist()))
    assert len(cuts & made) > 0.3 * len(cuts), "many of them stay"
    assert len(sketch.take()) == 0, "nothing is new"
    assert (result.uv == koebe.parts(vertices, triangles).uv).all(), "a sketch changes nothing"


@pytest.mark.parametrize("surface", [(VERTICES, FACES), perforated()])
def test_the_command_keeps_vertices_and_polygons(tmp_path, surface):
    vertices, faces = surface
    source, target, report = tmp_path / "in.obj", tmp_path / "out.obj", tmp_path / "out.json"
    source.write_text(obj_text(vertices, faces), encoding="utf-8")
    done = succeeded("parts", source, target, "--json", report, "--svg", tmp_path / "out.svg")
    assert done.stderr == "" and done.stdout.count("\n") == 1
    found, written, corners = read_corners(target)
    assert np.array_equal(found, vertices)
    assert written == [list(face) for face in faces]
    assert all(0 <= place <= 1 for face in corners for uv in face for place in uv)

    result = json.loads(report.read_text(encoding="utf-8"))
    assert list(result)[:4] == ["version", "input", "vertices", "faces"] and result["converged"]
    keys = {"handles_cut", "density_ratio_5_95", "flipped", "below_resolution", "angle_error_deg", "seconds",
            "warnings", "lost_area", "angle_error_stored_deg", "cut_length"}
    assert keys <= set(result) and result["input"] == "in.obj" and result["flipped"] == 0
    assert sorted(f for part in result["parts"] for f in part["faces"]) == list(range(len(faces)))
    assert all(set(part) == {"kind", "faces", "angle_error_deg", "loops", "off_round"} for part in result["parts"])
    assert "<svg" in (tmp_path / "out.svg").read_text(encoding="utf-8")


def test_exit_codes_of_the_command(tmp_path):
    source, target = tmp_path / "in.obj", tmp_path / "out.obj"
    source.write_text(obj_text(VERTICES, FACES), encoding="utf-8")
    for wrong in (["--price", "0"], ["--price", "few"], ["--balance", "area"]):
        assert command("parts", source, target, *wrong).returncode == USAGE
    assert command("parts", source, tmp_path / "out.stl").returncode == USAGE
    assert command("parts", source).returncode == USAGE
    source.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", encoding="utf-8")
    flat = command("parts", source, target)
    assert flat.returncode == CANNOT_BE_MAPPED and flat.stderr.startswith("InputError: ")
    assert not target.exists()


def test_a_tube_is_opened_along_the_slit_that_is_asked_for():
    """Up one side of the finger's tube, whichever: the UVs lie apart there and nowhere else but at the tip."""
    around, top = 24, 40
    for column in (0, 7, 19):
        path = column + around * np.arange(top)
        result = koebe.parts(VERTICES, TRIANGLES, slits=np.stack([path[:-1], path[1:]], axis=1))
        assert [part["kind"] for part in result.parts] == ["tube", "disk"]
        tube = np.flatnonzero(result.part == 0)
        places = {}
        for vertex, uv in zip(TRIANGLES[tube].ravel(), result.uv[tube].reshape(-1, 2).tolist(), strict=True):
            places.setdefault(vertex, set()).add(tuple(uv))
        twice = sorted(vertex for vertex, uv in places.items() if len(uv) > 1)
        assert twice == [vertex for vertex in path if vertex in places]


@pytest.mark.parametrize("slits", [[[0, 1, 2]], [[0.0, 1.0]], [[0, len(VERTICES)]], [[-1, 0]], "ab"])
def test_slits_that_are_no_edges_are_an_error(slits):
    with pytest.raises(koebe.InputError, match="slits"):
        koebe.parts(VERTICES, TRIANGLES, slits=slits)


def lost_area(vertices, triangles, uv):
    """The share of the area in faces without area as stored."""
    area = uv_measures.triangle_areas(vertices[triangles])
    return area[uv_measures.signed_areas(uv.astype(np.float32).astype(float)) <= 0].sum() / area.sum()


@pytest.mark.parametrize(
    ("kind", "seeds"),
    [
        ("stick", (4, 11, 12)),  # limbs of few faces around
        ("limbs", (10,)),
        ("plate", (2, 10)),  # handles
        ("knot", (3, 8, 12)),
        ("needles", (2,)),
        ("two", (8,)),  # two components of different size
    ],
)
def test_no_model_loses_its_area(kind, seeds):
    for seed in seeds:
        vertices, triangles = random_models.make(kind, seed)
        result = koebe.parts(vertices, triangles)
        assert result.converged and result.flipped == 0
        assert lost_area(vertices, triangles, result.uv) <= 0.01


def test_parts_bend_angles_no_more_than_one_map_that_can_be_used():
    for seed in range(4):
        vertices, triangles = random_models.make("needles", seed)
        one = koebe.uniformize(vertices, triangles, cut=True)
        if lost_area(vertices, triangles, one.uv) <= 0.01 and not one.flipped:
            parts = koebe.parts(vertices, triangles)
            assert parts.angle_error_deg["mean"] <= 1.01 * one.angle_error_deg["mean"]
