"""Show: where cuts and darts keep away."""

import json

import koebe
import numpy as np
import pytest
import random_models
from cli_support import CANNOT_BE_MAPPED, obj_text, succeeded
from cli_support import koebe as command
from koebe._native import _koebe
from test_parts import TRIANGLES, VERTICES


def creature():
    """A body with a head and four limbs, front and back alike: a sphere with bumps in the plane y = 0."""
    vertices, triangles = random_models.ball(5)
    directions = np.array([(0, 0, 1), (1, 0, 0.3), (-1, 0, 0.3), (0.5, 0, -1), (-0.5, 0, -1)], float)
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    near = np.clip(vertices @ directions.T, 0, 1)
    return vertices * (1 + 2.2 * (near**12).sum(axis=1))[:, None], triangles


def cut_share(result, vertices, triangles, weights):
    """The length of cuts, and the share of it that lies where the weight is 1."""
    sides = {}
    for face, corners in zip(triangles, result.uv, strict=True):
        for k in range(3):
            ends = [(face[k], tuple(corners[k])), (face[(k + 1) % 3], tuple(corners[(k + 1) % 3]))]
            a, b = sorted(ends)
            sides.setdefault((a[0], b[0]), []).append((a[1], b[1]))
    cuts = np.array([edge for edge, both in sides.items() if len(both) == 2 and both[0] != both[1]])
    lengths = np.linalg.norm(vertices[cuts[:, 0]] - vertices[cuts[:, 1]], axis=1)
    shown = weights[cuts].all(axis=1)
    return lengths.sum(), lengths[shown].sum() / lengths.sum()


def front(vertices, axis=1, sign=1):
    """1 on one half."""
    return (sign * vertices[:, axis] > 1e-9).astype(float)


MANY_CUTS = {"price": 0.0037, "darts": 0.2}  # borders round limbs have no choice: others must be there
MODELS = {"ball": lambda: random_models.ball(4), "creature": creature}


@pytest.mark.parametrize("sign", [1, -1])
@pytest.mark.parametrize("model", ["ball", pytest.param("creature", marks=pytest.mark.slow)])
def test_cuts_keep_away_from_the_half_that_is_shown(model, sign):
    vertices, triangles = MODELS[model]()
    show = front(vertices, sign=sign)
    plain, turned = (koebe.parts(vertices, triangles, **MANY_CUTS, show=one) for one in (None, show))
    assert turned.converged and turned.flipped == 0
    (before, share_before), (after, share_after) = (
        cut_share(one, vertices, triangles, show) for one in (plain, turned)
    )
    assert share_after < 0.85 * share_before
    assert after * share_after < 0.75 * before * share_before


def test_a_tube_is_opened_on_its_back():
    show, plain = front(VERTICES, axis=0), koebe.parts(VERTICES, TRIANGLES, darts=0.0)
    if cut_share(plain, VERTICES, TRIANGLES, show)[1] < 0.5:
        show = 1.0 - show  # the side on which it is opened without `show`
    assert cut_share(plain, VERTICES, TRIANGLES, show)[1] > 0.5
    turned = koebe.parts(VERTICES, TRIANGLES, darts=0.0, show=show)
    ring = np.pi  # a cut round the finger has half of its length on each side
    length, share = cut_share(turned, VERTICES, TRIANGLES, show)
    assert length * share < ring


def test_weights_of_zero_change_no_bit():
    plain = koebe.parts(VERTICES, TRIANGLES)
    assert np.array_equal(koebe.parts(VERTICES, TRIANGLES, show=np.zeros(len(VERTICES))).uv, plain.uv)


def test_weights_follow_their_vertices():
    """Numbers of vertices do not matter."""
    show = front(VERTICES, axis=0)
    order = np.random.default_rng(7).permutation(len(VERTICES))
    number = np.argsort(order)
    one = koebe.parts(VERTICES, TRIANGLES, show=show)
    other = koebe.parts(VERTICES[order], number[TRIANGLES], show=show[order])
    assert np.array_equal(one.uv, other.uv)


@pytest.mark.parametrize("wrong", [1.0 + 1e-9, -1e-9, np.nan, np.inf])
def test_a_weight_out_of_range_is_refused_with_its_vertex(wrong):
    show = np.zeros(len(VERTICES))
    show[[5, 9]] = wrong
    with pytest.raises(koebe.InputError, match="2 vertices have show not from 0 to 1") as refused:
        koebe.parts(VERTICES, TRIANGLES, show=show)
    assert refused.value.elements == [5, 9]
    options = _koebe.PartsOptions()  # the library checks too
    options.show = show
    with pytest.raises(koebe.InputError, match="a weight to show that is not from 0 to 1") as refused:
        _koebe.parts(VERTICES, TRIANGLES.astype(np.int32), options, None, _koebe.CancelToken())
    assert refused.value.elements == [5, 9]


@pytest.mark.parametrize("wrong", [np.zeros(3), np.zeros((len(VERTICES), 1)), "front"])
def test_what_is_no_weight_for_each_vertex_is_refused(wrong):
    with pytest.raises(koebe.InputError, match="show must be"):
        koebe.parts(VERTICES, TRIANGLES, show=wrong)


def test_the_command_reads_a_file(tmp_path):
    show = front(VERTICES, axis=0)
    (tmp_path / "in.obj").write_text(obj_text(VERTICES, TRIANGLES))
    (tmp_path / "w.txt").write_text("\n".join(f"{w:g}" for w in show))
    succeeded("parts", "in.obj", "a.obj", "--show", "w.txt", "--json", "r.json", cwd=tmp_path)
    report = json.loads((tmp_path / "r.json").read_text())
    turned = koebe.parts(VERTICES, TRIANGLES, show=show)
    assert report["options"]["show"] is True and turned.options["show"] is True
    assert report["cut_length"] == pytest.approx(turned.cut_length, rel=1e-6)
    for text in ("0 1 2", "0 1 front", ""):
        (tmp_path / "w.txt").write_text(text)
        wrong = command("parts", "in.obj", "b.obj", "--show", "w.txt", cwd=tmp_path)
        assert wrong.returncode == CANNOT_BE_MAPPED and "a weight to show" in wrong.stderr
        assert not (tmp_path / "b.obj").exists()
