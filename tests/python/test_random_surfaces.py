"""Random surfaces whose maps once broke a promise (`make reliability` names them), and a few of each kind."""

from pathlib import Path

import commands
import koebe
import numpy as np
import promises
import pytest
import random_surfaces


@pytest.mark.parametrize("kind", random_surfaces.KINDS)
def test_a_few_of_each_kind_keep_their_promises(kind):
    for seed in range(2000, 2005):
        surface = random_surfaces.make(kind, seed)
        if surface is not None:
            assert promises.broken(surface[1], koebe.uniformize(*surface)) == [], seed


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=[pytest.mark.slow] if name in ("parts", "schottky") else [])
        for name in commands.COMMANDS
        if name != "uniformize"
    ],
)
def test_every_command_keeps_its_promises_and_gives_one_surface_one_map(name):
    for kind in commands.COMMANDS[name].kinds:
        surface = commands.surface(name, kind, 2003)
        result = commands.answer(name, *surface)
        assert isinstance(result, str) or commands.COMMANDS[name].broken(surface[1], result) == [], kind
        for other in commands.variants(*surface, np.random.default_rng(1)):
            again = commands.answer(name, other.vertices, other.triangles)
            assert commands.difference(name, result, again, other) < 1e-6, (kind, other.name)


@pytest.mark.slow
@pytest.mark.parametrize(("scan", "degrees"), [("nikolov_Angel", 3.4), ("nikolov_blackVase", 6.0)])
def test_scans_that_need_many_repairs_keep_their_promises_and_their_circles(scan, degrees):
    # Vertices that slide along a small circle could pass each other, and the map covered the hole. Where circles
    # nearly meet one flipped face was left, and the map was made anew, with 3.5 and 9.6 degrees.
    file = Path(__file__).resolve().parents[3] / "shared" / "meshes" / "good" / f"{scan}.obj"
    if not file.is_file():
        pytest.skip("the shared meshes are not here")
    lines = [line.split() for line in file.read_text().splitlines()]
    vertices = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=float)
    triangles = np.array([[int(c.split("/")[0]) - 1 for c in line[1:]] for line in lines if line[:1] == ["f"]])
    result = koebe.uniformize(vertices, triangles)
    assert promises.broken(triangles, result) == [] and result.angle_error_deg["mean"] < degrees


def test_a_hole_turned_over_breaks_a_promise():
    turn = np.exp(2j * np.pi * np.arange(3) / 3)
    hole = np.stack([turn.real, turn.imag * 1e-9], axis=-1) * 1e-3
    assert promises.turned_over(hole) and not promises.turned_over(hole[::-1]) and not promises.turned_over(hole * 1e-4)


# Vertices deep in ears and limbs, of meshes of a few faces: where an automorphism turns faces over.
PLACED = [
    ("stacked", 2, 17, 23), ("stacked", 8, 7, 4), ("sphere", 2, 3, 4), ("ragged", 0, 311, None),
    ("ragged", 6, 111, 231), ("ragged", 8, 108, 95), ("lifted", 3, 171, 140), ("lifted", 9, 158, 30),
    ("planar", 8, 86, 57), ("degenerate", 0, 5, None),
]  # fmt: skip


@pytest.mark.parametrize(("kind", "seed", "center", "point"), PLACED)
def test_vertices_are_brought_to_their_places_without_a_flip(kind, seed, center, point):
    vertices, triangles = random_surfaces.make(kind, seed)
    result = koebe.uniformize(vertices, triangles, center=center, point=point)
    assert promises.broken(triangles, result) == [] and result.converged
    assert result.uv[center].tolist() == [0, 0] and (point is None or result.uv[point].tolist() == [1, 0])


def test_a_vertex_that_cannot_be_brought_to_0_is_named_and_no_face_is_flipped():
    vertices, triangles = random_surfaces.make("joined", 1008)
    result = koebe.uniformize(vertices, triangles, center=222, point=31)
    assert promises.broken(triangles, result) == [] and not result.converged
    assert [w.elements for w in result.warnings if w.kind == "out_of_place"] == [[222]]
    assert result.uv[31].tolist() == [1, 0]


@pytest.mark.parametrize("kind", random_surfaces.KINDS)
def test_any_vertices_of_each_kind_can_be_given_places(kind):
    for seed in range(3000, 3004):
        surface = random_surfaces.make(kind, seed)
        if surface is None:
            continue
        rng = np.random.default_rng(seed)
        rim = np.concatenate(koebe.boundary_loops(surface[1], vertex_count=len(surface[0])))
        inside = np.setdiff1d(surface[1], rim)
        center, point = int(rng.choice(inside)) if len(inside) else None, int(rng.choice(rim))
        result = koebe.uniformize(*surface, center=center, point=point, polish=seed % 2 == 0)
        assert promises.broken(surface[1], result) == [], seed
        assert np.abs(result.uv[point] - [1, 0]).max() <= 1e-12, seed
        if center is not None:
            placed = np.abs(result.uv[center]).max() <= 1e-12
            assert placed or "out_of_place" in [w.kind for w in result.warnings], seed


def test_the_polish_is_undone_only_where_a_loop_would_cross_itself():
    vertices, triangles = random_surfaces.make("grid", 335)
    polished = koebe.uniformize(vertices, triangles, polish=True)
    assert polished.converged and promises.broken(triangles, polished) == []
    error = polished.to_dict()["angle_error_deg"]
    assert error["mean"] < error["before_polish"]


@pytest.mark.parametrize(("kind", "seed"), [("strip", 7004), ("tube", 7009), ("planar", 7011)])
def test_the_polish_keeps_nothing_that_rounding_alone_calls_better(kind, seed):
    error = koebe.uniformize(*random_surfaces.make(kind, seed), polish=True).to_dict()["angle_error_deg"]
    assert error["mean"] <= error["before_polish"]


def test_the_outer_loop_runs_once_round_where_its_vertices_slide():
    # With all faces upright the rim turned back on itself, and the map lay over itself.
    vertices, triangles = random_surfaces.make("uneven", 38)
    result = koebe.uniformize(vertices, triangles, method="ck")
    assert promises.broken(triangles, result) == [] and result.converged


def test_faces_that_were_turned_are_no_flips():
    vertices, triangles = random_surfaces.make("uneven", 409)
    result = koebe.uniformize(vertices, triangles, method="ck")
    assert [len(w.elements) for w in result.warnings if w.kind == "reoriented_faces"] == [2]
    assert promises.broken(triangles, result) == []


def test_a_warning_takes_the_numbers_of_a_larger_mesh():
    vertices, triangles = random_surfaces.make("uneven", 409)
    (turned,) = (w for w in koebe.uniformize(vertices, triangles).warnings if w.kind == "reoriented_faces")
    first, second = turned.elements
    moved = turned.renumbered([1000 - face for face in range(len(triangles))])
    assert moved.elements == [1000 - second, 1000 - first] and moved.kind == turned.kind
    assert moved.text == turned.text.replace(f"the first face is {first}", f"the first face is {1000 - second}")
    assert moved.text != turned.text


@pytest.mark.parametrize(
    ("kind", "seed", "shape"), [("lifted", 31002, "ring"), ("ragged", 31011, "sphere"), ("sphere", 31915, "sphere")]
)
def test_a_pattern_lies_on_no_map_that_covers_a_place_twice(kind, seed, shape):
    # Flipped faces of a ring and of halves of a sphere, and a half whose rims cross at a vertex.
    with pytest.raises((koebe.SolverError, koebe.InputError), match="not one to one|too large on the sphere") as caught:
        koebe.lift(*random_surfaces.make(kind, seed), "voronoi", shape=shape, size=1.0, perforate=True)
    assert len(caught.value.elements) > 0
