"""Error bars of modules, on domains whose modules are known; and tables of families."""

import csv

import koebe
import numpy as np
import pytest
from cli_support import (
    CANNOT_BE_MAPPED,
    USAGE,
    cells,
    obj_text,
    succeeded,
    triangles_of,
    triangulated_plate,
)
from cli_support import koebe as command


class Circles:
    def __init__(self, holes):
        self.centers = np.array([(0.0, 0.0), *(hole[:2] for hole in holes)])
        self.radii = np.array([1.0, *(hole[2] for hole in holes)])


def cut_round(points, quads, middle, radius, inside):
    """Quadrilaterals on one side of a circle, those at it with their vertices moved onto it."""
    gone = (np.linalg.norm(points[quads].mean(axis=1) - middle, axis=1) < radius) != inside
    rim = np.intersect1d(quads[gone], quads[~gone])
    arm = points[rim] - middle
    points[rim] = middle + radius * arm / np.linalg.norm(arm, axis=1, keepdims=True)
    return quads[~gone]


def round_domain(n, holes, turn):
    """The unit disk without round holes, in squares of a turned grid: points z and triangles."""
    t = np.linspace(-1.2, 1.2, n + 1)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    points = np.stack([a.ravel() for a in np.meshgrid(t, t)], axis=1) @ rotation
    quads = cut_round(points, cells(n, n), 0.0, 1.0, True)
    for *middle, radius in holes:
        quads = cut_round(points, quads, middle, radius, False)
    used, quads = np.unique(quads, return_inverse=True)
    quads, points = quads.reshape(-1, 4), points[used]
    first, second = (np.linalg.norm(points[quads[:, k]] - points[quads[:, k + 2]], axis=1) for k in (0, 1))
    return points @ [1, 1j], triangles_of(np.where((first <= second)[:, None], quads, np.roll(quads, -1, 1)))


LIFTS = {  # conformal ones
    "plane": lambda z: (z.real, z.imag, 0.0 * z.real),
    "polynomial": lambda z: LIFTS["plane"](z + 0.3 * z**2 + 0.05j * z**3),
    "sphere": lambda z: np.array([2 * z.real, 2 * z.imag, abs(z) ** 2 - 1]) / (1 + abs(z) ** 2),
    "enneper": lambda z: ((z - z**3 / 3).real, -(1j * (z + z**3 / 3)).real, (z**2).real),
}


def random_holes(rng):
    holes = []
    while len(holes) < rng.integers(1, 4):
        (x, y), radius = rng.uniform(-0.7, 0.7, 2), rng.uniform(0.08, 0.2)
        if np.hypot(x, y) + radius < 0.88 and all(np.hypot(x - a, y - b) > radius + r + 0.15 for a, b, r in holes):
            holes.append((x, y, radius))
    return holes


def test_errors_of_exact_domains_lie_within_their_bars():
    rng = np.random.default_rng(2)
    within, over = [], []
    for number in range(20):
        holes = random_holes(rng)
        z, faces = round_domain(int(rng.choice([24, 32, 48])), holes, rng.uniform(0, 1))
        vertices = np.stack(list(LIFTS.values())[number % 4](z), axis=1)
        rims = koebe.boundary_loops(faces.astype(np.int32))

        def rim_of(x, y, radius, rims=rims, z=z):
            return min(rims, key=lambda rim: abs(abs(z[rim] - (x + 1j * y)) - radius).max())

        vertex = [int(rim_of(*circle)[0]) for circle in [(0.0, 0.0, 1.0), *holes]]
        result = koebe.uniformize(vertices, faces.astype(np.int32), outer=vertex[0])
        order = [next(k for k, loop in enumerate(result.loops) if v in loop) for v in vertex]
        error = abs(koebe.conformal_module(result, order=order) - koebe.conformal_module(Circles(holes)))
        bar = koebe.module_error(result, order=order)
        assert (bar > 0).all()
        within.append(error <= bar)
        over.append(np.linalg.norm(bar) / np.linalg.norm(error))
    assert np.concatenate(within).mean() > 0.9
    assert np.median(over) < 10 and np.percentile(over, 90) < 30


HOLES = np.array([(0.3, 0.3, 0.17), (0.75, 0.35, 0.08), (0.4, 0.72, 0.12)])


def shape(change, n=20):
    return triangulated_plate(n, HOLES + change)


def test_the_bar_falls_with_the_mesh_width_and_knows_no_size():
    bars = [np.linalg.norm(koebe.module_error(koebe.uniformize(*shape(0.0, n)))) for n in (20, 80)]
    assert bars[1] < 0.4 * bars[0]
    vertices, faces = shape(0.0)
    large = koebe.module_error(koebe.uniformize(1e6 * vertices, faces))
    assert np.allclose(large, koebe.module_error(koebe.uniformize(vertices, faces)), rtol=1e-3)


def test_a_saved_result_has_the_same_bars(tmp_path):
    result = koebe.uniformize(*shape(0.0))
    result.save(tmp_path / "face.npz")
    assert np.array_equal(koebe.module_error(koebe.load(tmp_path / "face.npz")), koebe.module_error(result))
    with pytest.raises(TypeError, match="result of uniformize"):
        koebe.module_error(Circles(HOLES))


RNG = np.random.default_rng(5)
SURFACES = {f"face {k}.obj": shape(0.01 * RNG.standard_normal((3, 3))) for k in range(3)}


@pytest.fixture
def folder(tmp_path):
    where = tmp_path / "faces"
    where.mkdir()
    for name, surface in SURFACES.items():
        (where / name).write_text(obj_text(*surface))
    (where / "notes.txt").write_text("no mesh")
    return where


def rows_of(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_the_command_makes_the_table_of_a_family(folder, tmp_path):
    family = koebe.family([koebe.uniformize(*s) for s in SURFACES.values()], labels=list(SURFACES), error=True)
    done = command("module", folder, "--csv", tmp_path / "modules.csv", "--error")
    assert (done.returncode, done.stdout) == (0, "")
    rows = rows_of(tmp_path / "modules.csv")
    assert [row["label"] for row in rows] == list(SURFACES) and {row["note"] for row in rows} == {""}
    assert np.allclose([[float(row[c]) for c in family.columns] for row in rows], family.modules, atol=1e-9)
    bars = [[float(row[f"{c}_error"]) for c in family.columns] for row in rows]
    assert np.allclose(bars, family.errors, atol=1e-6)
    family.to_csv(tmp_path / "python.csv")
    mine = [{name: text for name, text in row.items() if name != "note"} for row in rows]
    assert [list(row) for row in rows_of(tmp_path / "python.csv")] == [list(row) for row in mine]


def test_the_command_makes_the_table_of_distances(folder, tmp_path):
    names = list(SURFACES)
    family = koebe.family([koebe.uniformize(*s) for s in SURFACES.values()], reference=1, error=True)
    succeeded("compare", folder, "--csv", tmp_path / "far.csv", "--reference", names[1], "--error")
    rows = rows_of(tmp_path / "far.csv")
    assert [(row["a"], row["b"]) for row in rows] == [(names[0], names[1]), (names[0], names[2]), (names[1], names[2])]
    pairs = ([0, 0, 1], [1, 2, 2])
    assert np.allclose([float(row["distance"]) for row in rows], family.distances[pairs], atol=1e-9)
    assert np.allclose([float(row["distance_error"]) for row in rows], family.distance_errors[pairs], atol=1e-6)
    assert command("compare", folder / names[0], folder / names[2], "--csv", tmp_path / "two.csv").returncode == 0
    assert len(rows_of(tmp_path / "two.csv")) == 1


def test_shapes_that_cannot_be_mapped_have_a_row_that_says_so(folder, tmp_path):
    (folder / "bad, closed.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    (folder / "other.obj").write_text(obj_text(*flat_ring()))
    done = command("module", folder, "--csv", tmp_path / "modules.csv")
    assert done.returncode == CANNOT_BE_MAPPED and "2 of 5 shapes" in done.stderr
    rows = {row["label"]: row for row in rows_of(tmp_path / "modules.csv")}
    assert rows["bad, closed.obj"]["note"].startswith("TopologyError(closed)")
    assert rows["bad, closed.obj"]["r_1"] == rows["other.obj"]["y_2"] == "NA" and "loops" in rows["other.obj"]["note"]
    assert float(rows["face 1.obj"]["r_1"]) > 0.0
    assert command("compare", folder, "--csv", tmp_path / "far.csv").returncode == CANNOT_BE_MAPPED
    assert sum(row["distance"] == "NA" for row in rows_of(tmp_path / "far.csv")) == 7


def flat_ring():
    return triangulated_plate(12, HOLES[:1])


def test_tables_are_asked_for_in_the_right_words(folder, tmp_path):
    table = tmp_path / "t.csv"
    for words, says in (
        (("module", folder), "--csv"),
        (("compare", folder / "face 0.obj", folder / "face 1.obj", "--error"), "--csv"),
        (("compare", folder, "--csv", table, "--loops", "length"), "--loops"),
        (("compare", folder / "face 0.obj", folder / "face 1.obj", "--reference", "x"), "--csv"),
    ):
        done = command(*words)
        assert done.returncode == USAGE and says in done.stderr
    done = command("module", folder, "--csv", table, "--reference", "absent.obj")
    assert done.returncode == CANNOT_BE_MAPPED and "absent.obj" in done.stderr
    (tmp_path / "empty").mkdir()
    assert "holds no OBJ" in command("module", tmp_path / "empty", "--csv", table).stderr
    assert not table.exists()
