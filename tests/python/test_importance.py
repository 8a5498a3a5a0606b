"""Importance: what the balance and the sizes of faces are weighed by."""

import json

import koebe
import numpy as np
import pytest
from cli_support import USAGE, obj_text, succeeded, triangles_of, triangulated_plate
from cli_support import koebe as command
from uv_measures import signed_areas


def panel(n=24):
    """A bent plate with holes, as triangles."""
    return triangulated_plate(n)


def uv_area(triangles, uv, chosen):
    return np.abs(signed_areas(uv[triangles[chosen]])).sum()


def region(vertices, triangles, axis, sign):
    """Importance 1 at the outer third on one side, and the faces there."""
    along = sign * vertices[:, axis]
    importance = (along > np.quantile(along, 0.7)).astype(float)
    return importance, importance[triangles].all(axis=1)


@pytest.mark.parametrize("value", [0.0, 0.37, 1.0])
def test_equal_ones_change_no_bit(value):
    vertices, triangles = panel()
    plain = koebe.uniformize(vertices, triangles, balance="area")
    weighed = koebe.uniformize(vertices, triangles, balance="area", importance=np.full(len(vertices), value))
    assert np.array_equal(plain.uv, weighed.uv)
    cut = [koebe.uniformize(*two_tents(), cut=True, balance="area", importance=w) for w in (None, np.full(10, value))]
    assert np.array_equal(cut[0].uv, cut[1].uv)


def two_tents():
    """Two pyramids without bottom, apart."""
    tent = np.array([[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1.0]])
    faces = np.array([[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    return np.vstack([tent, tent + [3, 0, 0]]), np.vstack([faces, faces + 5])


@pytest.mark.parametrize("axis", [0, 1])
@pytest.mark.parametrize("sign", [-1, 1])
def test_what_is_important_gets_more_room_and_circles_stay(axis, sign):
    vertices, triangles = panel()
    importance, faces = region(vertices, triangles, axis, sign)
    plain = koebe.uniformize(vertices, triangles, balance="area", outer="longest")
    weighed = koebe.uniformize(vertices, triangles, balance="area", outer="longest", importance=importance)
    before, after = (uv_area(triangles, result.uv, faces) for result in (plain, weighed))
    assert after > 1.3 * before
    off = np.concatenate(weighed.off_circle)
    for loop, center, radius in zip(weighed.loops, weighed.centers, weighed.radii, strict=True):
        on = np.setdiff1d(loop, off)
        assert len(on) > 8
        assert np.allclose(np.linalg.norm(weighed.uv[on] - center, axis=1), radius, atol=1e-9)
    assert weighed.flipped == 0
    assert weighed.options["importance"] is True and "importance" not in plain.options


def test_the_map_is_as_conformal_as_the_mesh_is_fine():
    errors = []
    for n in (24, 48, 96):
        vertices, triangles = panel(n)
        importance, _ = region(vertices, triangles, 0, 1)
        result = koebe.uniformize(vertices, triangles, balance="area", outer="longest", importance=importance)
        errors.append(result.angle_error_deg["mean"])
    assert errors[1] < 0.65 * errors[0] and errors[2] < 0.65 * errors[1]


def test_an_important_piece_gets_a_larger_disk():
    vertices, triangles = two_tents()
    importance = np.repeat([1.0, 0.0], 5)
    result = koebe.uniformize(vertices, triangles, cut=True, balance="area", importance=importance)
    one, other = (piece["place"]["radius"] for piece in result.pieces)
    assert one == pytest.approx(4.0 * other)


def two_squares(n=8):
    """Two flat grids, apart."""
    across = np.linspace(0.0, 1.0, n + 1)
    grid = np.array([[x, y, 0.0] for x in across for y in across])
    quads = [[i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1]
             for i in range(n) for j in range(n)]  # fmt: skip
    triangles = triangles_of(np.array(quads))
    return np.vstack([grid, grid + [3.0, 0.0, 0.0]]), np.vstack([triangles, triangles + len(grid)])


@pytest.mark.parametrize("even", [None, 0.0, 0.3, 1.0])
def test_parts_have_the_sizes_that_importance_asks_for(even):
    vertices, triangles = two_squares()
    half = len(vertices) // 2
    result = koebe.parts(vertices, triangles, even=even, importance=np.repeat([0.5, 0.0], half))
    area = signed_areas(result.uv)
    first = np.arange(len(triangles)) < len(triangles) // 2
    assert area[first].sum() == pytest.approx(4.0 * area[~first].sum(), rel=1e-5)
    assert result.flipped == 0 and result.options["importance"] is True


def strip(length=16, n=4):
    """A flat strip, a unit wide."""
    points = np.array([[x / n, y / n, 0.0] for x in range(length * n + 1) for y in range(n + 1)])
    quads = [[i * (n + 1) + j, (i + 1) * (n + 1) + j, (i + 1) * (n + 1) + j + 1, i * (n + 1) + j + 1]
             for i in range(length * n) for j in range(n)]  # fmt: skip
    return points, triangles_of(np.array(quads))


@pytest.mark.parametrize(("even", "tolerance"), [(0.3, 0.05), (1.0, 0.005)])
def test_a_strip_is_twice_as_wide_where_it_counts_four_times(even, tolerance):
    vertices, triangles = strip()
    importance = 0.5 * (vertices[:, 0] < 8.0)
    result = koebe.parts(vertices, triangles, even=even, darts=0.0, importance=importance)
    middle = vertices[triangles].mean(axis=1)[:, 0]
    area = signed_areas(result.uv)
    assert area[middle < 4.0].sum() == pytest.approx(4.0 * area[middle > 12.0].sum(), rel=tolerance)
    plain = koebe.parts(vertices, triangles, even=even, darts=0.0)
    assert signed_areas(plain.uv)[middle < 4.0].sum() == pytest.approx(signed_areas(plain.uv)[middle > 12.0].sum())


def tube(around=24, along=12):
    turn = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    points = np.array([[(1 + 0.3 * z) * np.cos(t), (1 + 0.3 * z) * np.sin(t), z] for z in np.linspace(0, 2, along + 1)
                       for t in turn])  # fmt: skip
    quads = [[j * around + i, j * around + (i + 1) % around, (j + 1) * around + (i + 1) % around, (j + 1) * around + i]
             for j in range(along) for i in range(around)]  # fmt: skip
    return points, triangles_of(np.array(quads))


MAPS = {
    "disk": (panel, lambda *mesh, **options: koebe.uniformize(*mesh, even=0.4, **options)),
    "parts": (panel, koebe.parts),
    "ring": (tube, lambda *mesh, **options: koebe.ring_map(*mesh, even=0.4, **options)),
}


@pytest.mark.parametrize("of", MAPS)
def test_only_differences_count_in_even_maps(of):
    mesh, made = MAPS[of]
    vertices, triangles = mesh()
    plain = made(vertices, triangles)
    weights = np.where(vertices[:, 0] > np.median(vertices[:, 0]), 0.5, 0.0)
    for value in (0.37, 1.0):
        assert np.array_equal(made(vertices, triangles, importance=np.full(len(vertices), value)).uv, plain.uv)
    weighed = made(vertices, triangles, importance=weights)
    assert not np.array_equal(weighed.uv, plain.uv)
    assert np.array_equal(made(vertices, triangles, importance=weights + 0.25).uv, weighed.uv)


@pytest.mark.parametrize("of", MAPS)
def test_important_faces_are_larger_in_even_maps(of):
    mesh, made = MAPS[of]
    vertices, triangles = mesh()
    chosen = vertices[:, 0] > np.quantile(vertices[:, 0], 0.6)
    shares = []
    for result in (made(vertices, triangles), made(vertices, triangles, importance=chosen.astype(float))):
        uv = result.uv if result.uv.ndim == 3 else result.uv[triangles]
        area = signed_areas(uv)
        assert result.flipped == 0 and result.overlaps == 0 and area.min() > 0
        shares.append(area[chosen[triangles].all(axis=1)].sum() / area.sum())
    assert shares[1] > 1.3 * shares[0]


def test_a_map_that_nothing_makes_even_refuses_importance():
    vertices, triangles = tube()
    with pytest.raises(koebe.OptionError, match="importance needs even above 0"):
        koebe.ring_map(vertices, triangles, importance=np.zeros(len(vertices)))
    with pytest.raises(koebe.InputError, match="importance"):
        koebe.ring_map(vertices, triangles, even=0.3, importance=np.zeros(3))
    with pytest.raises(koebe.InputError, match="importance"):
        koebe.parts(vertices, triangles, importance=np.full(len(vertices), 2.0))


def test_what_is_no_importance_is_refused():
    vertices, triangles = panel()
    count = len(vertices)
    for cut in (False, True):
        bad = (np.zeros(count - 1), *(np.full(count, value) for value in (np.nan, 1.5, -0.1)), ["a"] * count)
        for wrong in bad:
            with pytest.raises(koebe.InputError, match="importance"):
                koebe.uniformize(vertices, triangles, balance="area", importance=wrong, cut=cut)
        with pytest.raises(koebe.OptionError, match="balance"):
            koebe.uniformize(vertices, triangles, importance=np.zeros(count), cut=cut)


def test_the_command_takes_a_file(tmp_path):
    vertices, triangles = panel()
    importance, _ = region(vertices, triangles, 0, 1)
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    (tmp_path / "w.txt").write_text("\n".join(f"{w:g}" for w in importance))
    succeeded("uniformize", "in.obj", "a.obj", "--balance", "area", "--importance", "w.txt", "--json", "r.json",
                   cwd=tmp_path)  # fmt: skip
    assert json.loads((tmp_path / "r.json").read_text())["options"]["importance"] is True
    command("uniformize", "in.obj", "b.obj", "--balance", "area", cwd=tmp_path)
    assert (tmp_path / "a.obj").read_text() != (tmp_path / "b.obj").read_text()
    succeeded("parts", "in.obj", "p.obj", "--importance", "w.txt", "--json", "p.json", cwd=tmp_path)
    assert json.loads((tmp_path / "p.json").read_text())["options"]["importance"] is True
    succeeded("uniformize", "in.obj", "e.obj", "--importance", "w.txt", "--even", "0.3", cwd=tmp_path)
    refused = command("uniformize", "in.obj", "c.obj", "--importance", "w.txt", cwd=tmp_path)
    assert refused.returncode == USAGE and "balance" in refused.stderr
    for text in ("0.5 2", "x", "", "0.5"):
        (tmp_path / "w.txt").write_text(text)
        wrong = command("uniformize", "in.obj", "c.obj", "--balance", "area", "--importance", "w.txt", cwd=tmp_path)
        assert wrong.returncode not in (0, USAGE) and "importance" in wrong.stderr
    assert not (tmp_path / "c.obj").exists()
