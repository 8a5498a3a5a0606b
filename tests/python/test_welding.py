"""Vertices in one place: told of, joined in the map by `weld`, and kept in the written mesh."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_rows, obj_text, perforated, read_corners, succeeded, triangles_of
from cli_support import koebe as run

VERTICES, QUADS = perforated(12, holes=((0.5, 0.5, 0.2),))
TRIANGLES = triangles_of(QUADS)
RANDOM = np.random.default_rng(5)
CRACK = 1e-5


def soup(faces, apart=0.0):
    """Each face with vertices of its own, each moved by less than `apart`."""
    moved = VERTICES[np.ravel(faces)] + RANDOM.uniform(-0.5, 0.5, (np.size(faces), 3)) * apart / np.sqrt(3)
    return moved, np.arange(np.size(faces)).reshape(np.shape(faces))


def coincident(report):
    return [warning for warning in report["warnings"] if warning["kind"] == "coincident"]


@pytest.mark.parametrize("distance", [0.0, 0.03, 0.2, 5.0])
def test_no_vertex_moves_farther_than_the_distance_and_kept_ones_are_farther_apart(distance):
    points = np.concatenate([RANDOM.uniform(-1, 1, (300, 3)), RANDOM.integers(-2, 3, (200, 3)) / 2.0])
    points[::7] = -0.0
    first = koebe.weld(points, distance)
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    kept = np.flatnonzero(first == np.arange(len(points)))
    assert (first <= np.arange(len(points))).all() and np.isin(first, kept).all()
    for v, one in enumerate(first):
        before = kept[kept < v]
        if one == v:
            assert not (apart[v, before] <= distance).any()
        else:
            assert apart[v, one] <= distance and apart[v, one] <= apart[v, before].min()


@pytest.mark.parametrize("faces", [TRIANGLES, QUADS], ids=["triangles", "quads"])
@pytest.mark.parametrize("apart", [0.0, CRACK])
@pytest.mark.parametrize("command", ["parts", "ring", "uniformize"])
def test_the_map_of_a_soup_is_that_of_its_surface(tmp_path, command, apart, faces):
    points, own = soup(faces, apart)
    (tmp_path / "soup.obj").write_text(obj_text(points, own))
    (tmp_path / "whole.obj").write_text(obj_text(VERTICES, faces))
    for name, words in (("soup", ["--weld", apart]), ("whole", [])):
        succeeded(command, f"{name}.obj", f"{name}_uv.obj", "--json", f"{name}.json", *words, cwd=tmp_path)
    vertices, corners, uv = map(np.array, read_corners(tmp_path / "soup_uv.obj"))
    assert np.array_equal(vertices, points) and np.array_equal(corners, own)
    found, wanted = (json.loads((tmp_path / f"{name}.json").read_text()) for name in ("soup", "whole"))
    assert found["options"]["weld"] == apart and wanted["options"]["weld"] is None
    assert found["flipped"] == 0
    assert np.isclose(found["angle_error_deg"]["mean"], wanted["angle_error_deg"]["mean"], rtol=0.02)
    (said,) = coincident(found)
    assert len(said["elements"]) == np.size(faces) - len(VERTICES)
    assert not {"unused_vertices"} & {one["kind"] for one in found["warnings"]}
    # Joined vertices have the same UVs, but for cuts.
    places = {}
    for vertex, place in zip(np.ravel(faces), uv.reshape(-1, 2), strict=True):
        places.setdefault(vertex, set()).add(tuple(place))
    cut = {vertex for vertex, found in places.items() if len(found) > 1}
    assert not cut if command == "uniformize" else len(cut) < len(VERTICES) / 4


@pytest.mark.parametrize("apart", [0.0, CRACK])
def test_a_warning_says_how_many_vertices_lie_in_one_place_and_what_joins_them(tmp_path, apart):
    points, own = soup(TRIANGLES, apart)
    (tmp_path / "soup.obj").write_text(obj_text(points, own))
    succeeded("parts", "soup.obj", "out.obj", "--json", "out.json", cwd=tmp_path)
    (said,) = coincident(json.loads((tmp_path / "out.json").read_text()))
    shared = np.flatnonzero(np.bincount(TRIANGLES.ravel())[TRIANGLES.ravel()] > 1)
    assert said["elements"] == shared.tolist()
    assert f"{len(TRIANGLES)} components, 1 if they were joined" in said["text"]
    distance = float(said["text"].split()[-1])
    assert distance == 0.0 if apart == 0.0 else 0.0 < distance <= 1.1 * apart
    assert len(np.unique(koebe.weld(points, distance))) == len(VERTICES)
    assert coincident(koebe.parts(points, own).to_dict())[0]["text"] == said["text"]


def test_nothing_is_said_of_a_surface_whose_rims_are_apart():
    assert not coincident(koebe.uniformize(VERTICES, TRIANGLES).to_dict())
    fine = VERTICES.copy()
    fine[:, 1] *= 1e-7  # thin everywhere, but no crack
    assert not coincident(koebe.parts(fine, TRIANGLES).to_dict())


def test_in_python_all_vertices_have_values_and_faces_that_collapse_are_left_out():
    points, own = soup(TRIANGLES)
    result = koebe.uniformize(points, own, weld=0)
    whole = koebe.uniformize(VERTICES, TRIANGLES)
    assert np.isfinite(result.uv).all() and result.uv.shape == (len(points), 2)
    assert np.allclose(result.uv[own], result.corner_uv * 2 - 1)
    assert [len(loop) for loop in result.loops] == [len(loop) for loop in whole.loops]
    assert np.isfinite(result.log_scale).all()
    middle = points[own[7]].mean(axis=0)
    spike = np.concatenate([own, [[own[7, 0], len(points), len(points) + 1]]])
    more = np.concatenate([points, [points[own[7, 0]] + 1e-9, middle]])
    thin = koebe.parts(more, spike, weld=1e-6)
    assert thin.uv.shape == (len(spike), 3, 2) and thin.part[-1] == -1
    with pytest.raises(koebe.InputError, match="collapse"):
        koebe.uniformize(points, own, weld=1e3)


def test_only_vertices_of_no_face_count_as_unused(tmp_path):
    points, own = soup(TRIANGLES)
    points = np.concatenate([points, [[9, 9, 9]]])
    (tmp_path / "soup.obj").write_text(obj_text(points, own))
    succeeded("uniformize", "soup.obj", "out.obj", "--weld", 0, "--json", "out.json", cwd=tmp_path)
    for report in (json.loads((tmp_path / "out.json").read_text()), koebe.uniformize(points, own, weld=0).to_dict()):
        (said,) = [one for one in report["warnings"] if one["kind"] == "unused_vertices"]
        assert said["elements"] == [len(points) - 1]


def test_a_vertex_that_was_joined_is_named_by_its_own_number():
    points, own = soup(TRIANGLES)
    inner = np.flatnonzero(np.linalg.norm(VERTICES - VERTICES[TRIANGLES[40, 0]], axis=1) == 0)[0]
    last = np.flatnonzero(TRIANGLES.ravel() == inner)[-1]
    centred = koebe.uniformize(points, own, weld=0, center=int(last))
    assert np.allclose(centred.uv[last], 0.0, atol=1e-9)


def test_places_where_three_faces_meet_are_refused_or_split(tmp_path):
    """Three fins on an edge: one surface with a non-manifold edge, once they are joined."""
    fins = [[0, 0, 0], [0, 0, 1], [1, 0, 0], [0, 0, 0], [0, 0, 1], [-1, 1, 0], [0, 0, 0], [0, 0, 1], [-1, -1, 0]]
    (tmp_path / "fins.obj").write_text(obj_text(fins, np.arange(9).reshape(3, 3)))
    done = run("uniformize", "fins.obj", "out.obj", "--weld", 0, cwd=tmp_path)
    assert done.returncode == CANNOT_BE_MAPPED and done.stderr.startswith("TopologyError(nonmanifold_edge)")
    done = succeeded("parts", "fins.obj", "out.obj", "--weld", 0, "--json", "out.json", cwd=tmp_path)
    assert json.loads((tmp_path / "out.json").read_text())["flipped"] == 0


def test_a_saved_result_keeps_the_vertices(tmp_path):
    points, own = soup(TRIANGLES)
    result = koebe.parts(points, own, weld=0)
    result.save(tmp_path / "soup.npz")
    loaded = koebe.load(tmp_path / "soup.npz")
    assert np.array_equal(loaded.uv, result.uv) and len(coincident(loaded.to_dict())) == 1
    loaded.export(tmp_path / "out.obj")
    vertices, corners, _ = read_corners(tmp_path / "out.obj")
    assert len(vertices) == len(points) and np.array_equal(corners, own)


def test_shapes_are_those_of_the_joined_surface(tmp_path):
    """Numbers of a soup, in every command that compares, carries or moves a surface, are those of its surface."""
    points, own = soup(TRIANGLES, CRACK)
    for name, surface in (("soup", (points, own)), ("whole", (VERTICES, TRIANGLES))):
        (tmp_path / f"{name}.obj").write_text(obj_text(*surface))
    (tmp_path / "template.json").write_text(
        json.dumps({"circles": [{"center": [0.1, 0.2], "radius": 0.3}], "outer": {"pin": {"vertex": 1, "angle": 30}}})
    )
    (tmp_path / "marks.txt").write_text(f"{int(np.flatnonzero(own.ravel() == own[40, 0])[0])} {TRIANGLES[40, 0]}\n")
    weld = ["--weld", 2 * CRACK]

    def said(*words):
        done = succeeded(*words, cwd=tmp_path)
        return done.stdout

    modules = [json.loads(said("module", f"{name}.obj", *weld))["module"] for name in ("soup", "whole")]
    assert np.allclose(*modules, atol=1e-3)
    bounds = json.loads(said("module", "soup.obj", "--certified", *weld))["modulus"]
    assert bounds["upper"] - bounds["lower"] < 0.1 and len(bounds) == 2
    assert float(said("compare", "soup.obj", "whole.obj", *weld).split()[1]) < 1e-3
    said("transfer", "soup.obj", "whole.obj", "moved.obj", "--landmarks", "marks.txt", *weld)
    assert np.abs(obj_rows(tmp_path / "moved.obj", "v") - points).max() < 0.02  # of edges of 1/12
    said("fit", "soup.obj", "template.json", "fit.obj", *weld)
    said("sequence", "soup.obj", "--output", "all", *weld)
    for file in ("fit.obj", "all/soup.obj"):
        vertices, corners, uv = map(np.array, read_corners(tmp_path / file))
        assert np.array_equal(vertices, points) and np.array_equal(corners, own)
        flat = uv.reshape(-1, 2)[np.argsort(own.ravel())]
        assert np.array_equal(flat, flat[koebe.weld(points, 2 * CRACK)])


def test_a_sequence_keeps_the_joins_of_its_first_file(tmp_path):
    points, own = soup(TRIANGLES)
    shear = points + points[:, [1]] * [0.2, 0, 0]
    apart = shear + RANDOM.uniform(-0.01, 0.01, shear.shape)  # none of them in one place
    for name, place in (("a", points), ("b", shear), ("c", apart)):
        (tmp_path / f"{name}.obj").write_text(obj_text(place, own))
    succeeded("sequence", "a.obj", "b.obj", "c.obj", "--output", "all", "--weld", 0, cwd=tmp_path)
    surface = koebe.Surface(points, own, weld=0)
    for name, place in (("a", None), ("b", shear), ("c", apart)):
        uv = np.reshape(read_corners(tmp_path / "all" / f"{name}.obj")[2], (-1, 2))
        result = surface.uniformize(place)
        assert np.array_equal(uv, uv[koebe.weld(points)]) and result.flipped == 0
        assert np.allclose(2 * uv - 1, result.uv, atol=1e-6)


@pytest.mark.parametrize("fair", [False, True])
def test_holes_of_the_joined_surface_are_filled_and_the_file_stays(tmp_path, fair):
    points, own = soup(TRIANGLES, CRACK)
    thin = np.concatenate([own, own[:1, [0, 1, 1]] + [[0, 0, own.size - own[0, 1]]]]) if fair else own
    points = np.concatenate([points, points[[own[0, 1]]]])
    vertices, faces, label = koebe.fill_holes(points, thin, fair=fair, weld=2 * CRACK)
    assert np.array_equal(vertices[: len(points)], points) and np.array_equal(faces[: len(thin)], thin)
    assert (label[: len(thin)] == -1).all() and set(label[len(thin) :]) == {0, 1}
    first = koebe.weld(vertices, 2 * CRACK)[faces]
    first = first[(first != np.roll(first, 1, axis=1)).all(axis=1)]
    pairs = np.sort(np.concatenate([first[:, [0, 1]], first[:, [1, 2]], first[:, [2, 0]]]), axis=1)
    assert (np.unique(pairs, axis=0, return_counts=True)[1] == 2).all()  # closed
    if fair:
        return
    (tmp_path / "soup.obj").write_text(obj_text(points, thin))
    done = succeeded("fill", "soup.obj", "out.obj", "--all", "--weld", 2 * CRACK, cwd=tmp_path)
    assert "2 loops filled" in done.stdout, done.stderr + done.stdout
    assert np.allclose(obj_rows(tmp_path / "out.obj", "v"), vertices)


def test_python_has_it_where_surfaces_are_read():
    points, own = soup(TRIANGLES, CRACK)
    weld, named = 2 * CRACK, int(np.flatnonzero(TRIANGLES.ravel() == 0)[-1])  # a joined vertex of the outer rim
    fit = koebe.fit_circles(points, own, [(0.1, 0.2)], [0.3], pins={-1: (named, 30.0)}, weld=weld)
    assert fit.flipped == 0 and np.isclose(np.angle(complex(*fit.uv[named]), deg=True), 30.0, atol=1e-4)
    low, high = koebe.certified_moduli(points, own, weld=weld).modulus
    ring = koebe.uniformize(points, own, weld=weld)
    moved = koebe.transfer(ring, koebe.uniformize(VERTICES, TRIANGLES), landmarks=[(named, 0)])
    assert low < high and np.isfinite(moved.points).all()
