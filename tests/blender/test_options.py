"""Values that `Options` refuses, and wheels that fit."""

import importlib.machinery
import platform
import sys
import zipfile

import bpy
import pytest

pytestmark = pytest.mark.alike


@pytest.mark.parametrize(
    "values",
    [
        {"method": "rf"}, {"engine": "gpu"}, {"balance": "x"}, {"placement": "x"},
        {"outer": "x"}, {"outer": -1}, {"center": "x"}, {"center": -1}, {"point": "longest"}, {"tolerance": 0.0},
        {"tolerance": float("nan")}, {"max_sweeps": 0}, {"threads": -1}, {"margin": 65537}, {"margin": -0.1},
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


def test_the_panel_is_made_of_the_table(addon):
    """Labels, words, defaults and ranges of every option, in the panel and in the operator that has it."""
    operators = {"uniformize": "koebe_uniformize", "parts": "koebe_parts", "sequence": "koebe_sequence",
                 **{domain: f"koebe_{domain}" for domain in ("torus", "ring", "sphere", "schottky")}}  # fmt: skip
    table = {row.name: row for row in addon("maps.option_table").ROWS.values() if row.is_property}
    panel = bpy.context.scene.koebe_uv.bl_rna.properties
    assert {prop.identifier for prop in panel} - {"rna_type", "name"} == {*table}
    for of, operator in operators.items():
        own = getattr(bpy.ops.uv, operator).get_rna_type().properties
        names = {row.name for row in table.values() if of in row.maps}
        assert {prop.identifier for prop in own} - {"rna_type"} == names
        for prop in [*own, *panel]:
            row = table.get(prop.identifier)
            if row is None:
                continue
            assert prop.name == row.blender["label"] and prop.description.lower().startswith(row.does.lower())
            assert prop.default == (pytest.approx(row.default) if row.kind == "number" else row.default)
            if row.choices:
                items = [(item.identifier, item.name, item.description.lower()) for item in prop.enum_items]
                assert items == [(word, label, means.lower()) for word, label, means in row.choices]
            elif row.kind in ("number", "integer"):
                # The panel offers nothing that the options refuse.
                assert not row.problem(prop.hard_min) and not row.problem(prop.hard_max)


def test_wheels_are_told_apart_by_their_tags(addon, monkeypatch):
    tags = addon("solver.wheel_tags")
    monkeypatch.setattr(sys, "platform", "linux")
    monkeypatch.setattr(platform, "machine", lambda: "x86_64")
    tag = tags.interpreter_tag()
    assert tag == f"cp3{sys.version_info.minor}"
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-manylinux_2_34_x86_64.whl")
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-manylinux_2_17_x86_64.manylinux2014_x86_64.whl")
    assert tags.wheel_fits(f"koebe-0.1.0-1-{tag}-abi3-linux_x86_64.whl")
    assert tags.wheel_fits("koebe-0.1.0-py3-none-manylinux_2_28_x86_64.whl")
    for other in (
        "koebe-0.1.0-py3-none-manylinux_2_28_aarch64.whl",
        "koebe-0.1.0-py3-none-win_amd64.whl",
        "koebe-0.1.0-py2-none-linux_x86_64.whl",
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
    assert tags.wheel_fits("koebe-0.1.0-py3-none-win_amd64.whl")
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr(platform, "machine", lambda: "arm64")
    assert tags.wheel_fits(f"koebe-0.1.0-{tag}-{tag}-macosx_11_0_arm64.whl")
    assert tags.wheel_fits("koebe-0.1.0-py3-none-macosx_11_0_arm64.whl")


def wheel_of(folder, platform_tag, *suffixes):
    """A wheel for several Pythons, by what is in it."""
    folder.mkdir(exist_ok=True)
    path = folder / f"koebe-0.1.0-py3-none-{platform_tag}.whl"
    with zipfile.ZipFile(path, "w") as archive:
        for name in ("koebe/__init__.py", "koebe/libkoebe.so", *(f"koebe/_koebe{suffix}" for suffix in suffixes)):
            archive.writestr(name, "")
    return path


def test_a_wheel_for_several_pythons_serves_those_whose_modules_it_has(addon, monkeypatch, tmp_path):
    load = addon("solver.load")
    monkeypatch.setattr(load, "ADDON", tmp_path)
    monkeypatch.setattr(load, "wheel_fits", lambda name: True)
    own = importlib.machinery.EXTENSION_SUFFIXES[0]
    path = wheel_of(tmp_path / "wheels", "plan9_vax", ".cpython-27-vax.so", own)
    assert load._fitting_wheel().path == path
    wheel_of(tmp_path / "wheels", "plan9_vax", ".cpython-27-vax.so", ".cpython-28-vax.so")
    with pytest.raises(load.NativeError) as caught:
        load._fitting_wheel()
    assert addon("solver.wheel_tags").interpreter_tag() in str(caught.value)
    assert "py3-none-plan9_vax (.cpython-27-vax.so, .cpython-28-vax.so)" in str(caught.value)
    path.write_bytes(b"no zip")  # whose damage is named where it is unpacked
    assert load._fitting_wheel().path == path


def test_without_a_wheel_that_fits_the_error_names_both_sides(addon, monkeypatch, tmp_path):
    load = addon("solver.load")
    (tmp_path / "wheels").mkdir()
    (tmp_path / "wheels" / "koebe-0.1.0-cp27-cp27-plan9_vax.whl").touch()
    monkeypatch.setattr(load, "ADDON", tmp_path)
    with pytest.raises(load.NativeError) as caught:
        load._fitting_wheel()
    assert addon("solver.wheel_tags").interpreter_tag() in str(caught.value)
    assert "cp27-cp27-plan9_vax" in str(caught.value)
