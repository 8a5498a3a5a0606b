"""koebe.open_surface, and what a CutResult is kept in."""

import pickle

import koebe
import numpy as np
import pytest
from test_cut import torus


def triangles_of_torus():
    vertices, quads = torus()
    return vertices, np.vstack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]]), np.tile(np.arange(len(quads)), 2)


def test_a_torus_becomes_one_piece_that_can_be_mapped():
    vertices, triangles, polygon = triangles_of_torus()
    opened = koebe.open_surface(vertices, triangles, polygon=polygon)
    (piece,) = opened.pieces
    assert opened.handles_cut == 1 and not opened.left_out
    assert [cut.kind for cut in opened.cuts] == ["handle", "opening"] and all(cut.text for cut in opened.cuts)
    assert np.array_equal(piece.vertices, vertices[piece.source_vertex])
    assert np.array_equal(piece.source_vertex[piece.triangles], triangles[piece.source_face])
    assert not piece.turned.any() and piece.turned.dtype == bool
    assert koebe.uniformize(piece.vertices, piece.triangles).flipped == 0
    # It is what uniformize(cut=True) maps.
    both = koebe.uniformize(vertices, triangles, cut=True)
    assert [cut["kind"] for cut in both.cuts] == ["handle", "opening"]


def test_turned_degenerate_and_double_faces():
    vertices = [[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    opened = koebe.open_surface(vertices, [[0, 1, 2], [0, 3, 2], [1, 1, 2], [2, 0, 1]])
    (piece,) = opened.pieces
    assert piece.source_face.tolist() == [0, 1] and piece.turned.sum() == 1
    assert [(out.face, out.like, out.degenerate) for out in opened.left_out] == [(2, 0, True), (3, 0, False)]


def test_what_is_no_mesh_is_refused():
    with pytest.raises(koebe.InputError):
        koebe.open_surface([[0, 0, 0]], [[0, 0, 0]])
    with pytest.raises(koebe.InputError, match="polygon"):
        koebe.open_surface(np.eye(3), [[0, 1, 2]], polygon=[0, 1])


def test_a_cut_result_survives_a_file_and_a_pickle(tmp_path):
    vertices, triangles, _ = triangles_of_torus()
    result = koebe.uniformize(vertices, triangles, cut=True)
    result.save(tmp_path / "r.npz")
    for again in (koebe.load(tmp_path / "r.npz"), pickle.loads(pickle.dumps(result))):
        assert isinstance(again, koebe.CutResult)
        assert np.array_equal(again.uv, result.uv) and again.to_dict() == result.to_dict()
        assert np.array_equal(again.piece, result.piece)
        assert np.array_equal(again.surface[1], triangles) and again.warnings == result.warnings
        assert np.array_equal(again.flipped_faces, result.flipped_faces)
