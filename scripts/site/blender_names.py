# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the add-on's operators with their properties as JSON, as Blender has registered them.

    blender -b --factory-startup --python-exit-code 1 -P scripts/site/blender_names.py -- OUT.json
"""

import json
import sys
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "tests" / "python"))

from addon_support import registered_addon  # noqa: E402


def names():
    """The operators' names, such as uv.koebe_unwrap."""
    return {f"{room}.{name}" for room in dir(bpy.ops) for name in dir(getattr(bpy.ops, room))}


def described(one):
    """A property as a dict."""
    said = {"name": one.identifier, "label": one.name, "does": one.description, "kind": one.type.lower()}
    said["hidden"] = one.is_hidden
    if one.type in ("INT", "FLOAT"):
        said["default"] = list(one.default_array) if one.is_array else one.default
        said["range"] = [one.hard_min, one.hard_max]
    elif one.type == "ENUM":
        items = [(item.identifier, item.name, item.description) for item in one.enum_items]
        said["default"] = sorted(one.default_flag) if one.is_enum_flag else one.default
        said["choices"] = items
    elif one.type in ("BOOLEAN", "STRING"):
        said["default"] = one.default
    return said


def operator(name):
    """An operator as a dict."""
    room, function = name.split(".")
    kind = getattr(getattr(bpy.ops, room), function).get_rna_type()
    properties = [described(one) for one in kind.properties if one.identifier != "rna_type"]
    return {"name": name, "label": kind.name, "does": kind.description, "properties": properties}


def main():
    before = names()
    registered_addon()
    added = sorted(names() - before)
    if not added:
        raise SystemExit("no operator was registered")
    Path(sys.argv[-1]).write_text(json.dumps([operator(name) for name in added], indent=1) + "\n", "utf-8")


if __name__ == "__main__":
    main()
