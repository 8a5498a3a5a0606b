"""Patterns on closed surfaces of genus 0: no seam, no flip, holes counted, and what no sphere can hold refused."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, obj_text, succeeded
from cli_support import koebe as command
from test_lift import edges_of, euler, loops_of, stored_areas
from test_lift_png import png
from test_lift_svg import LETTER_O, path, svg


def globe(levels=4, stretch=(1.0, 1.0, 1.0)):
    """An octahedron subdivided and put on an ellipsoid; the faces are counter-clockwise seen from outside."""
    points = [np.array(p, float) for p in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(levels):
        middle = {}

        def half(a, b, middle=middle):
            if (key := (min(a, b), max(a, b))) not in middle:
                middle[key] = len(points)
                points.append((points[a] + points[b]) / np.linalg.norm(points[a] + points[b]))
            return middle[key]

        faces = [
            new
            for a, b, c in faces
            for ab, bc, ca in [(half(a, b), half(b, c), half(c, a))]
            for new in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))
        ]
    return np.array(points) * stretch, np.array(faces)


def volume(result):
    return np.linalg.det(result.vertices[result.triangles]).sum() / 6


def sizes_of(loops, vertices):
    around = [vertices[loop] for loop in loops]
    return np.array([np.linalg.norm(points - np.roll(points, 1, axis=0), axis=1).sum() for points in around])


@pytest.mark.parametrize("pattern", ["circles", "voronoi"])
@pytest.mark.parametrize("stretch", [(1, 1, 1), (1, 1.5, 0.7)])
def test_each_outline_is_one_hole_and_none_is_left_out(pattern, stretch):
    vertices, triangles = globe(5, stretch)
    result = koebe.lift(vertices, triangles, pattern, shape="sphere", size=0.3, perforate=True)
    holes = result.outlines
    assert holes > 100 and result.left_out["at_border"] == 0 == result.left_out["crossing"]
    assert len(loops_of(result.triangles)) == holes and euler(result.triangles) == 2 - holes
    assert (stored_areas(result.uv) > 0).all() and result.uv.min() >= 0 and result.uv.max() <= 1
    assert result.converged and result.crossings == 0
    own = result.original >= 0
    assert (result.vertices[own] == vertices[result.original[own]]).all()


def test_circles_are_even_all_over_the_sphere():
    vertices, triangles = globe(5)
    result = koebe.lift(vertices, triangles, "circles", shape="sphere", size=0.25, bridge=0.05, perforate=True)
    loops = loops_of(result.triangles)
    sizes = sizes_of(loops, result.vertices) / (np.pi * 0.2)
    assert sizes.max() < 1.05 and sizes.min() > 0.6
    heights = np.array([result.vertices[loop].mean(axis=0)[2] for loop in loops])
    polar, equatorial = sizes[abs(heights) > 0.7], sizes[abs(heights) < 0.3]
    assert abs(polar.mean() - equatorial.mean()) < 0.04  # the charts change at the equator, and nobody sees it


def test_a_closed_surface_becomes_solids():
    vertices, triangles = globe(4)
    hollow = koebe.lift(vertices, triangles, "circles", shape="sphere", size=0.4, thickness=0.1, perforate=True)
    faces, directed = edges_of(hollow.triangles)
    assert hollow.closed and (faces == 2).all() and (directed == 1).all() and hollow.crossings == 0
    assert euler(hollow.triangles) == 2 * (2 - hollow.outlines)  # two spheres, joined by a wall in each hole
    relief = koebe.lift(vertices, triangles, "voronoi", shape="sphere", size=0.4, height=0.05)
    assert (edges_of(relief.triangles)[0] == 2).all() and euler(relief.triangles) == 2
    assert volume(relief) > 4.1
    assert (stored_areas(relief.uv[relief.patch < 2]) > 0).all()


def test_a_drawing_lies_around_a_vertex():
    vertices, triangles = globe(5)
    vertex = int(np.argmax(vertices @ (0.6, -0.64, 0.48)))
    for around in (None, vertex):
        middle = vertices[vertex] if around else np.array([0.0, 0.0, 1.0])
        result = lift_drawing(vertices, triangles, around)
        raised = np.unique(result.triangles[result.patch == 1])
        ring = result.vertices[raised] / np.linalg.norm(result.vertices[raised], axis=1)[:, None]
        away = np.arccos(np.clip(ring @ middle, -1, 1))
        assert result.outlines == 1 and euler(result.triangles) == 2
        assert away.max() == pytest.approx(0.2, rel=0.1) and away.min() == pytest.approx(0.1, rel=0.2)


def lift_drawing(vertices, triangles, around, **options):
    import tempfile
    from pathlib import Path

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "ring.svg"
        file.write_text(svg(path(LETTER_O, 'fill-rule="evenodd"')))
        return koebe.lift(
            vertices, triangles, file, shape="sphere", around=around, **{"size": 0.4, "height": 0.001, **options}
        )


def test_a_drawing_goes_over_the_equator_of_the_charts():
    vertices, triangles = globe(5)
    result = lift_drawing(vertices, triangles, int(np.argmax(vertices[:, 0])), size=1.0, height=None, perforate=True)
    assert result.outlines == 1 and len(loops_of(result.triangles)) == 1 and euler(result.triangles) == 1
    assert (stored_areas(result.uv) > 0).all()
    (loop,) = loops_of(result.triangles)
    away = np.arccos(np.clip(result.vertices[loop, 0], -1, 1))
    assert np.ptp(away) < 0.02  # a circle about the x axis


def test_an_image_goes_round_as_on_a_globe(tmp_path):
    vertices, triangles = globe(4)
    pixels = np.zeros((32, 64), np.uint8)
    pixels[:, 48:] = 255  # of longitudes from 90 to 180 degrees
    pixels[:4] = 255  # the cap about the north pole
    (tmp_path / "map.png").write_bytes(png(pixels))
    result = koebe.lift(vertices, triangles, tmp_path / "map.png", shape="sphere", height=0.1)
    height = np.linalg.norm(result.vertices, axis=1) - 1
    x, y, z = result.vertices.T / np.linalg.norm(result.vertices, axis=1)
    longitude = np.degrees(np.arctan2(y, x))
    assert (edges_of(result.triangles)[0] == 2).all() and euler(result.triangles) == 2
    assert height[(longitude > 100) & (longitude < 170) & (abs(z) < 0.8)].min() > 0.09
    assert height[(longitude < 80) & (longitude > -170) & (z < 0.8) & (z > -0.99)].max() < 0.01
    assert height[z > 0.97].min() > 0.09


def test_what_no_sphere_can_hold_is_refused(tmp_path):
    vertices, triangles = globe(3)
    sphere = {"shape": "sphere", "perforate": True}
    with pytest.raises(koebe.InputError, match="does not close on a sphere"):
        koebe.lift(vertices, triangles, "hexagons", **sphere)
    with pytest.raises(koebe.InputError, match="no evenness"):
        koebe.lift(vertices, triangles, "circles", even=0.5, **sphere)
    with pytest.raises(koebe.InputError, match="around is for"):
        koebe.lift(vertices, triangles, "circles", around=3, **sphere)
    with pytest.raises(koebe.InputError, match="does not exist"):
        lift_drawing(vertices, triangles, 10**6)
    with pytest.raises(koebe.InputError, match="repeats of a drawing"):
        lift_drawing(vertices, triangles, None, repeats=3)
    (tmp_path / "in.obj").write_text(obj_text(vertices, triangles))
    run = command("lift", "in.obj", "hexagons", "out.obj", "--shape", "sphere", "--perforate", cwd=tmp_path)
    assert run.returncode == CANNOT_BE_MAPPED and not (tmp_path / "out.obj").exists()
    run = succeeded("lift", "in.obj", "voronoi", "out.obj", "--shape", "sphere", "--perforate", "--json", "r.json",
                  cwd=tmp_path)  # fmt: skip
    report = json.loads((tmp_path / "r.json").read_text())
    assert report["shape"] == "sphere" and report["flipped"] == 0, run.stderr
