"""Lift: outlines at rims, thin bridges, and sizes by weights."""

import json

import koebe
import numpy as np
import pytest
from cli_support import koebe as command
from cli_support import obj_text, perforated, triangles_of

SQUARE = '<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H10V10H0Z"/><path d="M12 0H22V10H12Z"/></svg>'


def panel(n=40, holes=((0.5, 0.5, 0.15),)):
    """A flat square with holes."""
    vertices, quads = perforated(n, holes=holes)
    return np.asarray(vertices) * (1, 1, 0), triangles_of(quads)


def area_of(vertices, triangles):
    a, b = (vertices[triangles[:, k]] - vertices[triangles[:, 0]] for k in (1, 2))
    return 0.5 * np.linalg.norm(np.cross(a, b), axis=1).sum()


def hole_areas(result):
    """The middle (n, 3) and the area (n,) of each new hole in a plane."""
    middles, areas = [], []
    for loop in koebe.boundary_loops(result.triangles, vertex_count=len(result.vertices)):
        points = result.vertices[loop]
        if (result.original[loop] >= 0).all():
            continue
        x, y = points[:, 0], points[:, 1]
        areas.append(0.5 * abs(np.dot(x, np.roll(y, -1)) - np.dot(y, np.roll(x, -1))))
        middles.append(points.mean(axis=0))
    return np.array(middles), np.array(areas)


@pytest.mark.parametrize("pattern", ["hexagons", "triangles", "diamonds", "truchet"])
def test_outlines_at_rims_are_left_out_clipped_or_made_smaller(pattern):
    mesh = panel()
    left, clipped, whole = (
        koebe.lift(*mesh, pattern, size=0.12, rim=rim, perforate=True) for rim in ("leave", "clip", "whole")
    )
    assert left.outlines <= whole.outlines < clipped.outlines and (
        pattern != "hexagons" or left.outlines < whole.outlines
    )
    assert clipped.loops == left.loops  # bays at the rims are no holes
    assert clipped.left_out["at_border"] == 0 < whole.left_out["at_border"] <= left.left_out["at_border"]
    cut = [1.0 - area_of(one.vertices, one.triangles) / area_of(*mesh) for one in (left, whole, clipped)]
    assert max(cut[:2]) < cut[2]
    assert whole.loops["after"] == whole.loops["before"] + whole.outlines


def test_clipped_holes_are_even_up_to_the_rims():
    mesh = panel(holes=())
    share = [
        1.0 - area_of(one.vertices, one.triangles) / area_of(*mesh)
        for one in (
            koebe.lift(*mesh, "hexagons", size=s, rim="clip", bridge=0.2 * s, perforate=True) for s in (0.03, 0.06)
        )
    ]
    assert np.allclose(share, 0.64, atol=0.03)  # 0.8 squared; corners are round


def test_a_solid_with_clipped_outlines_is_closed():
    for more in ({"perforate": True}, {"height": 0.02}, {"height": -0.01}):
        result = koebe.lift(*panel(), "hexagons", size=0.1, rim="clip", thickness=0.03, **more)
        ends = np.concatenate([result.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
        forward = {tuple(e) for e in ends.tolist()}
        assert result.closed and len(forward) == len(ends) and forward == {tuple(e) for e in ends[:, ::-1].tolist()}
        assert np.linalg.det(result.vertices[result.triangles]).sum() > 0
        assert abs(result.weights.sum(axis=2) - 1).max() < 1e-12


def test_thin_bridges_are_told_with_their_places():
    mesh = panel(holes=())
    result = koebe.lift(*mesh, "hexagons", size=0.1, bridge=0.02, perforate=True, even=1.0)
    assert result.thin_bridges == 0 or result.thinnest_bridge < 0.019
    conformal = koebe.lift(*mesh, "hexagons", size=0.1, bridge=0.02, perforate=True)  # corners of a square crowd
    (warning,) = [one for one in conformal.warnings if one.kind == "thin_bridges"]
    assert conformal.thin_bridges > 0 and 0 < conformal.thinnest_bridge < 0.019 and len(warning.elements) > 0
    assert "thinner than asked for" in warning.text
    asked = koebe.lift(*mesh, "hexagons", size=0.1, perforate=True)
    assert asked.thin_bridges == 0 and asked.thinnest_bridge is None


def test_the_bridges_of_a_drawing_are_checked(tmp_path):
    (tmp_path / "two.svg").write_text(SQUARE)
    two = tmp_path / "two.svg"
    mesh = panel(holes=())
    thin = koebe.lift(*mesh, two, size=0.44, bridge=0.05, perforate=True)
    assert thin.thin_bridges == 1 and thin.thinnest_bridge == pytest.approx(0.04, rel=0.1)
    assert koebe.lift(*mesh, two, size=0.44, bridge=0.03, perforate=True).thin_bridges == 0
    with pytest.raises(koebe.InputError, match="a drawing has its own bridges"):
        koebe.lift(*mesh, two, bridge=0.03, height=0.1)


@pytest.mark.parametrize("more", [{"perforate": True}, {"height": 0.02}], ids=str)
def test_a_drawing_is_left_out_clipped_or_made_smaller(tmp_path, more):
    rings = "".join(f"M{x} 0H{x + 10}V10H{x}ZM{x + 2} 2V8H{x + 8}V2Z" for x in (0, 20, 40))
    (tmp_path / "rings.svg").write_text(f'<svg xmlns="http://www.w3.org/2000/svg"><path d="{rings}"/></svg>')
    mesh = panel(holes=())
    left, clipped, whole = (
        koebe.lift(*mesh, tmp_path / "rings.svg", size=1.2, rim=rim, **more) for rim in ("leave", "clip", "whole")
    )
    assert left.outlines == 1 and left.left_out["at_border"] == 2
    assert clipped.outlines == 3 == whole.outlines
    assert clipped.loops["after"] == 1 + ("perforate" in more)  # two are bays
    assert whole.loops["after"] == 1 + 3 * ("perforate" in more) and whole.left_out["at_border"] == 0


@pytest.mark.parametrize("pattern", ["circles", "voronoi", "hexagons", "stripes"])
def test_weights_give_the_sizes(pattern):
    vertices, triangles = panel(holes=())
    weights = 0.3 + 0.7 * vertices[:, 0]
    size = 0.05 if pattern == "stripes" else 0.1
    result = koebe.lift(vertices, triangles, pattern, size=size, graded=weights, perforate=True)
    middles, areas = hole_areas(result)
    low, high = areas[middles[:, 0] < 0.3], areas[middles[:, 0] > 0.7]
    assert len(low) > 4 and len(high) > 4 and 2.5 < np.median(high) / np.median(low) < 12
    part = koebe.lift(vertices, triangles, pattern, size=0.1, graded=(vertices[:, 0] > 0.5) * 1.0, perforate=True)
    middles, _ = hole_areas(part)
    assert len(middles) > 4 and middles[:, 0].min() > 0.45
    alike = koebe.lift(vertices, triangles, pattern, size=0.1, graded=np.ones(len(vertices)), perforate=True)
    plain = koebe.lift(vertices, triangles, pattern, size=0.1, perforate=True)
    assert alike.vertices.shape == plain.vertices.shape and np.allclose(alike.vertices, plain.vertices, atol=1e-6)


def test_what_does_not_fit_is_refused(tmp_path):
    vertices, triangles = panel()
    (tmp_path / "two.svg").write_text(SQUARE)
    for options, said in (
        ({"graded": np.zeros(len(vertices))}, "graded is below 0.1 everywhere"),
        ({"graded": np.full(len(vertices), 2.0)}, "graded not from 0 to 1"),
        ({"graded": np.ones(3)}, "graded must be"),
        ({"shape": "sphere", "rim": "clip"}, "on a sphere nothing is clipped"),
        ({"pattern": tmp_path / "two.svg", "graded": np.ones(len(vertices))}, "graded sizes are for the built-in"),
    ):
        with pytest.raises(koebe.InputError, match=said):
            koebe.lift(vertices, triangles, **{"perforate": True, **options})


def test_the_command_reads_weights_and_rims(tmp_path):
    vertices, triangles = panel(holes=())
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    weights = np.clip(0.3 + 0.7 * vertices[:, 0], 0, 1)
    (tmp_path / "w.txt").write_text("\n".join(map(repr, weights.tolist())))
    run = command("lift", "in.obj", "hexagons", "out.obj", "--size", "0.1", "--bridge", "0.02", "--rim", "clip",
                  "--graded", "w.txt", "--perforate", "--json", "r.json", cwd=tmp_path)  # fmt: skip
    assert run.returncode in (0, 4), run.stderr
    report = json.loads((tmp_path / "r.json").read_text())
    options = {"size": 0.1, "bridge": 0.02, "rim": "clip", "graded": weights, "perforate": True}
    result = koebe.lift(vertices, triangles, "hexagons", **options)
    assert report["outlines"] == result.outlines and report["faces"] == len(result.triangles)
    assert report["thin_bridges"] == result.thin_bridges and report["thinnest_bridge"] == result.thinnest_bridge
    assert report["options"]["rim"] == "clip" and report["options"]["graded"] is True


def test_a_thickness_far_above_the_cells_is_refused_early():
    vertices, triangles = panel(60, holes=())
    points = vertices.copy()
    points[:, 2] = 0.02 * np.sin(40 * points[:, 0]) * np.sin(40 * points[:, 1])
    with pytest.raises(koebe.InputError, match="far more than the surface has room for|would turn over") as caught:
        koebe.lift(points, triangles, "hexagons", size=0.05, perforate=True, thickness=50.0)
    assert len(caught.value.elements) > 0
