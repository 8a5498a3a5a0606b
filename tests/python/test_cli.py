"""The koebe command: files in, files out, exit codes, and what it prints."""

import contextlib
import json
import os
import pty
import re
import resource
import signal
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from cli_support import (
    CANNOT_BE_MAPPED,
    COMMAND,
    INTERRUPTED,
    NOT_CONVERGED,
    ROOT,
    USAGE,
    Obj,
    disk,
    koebe,
    names,
    obj_text,
    off_text,
    perforated,
    ply_bytes,
    stl_text,
    succeeded,
    triangles_of,
    triangulated_plate,
)

HOSTILE = sorted((ROOT.parent / "shared" / "meshes" / "hostile").glob("*"))


# ---------------------------------------------------------------- uniformize


def test_out_has_the_same_vertices_and_polygons_and_circles_for_holes(mesh):
    vertices, quads = perforated()
    succeeded("uniformize", mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json")
    out = Obj(mesh / "out.obj")
    assert np.array_equal(out.vertices, vertices)  # to the last bit
    assert out.faces == [tuple(q) for q in quads]
    assert out.uv.shape == (len(vertices), 2)
    assert out.uv.min() >= 0.0 and out.uv.max() <= 1.0

    report = json.loads((mesh / "report.json").read_text())
    assert len(report["loops"]) == 4
    assert report["loops"][0]["center"] == [0.0, 0.0] and report["loops"][0]["radius"] == 1.0
    for loop in report["loops"]:
        distance = np.linalg.norm(disk(out.uv)[loop["vertices"]] - loop["center"], axis=1)
        assert np.abs(distance - loop["radius"]).max() < 1e-6
    on_loops = [v for loop in report["loops"] for v in loop["vertices"]]
    assert len(on_loops) == len(set(on_loops))
    assert report["flipped"] == 0
    corners = disk(out.uv)[quads]
    a, b = corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]
    assert (a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]).min() > 0.0  # twice the areas


def test_prints_one_result_line_and_nothing_else(mesh):
    run = koebe("uniformize", mesh / "in.obj", mesh / "out.obj")
    number = r"[0-9.]+"
    assert re.fullmatch(
        rf"{re.escape(str(mesh / 'out.obj'))}: 4 loops, \d+ sweeps?, roundness {number}e-\d\d, "
        rf"angle error {number} deg, 0 flipped, {number} s\n",
        run.stdout,
    ), run.stdout
    assert run.stderr == ""
    quiet = koebe("uniformize", mesh / "in.obj", mesh / "out.obj", "--quiet")
    assert (quiet.returncode, quiet.stdout, quiet.stderr) == (0, "", "")
    assert names(mesh) == {"in.obj", "out.obj"}


def test_the_report_has_the_keys_of_the_contract(mesh):
    koebe("uniformize", mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json", "--method", "gk")
    report = json.loads((mesh / "report.json").read_text())
    assert list(report) == [
        *("version", "input", "vertices", "faces", "method", "engine", "outer_loop", "converged", "sweeps", "steps"),
        *("history", "loops", "mean_roundness", "even", "overlaps", "angle_error_deg", "angle_error_stored_deg"),
        *("lost_area", "beltrami"),
        *("area_distortion", "conformal_energy"),
        *("flipped", "below_resolution", "concave_polygons", "seconds", "peak_memory_mb", "warnings", "input_sha256"),
        "options",
    ]
    assert report["input"] == "in.obj"
    assert report["vertices"] == len(perforated()[0])
    assert (report["method"], report["engine"], report["converged"]) == ("gk", "condensed", True)
    for step in report["history"]:
        assert list(step) == ["step", "pair", "change", "mean_roundness", "mean_roundness_holes"]
    assert len(report["history"]) == report["steps"] > 0
    assert set(report["loops"][0]) == {
        *("vertices", "center", "radius", "roundness", "roundness_least_squares"),
        *("roundness_projected", "off_circle", "own_circle"),
    }
    assert list(report["seconds"]) == [*("read", "topology", "metric", "factor", "iterate", "finish", "write", "total")]
    parts = [value for stage, value in report["seconds"].items() if stage != "total"]
    assert 0.0 < sum(parts) <= report["seconds"]["total"]
    assert report["peak_memory_mb"] > 1.0


def test_every_format_gives_the_same_map(mesh):
    vertices, quads = perforated()
    (mesh / "in.off").write_text(off_text(vertices, quads))
    (mesh / "in.ply").write_bytes(ply_bytes(vertices, quads))
    outs = []
    for name in ("in.obj", "in.off", "in.ply"):
        assert koebe("uniformize", mesh / name, mesh / "out.obj").returncode == 0
        out = Obj(mesh / "out.obj")
        outs.append((out.vertices.tolist(), out.uv.tolist(), out.faces))
    assert outs[0] == outs[1] == outs[2]  # to the last bit, and from run to run


def test_stl_corners_become_shared_vertices(mesh):
    vertices, quads = perforated()
    (mesh / "in.STL").write_text(stl_text(vertices, triangles_of(quads)))
    succeeded("uniformize", mesh / "in.STL", mesh / "out.obj")
    out = Obj(mesh / "out.obj")
    assert len(out.vertices) == len(vertices)
    assert np.array_equal(out.vertices[np.array(out.faces)], vertices[triangles_of(quads)])


def test_outer_picks_the_loop_of_the_unit_circle(mesh):
    koebe("uniformize", mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json")
    hole = json.loads((mesh / "report.json").read_text())["loops"][2]["vertices"]
    run = succeeded("uniformize", mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json", "--outer", hole[1])
    report = json.loads((mesh / "report.json").read_text())
    assert set(report["loops"][0]["vertices"]) == set(hole)
    uv = disk(Obj(mesh / "out.obj").uv)
    assert np.abs(np.linalg.norm(uv[hole], axis=1) - 1.0).max() < 1e-12

    inner = next(v for v in range(len(perforated()[0])) if all(v not in loop["vertices"] for loop in report["loops"]))
    for bad in (inner, 10**6):
        run = koebe("uniformize", mesh / "in.obj", mesh / "out.obj", "--outer", bad)
        assert run.returncode == USAGE and re.fullmatch(rf"WrongUsage: --outer: .*{bad}.*\n", run.stderr), run.stderr


@pytest.mark.parametrize("command", ["uniformize", "ricci"])
def test_center_goes_to_0_and_point_to_1(mesh, command):
    koebe(command, mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json")
    plain = json.loads((mesh / "report.json").read_text())
    assert not {"center", "point"} & plain.keys()
    # The flow does not converge with a hole outside.
    hole = plain["loops"][2 if command == "uniformize" else 0]["vertices"]
    rim = {v for loop in plain["loops"] for v in loop["vertices"]}
    inside = next(v for v in range(len(perforated()[0])) if v not in rim)
    places = ["--center", inside, "--point", hole[1]]
    run = succeeded(command, mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json", *places)
    uv, report = Obj(mesh / "out.obj").uv, json.loads((mesh / "report.json").read_text())
    assert uv[inside].tolist() == [0.5, 0.5] and uv[hole[1]].tolist() == [1.0, 0.5]
    assert (report["center"], report["point"], report["flipped"]) == (inside, hole[1], 0)
    assert set(report["loops"][0]["vertices"]) == set(hole)
    for loop in report["loops"]:
        away = np.abs(np.linalg.norm(disk(uv)[loop["vertices"]] - loop["center"], axis=1) - loop["radius"])
        assert away.max() < (1e-12 if command == "uniformize" else 0.05)

    longest, hole = plain["loops"][0]["vertices"][0], plain["loops"][2]["vertices"]
    for option, bad, more in (
        ("--center", 10**6, []), ("--center", hole[0], []), ("--point", 10**6, []), ("--point", inside, []),
        ("--point", hole[0], ["--outer", longest]), ("--point", hole[0], ["--outer", "longest"]),
    ):  # fmt: skip
        run = koebe(command, mesh / "in.obj", mesh / "new.obj", option, bad, *more)
        assert run.returncode == USAGE and re.fullmatch(rf"WrongUsage: {option}: .*{bad}.*\n", run.stderr), run.stderr
        assert not (mesh / "new.obj").exists()


def test_vertices_of_no_face_and_faces_of_no_area_stay_in_the_file(tmp_path):
    vertices, quads = perforated()
    text = "v 9 9 9\n" + obj_text(vertices, quads + 1) + "v 8 8 8\n" + "f 2 2 3\n"
    (tmp_path / "in.obj").write_text(text)
    succeeded("uniformize", tmp_path / "in.obj", tmp_path / "out.obj", "--json", tmp_path / "report.json")
    out = Obj(tmp_path / "out.obj")
    assert np.array_equal(out.vertices, [[9, 9, 9], *vertices, [8, 8, 8]])
    assert out.faces[-1] == (1, 1, 2) and len(out.faces) == len(quads) + 1
    warnings = json.loads((tmp_path / "report.json").read_text())["warnings"]
    # The number of the face that was passed over.
    assert any(w["kind"] == "collapsed_faces" and w["elements"] == [len(quads)] for w in warnings), warnings


def test_svg_shows_every_circle(mesh):
    succeeded("uniformize", mesh / "in.obj", mesh / "out.obj", "--svg", mesh / "picture.svg")
    svg = ElementTree.parse(mesh / "picture.svg").getroot()
    tag = "{http://www.w3.org/2000/svg}"
    assert svg.get("viewBox")
    holes = [g for g in svg.iter(tag + "g") if g.get("class") == "holes"]
    assert len(holes[0].findall(tag + "circle")) == 3
    assert list(svg.iter(tag + "path"))


def test_out_may_be_in(mesh):
    before = Obj(mesh / "in.obj")
    assert koebe("uniformize", mesh / "in.obj", mesh / "in.obj").returncode == 0
    after = Obj(mesh / "in.obj")
    assert np.array_equal(before.vertices, after.vertices) and before.faces == after.faces
    assert len(after.uv) == len(after.vertices)


# ---------------------------------------------------------------- exit codes


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["flatten"],
        ["uniformize"],
        ["uniformize", "in.obj"],
        ["uniformize", "in.obj", "out.obj", "more"],
        ["uniformize", "in.obj", "out.obj", "--speed", "9"],
        ["uniformize", "in.obj", "out.obj", "--method", "tutte"],
        ["uniformize", "in.obj", "out.obj", "--engine", "steam"],
        ["uniformize", "in.obj", "out.obj", "--balance", "angle"],
        ["uniformize", "in.obj", "out.obj", "--outer", "-1"],
        ["uniformize", "in.obj", "out.obj", "--outer", "short"],
        ["uniformize", "in.obj", "out.obj", "--center", "-1"],
        ["uniformize", "in.obj", "out.obj", "--point", "first"],
        ["uniformize", "in.obj", "out.obj", "--center", "60", "--balance", "area"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "0"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "nan"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "1e-3x"],
        ["uniformize", "in.obj", "out.obj", "--max-sweeps", "0"],
        ["uniformize", "in.obj", "out.obj", "--max-sweeps", "1.5"],
        ["uniformize", "in.obj", "out.obj", "--threads", "-1"],
        ["uniformize", "in.obj", "out.obj", "--threads", "99999999999"],
        ["uniformize", "in.obj", "out.obj", "--json"],
        ["uniformize", "in.obj", "out.obj", "--json", "./out.obj"],
        ["fill", "in.obj", "out.obj", "--loops", "one"],
        ["fill", "in.obj", "out.obj", "--loops", "-1"],
        ["fill", "in.obj", "out.obj", "--all", "--loops", "1"],
        ["fill", "in.obj", "out.obj", "--all", "--outer", "1"],
        ["fill", "in.obj", "out.obj", "--outer", "auto"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "-1e-6"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "inf"],
        ["uniformize", "in.obj", "out.obj", "--tolerance", "1e999"],
        ["uniformize", "in.obj", "out.obj", "--max-sweeps", "-5"],
        ["uniformize", "in.obj", "out.obj", "--max-sweeps", "2147483648"],
        ["uniformize", "in.obj", "out.obj", "--outer", "99999"],
        ["uniformize", "in.obj", "out.obj", "--outer", "1.0"],
        ["uniformize", "in.obj", "out.obj", "--outer", ""],
        ["ricci", "in.obj", "out.obj", "--outer", "99999"],
        ["module", "in.obj", "--loops", "0,1,2,9"],
        ["module", "in.obj", "--loops", "short"],
        ["module", "in.obj", "--tolerance", "nan"],
        ["compare", "in.obj"],
        ["compare", "in.obj", "in.obj", "--loops", "best"],
        ["compare", "in.obj", "in.obj", "--any-outer", "--loops", "length"],
        ["ricci", "in.obj"],
        ["ricci", "in.obj", "out.obj", "--method", "gk"],
        ["ricci", "in.obj", "out.obj", "--packing", "obtuse"],
        ["ricci", "in.obj", "out.obj", "--target", "round"],
        ["ricci", "in.obj", "out.obj", "--triangulation", "fan"],
        ["ricci", "in.obj", "out.obj", "--svg", "out.obj"],
    ],
)
def test_wrong_usage_is_2_and_writes_nothing(mesh, arguments):
    run = koebe(*arguments, cwd=mesh)
    assert run.returncode == USAGE
    assert run.stdout == "" and re.fullmatch(r"WrongUsage: \S.*\n", run.stderr), run.stderr  # one line
    assert names(mesh) == {"in.obj"}


@pytest.mark.parametrize(
    "arguments", [["--help"], ["--version"], ["uniformize", "--help"], ["fill", "--help"], ["ricci", "--help"]]
)
def test_help_and_version_are_0(arguments):
    run = succeeded(*arguments)
    assert run.stdout and not run.stderr


def test_not_converged_is_4_and_all_files_are_written(mesh):
    run = koebe(
        *("uniformize", mesh / "in.obj", mesh / "out.obj", "--max-sweeps", 1, "--tolerance", 1e-14),
        *("--json", mesh / "report.json", "--svg", mesh / "picture.svg"),
    )
    assert run.returncode == NOT_CONVERGED
    assert run.stdout.endswith(" s, not converged, 1 warning: not converged in 1 sweep\n"), run.stdout
    assert names(mesh) == {"in.obj", "out.obj", "report.json", "picture.svg"}
    assert json.loads((mesh / "report.json").read_text())["converged"] is False


def assert_one_line_and_no_file(run, folder, before, error=r"\w+Error"):
    """Exit code 3, and an error line that starts with a match of `error`."""
    assert run.returncode == CANNOT_BE_MAPPED, (run.returncode, run.stdout, run.stderr)
    assert run.stdout == ""
    assert re.fullmatch(r"\w+(\(\w+\))?: \S.*\n", run.stderr), run.stderr  # one line
    assert re.match(error, run.stderr), run.stderr
    assert names(folder) == before


@pytest.mark.parametrize("option", ["OUT", "--json", "--svg"])
def test_files_that_cannot_be_written_are_found_before_the_mesh_is_read(tmp_path, option):
    (tmp_path / "folder.obj").mkdir()
    for bad in (tmp_path / "missing" / "out.obj", tmp_path / "folder.obj"):
        files = [bad] if option == "OUT" else [tmp_path / "out.obj", option, bad]
        run = koebe("uniformize", tmp_path / "no_such.obj", *files)
        assert_one_line_and_no_file(run, tmp_path, {"folder.obj"}, "FileError: cannot write")


def test_a_full_disk_is_3_and_leaves_the_other_files_alone(mesh):
    (mesh / "out.obj").write_text("old")
    limit = 30000  # bytes; less than OUT has
    run = koebe(
        *("uniformize", mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json"),
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit)),
    )
    assert_one_line_and_no_file(run, mesh, {"in.obj", "out.obj"}, "FileError: cannot write .*out.obj")
    assert (mesh / "out.obj").read_text() == "old"


def test_a_missing_mesh_is_3(tmp_path):
    run = koebe("uniformize", tmp_path / "in.obj", tmp_path / "out.obj")
    assert_one_line_and_no_file(run, tmp_path, set(), "FileError: cannot read")


def tube(n=12, m=5, twist=False, close=False):
    """A cylinder of n x m cells; its ends glued into a torus, or the strip into a Moebius band."""
    around, along = np.meshgrid(np.arange(n), np.arange(m if close else m + 1))
    angle = 2.0 * np.pi * around.ravel() / n
    height = along.ravel() / m
    vertices = np.stack([np.cos(angle), np.sin(angle), height], axis=1)
    index = lambda i, j: (j % m if close else j) * n + i % n  # noqa: E731
    cells = [(i, j) for j in range(m) for i in range(n - 1 if twist else n)]
    quads = [[index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)] for i, j in cells]
    if twist:
        quads += [[index(n - 1, j), index(0, m - j), index(0, m - j - 1), index(n - 1, j + 1)] for j in range(m)]
    return vertices, triangles_of(np.array(quads))


def hostile_meshes():
    """Name, file and bytes, and what the error line starts with."""
    vertices, triangles = triangulated_plate(8, ((0.5, 0.5, 0.2),))
    good = obj_text(vertices, triangles)
    two = obj_text(np.concatenate([vertices, vertices + 5]), np.concatenate([triangles, triangles + len(vertices)]))
    closed = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
    whole, cells = perforated(8, ())
    bowtie = obj_text(whole, np.delete(cells, [8 * 3 + 3, 8 * 4 + 4], axis=0))  # two holes that share a corner
    cases = [
        ("empty", "in.obj", "", "InputError"),
        ("nan", "in.obj", good.replace("v 0.0 0.0", "v nan 0.0", 1), "InputError: vertex 0 is not three"),
        ("past_the_end", "in.obj", good + "f 1 2 999\n", "InputError: 1 faces"),
        ("garbage", "in.obj", "v 0 0 0\nv 1 one 1\n", "InputError: vertex 1 is not three"),
        ("binary_noise", "in.stl", bytes(range(256)) * 8, "InputError"),
        ("huge_counts", "in.off", "OFF\n2000000000 2000000000 0\n", "InputError: the header's count"),
        ("cut_short", "in.ply", ply_bytes(vertices, triangles)[:-7], r"InputError: face \d+ is missing"),
        ("format", "in.gltf", b"glTF\2\0\0\0", "InputError: format not supported: '.gltf'; supported are OBJ"),
        ("all_collapsed", "in.obj", "v 0 0 0\nv 1 0 0\nf 1 1 2\n", "InputError"),
        ("wound_polygon", "in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf" + " 1 2 4 3" * 234 + "\n", "InputError"),
        ("one_point", "in.obj", re.sub(r"v .*", "v 1 1 1", good), "InputError: all vertices lie on one point"),
        ("third_face", "in.obj", good + f"v 9 9 9\nf 1 2 {len(vertices) + 1}\nf 2 1 {len(vertices) + 1}\n",
         r"TopologyError\(nonmanifold_edge\)"),
        ("bowtie", "in.obj", bowtie, r"TopologyError\(nonmanifold_vertex\)"),
        ("two_parts", "in.obj", two, r"TopologyError\(disconnected\)"),
        ("closed", "in.obj", closed, r"TopologyError\(closed\)"),
        ("torus", "in.obj", obj_text(*tube(close=True)), r"TopologyError\((closed|genus)\)"),
        ("moebius_band", "in.obj", obj_text(*tube(twist=True)), r"TopologyError\(nonorientable\)"),
    ]  # fmt: skip
    return [pytest.param(*case[1:], id=case[0]) for case in cases]


@pytest.mark.parametrize("name, content, error", hostile_meshes())
@pytest.mark.parametrize("command", ["uniformize", "fill", "ricci"])
def test_bad_meshes_are_3_with_one_line(tmp_path, command, name, content, error):
    (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
    (tmp_path / "out.obj").write_text("old")
    run = koebe(command, tmp_path / name, tmp_path / "out.obj")
    if command == "fill" and re.search("closed|genus|one point", error):
        assert run.returncode == 0, run.stderr  # nothing to fill, or nothing that asks for lengths
        return
    assert_one_line_and_no_file(run, tmp_path, {name, "out.obj"}, error)
    assert (tmp_path / "out.obj").read_text() == "old"


@pytest.mark.parametrize("path", HOSTILE, ids=lambda p: p.name)
def test_files_from_the_wild_give_a_result_or_one_line(tmp_path, path):
    run = koebe("uniformize", path, tmp_path / "out.obj", "--json", tmp_path / "report.json")
    if run.returncode in (0, NOT_CONVERGED):
        assert names(tmp_path) == {"out.obj", "report.json"}
        out = Obj(tmp_path / "out.obj")
        assert len(out.uv) == len(out.vertices) and np.isfinite(out.uv).all()
        assert run.stdout.count("\n") == 1
    else:
        assert_one_line_and_no_file(run, tmp_path, set())


def test_disconnected_faces_are_those_of_the_file(tmp_path):
    vertices, quads = perforated(8, ())
    island = [[len(vertices) + i for i in range(4)]]
    text = obj_text(np.concatenate([vertices, vertices[quads[0]] + 9.0]), island + quads.tolist())
    (tmp_path / "in.obj").write_text(text)
    run = koebe("uniformize", tmp_path / "in.obj", tmp_path / "out.obj")
    assert run.stderr.endswith(" [0]\n"), run.stderr


# ---------------------------------------------------------------- interrupts and terminals


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("command", ["uniformize", "fill", "ricci"])
def test_an_interrupt_is_130_and_nothing_is_written(tmp_path, command, number):
    os.mkfifo(tmp_path / "in.obj")  # the command waits for its input until the signal is sent
    arguments = [command, tmp_path / "in.obj", tmp_path / "out.obj"]
    run = subprocess.Popen(
        [COMMAND, *map(str, arguments)],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(number, signal.SIG_DFL),  # nohup and & start with some ignored
    )
    # The command does not wait for the end of its input; this opens when the command does, after it set its handlers.
    with contextlib.suppress(BrokenPipeError), open(tmp_path / "in.obj", "w") as pipe:
        run.send_signal(number)
        pipe.write(obj_text(*perforated()))
    stdout, stderr = run.communicate(timeout=60)
    assert run.returncode == INTERRUPTED, stderr
    assert stdout == "" and stderr.count("\n") == 1
    assert names(tmp_path) == {"in.obj"}


def on_terminal(*args):
    """Runs with stderr on a terminal; exit code and what came there."""
    try:
        reader, writer = pty.openpty()
    except OSError as error:
        pytest.skip(f"no pseudo-terminal here: {error}")
    run = subprocess.Popen([COMMAND, *map(str, args)], stdout=subprocess.DEVNULL, stderr=writer)
    os.close(writer)
    seen = b""
    while True:
        try:
            chunk = os.read(reader, 4096)
        except OSError:  # the other end is closed
            break
        if not chunk:
            break
        seen += chunk
    os.close(reader)
    return run.wait(timeout=60), seen.decode()


def test_progress_is_for_terminals_and_leaves_no_trace(mesh):
    code, seen = on_terminal("uniformize", mesh / "in.obj", mesh / "out.obj")
    assert code == 0
    percents = [int(p) for p in re.findall(r"(\d+)% \w+", seen)]
    assert percents == sorted(percents) and percents[-1] == 100, seen
    assert "\n" not in seen and seen.endswith("\r\033[K")
    assert on_terminal("uniformize", mesh / "in.obj", mesh / "out.obj", "--quiet") == (0, "")


def test_an_error_on_a_terminal_is_one_clean_line(mesh):
    (mesh / "in.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")
    code, seen = on_terminal("uniformize", mesh / "in.obj", mesh / "out.obj")
    assert code == CANNOT_BE_MAPPED
    assert seen.rsplit("\033[K", 1)[-1].startswith("TopologyError(closed): ")


# ---------------------------------------------------------------- ricci


def test_ricci_has_the_files_and_the_report_of_uniformize(mesh):
    files = lambda name: ("--json", mesh / f"{name}.json", "--svg", mesh / f"{name}.svg")  # noqa: E731
    run = succeeded("ricci", mesh / "in.obj", mesh / "ricci.obj", *files("ricci"))
    assert re.fullmatch(r".*ricci\.obj: 4 loops, \d+ sweeps, roundness .*, 0 flipped, [0-9.]+ s\n", run.stdout)
    assert koebe("uniformize", mesh / "in.obj", mesh / "koebe.obj", *files("koebe")).returncode == 0
    ricci, gk = (json.loads((mesh / f"{name}.json").read_text()) for name in ("ricci", "koebe"))
    assert list(ricci) == [key for key in gk if key not in ("even", "overlaps")]
    assert (ricci["method"], ricci["engine"], ricci["input"]) == ("ricci", "circle_packing", "in.obj")
    assert ricci["converged"] and ricci["steps"] >= ricci["sweeps"] == len(ricci["history"])
    assert max(loop["roundness_least_squares"] for loop in ricci["loops"]) < 1e-5
    # The same circles, but for an automorphism of the disk: intersections of pairs.
    assert np.allclose(inversive_distances(ricci), inversive_distances(gk), rtol=0.05)
    assert np.array_equal(Obj(mesh / "ricci.obj").vertices, Obj(mesh / "koebe.obj").vertices)


def inversive_distances(report):
    circles = [(complex(*loop["center"]), loop["radius"]) for loop in report["loops"]]
    pairs = [(a, b) for i, a in enumerate(circles) for b in circles[:i]]
    return [abs(r * r + s * s - abs(c - d) ** 2) / (2 * r * s) for (c, r), (d, s) in pairs]


@pytest.mark.parametrize("options", [["--max-sweeps", "2"], ["--target", "proportional"]])
def test_ricci_not_converged_is_4_and_all_files_are_written(mesh, options):
    run = koebe(
        *("ricci", mesh / "in.obj", mesh / "out.obj", *options),
        *("--json", mesh / "report.json", "--svg", mesh / "picture.svg"),
    )
    assert run.returncode == NOT_CONVERGED
    assert re.search(r" s, not converged, \d+ warnings?: .*not converged: .*\n$", run.stdout), run.stdout
    assert names(mesh) == {"in.obj", "out.obj", "report.json", "picture.svg"}
    report = json.loads((mesh / "report.json").read_text())
    assert report["converged"] is False
    assert any(w["text"].startswith("not converged: ") for w in report["warnings"])
    assert np.isfinite(Obj(mesh / "out.obj").uv).all()
