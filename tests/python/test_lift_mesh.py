"""Meshes bent over surfaces: places, heights, copies, what does not fit, and distant places that meet."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_text, perforated, succeeded, triangles_of
from cli_support import koebe as command
from test_lift import edges_of, euler, stored_areas, tube
from test_lift_sphere import globe


def sheet(columns=20, rows=10, width=2.0, height=1.0, lift=lambda x, y: 0 * x):
    """A rectangle of triangles with heights."""
    x, y = (k.ravel() for k in np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1)))
    i, j = (k.ravel() for k in np.meshgrid(np.arange(columns), np.arange(rows)))
    a = j * (columns + 1) + i
    b = a + columns + 1
    return np.stack([x, y, lift(x, y)], 1), np.concatenate([np.stack([a, a + 1, b + 1], 1), np.stack([a, b + 1, b], 1)])


@pytest.fixture
def bent(tmp_path):
    def bend(mesh, surface=None, **options):
        (tmp_path / "pattern.obj").write_text(obj_text(*mesh))
        return koebe.lift(*(surface or tube()), tmp_path / "pattern.obj", **{"shape": "ring", **options})

    return bend


def test_a_mesh_keeps_its_proportions_on_a_tube(bent):
    mesh = sheet(lift=lambda x, y: 0.1 + 0 * x)
    result = bent(mesh, size=1.6)
    assert result.size == pytest.approx(1.6) and len(result.vertices) == len(mesh[0])
    assert (result.triangles == mesh[1]).all() and not result.closed and result.outlines == 0
    radius = np.hypot(result.vertices[:, 0], result.vertices[:, 1])
    assert abs(radius - (1 + 0.1 * 1.6 / 2)).max() < 0.003  # the tube has 60 sides
    assert np.ptp(result.vertices[:, 2]) == pytest.approx(0.8, rel=0.01)
    assert (stored_areas(result.uv) > 0).all() and result.crossings == 0 and result.warnings == []
    taller = bent(mesh, size=1.6, height=2.5)
    radius = np.hypot(taller.vertices[:, 0], taller.vertices[:, 1])
    assert abs(radius - (1 + 2.5 * 0.1 * 1.6 / 2)).max() < 0.003


def test_copies_meet_round_a_ring(bent):
    result = bent(sheet(), repeats=4)
    assert result.size == pytest.approx(2 * np.pi / 4, rel=0.01)
    angle = np.sort(np.arctan2(result.vertices[:, 1], result.vertices[:, 0]) % (2 * np.pi))
    assert np.diff(angle).max() < 0.1 and len(result.triangles) == 4 * 400
    corners = result.vertices[result.triangles]
    assert np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max() < 0.3  # no face goes back over the cut
    assert result.crossings == 0  # they only touch
    with pytest.raises(koebe.InputError, match="wider than their share"):
        bent(sheet(), repeats=4, size=2.0)


def test_parts_over_a_hole_are_left_out(bent):
    vertices, faces = perforated(32)
    pieces = [sheet(4, 4, 0.04, 0.04) for _ in range(36)]
    points = np.concatenate([p + (0.1 * x, 0.1 * y, 0) for (p, _), (x, y) in zip(pieces, np.ndindex(6, 6))])
    mesh = points, np.concatenate([f + 25 * k for k, (_, f) in enumerate(pieces)])
    result = bent(mesh, (vertices, triangles_of(faces)), shape="disk")
    left = result.left_out["at_border"]
    assert 0 < left < 36 and len(result.triangles) == 32 * (36 - left)
    (warning,) = [one for one in result.warnings if "of the mesh" in one.text]
    assert warning.kind == "left_out" and "of the mesh left out" in warning.text and len(warning.elements) > 0
    with pytest.raises(koebe.InputError, match="no part of the mesh fits"):
        bent(sheet(), (vertices, triangles_of(faces)), shape="disk")  # it covers the holes
    with pytest.raises(koebe.InputError, match="no part of the mesh fits"):
        bent(sheet(), size=20.0)


def test_a_mesh_lies_around_a_vertex_of_a_sphere(bent):
    surface = globe(4)
    vertex = int(np.argmax(surface[0][:, 1]))
    result = bent(sheet(lift=lambda x, y: 0.2 + 0 * x), surface, shape="sphere", around=vertex, size=0.4)
    assert abs(np.linalg.norm(result.vertices, axis=1) - 1.04).max() < 0.004
    assert result.vertices.mean(axis=0)[1] > 1.0 and abs(result.vertices.mean(axis=0)[[0, 2]]).max() < 0.02


def test_undersides_and_walls_are_told(bent):
    box, faces = globe(2)
    result = bent((box, faces), size=0.5)
    assert (edges_of(result.triangles)[0] == 2).all() and euler(result.triangles) == 2
    kinds = [warning.kind for warning in result.warnings]
    assert kinds == ["flipped"] and "walls and undersides" in result.warnings[0].text


def test_distant_places_that_meet_are_told(bent):
    flat, faces = sheet(80, 10, 2.4 * np.pi, 1.0)  # rolled up, 1.2 times round
    angle, radius = flat[:, 0], 1 + 0.1 * flat[:, 0] / (2 * np.pi)
    rolled = np.stack([radius * np.cos(angle), radius * np.sin(angle), flat[:, 1]], 1)
    thin = koebe.lift(rolled, faces, "circles", size=0.3, thickness=0.05, perforate=True)
    assert thin.crossings == 0 and "crossings" not in [warning.kind for warning in thin.warnings]
    for options in ({"thickness": 0.13, "perforate": True}, {"height": 0.13}):
        thick = koebe.lift(rolled, faces, "circles", size=0.3, **options)
        assert thick.crossings > 0
        (warning,) = [one for one in thick.warnings if one.kind == "crossings"]
        assert "distant places of the result meet" in warning.text and max(warning.elements) < len(faces)
        at = angle[faces[warning.elements]]
        assert at.max() > 2.1 * np.pi and not ((at > 0.7 * np.pi) & (at < 1.7 * np.pi)).any()
        assert at.min() < 0.3 * np.pi or "height" in options  # walls have no face


def test_what_a_mesh_does_not_have_is_refused(bent, tmp_path):
    for options, message in (
        ({"perforate": True}, "bent as it is"),
        ({"thickness": 0.1}, "bent as it is"),
        ({"bridge": 0.1}, "a bridge is for"),
        ({"around": 3}, "around is for"),
        ({"shape": "disk", "repeats": 2}, "repeats of a mesh"),
    ):
        with pytest.raises(koebe.InputError, match=message):
            bent(sheet(), **options)
    line, faces = sheet()
    with pytest.raises(koebe.InputError, match="no width in x"):
        bent((line * (1, 0, 1), faces))
    (tmp_path / "in.obj").write_text(obj_text(*tube()))
    (tmp_path / "pattern.obj").write_text("v 0 0 0\nf 1 2 3\n")
    run = command("lift", "in.obj", "pattern.obj", "out.obj", "--shape", "ring", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and "InputError" in run.stderr
    (tmp_path / "pattern.obj").write_text(obj_text(*sheet()))
    options = ["--shape", "ring", "--size", "1", "--json", "r.json"]
    run = succeeded("lift", "in.obj", "pattern.obj", "out.obj", *options, cwd=tmp_path)
    report = json.loads((tmp_path / "r.json").read_text())
    assert "bent, 400 faces" in run.stdout, run.stderr
    assert report["pattern"] == "pattern.obj" and report["faces"] == 400 and report["crossings"] == 0
    assert (tmp_path / "out.obj").read_text().count("\nvt ") > 0
