"""One Blender window for each file of tests, with the zip installed as a user does."""

import os
from pathlib import Path

import pytest
from window import ROOT, Window

SAMPLES = ROOT / "blend_samples"


@pytest.fixture(scope="module")
def window(tmp_path_factory):
    """The window, on factory settings, with the zip that PACKAGE names, or else that of `make package`."""
    package = os.environ.get("PACKAGE")
    if not package:
        (package,) = (path for path in (ROOT / "dist").glob("koebe_uv-*.zip") if path.stem.count("-") == 1)
    home = tmp_path_factory.mktemp("blender")
    found = Window(str(package), home)
    yield found
    found.close()
    log = (home / "log").read_text()
    assert "Traceback" not in log, log  # what a draw function raises is seen nowhere else


@pytest.fixture
def open_sample(window):
    """A function that opens a .blend file in the workspace Layout: its mesh selected, seen from the front, and the tab
    Koebe open."""

    def opened(name, folder=SAMPLES):
        window.run(f"bpy.ops.wm.open_mainfile(filepath={str(Path(folder) / (name + '.blend'))!r}, load_ui=False)")
        window.run(
            "view = bpy.context.window_manager.windows[0].view_layer\n"
            "for obj in view.objects: obj.select_set(obj.type == 'MESH')\n"
            "view.objects.active = next(obj for obj in view.objects if obj.type == 'MESH')\n"
        )
        window.workspace("Layout")
        window.run("bpy.context.window_manager.koebe_uv.islands.clear(); heart.silences.clear()")
        window.look_at_model()
        return name

    return opened
