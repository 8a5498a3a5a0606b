"""Mesh files as other programs write them, beside the plain ones of the native tests."""

import json
import struct

import numpy as np
import pytest
from cli_support import koebe as run
from cli_support import succeeded, triangulated_plate
from koebe import _koebe

VERTICES, TRIANGLES = triangulated_plate(8, holes=((0.5, 0.5, 0.2),))
SINGLE = VERTICES.astype(np.float32)


def binary_stl(count, header=b"", behind=b""):
    record = np.zeros(len(TRIANGLES), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
    record["corners"] = SINGLE[TRIANGLES]
    return header.ljust(80) + struct.pack("<I", count) + record.tobytes() + behind


def parsed(data, extension):
    """The positions of the corners of each face."""
    vertices, corners, begin = _koebe.parse_mesh(data, extension)
    return [vertices[corners[a:b]] for a, b in zip(begin[:-1], begin[1:], strict=True)], len(vertices)


def assert_is_the_surface(data, extension):
    faces, count = parsed(data, extension)
    assert np.array_equal(faces, SINGLE[TRIANGLES].astype(float)) and count == len(VERTICES)


@pytest.mark.parametrize("header", [b"", b"solid", b"solid exported", b"solid facet normal vertex endsolid"])
@pytest.mark.parametrize("behind", [b"", b"\0\0", b"\n", b"solid " * 30])
def test_binary_stl_may_begin_like_a_text_and_go_on_behind_its_facets(header, behind):
    assert_is_the_surface(binary_stl(len(TRIANGLES), header, behind), ".stl")


def test_bytes_behind_the_facets_are_told_of(tmp_path):
    (tmp_path / "in.stl").write_bytes(binary_stl(len(TRIANGLES) - 2))
    succeeded("uniformize", "in.stl", "out.obj", "--cut", "--json", "out.json", cwd=tmp_path)
    said = [one["text"] for one in json.loads((tmp_path / "out.json").read_text())["warnings"]]
    assert any("100 bytes behind" in text for text in said)


@pytest.mark.parametrize("change", [str.lower, str.upper, str.title])
def test_text_stl_in_capitals_and_with_any_name(change):
    lines = [change("solid solid facet") + " a"]
    for face in SINGLE[TRIANGLES]:
        lines += [change("facet normal"), change("outer loop")]
        lines += [change("vertex ") + " ".join(map(repr, map(float, point))) for point in face]
        lines += [change("endloop"), change("endfacet")]
    lines += [change("endsolid solid facet") + " a"]
    assert_is_the_surface("\n".join(lines).encode(), ".stl")


def ply(form, elements):
    """A header, and what stands behind it."""
    return f"ply\nformat {form} 1.0\n{elements}end_header\n".encode()


XYZ = f"element vertex {len(SINGLE)}\nproperty float x\nproperty float y\nproperty float z\n"
FACES = f"element face {len(TRIANGLES)}\nproperty list {{}} {{}} vertex_indices\n"


@pytest.mark.parametrize("order, form", [("<", "binary_little_endian"), (">", "binary_big_endian")])
@pytest.mark.parametrize("length, number", [("int", "int"), ("uint", "uint"), ("int", "ushort"), ("uchar", "short")])
def test_ply_lists_of_every_width(order, form, length, number):
    widths = {"int": "i4", "uint": "u4", "ushort": "u2", "short": "i2", "uchar": "u1"}
    record = np.zeros(len(TRIANGLES), [("n", order + widths[length]), ("v", order + widths[number], 3)])
    record["n"], record["v"] = 3, TRIANGLES
    data = ply(form, XYZ + FACES.format(length, number)) + SINGLE.astype(order + "f4").tobytes()
    assert_is_the_surface(data + record.tobytes(), ".ply")
    record["n"][5] = -1 if length == "int" else 0x7F
    with pytest.raises(Exception, match="face 5 is missing|face [0-9]+ "):
        parsed(data + record.tobytes(), ".ply")


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian"])
def test_triangle_strips_of_ply_are_triangles(tmp_path, form):
    rows = 9
    grid = np.arange(rows * rows).reshape(rows, rows)
    x, y = np.meshgrid(np.arange(rows, dtype="<f4"), np.arange(rows, dtype="<f4"))
    points = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
    strips = [np.append(np.stack([grid[k + 1], grid[k]], axis=1).ravel(), -1) for k in range(rows - 1)]
    numbers = np.concatenate(strips).astype("<i4")
    header = ply(form, f"element vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
                       "element tristrips 1\nproperty list int int vertex_indices\n")  # fmt: skip
    if form == "ascii":
        data = header + "\n".join(" ".join(map(str, map(int, p))) for p in points).encode()
        data += f"\n{len(numbers)} {' '.join(map(str, numbers))}\n".encode()
    else:
        data = header + points.tobytes() + struct.pack("<i", len(numbers)) + numbers.tobytes()
    faces, _ = parsed(data, ".ply")
    assert len(faces) == 2 * (rows - 1) ** 2
    normals = np.cross(*np.moveaxis(np.array(faces)[:, 1:] - np.array(faces)[:, :1], 1, 0))
    assert (normals[:, 2] > 0).all() or (normals[:, 2] < 0).all()
    (tmp_path / "in.ply").write_bytes(data)
    succeeded("uniformize", "in.ply", "out.ply", "--json", "out.json", cwd=tmp_path)
    report = json.loads((tmp_path / "out.json").read_text())
    assert report["flipped"] == 0 and report["faces"] == len(faces)
    assert len(parsed((tmp_path / "out.ply").read_bytes(), ".ply")[0]) == len(faces)


def test_a_count_of_no_facets_is_the_reason(tmp_path):
    (tmp_path / "in.stl").write_bytes(binary_stl(0))
    done = run("parts", "in.stl", "out.obj", cwd=tmp_path)
    assert done.returncode == 3 and "counts no facet" in done.stderr


PLY_HEADER = "ply\nformat {} 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
PLY_HEADER += "element face 2\nproperty list uchar int vertex_indices\nend_header\n"
SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "<f4")
HALVES = b"".join(b"\3" + np.array(face, "<i4").tobytes() for face in ([0, 1, 2], [0, 2, 3]))
PLY_TEXT = PLY_HEADER.format("ascii").encode() + b"0 0 0 1 0 0 1 1 0 0 1 0\n3 0 1 2\n3 0 2 3\n"
PLY_BINARY = PLY_HEADER.format("binary_little_endian").encode() + SQUARE.tobytes() + HALVES


@pytest.mark.parametrize(
    "name, data, reason",
    [
        ("a.ply", PLY_TEXT + b"3 0 1 3\n", "counts fewer elements"),
        ("b.ply", PLY_BINARY + HALVES[:13], "counts fewer elements"),
        ("c.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n\0\0\0f 1 2 3\nf 2 4 3\n", "byte 32"),
    ],
)
def test_no_face_is_lost_without_a_word(tmp_path, name, data, reason):
    (tmp_path / name).write_bytes(data)
    done = run("parts", name, "out.obj", cwd=tmp_path)
    assert done.returncode == 3 and reason in done.stderr


@pytest.mark.parametrize("data", [PLY_TEXT + b"\n \r\n", PLY_BINARY + b"\r\n"])
def test_blanks_may_end_a_ply(tmp_path, data):
    (tmp_path / "in.ply").write_bytes(data)
    succeeded("parts", "in.ply", "out.obj", cwd=tmp_path)
