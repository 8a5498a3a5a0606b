"""The paper's algorithms as options of the mesh engine, in the package and in the command."""

import json

import koebe
import numpy as np
import pytest
from cli_support import CANNOT_BE_MAPPED, NOT_CONVERGED, USAGE, obj_text, triangulated_plate
from cli_support import koebe as command

VERTICES, FACES = triangulated_plate()
LOOPS = 4


def run(**options):
    return koebe.uniformize(VERTICES, FACES, engine="mesh", **options)


def inversive_distances(r):
    i, j = np.triu_indices(len(r.radii), 1)
    apart = ((r.centers[i] - r.centers[j]) ** 2).sum(axis=1)
    return np.abs(r.radii[i] ** 2 + r.radii[j] ** 2 - apart) / (2 * r.radii[i] * r.radii[j])


@pytest.mark.parametrize("method", ["gk", "ck", "against-outer"])
@pytest.mark.parametrize("engine", ["mesh", "condensed"])
def test_every_method_finds_the_same_circles(engine, method):
    r = koebe.uniformize(VERTICES, FACES, engine=engine, method=method)
    assert r.converged and r.flipped == 0 and r.method == method
    assert np.allclose(inversive_distances(r), inversive_distances(run()), rtol=2e-2)


def test_each_step_puts_the_loop_that_it_opens_on_the_unit_circle():
    r = run(method="ck", schedule=[0, 3, 1, 2], max_sweeps=1, record_steps=True)
    assert len(r.step_maps) == r.steps == LOOPS
    for step, image in zip(r.history, r.step_maps):
        assert image.shape == (len(VERTICES), 2)
        radius = np.hypot(*image[r.loops[step["pair"][0]]].T)
        assert np.isfinite(radius).sum() >= len(radius) - 4  # ears are not in it
        assert np.nanmax(np.abs(radius - 1.0)) < 1e-12
    assert run().step_maps == []


@pytest.mark.parametrize("engine", ["mesh", "condensed"])
def test_the_mean_roundness_is_that_of_the_loops(engine):
    r = koebe.uniformize(VERTICES, FACES, engine=engine)
    for means, of in ((r.mean_roundness, r.roundness), (r.mean_roundness["least_squares"], r.roundness_least_squares)):
        assert np.isclose(means["all"], np.mean(of), rtol=1e-12)
        assert np.isclose(means["holes"], np.mean(of[1:]), rtol=1e-12)
    assert np.isclose(r.history[-1]["mean_roundness_holes"], r.mean_roundness["holes"], rtol=0.05)
    assert np.isclose(r.history[-1]["mean_roundness"], r.mean_roundness["all"], rtol=0.05)


def test_partners_and_schedules():
    fixed, changing = run(max_sweeps=3, tolerance=1e-12), run(partners="changing", max_sweeps=3, tolerance=1e-12)
    assert [step["pair"] for step in fixed.history] == 3 * [[0, 1], [2, 3]]
    met = sorted(tuple(sorted(step["pair"])) for step in changing.history)
    assert met == [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
    order = [(0, 2), (3, 0), (0, 2), (3, 1), (0, 2)]  # of Fig. 4
    assert [tuple(step["pair"]) for step in run(schedule=order, max_sweeps=1).history] == order
    assert [step["pair"] for step in run(method="ck", schedule=[0, 3, 1, 2], max_sweeps=1).history] == [
        *([0, 0], [3, 3], [1, 1], [2, 2])
    ]


@pytest.mark.parametrize("metric", ["planar", "reflected", "reflected-last"])
@pytest.mark.parametrize("annulus", ["harmonic", "yamabe"])
def test_what_is_in_print_has_its_price_and_is_a_map(metric, annulus):
    exact = inversive_distances(koebe.uniformize(VERTICES, FACES))
    r = run(metric=metric, annulus=annulus, max_sweeps=4)
    assert not r.converged and r.flipped == 0
    own = np.abs(inversive_distances(run(max_sweeps=4)) / exact - 1).max()
    assert np.abs(inversive_distances(r) / exact - 1).max() > 2 * own


@pytest.mark.parametrize(
    ("options", "says"),
    [
        ({"engine": "condensed", "metric": "planar"}, "engine='mesh'"),
        ({"engine": "condensed", "record_steps": True}, "engine='mesh'"),
        ({"engine": "condensed", "schedule": [(0, 1), (2, 3)]}, "engine='mesh'"),
        ({"partners": "changing", "method": "ck"}, "need method='gk'"),
        ({"partners": "changing", "schedule": [(0, 1), (2, 3)]}, "no schedule"),
        ({"annulus": "yamabe"}, "metric='planar'"),
        ({"metric": "reflected-last", "method": "ck"}, "not for method='ck'"),
        ({"schedule": []}, "must have steps"),
        ({"schedule": [[]]}, "must have steps"),
        ({"schedule": [(0, -1)]}, "whole number"),
        ({"method": "outer"}, "must be one of"),
        ({"metric": "image"}, "must be one of"),
    ],
)
def test_options_that_do_not_fit_each_other(options, says):
    with pytest.raises(koebe.OptionError, match=says):
        koebe.uniformize(VERTICES, FACES, **{"engine": "mesh", **options})


@pytest.mark.parametrize(
    ("schedule", "says"),
    [
        ([(0, 1)], "never opens loop 2"),
        ([(0, 1), (2, 4)], "names loop 4"),
        ([(0, 1), (2, 2), (2, 3)], "twice"),
        ([(0, 1), (2,), (2, 3)], "opens 1 loops, not 2"),
    ],
)
def test_a_schedule_that_does_not_fit_the_surface(schedule, says):
    with pytest.raises(koebe.InputError, match=says):
        run(schedule=schedule)


@pytest.mark.parametrize("schedule", ["0-1,2-3", 7, [("a", "b")], [0.5]])
def test_a_schedule_of_another_type(schedule):
    with pytest.raises(TypeError):
        run(schedule=schedule)


@pytest.fixture
def mesh(tmp_path):
    (tmp_path / "in.obj").write_text(obj_text(VERTICES, FACES))
    return tmp_path


def test_the_command_has_the_same_options(mesh):
    files = (mesh / "in.obj", mesh / "out.obj", "--json", mesh / "report.json", "--engine", "mesh", "--max-sweeps", 1)
    words = ("--method", "ck", "--schedule", "0,3,1,2", "--metric", "reflected", "--annulus", "yamabe")
    assert command("uniformize", *files, *words).returncode == NOT_CONVERGED
    report = json.loads((mesh / "report.json").read_text())
    assert [step["pair"][0] for step in report["history"]] == [0, 3, 1, 2]
    twin = run(method="ck", schedule=[0, 3, 1, 2], metric="reflected", annulus="yamabe", max_sweeps=1)
    assert np.allclose([loop["radius"] for loop in report["loops"]], twin.radii, rtol=1e-6)
    assert command("uniformize", *files, "--partners", "changing").returncode == NOT_CONVERGED


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--metric", "planar"), "--engine mesh"),
        (("--engine", "mesh", "--annulus", "yamabe"), "--metric planar"),
        (("--engine", "mesh", "--metric", "reflected-last", "--method", "ck"), "not for --method ck"),
        (("--engine", "mesh", "--schedule", "0-1,2"), "opens 1 loops, not 2"),
        (("--engine", "mesh", "--schedule", "0-1"), "never opens loop 2"),
        (("--engine", "mesh", "--schedule", "0-9,1-2"), "names loop 9"),
        (("--engine", "mesh", "--schedule", "0--1"), "steps like"),
        (("--engine", "mesh", "--schedule", "0-1-2"), "steps like"),
        (("--engine", "mesh", "--partners", "changing", "--method", "ck"), "--method gk"),
    ],
)
def test_the_command_refuses_what_does_not_fit(mesh, words, says):
    done = command("uniformize", mesh / "in.obj", mesh / "out.obj", *words)
    assert done.returncode == USAGE and says in done.stderr and done.stdout == ""
    assert not (mesh / "out.obj").exists()


def test_a_closed_mesh_is_told_so_with_a_schedule_too(mesh):
    tetrahedron = obj_text(np.eye(4)[:, :3], [[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]])
    (mesh / "closed.obj").write_text(tetrahedron)
    done = command("uniformize", mesh / "closed.obj", mesh / "out.obj", "--engine", "mesh", "--schedule", "0-1")
    assert done.returncode == CANNOT_BE_MAPPED and "closed" in done.stderr
