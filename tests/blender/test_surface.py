"""Cutting surfaces into islands: laws of `islands.cut_into_islands`, on arrays."""

import types

import numpy as np
import pytest
from scenes import panel_arrays

pytestmark = pytest.mark.alike


@pytest.fixture
def surface(addon):
    """Surfaces, their islands, and the areas of triangles, under one name."""
    parts = [addon(f"surfaces.{name}") for name in ("surface", "islands", "triangles")]
    return types.SimpleNamespace(**{name: value for part in parts for name, value in vars(part).items()})


def make_surface(module, vertices, faces, seams=(), selected=None):
    """A `Surface` of polygons given as lists, edges numbered as they are met."""
    edge_ids, corner_vertex, corner_edge, corners, start, size, face_of = {}, [], [], [], [], [], []
    for number, face in enumerate(faces):
        first = len(corner_vertex)
        start.append(first)
        size.append(len(face))
        for a, b in zip(face, [*face[1:], face[0]], strict=True):
            corner_vertex.append(a)
            corner_edge.append(edge_ids.setdefault(frozenset((a, b)), len(edge_ids)))
        for i in range(1, len(face) - 1):
            corners.append((first, first + i, first + i + 1))
            face_of.append(number)
    seam = np.zeros(len(edge_ids), dtype=bool)
    for a, b in seams:
        seam[edge_ids[frozenset((a, b))]] = True
    chosen = np.ones(len(faces), dtype=bool) if selected is None else np.asarray(selected)
    return module.Surface(
        np.asarray(vertices, dtype=float), np.array(corner_vertex), np.array(corner_edge), np.array(start),
        np.array(size), seam, chosen, np.array(corners).reshape(-1, 3), np.array(face_of),
    )  # fmt: skip


def euler_characteristic(island):
    edges = np.sort(np.concatenate([island.triangles[:, [0, 1]], island.triangles[:, [1, 2]],
                                    island.triangles[:, [2, 0]]]), axis=1)  # fmt: skip
    return len(island.vertices) - len(np.unique(edges, axis=0)) + len(island.triangles)


def grid(columns, rows):
    """Vertices and quads of a flat grid; vertex (i, j) is j * (columns + 1) + i."""
    vertices = [(i, j, 0.0) for j in range(rows + 1) for i in range(columns + 1)]
    at = lambda i, j: j * (columns + 1) + i  # noqa: E731
    quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(rows) for i in range(columns)]
    return vertices, quads


@pytest.mark.parametrize("way", [lambda surface, whole: surface.cut_into_islands(whole)[0],
                                 lambda surface, whole: surface.whole_island(whole)], ids=["cut", "whole"])  # fmt: skip
def test_uncut_surface_is_its_own_island_array_for_array(surface, way):
    vertices, faces = panel_arrays()
    whole = make_surface(surface, vertices, faces)
    island = way(surface, whole)
    assert np.array_equal(island.vertices, vertices)
    assert np.array_equal(island.triangles, whole.corner_vertex[whole.triangle_corners])
    assert np.array_equal(island.source_vertex, np.arange(len(vertices)))
    assert np.array_equal(island.corners, np.arange(len(whole.corner_vertex)))
    assert np.array_equal(island.corner_vertex, whole.corner_vertex)
    assert island.triangles.dtype == np.int32


@pytest.mark.parametrize("part", [{"seams": [(1, 5)]}, {"selected": [True] * 8 + [False]}], ids=["seam", "selection"])
def test_a_surface_with_a_seam_or_a_face_left_out_is_no_whole_island(surface, part):
    assert surface.whole_island(make_surface(surface, *grid(3, 3), **part)) is None


def test_a_surface_with_a_loose_vertex_is_no_whole_island(surface):
    vertices, quads = grid(3, 3)
    assert surface.whole_island(make_surface(surface, [*vertices, (9.0, 9.0, 9.0)], quads)) is None


def test_areas_are_those_of_the_cross_product_however_many_triangles(addon, surface, monkeypatch):
    monkeypatch.setattr(addon("surfaces.triangles"), "BLOCK", 7)
    random = np.random.default_rng(3)
    points, triangles = random.normal(size=(40, 3)), random.integers(0, 40, size=(23, 3)).astype(np.int32)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    in_space = surface.areas(points, triangles)
    assert np.allclose(in_space, 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1), rtol=1e-13)
    u, v = (b - a)[:, :2], (c - a)[:, :2]
    flat = surface.signed_areas(points[:, :2], triangles)
    assert np.allclose(flat, 0.5 * (u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), rtol=1e-12)


def test_unused_vertices_are_left_out_and_the_rest_keep_their_order(surface):
    vertices, quads = grid(2, 1)
    (island,) = surface.cut_into_islands(make_surface(surface, vertices, quads, selected=[False, True]))
    assert island.source_vertex.tolist() == [1, 2, 4, 5]
    assert island.vertices.tolist() == [list(vertices[v]) for v in (1, 2, 4, 5)]
    assert island.corners.tolist() == [4, 5, 6, 7]
    assert island.faces.tolist() == [1]


def test_seam_across_divides(surface):
    vertices, quads = grid(4, 3)
    seams = [(2 + 5 * j, 2 + 5 * (j + 1)) for j in range(3)]
    islands = surface.cut_into_islands(make_surface(surface, vertices, quads, seams))
    assert [island.faces.tolist() for island in islands] == [[0, 1, 4, 5, 8, 9], [2, 3, 6, 7, 10, 11]]
    for island in islands:
        assert len(island.vertices) == 12
        assert euler_characteristic(island) == 1


def test_seam_that_ends_inside_opens_a_slit_and_doubles_only_its_inner_vertices(surface):
    vertices, quads = grid(4, 4)
    at = lambda i, j: 5 * j + i  # noqa: E731
    seams = [(at(2, 0), at(2, 1)), (at(2, 1), at(2, 2))]
    (island,) = surface.cut_into_islands(make_surface(surface, vertices, quads, seams))
    doubled = [v for v, n in enumerate(np.bincount(island.source_vertex)) if n == 2]
    assert doubled == [at(2, 0), at(2, 1)]  # the tip at(2, 2) stays one vertex
    assert euler_characteristic(island) == 1


def test_seam_of_one_edge_inside_changes_nothing_but_could_not_open(surface):
    vertices, quads = grid(4, 4)
    whole = make_surface(surface, vertices, quads, [(12, 13)])
    (island,) = surface.cut_into_islands(whole)
    assert len(island.vertices) == 25


def test_seam_around_a_tube_and_along_it(surface):
    around, along = 8, 3
    vertices = [(np.cos(a), np.sin(a), z) for z in range(along + 1) for a in 2 * np.pi * np.arange(around) / around]
    at = lambda i, j: j * around + i % around  # noqa: E731
    quads = [(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)) for j in range(along) for i in range(around)]
    (tube,) = surface.cut_into_islands(make_surface(surface, vertices, quads))
    assert euler_characteristic(tube) == 0
    lengthwise = [(at(0, j), at(0, j + 1)) for j in range(along)]
    (opened,) = surface.cut_into_islands(make_surface(surface, vertices, quads, lengthwise))
    assert euler_characteristic(opened) == 1
    assert len(opened.vertices) == len(vertices) + along + 1
    ring = [(at(i, 1), at(i + 1, 1)) for i in range(around)]
    parts = surface.cut_into_islands(make_surface(surface, vertices, quads, ring))
    assert [len(part.faces) for part in parts] == [8, 16]
    assert [euler_characteristic(part) for part in parts] == [0, 0]


def test_surfaces_that_touch_in_a_vertex_come_apart(surface):
    vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0), (0, -1, 0)]
    islands = surface.cut_into_islands(make_surface(surface, vertices, [(0, 1, 2), (0, 3, 4)]))
    assert [island.source_vertex.tolist() for island in islands] == [[0, 1, 2], [0, 3, 4]]


def test_faces_of_opposite_orientation_are_still_neighbours(surface):
    vertices, quads = grid(2, 1)
    quads[1] = quads[1][::-1]
    (island,) = surface.cut_into_islands(make_surface(surface, vertices, quads))
    assert island.source_vertex.tolist() == [0, 1, 2, 3, 4, 5]
    assert np.array_equal(island.corner_vertex, np.array(quads).ravel())


@pytest.mark.parametrize("is_seam", [False, True])
def test_three_faces_on_an_edge_stay_together_unless_it_is_a_seam(surface, is_seam):
    vertices = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1)]
    faces = [(0, 1, 2), (1, 0, 3), (0, 1, 4)]
    islands = surface.cut_into_islands(make_surface(surface, vertices, faces, [(0, 1)] if is_seam else []))
    assert len(islands) == (3 if is_seam else 1)
    if not is_seam:
        assert islands[0].source_vertex.tolist() == [0, 1, 2, 3, 4]


def test_nothing_selected_gives_no_island(surface):
    vertices, quads = grid(2, 1)
    assert surface.cut_into_islands(make_surface(surface, vertices, quads, selected=[False, False])) == []


def test_components_agree_with_a_search(addon):
    connected_components = addon("surfaces.connected_components").connected_components
    random = np.random.default_rng(7)
    for count, edges in [(1, 0), (50, 20), (200, 150), (200, 400), (500, 499)]:
        first, second = random.integers(0, count, edges), random.integers(0, count, edges)
        expected = np.arange(count)
        for _ in range(count):
            low = np.minimum(expected[first], expected[second])
            np.minimum.at(expected, first, low)
            np.minimum.at(expected, second, low)
        assert np.array_equal(connected_components(count, first, second), expected)


def test_components_of_a_long_path_and_of_a_star_with_a_high_hub_take_few_rounds(addon, monkeypatch):
    components = addon("surfaces.connected_components")
    monkeypatch.setattr(components.itertools, "count", lambda: range(20))
    path = np.random.default_rng(1).permutation(20000)
    assert not components.connected_components(20000, path[:-1], path[1:]).any()
    leaves = np.arange(19999)
    assert not components.connected_components(20000, leaves, np.full(19999, 19999)).any()
