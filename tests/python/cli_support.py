"""What the tests of the command share: how it is called, meshes as files, and a reader of what it writes.

The command is build/koebe, or what the environment variable KOEBE_COMMAND names.
"""

import json
import os
import struct
import subprocess
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]
COMMAND = os.environ.get("KOEBE_COMMAND", str(ROOT / "build" / "koebe"))

USAGE, CANNOT_BE_MAPPED, NOT_CONVERGED, INTERRUPTED = 2, 3, 4, 130


def koebe(*args, **options):
    return subprocess.run([COMMAND, *map(str, args)], capture_output=True, text=True, timeout=120, **options)


def succeeded(*args, **options):
    """The finished process of a call that has to succeed."""
    run = koebe(*args, **options)
    assert run.returncode == 0, run.stderr
    return run


def lasting(value):
    """A report without what is measured anew in each run."""
    if isinstance(value, dict):
        return {key: lasting(one) for key, one in value.items() if key not in ("seconds", "peak_memory_mb")}
    return [lasting(one) for one in value] if isinstance(value, list) else value


def same_as_package(report, result):
    """Whether a command's report is the package's, but for the file and what is measured anew in each run."""
    of_file = ("input", "input_sha256")
    own, said = (lasting({k: v for k, v in one.items() if k not in of_file}) for one in (result.to_dict(), report))
    return own == said


def contents(folder):
    """Every file of a folder of results, hidden ones too, without what is measured anew."""
    found = {}
    for path in Path(folder).rglob("*"):
        if path.is_file() and path.suffix != ".csv":
            name, content = path.relative_to(folder).as_posix(), path.read_bytes()
            found[name] = lasting(json.loads(content)) if path.suffix == ".json" else content
    return found


def new_program(path, text):
    """A program of these lines at the path."""
    path.write_text(text)
    path.chmod(0o755)
    return path


def cells(rows, columns):
    """Quadrilaterals of a grid of vertices that are numbered along one row after the other."""
    corner = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    return np.stack([corner, corner + 1, corner + columns + 2, corner + columns + 1], axis=1)


def perforated(n=24, holes=((0.3, 0.3, 0.12), (0.7, 0.35, 0.1), (0.5, 0.72, 0.14))):
    """A wavy square of n x n cells with round holes: vertices and quadrilaterals, no vertex unused."""
    t = np.linspace(0.0, 1.0, n + 1)
    points = np.stack([a.ravel() for a in np.meshgrid(t, t)], axis=1)
    quads = cells(n, n)
    center = points[quads].mean(axis=1)
    for *middle, radius in holes:
        inside = np.linalg.norm(center - middle, axis=1) < radius
        rim = np.intersect1d(quads[inside], quads[~inside])
        arm = points[rim] - middle
        points[rim] = middle + radius * arm / np.linalg.norm(arm, axis=1, keepdims=True)
        quads, center = quads[~inside], center[~inside]
    used, quads = np.unique(quads, return_inverse=True)
    x, y = points[used].T
    return np.stack([x, y, 0.15 * np.sin(3.0 * x) * np.cos(2.0 * y)], axis=1), quads.reshape(-1, 4)


def triangles_of(quads):
    return quads[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def triangulated_plate(*shape, **options):
    """As `perforated`, in triangles."""
    vertices, quads = perforated(*shape, **options)
    return vertices, triangles_of(quads).astype(np.int32)


def obj_text(vertices, faces):
    lines = ["v " + " ".join(repr(float(x)) for x in v) for v in vertices]
    lines += ["f " + " ".join(str(i + 1) for i in f) for f in faces]
    return "\n".join(lines) + "\n"


def off_text(vertices, faces):
    lines = ["OFF", f"{len(vertices)} {len(faces)} 0"]
    lines += [" ".join(repr(float(x)) for x in v) for v in vertices]
    lines += [" ".join(map(str, [len(f), *f])) for f in faces]
    return "\n".join(lines) + "\n"


def ply_bytes(vertices, faces):
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        "property double x\nproperty double y\nproperty double z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    body = b"".join(struct.pack(f"<B{len(f)}i", len(f), *f) for f in faces)
    return header.encode() + np.asarray(vertices, dtype="<f8").tobytes() + body


def stl_text(vertices, triangles):
    facets = []
    for triangle in triangles:
        corners = "".join(f"vertex {x!r} {y!r} {z!r}\n" for x, y, z in vertices[triangle].tolist())
        facets.append(f"facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    return "solid a\n" + "".join(facets) + "endsolid a\n"


def write_obj(path, vertices, faces):
    path.write_text(obj_text(vertices, faces))


def obj_rows(path, keyword):
    """The numbers of all lines of an OBJ that begin with the keyword."""
    lines = [line.split() for line in path.read_text(encoding="utf-8").splitlines()]
    return np.array([words[1:] for words in lines if words and words[0] == keyword], float)


def read_corners(path):
    """Vertices, faces, and (u, v) of each corner of each face of an OBJ."""
    places = obj_rows(path, "vt").tolist()
    words = [line.split()[1:] for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("f ")]
    pairs = [[[int(number) - 1 for number in word.split("/")[:2]] for word in face] for face in words]
    faces, corners = [[v for v, _ in face] for face in pairs], [[places[t][:2] for _, t in face] for face in pairs]
    return obj_rows(path, "v"), faces, corners


class Obj:
    """An OBJ as it is written: vertices, texture coordinates, faces as tuples, groups as [(name, first face)]."""

    def __init__(self, path):
        self.vertices, self.uv, self.faces, self.groups = [], [], [], []
        for line in Path(path).read_text().splitlines():
            keyword, *words = line.split() or [""]
            if keyword == "v":
                self.vertices.append([float(w) for w in words])
            elif keyword == "vt":
                self.uv.append([float(w) for w in words])
            elif keyword == "f":
                corners = [w.split("/") for w in words]
                assert all(len(set(c)) == 1 for c in corners), "vt has another number than v"
                self.faces.append(tuple(int(c[0]) - 1 for c in corners))
            elif keyword == "g":
                self.groups.append((words[0], len(self.faces)))
        self.vertices, self.uv = np.array(self.vertices), np.array(self.uv)


def names(folder):
    return {p.name for p in folder.iterdir()}


def disk(uv):
    return 2.0 * uv - 1.0
