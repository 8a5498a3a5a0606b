"""Borders of materials and groups, split normals and given edges, which cut parts."""

import json

import koebe
import numpy as np
import pytest
from cli_support import succeeded
from glb_support import GlbBuilder

FACES = [[1, 3, 4, 2], [5, 6, 8, 7], [1, 2, 6, 5], [3, 7, 8, 4], [1, 5, 7, 3], [2, 4, 8, 6]]
CORNERS = [(x, y, z) for x in (0, 1) for y in (0, 1) for z in (0, 1)]


def cube(before=("",) * 6, normals=None):
    """An OBJ of a cube. @param before lines before each face @param normals of each corner, by number"""
    lines = [f"v {x} {y} {z}" for x, y, z in CORNERS]
    lines += ["vn 1 0 0", "vn 0 1 0", "vn 0 0 1"]
    for k, face in enumerate(FACES):
        words = [str(v) if normals is None else f"{v}//{normals[k][i]}" for i, v in enumerate(face)]
        lines += [*before[k].split("|"), "f " + " ".join(words)]
    return "\n".join(lines) + "\n"


def parts(tmp_path, text, *words):
    (tmp_path / "i.obj").write_text(text)
    succeeded("parts", tmp_path / "i.obj", tmp_path / "o.obj", "--json", tmp_path / "j.json", *words)
    return json.loads((tmp_path / "j.json").read_text())["parts"]


LID = ("usemtl a|g x", "", "", "", "usemtl b|g y", "usemtl a|g x")
# The last face but one has normals of its own at two of its edges; one corner differs at one end of an edge only.
SPLIT = [[1] * 4, [1] * 4, [1] * 4, [1] * 4, [2] * 4, [1] * 4]


@pytest.mark.parametrize(("word", "text", "cut"), [
    ("materials", cube(LID), True), ("groups", cube(LID), True), ("all", cube(LID), True),
    ("normals", cube(LID), False), ("nothing", cube(LID), False),
    ("normals", cube(normals=SPLIT), True), ("materials", cube(normals=SPLIT), False),
    ("all", cube(normals=[[1] * 4] * 6), False),
])  # fmt: skip
def test_the_file_cuts(tmp_path, word, text, cut):
    """No part has the fifth face and another one."""
    found = parts(tmp_path, text, "--cut-at", word)
    alone = [4] in [part["faces"] for part in found]
    assert alone is cut


def test_a_lone_edge_cuts_nothing_and_a_line_does():
    n = 6
    x, y = np.meshgrid(np.arange(n), np.arange(n), indexing="ij")
    vertices = np.stack([x, y, 0 * x], -1).reshape(-1, 3).astype(float)
    at = np.arange(n * n).reshape(n, n)
    a, b, c, d = (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:])
    triangles = np.concatenate([np.stack([a, b, c], -1).reshape(-1, 3), np.stack([a, c, d], -1).reshape(-1, 3)])
    across = np.stack([at[3, :-1], at[3, 1:]], -1)
    assert len(koebe.parts(vertices, triangles).parts) == 1
    assert len(koebe.parts(vertices, triangles, cuts=across[2:3]).parts) == 1
    result = koebe.parts(vertices, triangles, cuts=across[:, ::-1])
    assert len(result.parts) == 2 and result.flipped == 0 and result.overlaps == 0
    assert result.angle_error_deg["mean"] < 1e-4
    sides = [set(vertices[triangles[part["faces"]]].mean(1)[:, 0] > 3) for part in result.parts]
    assert sorted(map(sorted, sides)) == [[False], [True]]
    with pytest.raises(koebe.InputError, match="cuts need"):
        koebe.parts(vertices, triangles, cuts=across, cut=False)
    with pytest.raises(koebe.InputError, match="cuts name a vertex"):
        koebe.parts(vertices, triangles, cuts=[[0, n * n]])


def test_cuts_of_a_smooth_surface_are_borders():
    """A ball cut along its equator, and random sets of edges of it: one to one, whatever they are."""
    ball = ball_of_rings()
    z = ball[0][:, 2]
    edges = np.unique(np.sort(np.concatenate([ball[1][:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    equator = edges[(np.abs(z[edges]) < 1e-9).all(axis=1)]
    result = koebe.parts(*ball, cuts=equator)
    for part in result.parts:
        assert np.ptp(np.sign(z[ball[1][part["faces"]]].mean(axis=1))) == 0
    rng = np.random.default_rng(1)
    for _ in range(12):
        some = edges[rng.random(len(edges)) < rng.uniform(0, 0.5)]
        result = koebe.parts(*ball, cuts=some)
        assert result.flipped == 0 and result.overlaps == 0 and result.converged
        assert sorted(f for part in result.parts for f in part["faces"]) == list(range(len(ball[1])))


def ball_of_rings(n=12):
    """A ball of n rings with poles, and the equator along edges."""
    around = 2 * n
    t, p = np.meshgrid(np.pi * np.arange(1, n) / n, 2 * np.pi * np.arange(around) / around, indexing="ij")
    rings = np.stack([np.sin(t) * np.cos(p), np.sin(t) * np.sin(p), np.cos(t)], -1).reshape(-1, 3)
    vertices = np.concatenate([rings, [[0, 0, 1], [0, 0, -1]]])
    i, k = np.meshgrid(np.arange(n - 2), np.arange(around), indexing="ij")
    a, b = i * around + k, i * around + (k + 1) % around
    quads = [np.stack([a, a + around, b + around], -1), np.stack([a, b + around, b], -1)]
    k = np.arange(around)
    top = np.stack([np.full(around, len(rings)), k, (k + 1) % around], -1)
    low = (n - 2) * around
    bottom = np.stack([np.full(around, len(rings) + 1), low + (k + 1) % around, low + k], -1)
    return vertices, np.concatenate([*(q.reshape(-1, 3) for q in quads), top, bottom])


def test_materials_of_glb_cut(tmp_path):
    """A plate of two primitives with materials of their own."""
    points = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], np.float32)
    for materials, expected in (((0, 1), 2), ((0, 0), 1)):
        glb = GlbBuilder()
        glb.json["materials"] = [{}, {}]
        halves = np.array([[[0, 1, 2], [0, 2, 3]], [[1, 4, 5], [1, 5, 2]]], "<u2")
        glb.mesh(*[{"attributes": {"POSITION": glb.positions(points)}, "material": material,
                    "indices": glb.accessor(faces.ravel(), "SCALAR")}
                   for faces, material in zip(halves, materials, strict=True)])  # fmt: skip
        (tmp_path / "i.glb").write_bytes(glb.bytes())
        succeeded("parts", tmp_path / "i.glb", tmp_path / "o.glb", "--json", tmp_path / "j.json", "--cut-at=materials")
        assert len(json.loads((tmp_path / "j.json").read_text())["parts"]) == expected
