"""Parts that are copies or mirror images of another part are laid onto it."""

import json

import koebe
import numpy as np
import pytest
from cli_support import cells, obj_text, succeeded, triangles_of
from uv_measures import signed_areas


def sheet(n=8, bend=0.9):
    """A bent sheet that is not its own mirror image: vertices and quadrilaterals."""
    x, y = np.meshgrid(np.linspace(0.0, 1.6, 2 * n + 1), np.linspace(0.0, 1.0, n + 1), indexing="ij")
    vertices = np.stack([x + 0.2 * y, y, 0.2 * bend * np.sin(2 * x + y) + 0.1 * x * y], axis=-1).reshape(-1, 3)
    return vertices, cells(2 * n, n)[:, [0, 3, 2, 1]]


def turned(points, seed=1):
    """The points after some rotation."""
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return points @ (turn * np.sign(np.linalg.det(turn)))


def family(same_diagonals=False):
    """The sheet, its mirror image, and a turned copy: vertices, triangles, and the polygon of each triangle."""
    points, quads = sheet()
    mirrored = points * [-1.0, 1.0, 1.0] - [3.0, 0.0, 0.0]
    backwards = quads[:, ::-1] if not same_diagonals else np.roll(quads[:, ::-1], 1, axis=1)
    vertices = np.concatenate([points, mirrored, turned(points) + [0.0, 5.0, 0.0]])
    count = len(points)
    faces = np.concatenate([quads, backwards + count, quads + 2 * count])
    return vertices, triangles_of(faces), np.repeat(np.arange(len(faces)), 2)


def of_vertices(uv, triangles, count):
    """(V, 2) the UV of each vertex, where every corner of a vertex has the same UV."""
    at = np.zeros((count, 2))
    at[triangles.ravel()] = uv.reshape(-1, 2)
    assert np.array_equal(at[triangles], uv)
    return at


@pytest.mark.parametrize("same_diagonals", [False, True])
def test_twins_share_their_texels(same_diagonals):
    vertices, triangles, polygon = family(same_diagonals)
    apart = koebe.parts(vertices, triangles, polygon=polygon, darts=0, price=1.0)
    result = koebe.parts(vertices, triangles, polygon=polygon, darts=0, price=1.0, stack=True, stack_mirrored=True)
    assert apart.stacked == [] and len(result.parts) == 3 and len(result.stacked) == 2
    assert {one["onto"] for one in result.stacked}.isdisjoint(one["part"] for one in result.stacked)
    at = of_vertices(result.uv, triangles, len(vertices)).reshape(3, -1, 2)
    assert np.array_equal(at[0], at[1]) and np.array_equal(at[0], at[2])

    sign = np.sign(signed_areas(result.uv.astype(np.float32).astype(float))).reshape(3, -1)
    mirrored = {one["part"]: one["mirrored"] for one in result.stacked}
    for k in range(3):
        part = result.part[k * len(triangles) // 3]
        assert (sign[k] == (-1 if mirrored.get(part, False) else 1)).all()
    assert sum(mirrored.values()) in (1, 2) and result.flipped == 0 and result.converged and result.lost_area == 0
    assert result.density > 1.5 * apart.density
    first = np.abs(signed_areas(result.uv))[: len(triangles) // 3].sum()
    assert result.coverage == pytest.approx(first, rel=1e-6)
    assert result.angle_error_deg["mean"] == pytest.approx(apart.angle_error_deg["mean"], abs=0.11)
    assert result.beltrami["max"] < 1


def test_parts_of_other_shape_or_wanted_size_are_not_stacked():
    vertices, triangles, polygon = family()
    count = len(vertices) // 3
    bent = vertices.copy()
    bent[count:] *= [1.0, 1.0, 1.2]
    assert (
        len(koebe.parts(bent, triangles, polygon=polygon, darts=0, price=1.0, stack=True, stack_mirrored=True).stacked)
        == 0
    )
    weights = np.zeros(len(vertices))
    weights[:count] = np.linspace(0.0, 1.0, count)
    result = koebe.parts(
        vertices, triangles, polygon=polygon, darts=0, price=1.0, stack=True, stack_mirrored=True, importance=weights
    )
    assert len(result.stacked) == 1 and result.part[0] not in [one["part"] for one in result.stacked]


def test_a_bump_is_no_dent():
    """A part and its image in its own plane have the same lengths, but one is no copy of the other."""
    x, y = np.meshgrid(np.linspace(-1, 1, 13), np.linspace(-1, 1, 13), indexing="ij")
    height = 0.4 * np.exp(-2 * ((x - 0.2) ** 2 + (y + 0.3) ** 2)) + 0.1 * x
    points = np.stack([x, y, height], axis=-1).reshape(-1, 3)
    corner = (np.arange(12)[:, None] * 13 + np.arange(12)).ravel()
    quads = np.stack([corner, corner + 13, corner + 14, corner + 1], axis=-1)
    dent = points * [1, 1, -1] + [4, 0, 0]
    vertices, triangles = np.concatenate([points, dent]), triangles_of(np.concatenate([quads, quads + len(points)]))
    result = koebe.parts(vertices, triangles, darts=0, price=1.0, stack=True, stack_mirrored=True)
    upright = signed_areas(result.uv) > 0
    assert all(one["mirrored"] for one in result.stacked) and result.flipped == 0
    assert not result.stacked or upright[: len(triangles) // 2].all() != upright[len(triangles) // 2 :].all()


def test_the_command_has_it(tmp_path):
    vertices, triangles, _ = family(same_diagonals=True)
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    words = "--stack --stack-mirrored --darts 0 --price 1 --json r.json".split()
    succeeded("parts", "in.obj", "out.obj", *words, cwd=tmp_path)
    report = json.loads((tmp_path / "r.json").read_text())
    assert len(report["stacked"]) == 2 and report["flipped"] == 0 and report["tiles"] == 1
    assert report["options"]["stack"] is True
