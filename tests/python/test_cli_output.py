"""Where the koebe command writes: formats, names of any bytes, links, standard streams, and files that are one."""

import fcntl
import json
import os
import re
import stat
import subprocess

import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, COMMAND, USAGE, Obj, koebe, names, obj_text, perforated, succeeded


@pytest.fixture
def folder(tmp_path):
    """A folder with the perforated square in quadrilaterals as in.obj."""
    (tmp_path / "in.obj").write_text(obj_text(*perforated()))
    return tmp_path


def ply(path):
    """Property names of vertices and faces, vertices (V, k), polygons, and what follows their corners."""
    header, body = path.read_text().split("end_header\n")
    counts = dict(re.findall(r"element (\w+) (\d+)", header))
    of_vertices, of_faces = header.split("element face")
    lines = body.splitlines()
    vertex_count = int(counts["vertex"])
    assert len(lines) == vertex_count + int(counts["face"])
    faces = [list(map(int, line.split())) for line in lines[vertex_count:]]
    return (
        re.findall(r"property double (\w+)", of_vertices),
        re.findall(r"property int (\w+)", of_faces),
        np.array([list(map(float, line.split())) for line in lines[:vertex_count]]),
        [tuple(f[1 : 1 + f[0]]) for f in faces],
        [f[1 + f[0] :] for f in faces],
    )


# ---------------------------------------------------------------- formats


def test_ply_has_the_map_of_obj_in_the_same_order(folder):
    for name in ("out.obj", "out.PLY"):
        assert koebe("uniformize", "in.obj", name, cwd=folder).returncode == 0
    obj = Obj(folder / "out.obj")
    of_vertices, of_faces, vertices, polygons, _ = ply(folder / "out.PLY")
    assert of_vertices == ["x", "y", "z", "s", "t", "texture_u", "texture_v"] and of_faces == []
    assert np.array_equal(vertices[:, :3], obj.vertices)  # to the last bit
    assert np.array_equal(vertices[:, 3:5], obj.uv) and np.array_equal(vertices[:, 5:7], obj.uv)
    assert polygons == obj.faces
    succeeded("uniformize", "out.PLY", "again.obj", cwd=folder)  # it is read back
    back = Obj(folder / "again.obj")
    assert np.array_equal(back.vertices, obj.vertices) and np.array_equal(back.uv, obj.uv) and back.faces == obj.faces


def test_patches_are_a_property_in_ply(folder):
    for name in ("out.obj", "out.ply"):
        assert koebe("fill", "in.obj", name, cwd=folder).returncode == 0
    obj = Obj(folder / "out.obj")
    of_vertices, of_faces, vertices, polygons, rest = ply(folder / "out.ply")
    assert of_vertices == ["x", "y", "z"] and of_faces == ["patch"]
    assert np.array_equal(vertices, obj.vertices) and polygons == obj.faces
    groups = [*obj.groups, ("end", len(obj.faces))]
    for (name, begin), (_, end) in zip(groups, groups[1:]):
        expected = -1 if name == "surface" else int(name.removeprefix("patch_"))
        assert rest[begin:end] == [[expected]] * (end - begin)


@pytest.mark.parametrize("command", ["uniformize", "fill", "ricci", "parts"])
@pytest.mark.parametrize("name", ["out.off", "out.stl", "out.gltf", "out", "obj", "out.obj2", ".ply"])
def test_other_formats_are_refused_before_any_work(tmp_path, command, name):
    run = koebe(command, tmp_path / "missing.obj", name, cwd=tmp_path)
    assert run.returncode == USAGE and run.stdout == ""
    assert re.fullmatch(r"WrongUsage: OUT: .*OUT must end in \.obj or \.ply .*\n", run.stderr), run.stderr
    assert names(tmp_path) == set()


# Not with /dev/null and /dev/stdout: were the law broken, root would lose them here.
def test_pipes_without_an_extension_take_obj(folder):
    assert koebe("uniformize", "in.obj", "out.obj", cwd=folder).returncode == 0
    expected = (folder / "out.obj").read_bytes()
    run = koebe("uniformize", "in.obj", "/proc/self/fd/1", "--quiet", cwd=folder)
    assert (run.returncode, run.stdout.encode()) == (0, expected), run.stderr
    os.mkfifo(folder / "pipe")
    with open(os.open(folder / "pipe", os.O_RDWR), "rb") as pipe:  # there is a reader from the start
        fcntl.fcntl(pipe, fcntl.F_SETPIPE_SZ, 1 << 20)
        run = succeeded("uniformize", "in.obj", "pipe", cwd=folder)
        assert run.stdout.startswith("pipe: 4 loops"), run
        assert os.read(pipe.fileno(), 1 << 20) == expected
    assert stat.S_ISFIFO(os.stat(folder / "pipe").st_mode)
    assert names(folder) == {"in.obj", "out.obj", "pipe"}


# ---------------------------------------------------------------- names

ODD = b"\xff\xc3 n\xe2\x82 \n\x1b"


@pytest.mark.parametrize("command", ["uniformize", "fill", "ricci"])
def test_names_may_have_any_bytes(tmp_path, command):
    folder = os.fsencode(tmp_path)
    source, out = (os.path.join(folder, word + ODD + b".obj") for word in (b"in", b"out"))
    with open(source, "w") as file:
        file.write(obj_text(*perforated()))
    files = [source, out]
    if command != "fill":
        files += [b"--json", os.path.join(folder, b"j" + ODD), b"--svg", os.path.join(folder, b"s" + ODD)]
    run = subprocess.run([COMMAND, command, *files], capture_output=True, timeout=60)
    assert run.returncode == 0, run.stderr
    assert "out\ufffd\ufffd n\ufffd   .obj: " in run.stdout.decode("utf-8") and run.stdout.count(b"\n") == 1
    assert len(os.listdir(folder)) == (2 if command == "fill" else 4)
    if command != "fill":
        with open(files[3], "rb") as file:
            report = json.loads(file.read().decode("utf-8"))
        assert report["input"] == "in\ufffd\ufffd n\ufffd \n\x1b.obj"
    missing = subprocess.run([COMMAND, command, source + b".obj", out], capture_output=True, timeout=60)
    assert missing.returncode == CANNOT_BE_MAPPED
    assert missing.stderr.decode("utf-8").count("\n") == 1


def test_modules_name_any_bytes_too(tmp_path):
    source = os.path.join(os.fsencode(tmp_path), ODD + b".obj")
    with open(source, "w") as file:
        file.write(obj_text(*perforated()))
    module = subprocess.run([COMMAND, "module", source], capture_output=True, timeout=60)
    compare = subprocess.run([COMMAND, "compare", source, source, "--json"], capture_output=True, timeout=60)
    expected = "\ufffd\ufffd n\ufffd \n\x1b.obj"
    assert json.loads(module.stdout.decode("utf-8"))["input"] == expected
    assert json.loads(compare.stdout.decode("utf-8"))["b"]["input"] == expected


# ---------------------------------------------------------------- files that are one


def make_names(folder):
    """Other names of in.obj, and of a file that is not there."""
    (folder / "sub").mkdir()
    (folder / "sub_link").symlink_to("sub")
    (folder / "link.obj").symlink_to("in.obj")
    (folder / "hard.obj").hardlink_to(folder / "in.obj")
    (folder / "dangling.obj").symlink_to("new.obj")


INPUT_NAMES = ["in.obj", "./in.obj", "sub/../in.obj", "sub_link/../in.obj", "link.obj", "hard.obj"]


@pytest.mark.parametrize("name", INPUT_NAMES)
@pytest.mark.parametrize("option", ["--json", "--svg"])
def test_the_mesh_is_not_overwritten_by_a_report(folder, name, option):
    make_names(folder)
    before, files = (folder / "in.obj").read_bytes(), names(folder)
    run = koebe("uniformize", "in.obj", "out.obj", option, name, cwd=folder)
    assert (run.returncode, run.stderr) == (
        USAGE,
        f"WrongUsage: {option}: is the mesh 'in.obj' itself (see koebe --help)\n",
    )
    run = koebe("compare", "in.obj", "hard.obj", "--json", name, cwd=folder)
    assert run.returncode == USAGE and "--json: is the mesh" in run.stderr, run
    assert (folder / "in.obj").read_bytes() == before and names(folder) == files


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("out.obj", "./out.obj"),
        ("new.obj", "dangling.obj"),
        ("sub/out.obj", "sub_link/out.obj"),
        ("link.obj", "hard.obj"),
        ("sub/../out.obj", "out.obj"),
    ],
)
def test_outputs_are_different_files(folder, one, other):
    make_names(folder)
    files = names(folder)
    for pair in ((one, other), (other, one)):
        for options in (["--json", pair[1]], ["--svg", pair[1]]):
            run = koebe("uniformize", "in.obj", pair[0], *options, cwd=folder)
            assert run.returncode == USAGE and "must be different files" in run.stderr, (pair, options, run)
        run = koebe("uniformize", "in.obj", "other.obj", "--json", pair[0], "--svg", pair[1], cwd=folder)
        assert run.returncode == USAGE, (pair, run)
    assert names(folder) == files and (folder / "in.obj").read_text() == obj_text(*perforated())


def test_standard_output_is_a_file_like_others(folder):
    with open(folder / "out.obj", "w") as stream:
        run = subprocess.run([COMMAND, "uniformize", folder / "in.obj", folder / "out.obj"], stdout=stream, stderr=-1)
    assert run.returncode == USAGE and b"standard output" in run.stderr
    run = koebe("uniformize", "in.obj", "/proc/self/fd/1", cwd=folder)  # a pipe
    assert run.returncode == USAGE and "standard output" in run.stderr and run.stdout == ""


def test_a_link_stays_and_its_target_is_replaced(folder):
    make_names(folder)
    koebe("uniformize", "in.obj", "out.obj", cwd=folder)
    expected = (folder / "out.obj").read_bytes()
    for name, target in (("dangling.obj", "new.obj"), ("link.obj", "in.obj")):
        succeeded("uniformize", "in.obj", name, cwd=folder)
        assert (folder / name).is_symlink() and (folder / target).read_bytes() == expected
    assert (folder / "hard.obj").read_text() == obj_text(*perforated())  # the other name keeps the old file


def test_what_is_no_file_is_an_error(folder):
    (folder / "folder.obj").mkdir()
    (folder / "zero.obj").symlink_to("/dev/zero")  # has no end
    (folder / "a.obj").symlink_to("b.obj")
    (folder / "b.obj").symlink_to("a.obj")
    files = names(folder)
    for source, out, error in [
        ("folder.obj", "out.obj", "cannot read folder.obj"),
        ("zero.obj", "out.obj", "cannot read zero.obj (it is a device)"),
        ("a.obj", "out.obj", "cannot read a.obj"),
        ("in.obj", "folder.obj", "cannot write folder.obj"),
        ("in.obj", "a.obj", "cannot write a.obj"),
        ("in.obj", "in.obj/out.obj", "cannot write in.obj/out.obj"),
    ]:
        run = koebe("uniformize", source, out, cwd=folder)
        assert run.returncode == CANNOT_BE_MAPPED and run.stderr.startswith(f"FileError: {error}"), (source, out, run)
        assert run.stderr.count("\n") == 1
    run = koebe("uniformize", "/dev/stdin", "out.obj", cwd=folder, stdin=subprocess.DEVNULL)
    assert run.returncode == CANNOT_BE_MAPPED and run.stderr.startswith("InputError: format not supported: ''"), run
    assert names(folder) == files


# ---------------------------------------------------------------- standard streams


def with_streams(redirection, *args, cwd):
    """Runs under a shell's redirections; the exit code, and what came to a standard error that is open."""
    words = " ".join(args)
    run = subprocess.run(
        ["sh", "-c", f'"$0" {words} {redirection}', COMMAND], cwd=cwd, stderr=subprocess.PIPE, text=True, timeout=60
    )
    return run.returncode, run.stderr


@pytest.mark.parametrize("arguments", [("uniformize", "in.obj", "out.obj"), ("fill", "in.obj", "out.obj")])
def test_standard_output_that_is_full_or_closed_is_an_error(folder, arguments):
    koebe(*arguments, cwd=folder)
    expected = (folder / "out.obj").read_bytes()
    (folder / "out.obj").unlink()
    code, error = with_streams(">&-", *arguments, cwd=folder)
    assert code == CANNOT_BE_MAPPED and error.startswith("FileError: cannot write standard output (")
    assert names(folder) == {"in.obj"}  # known before the work
    code, error = with_streams("> /dev/full", *arguments, cwd=folder)
    assert code == CANNOT_BE_MAPPED and error.startswith("FileError: cannot write standard output (No space left")
    assert (folder / "out.obj").read_bytes() == expected and error.count("\n") == 1
    assert with_streams(">&-", *arguments, "--quiet", cwd=folder) == (0, "")
    assert with_streams("> /dev/full", *arguments, "--quiet", cwd=folder) == (0, "")


@pytest.mark.parametrize(
    "arguments",
    [("module", "in.obj"), ("compare", "in.obj", "in.obj"), ("--help",), ("--version",), ("fill", "--help")],
)
def test_other_output_that_is_lost_is_an_error_too(folder, arguments):
    for redirection in (">&-", "> /dev/full"):
        code, error = with_streams(redirection, *arguments, cwd=folder)
        last = error.splitlines()[-1]  # compare warns before
        assert code == CANNOT_BE_MAPPED and last.startswith("FileError: cannot write standard output ("), redirection
        assert error.count("FileError") == 1


def test_a_broken_pipe_is_an_error_and_no_signal(folder):
    reader, writer = os.pipe()
    os.close(reader)
    run = subprocess.run(
        [COMMAND, "uniformize", "in.obj", "out.obj"], cwd=folder, stdout=writer, stderr=subprocess.PIPE, timeout=60
    )
    os.close(writer)
    assert run.returncode == CANNOT_BE_MAPPED and run.stderr.startswith(b"FileError: cannot write standard output (Br")
    assert len(Obj(folder / "out.obj").uv) > 0


def test_closed_streams_get_nothing_into_files(folder):
    koebe("uniformize", "in.obj", "out.obj", "--json", "report.json", cwd=folder)
    expected = (folder / "out.obj").read_bytes()
    (folder / "out.obj").unlink()
    for redirection in ("<&- >&- 2>&-", ">&- 2>&-", "2>&-", "<&-"):
        code, _ = with_streams(redirection, "uniformize", "in.obj", "out.obj", "--quiet", cwd=folder)
        assert code == 0 and (folder / "out.obj").read_bytes() == expected, redirection
    code, _ = with_streams("<&- 2>&-", "uniformize", "in.obj", "out.obj", "--json", "report.json", cwd=folder)
    assert code == 0 and (folder / "out.obj").read_bytes() == expected
    json.loads((folder / "report.json").read_text())
    (folder / "in.obj").write_text("v 0 0 0\n")  # an error without a place to go
    assert with_streams(">&- 2>&-", "uniformize", "in.obj", "out.obj", "--quiet", cwd=folder) == (CANNOT_BE_MAPPED, "")
    assert (folder / "out.obj").read_bytes() == expected


# ---------------------------------------------------------------- what a file holds beside its mesh


def kept_lines(text):
    """All of an OBJ but its texture coordinates: lines, and of faces the vertices and normals."""
    lines = []
    for line in text.splitlines():
        keyword, *words = line.split() or [""]
        if keyword == "f":
            corners = [[*word.split("/"), "", ""] for word in words]
            line = " ".join(["f", *(f"{c[0]}//{c[2]}" for c in corners)])
        if keyword != "vt" and not line.startswith("# Koebe UV"):
            lines.append(line)
    return lines


def warnings(run, report):
    assert run.returncode == 0, run.stderr
    return {w["kind"]: w["text"] for w in json.loads(report.read_text())["warnings"]}


@pytest.fixture
def rich(tmp_path):
    """The perforated square as in.obj, with all that an artist's OBJ holds."""
    vertices, quads = perforated()
    lines = ["# by hand", "mtllib a.mtl", "o sheet"]
    lines += [f"v {x!r} {y!r} {z!r} 0.5 0.25 1" for x, y, z in vertices.tolist()]
    lines += ["vt 0.25 0.75", "vn 0 0 1", "vn 0 1 0", "g left", "usemtl skin", "s 1"]
    for k, quad in enumerate(quads.tolist()):
        lines += ["g right", "usemtl cloth", "s off"] if k == len(quads) // 2 else []
        lines.append("f " + " ".join(f"{i + 1}/1/{1 + k % 2}" for i in quad))
    (tmp_path / "in.obj").write_text("\n".join([*lines, "l 1 2 3", ""]))
    return tmp_path


@pytest.mark.parametrize("command", [["uniformize"], ["uniformize", "--cut"], ["parts"], ["ring"], ["sphere"]])
def test_an_obj_keeps_all_but_its_texture_coordinates(rich, command):
    name, *options = command
    run = koebe(name, "in.obj", "out.obj", *options, "--json", "r.json", cwd=rich)
    assert warnings(run, rich / "r.json").keys() - {"cut", "concave_polygons"} == {"replaced_uvs"}
    out = (rich / "out.obj").read_text()
    assert kept_lines(out) == kept_lines((rich / "in.obj").read_text())
    used = [int(word.split("/")[1]) for line in out.splitlines() if line.startswith("f ") for word in line.split()[1:]]
    assert sorted(set(used)) == list(range(1, len(re.findall("^vt ", out, re.MULTILINE)) + 1))
    koebe(name, "in.obj", "in.obj", *options, cwd=rich)  # OUT may be IN
    assert (rich / "in.obj").read_text() == out


def test_a_large_obj_keeps_all_whatever_the_threads(tmp_path):
    # Its text is copied in pieces of a megabyte, side by side. Their buffers grew in the middle of a word once.
    m = 150
    x, y = (part.ravel() for part in np.meshgrid(np.linspace(0, np.pi, m), np.linspace(0, np.e, m)))
    corner = (m * np.arange(m - 1)[:, None] + np.arange(m - 1)).ravel() + 1
    lines = [f"v {a!r} {b!r} {np.sin(a * b)!r} 0.123456 0.234567 0.345678" for a, b in zip(x.tolist(), y.tolist())]
    lines += [f"f {a} {a + 1} {a + m + 1} {a + m}" for a in corner.tolist()]
    (tmp_path / "in.obj").write_text("\n".join([*lines, ""]))
    assert (tmp_path / "in.obj").stat().st_size > 2**21
    texts = []
    for threads in ("1", "2", "3"):
        succeeded("uniformize", "in.obj", "out.obj", "--threads", threads, cwd=tmp_path)
        texts.append((tmp_path / "out.obj").read_text())
    assert kept_lines(texts[0]) == kept_lines((tmp_path / "in.obj").read_text())
    assert texts[0] == texts[1] == texts[2]


def test_fill_keeps_texture_coordinates_too(rich):
    assert koebe("fill", "in.obj", "out.obj", cwd=rich).stdout.count("warning") == 0
    text, out = (rich / "in.obj").read_text(), (rich / "out.obj").read_text()
    assert text in out
    assert re.findall("^g .*", out.replace(text, ""), re.MULTILINE) == ["g patch_1", "g patch_2", "g patch_3"]


def test_normals_of_a_surface_that_was_moved_are_left_out_with_a_warning(rich):
    run = koebe("transfer", "in.obj", "in.obj", "out.obj", "--json", "r.json", cwd=rich)
    assert warnings(run, rich / "r.json")["not_kept"].endswith(": normals")
    out = (rich / "out.obj").read_text()
    assert out.count("usemtl") == 2 and out.count(" 0.5 0.25 1\n") == len(perforated()[0]) and "vn " not in out


def test_what_another_format_does_not_hold_is_named(rich):
    said = warnings(koebe("uniformize", "in.obj", "out.ply", "--json", "r.json", cwd=rich), rich / "r.json")
    assert said.keys() == {"replaced_uvs", "not_kept"}
    for word in ("groups", "materials", "smoothing groups", "normals", "vertex colours", "lines and points"):
        assert word in said["not_kept"], word
    vertices, quads = perforated()
    off = ["COFF", f"{len(vertices)} {len(quads)} 0"]
    off += [f"{x!r} {y!r} {z!r} 1 0 0 1" for x, y, z in vertices.tolist()]
    off += ["4 {} {} {} {}".format(*quad) + " 0 1 0" * (k == 3) for k, quad in enumerate(quads.tolist())]
    (rich / "in.off").write_text("\n".join(off))
    said = warnings(koebe("uniformize", "in.off", "out.obj", "--json", "r.json", cwd=rich), rich / "r.json")
    assert said == {"not_kept": "the written file does not have: vertex colours and face colours"}


def test_a_ply_keeps_all_but_its_texture_coordinates(rich):
    vertices, quads = perforated()
    header = ["ply", "format ascii 1.0", "comment TextureFile a.png", f"element vertex {len(vertices)}"]
    header += [f"property double {name}" for name in "xyzst"] + ["property uchar red", "property float nx"]
    header += [f"element face {len(quads)}", "property list uchar int vertex_index", "property int part", "end_header"]
    rows = [f"{x!r} {y!r} {z!r} 0 0 {k % 256} 0.5" for k, (x, y, z) in enumerate(vertices.tolist())]
    rows += ["4 {} {} {} {} ".format(*quad) + str(-k) for k, quad in enumerate(quads.tolist())]
    (rich / "in.ply").write_text("\n".join([*header, *rows, ""]))
    for command, added in (("uniformize", 4), ("parts", 0)):
        run = koebe(command, "in.ply", "out.ply", "--json", "r.json", cwd=rich)
        assert warnings(run, rich / "r.json").keys() == {"replaced_uvs"}
        head, body = (rich / "out.ply").read_text().split("end_header\n")
        lines = [line.split() for line in body.splitlines()]
        assert "comment TextureFile a.png\n" in head and "property uchar red\nproperty float nx\n" in head
        assert [row[3:5] for row in lines[: len(vertices)]] == [[str(k % 256), "0.5"] for k in range(len(vertices))]
        assert {len(row) for row in lines[: len(vertices)]} == {5 + added}
        assert [row[5] for row in lines[len(vertices) :]] == [str(-k) for k in range(len(quads))]
    assert {(row[6], len(row)) for row in lines[len(vertices) :]} == {("8", 15)}  # texcoord, of parts
    said = warnings(koebe("uniformize", "in.ply", "out.obj", "--json", "r.json", cwd=rich), rich / "r.json")
    assert said["not_kept"] == "the written file does not have: vertex colours, normals and face property part"


# ---------------------------------------------------------------- warnings


def test_the_result_line_counts_the_warnings(folder):
    vertices, quads = perforated()
    (folder / "in.obj").write_text(obj_text(vertices, [*quads, (0, 0, 1)]) + "v 8 8 8\n")
    run = koebe("uniformize", "in.obj", "out.obj", "--json", "report.json", cwd=folder)
    warnings = json.loads((folder / "report.json").read_text())["warnings"]
    assert len(warnings) == 2
    assert re.fullmatch(
        r"out\.obj: 4 loops, .* flipped, [0-9.]+ s, 2 warnings: faces with fewer than three different vertices.*\n",
        run.stdout,
    ), run.stdout
    run = koebe("fill", "in.obj", "out.obj", cwd=folder)
    assert re.search(r" s, 1 warning: faces with fewer than three different vertices.*\n$", run.stdout), run.stdout
    kinds = [warning["kind"] for warning in json.loads(koebe("module", "in.obj", cwd=folder).stdout)["warnings"]]
    assert kinds == ["collapsed_faces", "unused_vertices", "coarse_mesh"]


def test_warnings_of_faces_name_the_faces_of_the_file(folder):
    """The map is of triangles; a script knows the quads."""
    vertices, quads = perforated()
    turned = [*quads[:7], quads[7][::-1], *quads[8:]]
    (folder / "in.obj").write_text(obj_text(vertices, turned))
    koebe("uniformize", "in.obj", "out.obj", "--json", "report.json", cwd=folder)
    (warning,) = json.loads((folder / "report.json").read_text())["warnings"]
    assert set(warning) == {"kind", "elements", "text"}
    assert (warning["kind"], warning["elements"]) == ("reoriented_faces", [7])
    assert warning["text"].endswith("the first face is 7")
