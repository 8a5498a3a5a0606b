"""batch.py on several files and folders: each by a Blender of its own, through the native module's command."""

import importlib
import json
import os
import signal
import time
from pathlib import Path

import bpy
import processes
import pytest
import scenes

pytestmark = pytest.mark.skipif(not bpy.app.binary_path, reason="the module bpy is no program to start")


@pytest.fixture
def library(tmp_path):
    """Two files that can be mapped, one in a folder with a picture, and one whose only object is closed."""
    folder = tmp_path / "library"
    (folder / "more").mkdir(parents=True)
    for name, closed in (("a", False), ("more/b", False), ("closed", True)):
        bpy.ops.wm.read_homefile(use_empty=True)
        if closed:
            scenes.add_cube()
        else:
            scenes.add_panel()
        if name == "more/b":
            picture = bpy.data.images.new("Picture", 4, 4)
            picture.filepath_raw, picture.file_format = str(folder / "picture.png"), "PNG"
            picture.save()
            bpy.ops.wm.save_as_mainfile(filepath=str(folder / f"{name}.blend"))
            bpy.ops.file.make_paths_relative()
            picture.use_fake_user = True
        bpy.ops.wm.save_as_mainfile(filepath=str(folder / f"{name}.blend"))
    return folder


def start(addon_name, folder, *words):
    script = Path(importlib.import_module(addon_name).__file__).with_name("batch.py")
    return processes.start(script, folder, arguments=words)


def run(addon_name, folder, *words):
    return processes.finish(start(addon_name, folder, *words))


def rows(out):
    return {row["name"]: row for row in json.loads((out / "summary.json").read_text())["files"]}


def test_a_folder_is_mapped_file_by_file_and_resumed(addon_name, koebe, library, tmp_path):
    out = tmp_path / "out"
    words = (library, "--output", out, "--workers", "2", "--layer", "Mine", "--no-upright", "--no-cut")
    code, printed, err = run(addon_name, tmp_path, *words)
    assert code == 3, err
    table = rows(out)
    codes = {name: row["exit_code"] for name, row in table.items()}
    assert codes == {"a.blend": 0, "closed.blend": 3, "more/b.blend": 0}
    assert table["a.blend"]["faces"] > 0 == table["a.blend"]["flipped"] and table["a.blend"]["angle_error_deg"] > 0.0
    assert sorted(table["a.blend"]["options"]["arguments"]) == ["--layer=Mine", "--no-cut", "--no-upright"]
    assert table["closed.blend"]["error"] == "TopologyError(closed)" and not (out / "closed.blend").exists()
    for name in ("a", "more/b"):
        bpy.ops.wm.open_mainfile(filepath=str(out / f"{name}.blend"))
        assert "Mine" in bpy.data.objects["Panel"].data.uv_layers
    picture = bpy.path.abspath(bpy.data.images["Picture"].filepath)
    assert os.path.samefile(picture, library / "picture.png")
    left = {path.relative_to(out).as_posix() for path in out.rglob("*")}
    named = {f"{name}.{kind}" for name in ("a", "more/b") for kind in ("blend", "json")}
    assert left == named | {"more", "closed.json", "summary.json", "summary.csv"}
    times = {path: path.stat().st_mtime_ns for path in out.rglob("*.blend")}
    code, printed, err = run(addon_name, tmp_path, *words)
    assert code == 3 and err.count("unchanged") == 3
    assert {path: path.stat().st_mtime_ns for path in out.rglob("*.blend")} == times


def test_two_files_are_a_library_too(addon_name, koebe, library, tmp_path):
    code, printed, err = run(
        addon_name, tmp_path, library / "a.blend", library / "more" / "b.blend", "--output", tmp_path / "out"
    )
    assert code == 0, err
    assert set(rows(tmp_path / "out")) == {"a.blend", "b.blend"}


def test_a_file_without_the_object_is_told_by_itself(addon_name, koebe, library, tmp_path):
    code, printed, err = run(
        addon_name, tmp_path, library / "a.blend", library / "closed.blend", "--output", tmp_path / "out",
        "--objects", "Panel",
    )  # fmt: skip
    assert code == 3, err
    table = rows(tmp_path / "out")
    assert table["a.blend"]["exit_code"] == 0
    assert table["closed.blend"]["error"] == "UsageError"
    assert "there is no object named 'Panel'" in table["closed.blend"]["error_text"]


def test_a_folder_without_files_is_2(addon_name, koebe, tmp_path):
    (tmp_path / "empty").mkdir()
    code, printed, err = run(addon_name, tmp_path, tmp_path / "empty", "--output", tmp_path / "out")
    assert code == 2 and "no mesh file" in err


def test_a_library_has_no_one_report(addon_name, library, tmp_path):
    code, printed, err = run(addon_name, tmp_path, library, "--output", tmp_path / "out", "--report", "r.json")
    assert code == 2 and "--report works with one file" in err


def test_killed_half_way_it_is_resumed(addon_name, koebe, library, tmp_path):
    out = tmp_path / "out"
    words = (library, "--output", out, "--workers", "1", "--no-cut")
    process = start(addon_name, tmp_path, *words)
    end = time.monotonic() + 120
    while not (out / "a.json").exists() and time.monotonic() < end:
        time.sleep(0.01)
    process.send_signal(signal.SIGKILL)
    processes.finish(process)
    code, printed, err = run(addon_name, tmp_path, *words)
    assert code == 3 and "a.blend: unchanged" in err
    assert len(rows(out)) == 3
    assert not [path for path in out.rglob("*") if path.name.startswith(".koebe")]
