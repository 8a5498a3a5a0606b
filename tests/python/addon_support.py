"""The add-on's modules, imported from this checkout: in Blender all, elsewhere those that need no bpy."""

import importlib
import importlib.util
import sys
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addon"
NAME = "koebe_uv"
# Code for another process: makes `addon_module` there.
LOAD = f"import sys\nsys.path.insert(0, {str(Path(__file__).parent)!r})\nfrom addon_support import addon_module\n"


def addon_module(name):
    """A module by its name in the add-on, for example "maps.options"."""
    if NAME not in sys.modules:
        spec = importlib.util.spec_from_file_location(
            NAME, ADDON / "__init__.py", submodule_search_locations=[str(ADDON)]
        )
        sys.modules[NAME] = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(sys.modules[NAME])
    return importlib.import_module(f"{NAME}.{name}")


def registered_addon():
    """Register the add-on of this checkout in Blender. @return the native package"""
    native_package = addon_module("jobs.native_package")
    sys.modules[NAME].register()
    return native_package.load()


def named_module(name):
    """A module of the rooms that need no bpy."""
    (room,) = [room for room in ("surfaces", "layers", "maps") if (ADDON / room / f"{name}.py").exists()]
    return addon_module(f"{room}.{name}")
