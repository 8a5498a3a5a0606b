"""koebe fill: holes filled, and labelled in the file."""

import re

import numpy as np
import pytest
from cli_support import USAGE, Obj, koebe, names, obj_text, perforated, succeeded


def border_of(faces):
    edges = {(f[i], f[(i + 1) % len(f)]) for f in faces for i in range(len(f))}
    return {e for e in edges if (e[1], e[0]) not in edges}


def test_fill_leaves_the_longest_loop_open_and_labels_the_patches(mesh):
    vertices, quads = perforated()
    run = succeeded("fill", mesh / "in.obj", mesh / "out.obj")
    assert re.fullmatch(r".*out\.obj: 3 loops filled, \d+ faces added, [0-9.]+ s\n", run.stdout), run.stdout
    out = Obj(mesh / "out.obj")
    assert np.array_equal(out.vertices[: len(vertices)], vertices)
    assert out.faces[: len(quads)] == [tuple(q) for q in quads]
    rim = {(i, j) for i, j in border_of(quads.tolist()) if np.isin(vertices[[i, j], :2], (0.0, 1.0)).any(axis=1).all()}
    assert border_of(out.faces) == rim and len(rim) == 4 * 24
    assert out.groups[0] == ("surface", 0)
    assert [name for name, _ in out.groups[1:]] == ["patch_1", "patch_2", "patch_3"]
    assert out.groups[1][1] == len(quads)


def test_fill_all_closes_the_surface(mesh):
    run = succeeded("fill", mesh / "in.obj", mesh / "out.obj", "--all")
    assert ": 4 loops filled, " in run.stdout, run
    out = Obj(mesh / "out.obj")
    assert border_of(out.faces) == set()
    assert [name for name, _ in out.groups] == ["surface", "patch_0", "patch_1", "patch_2", "patch_3"]
    again = succeeded("fill", mesh / "out.obj", mesh / "again.obj")  # nothing is left
    assert re.search(r"again\.obj: 0 loops filled, 0 faces added, \S+ s, 1 warning: there is no hole", again.stdout)
    assert Obj(mesh / "again.obj").faces == out.faces


def test_fill_leaves_the_loop_of_a_vertex_open(mesh):
    vertices, quads = perforated()
    ring = np.flatnonzero(np.abs(np.linalg.norm(vertices[:, :2] - [0.7, 0.35], axis=1) - 0.1) < 1e-9)
    run = succeeded("fill", mesh / "in.obj", mesh / "out.obj", "--outer", ring[3])
    assert {v for edge in border_of(Obj(mesh / "out.obj").faces) for v in edge} == set(ring)
    inner = int(np.argmin(np.linalg.norm(vertices[:, :2] - [0.5, 0.5], axis=1)))
    for bad in (inner, len(vertices)):
        run = koebe("fill", mesh / "in.obj", mesh / "new.obj", "--outer", bad)
        assert run.returncode == USAGE and re.fullmatch(rf"WrongUsage: --outer: .*{bad}.*\n", run.stderr), run.stderr
    assert names(mesh) == {"in.obj", "out.obj"}


def test_fill_of_chosen_loops_leaves_the_others_open(mesh):
    _, quads = perforated()
    succeeded("fill", mesh / "in.obj", mesh / "out.obj", "--loops", "1,3")
    out = Obj(mesh / "out.obj")
    assert [name for name, _ in out.groups] == ["surface", "patch_1", "patch_3"]
    still_open = border_of(out.faces)
    assert still_open < border_of(quads.tolist())
    assert koebe("uniformize", mesh / "out.obj", mesh / "map.obj").stdout.count("2 loops") == 1
    outside = koebe("fill", mesh / "in.obj", mesh / "out.obj", "--loops", "4")
    assert outside.returncode == USAGE
    said = "WrongUsage: --loops: there is no boundary loop 4: the surface has 4 loops, numbered from 0\n"
    assert outside.stderr == said


def test_fill_keeps_polygons_that_lie_the_wrong_way_round_and_names_them(mesh):
    """The patches fit the other faces: with the polygon turned by hand the filled surface is closed."""
    vertices, quads = perforated()
    text = obj_text(vertices, [q[::-1] if i == 7 else q for i, q in enumerate(quads)])
    (mesh / "in.obj").write_text(text)
    run = succeeded("fill", mesh / "in.obj", mesh / "out.obj", "--all")
    assert "kept in the other orientation" in run.stdout and "is 7" in run.stdout
    kept = [line for line in (mesh / "out.obj").read_text().splitlines() if line.startswith("f ")]
    assert kept[: len(quads)] == [line for line in text.splitlines() if line.startswith("f ")]
    faces = Obj(mesh / "out.obj").faces
    faces[7] = faces[7][::-1]
    assert border_of(faces) == set()


@pytest.mark.parametrize("scale", [1e308, 1.7e308, 1e-300, 5e-324])
def test_fill_is_finite_at_the_ends_of_the_numbers(mesh, scale):
    vertices, quads = perforated()
    with np.errstate(over="ignore"):
        huge = np.clip((2.0 * vertices - 1.0) * scale, -1.7e308, 1.7e308)
    (mesh / "in.obj").write_text(obj_text(huge, quads))
    succeeded("fill", mesh / "in.obj", mesh / "out.obj", "--all")
    out = Obj(mesh / "out.obj").vertices
    assert np.isfinite(out).all()
    assert (out.min(axis=0) >= huge.min(axis=0)).all() and (out.max(axis=0) <= huge.max(axis=0)).all()
