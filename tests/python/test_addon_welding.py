"""Merge by distance in the UVs only: surfaces of the add-on with joined vertices, without Blender."""

import koebe
import numpy as np
import pytest
from cli_support import perforated

VERTICES, QUADS = perforated(8, holes=((0.5, 0.5, 0.2),))


def surface_of(addon, points, faces, seams=()):
    """A surface of quadrilaterals; an edge is a seam if its ends, or points at their places, are given."""
    vertex = np.ravel(faces).astype(np.int32)
    ends = np.sort(np.stack([vertex, np.roll(faces, -1, axis=1).ravel()]), axis=0)
    edges, edge = np.unique(ends, axis=1, return_inverse=True)
    corner = 4 * np.arange(len(faces))[:, None] + [[0, 1, 2, 0, 2, 3]]
    places = [{tuple(points[a]), tuple(points[b])} for a, b in edges.T]
    seam = np.array([place in [{*map(tuple, one)} for one in seams] for place in places])
    return addon("surfaces.surface").Surface(
        points, vertex, edge.ravel().astype(np.int32), corner[:, 0].astype(np.int32), np.full(len(faces), 4, np.int32),
        seam, np.ones(len(faces), bool), corner.reshape(-1, 3).astype(np.int32), np.repeat(np.arange(len(faces)), 2),
    )  # fmt: skip


@pytest.mark.parametrize("apart", [0.0, 1e-5])
@pytest.mark.parametrize("with_seam", [False, True])
def test_joined_surfaces_have_the_islands_of_the_whole_one(addon, apart, with_seam):
    seams = [(VERTICES[a], VERTICES[b]) for a, b in QUADS[10:14, :2]] if with_seam else []
    whole = surface_of(addon, VERTICES, QUADS, seams)
    own = np.arange(QUADS.size).reshape(-1, 4)
    points = VERTICES[QUADS.ravel()]
    soup = surface_of(addon, points, own, seams)
    moved = np.random.default_rng(2).uniform(-0.5, 0.5, points.shape) * apart / np.sqrt(3)
    apart_soup = type(soup)(**{**vars(soup), "positions": points + moved})
    cut = addon("surfaces.islands").cut_into_islands
    assert len(cut(apart_soup)) == len(QUADS)
    joined, first = addon("surfaces.welding").joined(koebe, apart_soup, max(apart, 1e-9))
    assert len(np.unique(first)) == len(VERTICES) and joined.selected.all()
    found, wanted = cut(joined), cut(whole)
    assert [len(island.faces) for island in found] == [len(island.faces) for island in wanted]
    assert [len(island.vertices) for island in found] == [len(island.vertices) for island in wanted]
    assert joined.seam[joined.corner_edge].sum() == whole.seam[whole.corner_edge].sum()
    assert np.array_equal(joined.corner_vertex, first[apart_soup.corner_vertex])


def test_faces_that_collapse_are_not_mapped(addon):
    surface = surface_of(addon, VERTICES, QUADS)
    width = np.linalg.norm(np.diff(VERTICES[QUADS[0, :2]], axis=0))
    joined, first = addon("surfaces.welding").joined(koebe, surface, 1.01 * width)
    corners = np.sort(first[QUADS], axis=1)
    twice = (np.diff(corners, axis=1) == 0).any(axis=1)
    assert twice.any() and np.array_equal(joined.selected, ~twice)
