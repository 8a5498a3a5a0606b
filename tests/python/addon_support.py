"""The modules of the add-on that need no bpy, imported from this checkout."""

import importlib
import importlib.util
import sys
from pathlib import Path

ADDON = Path(__file__).resolve().parents[2] / "addon"
NAME = "addon_without_bpy"
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


def maps_module(name):
    """A module of the add-on's room `maps`."""
    return addon_module(f"maps.{name}")
