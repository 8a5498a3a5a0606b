"""One verdict on every map: what is lost of the surface, and the angle error, as the UVs are stored."""

import json

import koebe
import numpy as np
import promises
import pytest
from cli_support import NOT_CONVERGED, obj_text
from cli_support import koebe as command
from domain_surfaces import holed_ring, holed_torus
from sphere_surfaces import icosphere


def with_finger(vertices, triangles, rings):
    """A tube in place of the faces round an inner vertex, so many times as long as it is thick, closed at its end."""
    ahead = {}
    border = {tuple(e) for k in range(3) for e in triangles[:, [k, (k + 1) % 3]]}
    rim = {v for a, b in border if (b, a) not in border for v in (a, b)}
    tip = next(v for v in range(len(vertices) // 3, len(vertices)) if v not in rim)
    for face in triangles[(triangles == tip).any(axis=1)]:
        a, b = np.roll(face, -int(np.argmax(face == tip)))[1:]
        ahead[a] = b
    ring = [next(iter(ahead))]
    while ahead[ring[-1]] != ring[0]:
        ring.append(ahead[ring[-1]])
    arms = vertices[ring] - vertices[tip]
    out = np.cross(arms, np.roll(arms, -1, axis=0)).sum(axis=0)
    step = np.linalg.norm(arms, axis=1).mean() * out / np.linalg.norm(out)
    points, faces, last = [vertices], [triangles[(triangles != tip).all(axis=1)]], np.array(ring)
    for i in range(rings):
        points.append(vertices[ring] + (i + 1) * step)
        new = np.arange(len(ring)) + len(vertices) + i * len(ring)
        a, b, c, d = last, np.roll(last, -1), np.roll(new, -1), new
        faces += [np.stack([a, b, c], axis=1), np.stack([a, c, d], axis=1)]
        last = new
    faces.append(np.stack([last, np.roll(last, -1), np.full(len(last), tip)], axis=1))
    points = np.concatenate(points)
    points[tip] += (rings + 0.5) * step
    return points, np.concatenate(faces).astype(np.int32)


RING, TORUS, BALL = holed_ring(4, holes={(1, 0): ((0.5, 0.5), 0.3)})[:2], holed_torus(4)[:2], icosphere(6)
DOMAINS = {
    "ring": (koebe.ring_map, RING),
    "torus": (koebe.torus_map, TORUS),
    "sphere": (koebe.sphere_map, BALL),
    "octahedron": (lambda *surface, **options: koebe.sphere_map(*surface, layout="octahedral", **options), BALL),
    "schottky": (koebe.schottky_map, TORUS),
}
ONE_MAP = {
    "uniformize": (koebe.uniformize, RING),
    "sequence": (lambda *surface, **options: koebe.Surface(*surface, **options).uniformize(), RING),
    "cut": (lambda *surface, **options: koebe.uniformize(*surface, cut=True, **options), TORUS),
}


def untrue(result, vertices, triangles):
    """Figures that the UVs do not have."""
    corners = (1 + result.uv)[triangles] / 2 if result.uv.ndim == 2 else result.uv
    return promises.untrue(result, vertices, triangles, corners)


@pytest.mark.parametrize("name", [*DOMAINS, *ONE_MAP, "parts"])
def test_the_verdict_is_that_of_the_stored_uvs_and_too_much_loss_is_said_first(name):
    unwrap, surface = {**DOMAINS, **ONE_MAP, "parts": (koebe.parts, TORUS)}[name]
    plain = unwrap(*surface)
    assert plain.converged and plain.lost_area < 0.01 and untrue(plain, *surface) == []
    assert "lost_area" not in [warning.kind for warning in plain.warnings]
    if name == "parts":  # which cuts limbs off
        return
    limbed = with_finger(*surface, 60)
    result = unwrap(*limbed)
    assert result.lost_area > 0.01 and untrue(result, *limbed) == []
    first = result.warnings[0]
    assert first.kind == "lost_area" and first.elements == result.flipped_faces.tolist()
    assert f"{100 * result.lost_area:.3g} % of the surface's area" in first.text
    assert result.converged is (name in ONE_MAP) and first.text.startswith("not done") is (name in DOMAINS)
    taken = unwrap(*limbed, most_lost=1)
    # UVs of a sphere with flipped faces that are drawn have not converged, whatever area may be lost.
    assert taken.converged is (taken.flipped == taken.below_resolution)
    assert "lost_area" not in [warning.kind for warning in taken.warnings]
    assert taken.lost_area == result.lost_area and np.array_equal(taken.uv, result.uv)


def test_the_command_ends_with_4_and_writes_all_files(tmp_path):
    vertices, triangles = with_finger(*BALL, 60)
    (tmp_path / "ball.obj").write_text(obj_text(vertices, triangles))
    # A second component 1e-11 as large: parts have one texel density, so 32-bit UVs lose it.
    (tmp_path / "two.obj").write_text(
        obj_text(np.concatenate([BALL[0], 1e-11 * BALL[0]]), np.concatenate([BALL[1], BALL[1] + len(BALL[0])]))
    )
    for call in (["sphere", tmp_path / "ball.obj"], ["parts", tmp_path / "two.obj", "--most-lost", "0"]):
        out, report = tmp_path / "out.obj", tmp_path / "out.json"
        out.unlink(missing_ok=True)
        done = command(*call[:2], out, "--json", report, *call[2:])
        assert done.returncode == NOT_CONVERGED and "not converged" in done.stdout and out.stat().st_size > 1000
        said = json.loads(report.read_text())
        assert said["converged"] is False and said["warnings"][0]["kind"] == "lost_area"
        assert said["lost_area"] > said["options"]["most_lost"]
        drawn = said["flipped"] > said["below_resolution"]
        assert command(*call[:2], out, "--most-lost", "1").returncode == (NOT_CONVERGED if drawn else 0)


@pytest.mark.parametrize("value", ["-0.1", "1.1", "nan", "x"])
def test_most_lost_is_a_share(value, tmp_path):
    assert command("sphere", tmp_path / "in.obj", tmp_path / "out.obj", "--most-lost", value).returncode == 2
    if value != "x":
        with pytest.raises(koebe.OptionError):
            koebe.sphere_map(*BALL, most_lost=float(value))
