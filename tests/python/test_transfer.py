"""Points of one surface on another: laws on surfaces whose correspondence is known."""

import json

import koebe
import numpy as np
import pytest
from atrium_templates import atrium
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, perforated, succeeded, triangles_of, triangulated_plate
from cli_support import koebe as command

HOLES = ((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))
VERTICES, FACES = triangulated_plate(32, HOLES)
A = koebe.uniformize(VERTICES, FACES)


def placed(vertices, faces, places):
    return np.einsum("vk,vkd->vd", places.weights, vertices[faces[places.faces]])


def test_a_surface_lies_on_itself():
    places = koebe.transfer(A, A)
    assert places.fitted and places.alignment.residual < 1e-9
    assert np.allclose(places.points, VERTICES, atol=1e-6)
    assert np.allclose(koebe.transfer(A, A, VERTICES[:, 0]), VERTICES[:, 0], atol=1e-6)
    assert koebe.transfer(A, A, VERTICES).shape == VERTICES.shape


def test_places_are_points_of_the_other_surface():
    other, quads = perforated(24, ((0.32, 0.33, 0.1), (0.68, 0.3, 0.12), (0.5, 0.7, 0.12)))
    b = koebe.uniformize(other, triangles_of(quads).astype(np.int32))
    for a, c in ((A, b), (b, A)):
        places = koebe.transfer(a, c)
        assert places.faces.shape == (c.vertex_count,) and places.weights.min() >= 0.0
        assert np.allclose(places.weights.sum(axis=1), 1.0, atol=1e-12)
        assert np.allclose(placed(*a.surface, places), places.points, atol=1e-12)
        assert places.distances.max() < 0.02  # the height of an arc over an edge of the rim


def test_the_same_shape_in_other_triangles():
    # A conformal map of a flat domain moves no point: finer triangles find the points of coarser ones.
    def flat(n):
        vertices, quads = perforated(n, HOLES)
        vertices[:, 2] = 0.0
        return koebe.uniformize(vertices, triangles_of(quads).astype(np.int32))

    errors = []
    for n in (24, 48):
        places = koebe.transfer(flat(2 * n), flat(n))
        errors.append(np.linalg.norm(places.points - flat(n).surface[0], axis=1).mean())
    assert errors[0] < 0.02 and errors[1] < 0.75 * errors[0]


def test_the_rims_of_different_holes_meet_when_they_are_fitted():
    b = koebe.uniformize(*flattened(((0.25, 0.3, 0.16), (0.72, 0.4, 0.07), (0.5, 0.75, 0.1))))
    fitted, aligned = koebe.transfer(A, b), koebe.transfer(A, b, fit=False)
    assert fitted.fitted and not aligned.fitted
    assert np.allclose(fitted.alignment.misses, aligned.alignment.misses)
    assert np.allclose(fitted.alignment.misses_in_radii, fitted.alignment.misses / b.radii)
    rims = {v for loop in A.loops[1:] for v in loop.tolist()}
    on_rim = [set(FACES[fitted.faces[v]].tolist()) & rims for loop in b.loops[1:] for v in loop]
    assert all(on_rim)  # each vertex of a hole's rim lies in a face at a hole's rim
    assert aligned.distances.max() > 5 * fitted.distances.max()
    # Fitting turns no face over.
    assert koebe.distortion(VERTICES, FACES, fitted.uv)["flipped"] == 0


def test_tubes_are_fitted_too():
    # A body with five tubes: the faces round its tiny circles are large, and harmonic steps would turn them over.
    rng = np.random.default_rng(0)
    vertices, faces, rims = atrium(2)
    bent = vertices + 0.15 * np.sin(vertices @ rng.normal(size=(3, 3)) + rng.uniform(0, 6, 3))
    a, b = (koebe.uniformize(points, faces, outer=int(rims[-1][0])) for points in (vertices, bent))
    place = [[next(k for k, loop in enumerate(one.loops) if rim[0] in loop) for rim in rims] for one in (a, b)]
    match = np.array(place[1])[np.argsort(place[0])]
    fitted, aligned = (koebe.transfer(a, b, match=match, fit=fit) for fit in (True, False))
    assert fitted.fitted and fitted.flipped == 0 and fitted.warnings == []
    error, before = (np.linalg.norm(found.points - vertices, axis=1).mean() for found in (fitted, aligned))
    assert error < 0.6 * before  # vertices correspond by number
    assert koebe.distortion(vertices, faces, fitted.uv)["flipped"] == 0


def flattened(holes):
    return triangulated_plate(28, holes)


@pytest.mark.parametrize(
    ("arguments", "options", "error", "says"),
    [
        ((A, koebe.uniformize(*flattened(HOLES[:2]))), {}, koebe.InputError, "4 and 3|3 and 4"),
        ((A, A, np.zeros(3)), {}, koebe.InputError, "not a row for each"),
        ((A, A), {"match": []}, koebe.InputError, "match must name"),
        ((A, A), {"match": [0, 1, 1, 2]}, koebe.InputError, "twice"),
        ((A, A), {"match": [1, 0, 2, 3]}, koebe.InputError, "match must name"),
        ((A, VERTICES), {}, TypeError, "results of uniformize"),
        ((A, A), {"fit": 1}, TypeError, "fit"),
    ],
)
def test_what_cannot_be_carried(arguments, options, error, says):
    with pytest.raises(error, match=says):
        koebe.transfer(*arguments, **options)


def test_the_command_writes_the_points_of_a_on_b(tmp_path):
    other, faces = flattened(((0.32, 0.33, 0.1), (0.68, 0.3, 0.12), (0.5, 0.7, 0.12)))
    (tmp_path / "a.obj").write_text(obj_text(VERTICES, FACES))
    (tmp_path / "b.obj").write_text(obj_text(other, faces))
    files = (tmp_path / "a.obj", tmp_path / "b.obj", tmp_path / "out.obj", "--json", tmp_path / "places.json")
    done = succeeded("transfer", *files)
    assert done.stdout.startswith(f"{tmp_path / 'out.obj'}: {len(VERTICES)} points, holes miss by")
    lines = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
    points = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    assert sum(line[:1] == ["f"] for line in lines) == len(FACES)
    expected = koebe.transfer(koebe.uniformize(other, faces), A)
    assert np.allclose(points, expected.points, atol=1e-6)
    report = json.loads((tmp_path / "places.json").read_text())
    corners = np.array([place["triangle"] for place in report["places"]])
    weights = np.array([place["weights"] for place in report["places"]])
    assert np.allclose(np.einsum("vk,vkd->vd", weights, other[corners]), points, atol=1e-6)
    assert report["fitted"] is True and np.allclose(report["misses_in_radii"], expected.alignment.misses_in_radii)


def test_the_command_leaves_nothing_of_what_cannot_be(tmp_path):
    (tmp_path / "a.obj").write_text(obj_text(VERTICES, FACES))
    (tmp_path / "b.obj").write_text(obj_text(*flattened(HOLES[:2])))
    done = command("transfer", tmp_path / "a.obj", tmp_path / "b.obj", tmp_path / "out.obj")
    assert done.returncode == CANNOT_BE_MAPPED and "loops" in done.stderr
    assert command("transfer", tmp_path / "a.obj", tmp_path / "b.obj", tmp_path / "out.xyz").returncode == USAGE
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.obj", "b.obj"]
