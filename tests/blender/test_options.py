"""Values that `Options` refuses, and wheels that fit."""

import platform
import sys

import pytest


@pytest.mark.parametrize(
    "values",
    [
        {"method": "rf"}, {"engine": "gpu"}, {"balance": "x"}, {"placement": "x"},
        {"outer": "x"}, {"outer": -1}, {"center": "x"}, {"center": -1}, {"point": "longest"}, {"tolerance": 0.0},
        {"tolerance": float("nan")}, {"max_sweeps": 0}, {"threads": -1}, {"margin": 0.5}, {"margin": -0.1},
        {"checker_size": 0.0}, {"layer": ""}, {"layer": "  "}, {"layer": ".hidden"}, {"layer": "ä" * 32},
    ],
    ids=str,
)  # fmt: skip
def test_unusable_values_are_refused_by_name(addon, values):
    options = addon("maps.options")
    with pytest.raises(options.OptionError, match=next(iter(values))):
        options.Options(**values)


def test_usable_values_are_taken(addon):
    options = addon("maps.options")
    chosen = options.Options(method="ck", outer=12, layer="ä" * 31, margin=0.0)
    assert chosen.solver_arguments()["method"] == "ck"
    assert chosen.outer == 12


def test_wheels_are_told_apart_by_their_tags(addon, monkeypatch):
    tags = addon("solver.wheel_tags")
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(platform, "machine", lambda: "x86_64")
    tag = tags.interpreter_tag()
    assert tag == f"cp3{sys.version_info.minor}"
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-manylinux_2_34_x86_64.whl")
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-manylinux_2_17_x86_64.manylinux2014_x86_64.whl")
    assert tags.wheel_fits(f"koebe-0.1.0-1-{tag}-abi3-linux_x86_64.whl")
    for other in (
        "koebe-0.1.0-cp27-cp27-linux_x86_64.whl",
        f"koebe-0.1.0-{tag}-{tag}t-linux_x86_64.whl",
        f"koebe-0.1.0-{tag}-{tag}-manylinux_2_34_aarch64.whl",
        f"koebe-0.1.0-{tag}-{tag}-musllinux_1_2_x86_64.whl",
        f"koebe-0.1.0-{tag}-{tag}-win_amd64.whl",
        f"koebe-0.1.0-{tag}-{tag}-macosx_11_0_x86_64.whl",
        f"koebe-{tag}.whl",
        f"koebe-0.1.0-{tag}-{tag}-linux_x86_64.zip",
    ):
        assert not tags.wheel_fits(other), other
    monkeypatch.setattr(sys, "platform", "win32")
    monkeypatch.setattr(platform, "machine", lambda: "AMD64")
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-win_amd64.whl")
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-macosx_11_0_arm64.whl")


def test_without_a_wheel_that_fits_the_error_names_both_sides(addon, monkeypatch, tmp_path):
    load = addon("solver.load")
    (tmp_path / "wheels").mkdir()
    (tmp_path / "wheels" / "koebe-0.1.0-cp27-cp27-plan9_vax.whl").touch()
    monkeypatch.setattr(load, "ADDON", tmp_path)
    with pytest.raises(load.NativeError) as caught:
        load._fitting_wheel()
    assert addon("solver.wheel_tags").interpreter_tag() in str(caught.value)
    assert "cp27-cp27-plan9_vax" in str(caught.value)
