"""Installed, used and removed through Blender's own operators: no library and no wheel is left anywhere."""

import importlib
import shutil
import sys
from pathlib import Path

import processes
import pytest

# Prints the sizes of what is there before and after the removal.
SCRIPT = """
import importlib, os, sys
from pathlib import Path
import bpy, addon_utils
home = Path(os.environ["HOME_UNDER_TEST"])
def megabytes():
    return sum(f.stat().st_size for f in home.rglob("*") if f.is_file() and not f.is_symlink()) / 1e6
sys.path.insert(0, os.environ["TESTS"])
import installing
module = installing.install(str(home.parent / "koebe_uv.zip"))
native = importlib.import_module(module + ".jobs.native_package")
assert native.load().__file__.startswith(str(home))
print("BEFORE", megabytes(), flush=True)
if bpy.app.version >= (4, 2, 0):
    index = [repo.module for repo in bpy.context.preferences.extensions.repos].index("user_default")
    bpy.ops.extensions.package_uninstall(repo_index=index, pkg_id="koebe_uv")
else:
    window = bpy.context.window_manager.windows[0]
    with bpy.context.temp_override(window=window, area=window.screen.areas[0]):  # it redraws an area
        bpy.ops.preferences.addon_remove(module=module)
assert not any(addon_utils.check(module))
print("AFTER", megabytes(), flush=True)
if not bpy.app.binary_path and bpy.app.version < (4, 5, 0):
    # The module bpy 4.2 crashes at its end once an add-on was removed that has a property with a function: any add-on,
    # also one without a library. Blender itself does not free its types that late.
    os._exit(0)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="a loaded library can be removed only when Blender starts next")
def test_removal_leaves_no_library(addon_name, tmp_path):
    installed = Path(importlib.import_module(addon_name).__file__).parent
    shutil.copytree(installed, tmp_path / "koebe_uv", ignore=shutil.ignore_patterns("__pycache__", "unpacked"))
    shutil.make_archive(str(tmp_path / "koebe_uv"), "zip", tmp_path, "koebe_uv")
    home = tmp_path / "home"
    folders = {name: home / name.lower() for name in ("CONFIG", "SCRIPTS", "DATAFILES", "EXTENSIONS")}
    for folder in (*folders.values(), folders["SCRIPTS"] / "addons"):
        folder.mkdir(parents=True)
    script = tmp_path / "script.py"
    script.write_text(SCRIPT)
    process = processes.start(script, tmp_path, HOME_UNDER_TEST=home, BLENDER_USER_RESOURCES=home,
                              TESTS=Path(__file__).parent,
                              **{f"BLENDER_USER_{name}": folder for name, folder in folders.items()})
    code, out, err = processes.finish(process)
    sizes = {line.split()[0]: float(line.split()[1]) for line in out.splitlines() if line[:6] in ("BEFORE", "AFTER ")}
    assert code == 0 and sizes["BEFORE"] > 5, out + err
    assert sizes["AFTER"] < 0.1, out + err
