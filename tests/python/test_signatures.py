"""Functions of one cast: the same things have the same names, calls show and log what they do."""

import inspect
import io
import logging
import re
import time

import koebe
import numpy as np
import pytest
from koebe import _docstrings, _watched

FUNCTIONS = {name: one for name, one in vars(koebe).items() if name in koebe.__all__ and inspect.isfunction(one)}
SIGNATURES = {name: inspect.signature(one).parameters for name, one in FUNCTIONS.items()}
FACE = koebe.example("face")
# What a function is about, if it is no surface.
SUBJECTS = set(
    "a result results path files subject distances matrix rims points radii uv image name loop_count".split()
)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_arguments_are_named_alike(name):
    names = list(SIGNATURES[name])
    if names[0] == "vertices":
        assert names[1:2] == ["triangles"] or name == "weld"
        assert SIGNATURES[name]["triangles"].default is None if name != "weld" else True
    else:
        assert names[0] in SUBJECTS and "triangles" not in names
    assert (names[0] == "a") == (names[1:2] == ["b"])
    assert ("progress" in names) == ("cancel" in names)
    assert not {"mesh", "source", "target", "v", "f", "faces", "verts"} & {*names}
    if "progress" in names:
        assert SIGNATURES[name]["progress"].default is None


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_argument_is_described_with_its_type(name):
    text = FUNCTIONS[name].__doc__
    said = re.findall(r"^\**(\w+) : \S", text.partition("Parameters")[2].partition("\n\nReturns")[0], re.MULTILINE)
    assert said == list(SIGNATURES[name]) and "\nExamples\n" in text
    assert name in _docstrings.PLAIN and "----" not in _docstrings.PLAIN[name]


@pytest.mark.parametrize("option", ["threads", "importance"])
def test_maps_have_the_options_that_their_native_options_have(option):
    natives = {
        "uniformize": "Uniformize", "parts": "Parts", "flatten": "Flatten", "sphere_map": "Sphere", "pack": "Pack",
        "torus_map": "Tile", "ring_map": "Tile", "schottky_map": "Schottky", "lift": "Lift",
        "certified_moduli": "Capacity",
    }  # fmt: skip
    for name, native in natives.items():
        options = getattr(koebe._koebe, f"{native}Options")()
        has = hasattr(options, option) or hasattr(getattr(options, "mesh", None), option)
        assert (option in SIGNATURES[name]) == has, name


def test_old_names_are_taken_with_a_warning():
    result = koebe.uniformize(FACE)
    with pytest.warns(DeprecationWarning, match="align_domains: source is now a") as told:
        alignment = koebe.align_domains(source=result, b=result)
    assert alignment == koebe.align_domains(result, result) and told[0].filename == __file__
    with pytest.warns(DeprecationWarning, match="fit_circles: mesh is now vertices") as told:
        fit = koebe.fit_circles(mesh=FACE, centers=result.centers, radii=result.radii)
    assert fit.flipped == 0 and told[0].filename == __file__
    rims = koebe.boundary_loops(FACE[1])
    for again in (koebe.boundary_loops(*FACE), koebe.boundary_loops(triangles=FACE[1]), koebe.boundary_loops(FACE)):
        assert all(map(np.array_equal, rims, again))


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_long_call_shows_a_bar_in_a_terminal_alone(monkeypatch):
    result = koebe.uniformize(FACE)
    monkeypatch.setattr(_watched, "_SILENT", 0.0)
    monkeypatch.setattr(_watched, "_PAUSE", 0.0)
    for stream, shown in ((io.StringIO(), False), (Terminal(), True)):
        for call in (lambda **how: koebe.uniformize(FACE, **how), lambda **how: koebe.family([FACE, FACE], **how)):
            monkeypatch.setattr("sys.stderr", stream)
            begin = stream.tell()
            call()
            said = stream.getvalue()[begin:]
            assert bool(said) == shown
            if shown:
                name = said[1:].partition(" ")[0]
                assert {*re.findall(r"\r(\w+) \[", said)} == {name} and said.endswith(" \r") and "%" in said
            call(progress=False)
            call(progress=lambda fraction, stage: None)
            assert stream.getvalue()[begin:] == said
    assert koebe.uniformize(FACE) == result


def test_a_short_call_and_a_closed_stream_show_nothing(monkeypatch):
    stream = Terminal()
    monkeypatch.setattr("sys.stderr", stream)
    begin = time.monotonic()
    koebe.uniformize(FACE)
    assert time.monotonic() - begin > _watched._SILENT or not stream.getvalue()
    stream.close()
    koebe.uniformize(FACE)
    monkeypatch.setattr("sys.stderr", None)
    koebe.uniformize(FACE)


def test_calls_are_logged_once(caplog):
    with caplog.at_level(logging.INFO, "koebe"):
        result = koebe.uniformize(FACE)
        koebe.family([result, FACE])
    said = [(one.levelname, one.getMessage().partition(":")[0]) for one in caplog.records]
    assert said == [("INFO", "uniformize"), ("INFO", "family")] and str(result) in caplog.text
    caplog.clear()
    with caplog.at_level(logging.INFO, "koebe"):
        early = koebe.uniformize(FACE, max_sweeps=1, tolerance=1e-14)
    assert [one.levelname for one in caplog.records] == ["INFO"] + ["WARNING"] * len(early.warnings)
    assert early.warnings[0].text in caplog.text


def test_a_disk_is_the_complex_plane_too():
    result = koebe.uniformize(FACE)
    assert np.array_equal(result.z.real, result.uv[:, 0]) and np.array_equal(result.z.imag, result.uv[:, 1])
