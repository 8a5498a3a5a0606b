"""Any mesh: `koebe uniformize --cut` and `koebe.uniformize(..., cut=True)`."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, USAGE, obj_text, perforated, read_corners, succeeded, triangles_of
from cli_support import koebe as command
from uv_measures import signed_areas


def torus(m=16, n=8, thick=0.35):
    """A closed torus of m x n quadrilaterals."""
    i, j = (a.ravel() for a in np.meshgrid(np.arange(m), np.arange(n), indexing="ij"))
    a, b = 2 * np.pi * i / m, 2 * np.pi * j / n
    r = 1 + thick * np.cos(b)
    vertices = np.stack([r * np.cos(a), r * np.sin(a), thick * np.sin(b)], axis=1)

    def number(i, j):
        return (i % m) * n + j % n

    quads = np.stack([number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)], axis=1)
    return vertices, quads


def areas(uv):
    """Signed areas of (F, 3, 2), the coordinates rounded to 32 bits."""
    return signed_areas(uv.astype(np.float32).astype(float))


def test_a_torus_of_quadrilaterals_keeps_its_faces_and_gets_seams(tmp_path):
    vertices, quads = torus()
    (tmp_path / "in.obj").write_text(obj_text(vertices, quads))
    done = succeeded("uniformize", "in.obj", "out.obj", "--cut", "--json", "r.json", "--svg", "p.svg", cwd=tmp_path)
    assert done.stdout.startswith("out.obj: 1 piece, 2 cuts, angle error")
    positions, faces, corners = read_corners(tmp_path / "out.obj")
    assert np.array_equal(positions, vertices) and faces == quads.tolist()
    uv = np.array(corners)
    assert np.all((uv >= 0) & (uv <= 1))
    for triangle in ([0, 1, 2], [0, 2, 3]):
        assert np.all(areas(uv[:, triangle]) > 0)
    report = json.loads((tmp_path / "r.json").read_text())
    assert [cut["kind"] for cut in report["cuts"]] == ["handle", "opening"] and report["handles_cut"] == 1
    assert report["flipped"] == report["below_resolution"] == 0 and report["converged"] is True
    assert [warning["kind"] for warning in report["warnings"]][:1] == ["cut"]
    assert report["options"]["cut"] is True and len(report["pieces"]) == 1
    # The edges whose two sides lie apart are the cuts, no others.
    sides = {}
    for face, places in zip(faces, corners, strict=True):
        for k in range(4):
            v, w = face[k], face[(k + 1) % 4]
            ends = sorted([(v, tuple(places[k])), (w, tuple(places[(k + 1) % 4]))])
            sides.setdefault(frozenset((v, w)), []).append(ends)
    apart = {edge for edge, both in sides.items() if both[0] != both[1]}
    cut = {frozenset(e) for c in report["cuts"] for e in zip(c["elements"], c["elements"][1:], strict=False)}
    assert apart == cut


def test_without_cut_the_error_stays(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*torus()))
    refused = command("uniformize", "in.obj", "out.obj", cwd=tmp_path)
    assert refused.returncode == CANNOT_BE_MAPPED and refused.stderr.startswith("TopologyError(genus): genus 1")
    assert not (tmp_path / "out.obj").exists()


def test_what_needs_no_cut_is_mapped_as_without(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*perforated()))
    assert command("uniformize", "in.obj", "strict.obj", cwd=tmp_path).returncode == 0
    assert command("uniformize", "--cut", "in.obj", "cut.obj", cwd=tmp_path).returncode == 0
    (_, faces, strict), (_, same, cut) = (read_corners(tmp_path / name) for name in ("strict.obj", "cut.obj"))
    assert faces == same and strict == cut


def test_faces_without_a_place_stay_in_the_file(tmp_path):
    vertices, quads = perforated()
    faces = [*triangles_of(quads).tolist(), [0, 0, 1], quads[0].tolist()[:3], [2, 2, 2]]
    (tmp_path / "in.obj").write_text(obj_text(vertices, faces))
    succeeded("uniformize", "--cut", "in.obj", "out.obj", "--json", "r.json", cwd=tmp_path)
    _, written, corners = read_corners(tmp_path / "out.obj")
    assert written == faces
    assert corners[-2] == corners[0]  # drawn over the face that it repeats
    assert len({tuple(c) for c in corners[-3]}) == len({tuple(c) for c in corners[-1]}) == 1  # on one point
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["left_out"] == [{"face": len(faces) - 2, "like": 0}]
    kinds = {warning["kind"]: warning["elements"] for warning in report["warnings"]}
    assert kinds["collapsed_faces"] == [len(faces) - 3, len(faces) - 1]
    assert kinds["left_out"] == [len(faces) - 2]


def test_a_turned_face_is_named_as_the_file_counts_it(tmp_path):
    vertices, quads = torus()
    quads[5] = quads[5][::-1]
    (tmp_path / "in.obj").write_text(obj_text(vertices, quads))
    assert command("torus", "in.obj", "out.obj", "--json", "r.json", cwd=tmp_path).returncode == 0
    assert json.loads((tmp_path / "r.json").read_text())["turned"] == [5]


def test_a_polygon_that_is_none_is_left_out(tmp_path):
    vertices, quads = perforated()
    faces = [*quads.tolist(), [0, 1, 0, 2]]
    (tmp_path / "in.obj").write_text(obj_text(vertices, faces))
    assert command("uniformize", "in.obj", "out.obj", cwd=tmp_path).returncode == CANNOT_BE_MAPPED
    succeeded("uniformize", "--cut", "in.obj", "out.obj", "--json", "r.json", cwd=tmp_path)
    _, written, corners = read_corners(tmp_path / "out.obj")
    assert written == faces and len({tuple(c) for c in corners[-1]}) == 1
    first = json.loads((tmp_path / "r.json").read_text())["warnings"][0]
    assert (first["kind"], first["elements"]) == ("left_out", [len(faces) - 1])


def test_ply_has_the_corners_of_obj(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*torus()))
    for name in ("out.obj", "out.ply"):
        assert command("uniformize", "--cut", "in.obj", name, cwd=tmp_path).returncode == 0
    _, _, corners = read_corners(tmp_path / "out.obj")
    header, body = (tmp_path / "out.ply").read_text().split("end_header\n")
    assert header.endswith("property list uchar double texcoord\n")
    lines = body.splitlines()[-len(corners) :]
    of_ply = [np.array(line.split()[6:], dtype=float).reshape(4, 2).tolist() for line in lines]
    assert of_ply == corners


def test_schedules_are_about_the_loops_of_one_surface(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(*torus()))
    wrong = ["uniformize", "--cut", "--engine", "mesh", "--schedule", "0,1", "in.obj", "out.obj"]
    assert command(*wrong, cwd=tmp_path).returncode == USAGE
    with pytest.raises(koebe.OptionError, match="cut excludes"):
        koebe.uniformize(*torus(), cut=True, engine="mesh", record_steps=True)


def test_python_gives_the_uvs_of_corners():
    vertices, quads = torus()
    triangles = triangles_of(quads)
    result = koebe.uniformize(vertices, triangles, cut=True)
    assert isinstance(result, koebe.CutResult) and result.uv.shape == (len(triangles), 3, 2)
    assert np.all(areas(result.uv) > 0) and result.flipped == 0 and len(result.flipped_faces) == 0
    assert [cut["kind"] for cut in result.cuts] == ["handle", "opening"] and result.handles_cut == 1
    assert np.array_equal(np.unique(result.piece), [0])
    assert result.warnings[0].kind == "cut" and result.warnings[0].of == "vertices"
    assert result.to_dict()["options"]["cut"] is True and "CutResult" in repr(result)
    with pytest.raises(koebe.TopologyError):
        koebe.uniformize(vertices, triangles)


def test_python_takes_degenerate_faces_with_cut_alone():
    vertices, quads = perforated()
    triangles = np.concatenate([triangles_of(quads), [[0, 0, 1], quads[0, [1, 0, 2]]]])
    with pytest.raises(koebe.InputError, match="same vertex twice"):
        koebe.uniformize(vertices, triangles)
    result = koebe.uniformize(vertices, triangles, cut=True)
    assert result.piece[-2:].tolist() == [-1, -1] and result.left_out[-1]["like"] == 0
    assert np.array_equal(result.uv[-1], result.uv[0][[1, 0, 2]])
    assert np.isfinite(result.uv).all()


def test_a_batch_cuts_too_and_knows_what_it_has_done(tmp_path):
    (tmp_path / "in").mkdir()
    (tmp_path / "in" / "torus.obj").write_text(obj_text(*torus()))
    (strict,) = koebe.batch(tmp_path / "in", tmp_path / "out")
    assert strict["exit_code"] == CANNOT_BE_MAPPED and strict["error"] == "TopologyError(genus)"
    (row,) = koebe.batch(tmp_path / "in", tmp_path / "out", cut=True)
    assert row["exit_code"] == 0 and row["flipped"] == 0 and row["options"]["cut"] is True
    written = (tmp_path / "out" / "torus.obj").stat().st_mtime_ns
    koebe.batch(tmp_path / "in", tmp_path / "out", cut=True)
    assert (tmp_path / "out" / "torus.obj").stat().st_mtime_ns == written
    wrong = command("batch", "in", "--output", "out", "--cut", "--engine", "mesh", "--schedule", "0,1", cwd=tmp_path)
    assert wrong.returncode == USAGE
