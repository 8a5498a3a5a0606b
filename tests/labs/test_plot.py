"""Pictures of a result."""

import doctest
import sys
from pathlib import Path

import koebe
import numpy as np
import pytest
from koebe._fields import areas as signed_areas
from matplotlib import pyplot as plt
from test_meshes import TRIANGLES, VERTICES

RESULT = koebe.uniformize(VERTICES, TRIANGLES)


@pytest.mark.parametrize("field", ["checker", "log_scale", "angle_error"])
def test_the_surface_and_its_domain_are_drawn(field, tmp_path):
    figure = koebe.plot(RESULT, field=field)
    space, plane = figure.axes[:2]
    assert len(figure.axes) == (2 if field == "checker" else 3)  # with a colour bar
    drawn = [(*patch.center, patch.radius) for patch in plane.patches]
    assert np.allclose(drawn, np.column_stack([RESULT.centers, RESULT.radii]))
    pieces = len(plane.collections[0].get_paths()) / len(TRIANGLES)
    assert pieces > 1 if field == "checker" else pieces == 1
    areas = [path.vertices[:-1] for path in plane.collections[0].get_paths()]
    area = sum(0.5 * np.cross(b - a, c - a) for a, b, c in (np.c_[t, np.zeros(3)][:3] for t in areas))[2]
    assert np.isclose(area, np.pi * (1 - (RESULT.radii[1:] ** 2).sum()), rtol=0.05)
    figure.savefig(tmp_path / "picture.png")
    assert (tmp_path / "picture.png").stat().st_size > 10_000


def test_another_field_is_an_error():
    with pytest.raises(koebe.OptionError, match="field must be one of checker, log_scale, angle_error"):
        koebe.plot(RESULT, field="area")


def test_values_of_ones_own_colour_the_picture():
    heights = RESULT.vertices[:, 2]
    pictures = [koebe.plot(RESULT, field=values) for values in (heights, heights[RESULT.triangles].mean(axis=1))]
    colours = [figure.axes[1].collections[0].get_facecolor() for figure in pictures]
    assert np.array_equal(*colours) and len(np.unique(colours[0], axis=0)) > 100 and len(pictures[0].axes) == 3
    for wrong in (heights[:5], np.array(["a"] * len(heights)), None):
        with pytest.raises(koebe.InputError, match="numbers at the vertices"):
            koebe.plot(RESULT, field=wrong)


def test_a_family_is_drawn_as_its_mean_over_its_template():
    stretched = koebe.uniformize(RESULT.vertices * [1.0, 1.2, 1.0], RESULT.triangles)
    found = koebe.family([RESULT, stretched])
    space, plane = koebe.plot(found, field=found.spread).axes[:2]
    assert np.allclose([patch.radius for patch in plane.patches], found.maps[0].radii)
    assert np.allclose(space.get_ylim(), [found.mean[:, 1].min(), found.mean[:, 1].max()])
    ball = koebe.fill_holes(VERTICES, TRIANGLES)[:2]
    closed = koebe.family([ball, ball])
    assert len(koebe.plot(closed).axes) == 2


def test_matplotlib_is_loaded_by_no_one_else():
    import subprocess

    done = subprocess.run([sys.executable, "-c", "import koebe, sys; sys.exit('matplotlib' in sys.modules)"])
    assert done.returncode == 0


def test_the_example_of_the_docstring_runs(monkeypatch):
    monkeypatch.chdir(Path(__file__).resolve().parents[2])
    (found,) = doctest.DocTestFinder(recurse=False).find(koebe.plot, "plot", module=False, globs={})
    assert found.examples and doctest.DocTestRunner().run(found).failed == 0


def test_a_result_is_drawn_into_axes_of_ones_own():
    from matplotlib import pyplot

    figure, plane = pyplot.subplots()
    assert koebe.plot(RESULT, ax=plane) is figure and len(figure.axes) == 1 and len(plane.patches) == len(RESULT.loops)
    figure = pyplot.figure()
    space, plane = figure.add_subplot(1, 2, 1, projection="3d"), figure.add_subplot(1, 2, 2)
    assert koebe.plot(RESULT, field="log_scale", ax=(plane, space)) is figure and len(figure.axes) == 3
    assert len(space.collections) == len(plane.collections) == 1
    for wrong in (3, [], [plane, plane], "plane"):
        with pytest.raises(TypeError, match="ax must be"):
            koebe.plot(RESULT, ax=wrong)


LINK = Path(__file__).resolve().parents[2] / "docs" / "link.obj"
MAPS = {
    "cut": lambda: koebe.uniformize(LINK, cut=True),
    "parts": lambda: koebe.parts(LINK),
    "ring": lambda: koebe.ring_map(VERTICES, TRIANGLES),
    "torus": lambda: koebe.torus_map(LINK),
    "sphere": lambda: koebe.sphere_map(VERTICES, TRIANGLES),
    "schottky": lambda: koebe.schottky_map(LINK),
    "flatten": lambda: koebe.flatten(LINK),
    "lift": lambda: koebe.lift(VERTICES, TRIANGLES, perforate=True),
}


@pytest.mark.parametrize("kind", MAPS)
def test_every_map_is_drawn(kind):
    result = MAPS[kind]()
    for field in ("checker", "log_scale", "angle_error"):
        space, plane = koebe.plot(result, field=field).axes[:2]
        drawn = np.array([path.vertices[:3] for path in plane.collections[0].get_paths()])
        areas, expected = (abs(signed_areas(uv)).sum() for uv in (drawn, result.corner_uv[result._drawn()]))
        assert np.isclose(areas, expected, rtol=1e-6)
        assert len(space.collections[0].get_facecolor()) == len(drawn)
        plt.close("all")


def test_a_solid_is_drawn_without_uvs():
    solid = koebe.lift(VERTICES, TRIANGLES, perforate=True, thickness=0.01)
    assert len(koebe.plot(solid).axes) == 1
    with pytest.raises(koebe.InputError, match="a solid has no UVs"):
        koebe.plot(solid, field="log_scale")
