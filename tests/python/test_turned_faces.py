"""Faces with another orientation than most: every command and function names them, and no file loses them."""

import json

import koebe
import numpy as np
import pytest
from cli_support import koebe as run
from cli_support import obj_text, perforated, triangles_of
from domain_surfaces import holed_ring, holed_torus
from handle_surfaces import double_ring, plate
from sphere_surfaces import icosphere

TURNED = [3, 4, 20]

SURFACES = {
    "plate": lambda: (perforated(12)[0], triangles_of(perforated(12)[1])),
    "ring": lambda: holed_ring(4)[:2],
    "torus": lambda: holed_torus(4)[:2],
    "ball": lambda: icosphere(4),
    "pretzel": lambda: double_ring(3)[:2],
}


def turned(surface):
    vertices, triangles = SURFACES[surface]()
    triangles = np.array(triangles)
    triangles[TURNED] = triangles[TURNED][:, ::-1]
    return vertices, triangles


def face_lines(path):
    """The vertices of each face as they are written."""
    lines = path.read_text().splitlines()
    return [[word.split("/")[0] for word in line.split()[1:]] for line in lines if line.startswith("f ")]


# The arguments of each command, and its surface. OUT is a mesh, REPORT its JSON.
COMMANDS = {
    "uniformize": ("plate", "IN OUT --json REPORT"),
    "uniformize --cut": ("plate", "IN OUT --json REPORT"),
    "ricci": ("plate", "IN OUT --json REPORT"),
    "fit": ("plate", "IN CIRCLES OUT --json REPORT"),
    "parts": ("plate", "IN OUT --json REPORT"),
    "lift": ("plate", "IN circles RAISED --perforate --json REPORT"),
    "flatten": ("plate", "IN SVG --json REPORT"),
    "ring": ("ring", "IN OUT --json REPORT"),
    "torus": ("torus", "IN OUT --json REPORT"),
    "sphere": ("ball", "IN OUT --json REPORT"),
    "schottky": ("pretzel", "IN OUT --json REPORT"),
    "transfer": ("plate", "IN IN OUT --json REPORT"),
    "sequence": ("plate", "IN --output FOLDER"),
    "fill": ("plate", "IN OUT"),
    "compare": ("plate", "IN IN"),
    "module": ("plate", "IN"),
    "module --certified": ("ring", "IN"),
    "module --csv": ("plate", "REPORT IN"),
}  # fmt: skip


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_names_turned_faces_and_keeps_them(command, tmp_path):
    surface, arguments = COMMANDS[command]
    paths = {"IN": tmp_path / "in.obj", "OUT": tmp_path / "out.obj", "REPORT": tmp_path / "report.json",
             "RAISED": tmp_path / "raised.obj", "SVG": tmp_path / "out.svg", "FOLDER": tmp_path / "all",
             "CIRCLES": tmp_path / "circles.json"}  # fmt: skip
    paths["IN"].write_text(obj_text(*turned(surface)))
    if "CIRCLES" in arguments:
        own = koebe.uniformize(paths["IN"])
        circles = zip(own.centers[1:].tolist(), own.radii[1:].tolist(), strict=True)
        listed = [{"center": center, "radius": radius} for center, radius in circles]
        paths["CIRCLES"].write_text(json.dumps({"circles": listed}))
    done = run(*command.split(), *(paths.get(word, word) for word in arguments.split()))
    assert done.returncode in (0, 4), done.stderr
    report = tmp_path / "all" / "in.json" if command == "sequence" else paths["REPORT"]
    if command == "module --csv":
        assert "3 faces turned" in report.read_text()
        return
    if report.exists() or command.startswith("module"):
        warnings = json.loads(done.stdout if command.startswith("module") else report.read_text())["warnings"]
        assert [one["elements"] for one in warnings if one["kind"] == "reoriented_faces"] in ([TURNED], [TURNED] * 2)
    else:
        said = done.stdout + done.stderr
        assert "3 faces" in said and f"is {TURNED[0]}" in said
    for out in (paths["OUT"], tmp_path / "all" / "in.obj"):
        if out.exists():
            assert face_lines(out)[: len(face_lines(paths["IN"]))] == face_lines(paths["IN"])


@pytest.mark.parametrize("name", ["fill_holes", "boundary_loops", "disk_map", "annulus_map"])
def test_functions_without_a_report_warn(name):
    vertices, triangles = turned("plate")
    if name.endswith("map"):
        with pytest.warns(koebe.Warning):
            loops = list(range(2 if name == "annulus_map" else 1, 4))
            vertices, triangles, _ = koebe.fill_holes(vertices, triangles, loops=loops)
    with pytest.warns(koebe.Warning, match="3 faces") as caught:
        getattr(koebe, name)((vertices, triangles))
    assert caught[0].message.elements == TURNED


CLOSED = {
    "sphere_map": lambda: icosphere(4),
    "torus_map": lambda: holed_torus(4, holes={})[:2],
    "schottky_map": lambda: plate(np.random.default_rng(0)),
}


@pytest.mark.parametrize("name", CLOSED)
def test_a_surface_that_is_inside_out_is_told(name):
    """Its map is the map of its mirror image."""
    function = getattr(koebe, name)
    vertices, triangles = CLOSED[name]()
    volume = np.linalg.det(vertices[triangles]).sum()
    outward = triangles if volume > 0 else triangles[:, ::-1].copy()
    right, wrong = function(vertices, outward), function(vertices, outward[:, ::-1].copy())
    assert not [one for one in right.warnings if one.kind == "reoriented_faces"]
    assert ["inside out" in one.text for one in wrong.warnings if one.kind == "reoriented_faces"] == [True]
