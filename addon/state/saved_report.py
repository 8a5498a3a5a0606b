# SPDX-License-Identifier: GPL-3.0-or-later
"""Saves the report with the file: writes it into the scene before saving, reads it after loading."""

import json
import math
from typing import Any

import bpy
from bpy.props import StringProperty

from .run_report import (
    COLLECTIONS,
    KoebeIslandReport,
    KoebeLoopReport,
    KoebeReport,
    KoebeWarningReport,
    report_of,
)

VERSION = 1
# Needed only in this session, and not saved.
NOT_SAVED = ("rna_type", *COLLECTIONS, "corners", "history", "object_key", "mesh_key")
# Texts that hold lists of whole numbers as JSON; cuts hold lists of such lists.
NUMBERS = ("flipped_faces", "torn_faces", "moved_faces", "cut_edges", "vertices", "elements")
CUTS = "cuts"
ELEMENTS = ("vertices", "edges", "faces")
LARGEST = 2**31 - 1


class DamagedError(ValueError):
    """Content that is not a report of this version."""


def packed(report: KoebeReport) -> str:
    """The report as text; empty without a report."""
    if not report.islands:
        return ""
    islands = []
    for entry in report.islands:
        lists = {name: [_values(item) for item in getattr(entry, name)] for name in COLLECTIONS}
        islands.append({**_values(entry), "object_name": entry.owner_name, **lists})
    return json.dumps({"version": VERSION, "active": report.active, "islands": islands})


def unpack(text: str, report: KoebeReport) -> None:
    """Fill the report from text. Damaged text, or text of another version, leaves it empty."""
    report.islands.clear()
    try:
        content = json.loads(text) if text else {"version": VERSION, "active": 0, "islands": []}
        _require(isinstance(content, dict) and content.get("version") == VERSION)
        for values in _list(content, "islands"):
            entry = report.islands.add()
            _fill(entry, values)
            for name in COLLECTIONS:
                for item in _list(values, name):
                    _fill(getattr(entry, name).add(), item)
            _require(all(len(loop.vertices) > len("[]") for loop in entry.loops))
            _require(all(bool(one.of) == bool(one.elements) and one.of in ("", *ELEMENTS) for one in entry.warnings))
        _require(_is_whole(content.get("active")))
        report.active = content["active"]
    except (ValueError, RecursionError):  # JSON errors too
        report.islands.clear()


def _values(group: Any) -> dict[str, Any]:
    """The values of a report's entry that are set, by name."""
    found = {}
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if name not in NOT_SAVED and group.is_property_set(name):
            value = getattr(group, name)
            found[name] = list(value) if getattr(prop, "is_array", False) else value
    return found


def _fill(group: KoebeIslandReport | KoebeLoopReport | KoebeWarningReport, values: Any) -> None:
    """Set an entry's values. Raises DamagedError for an impossible value."""
    _require(isinstance(values, dict))
    for prop in group.bl_rna.properties:
        name = prop.identifier
        if name not in values or name in NOT_SAVED:
            continue
        value = values[name]
        if getattr(prop, "is_array", False):
            _require(isinstance(value, list) and len(value) == prop.array_length and all(map(_is_number, value)))
        else:
            _require(FITS[prop.type](value))
        if name in NUMBERS and value:
            _require(_are_numbers(json.loads(value)))
        if name == CUTS and value:
            found = json.loads(value)
            _require(isinstance(found, list) and all(map(_are_numbers, found)))
        if name == "offenders" and value:
            found = json.loads(value)
            _require(isinstance(found, list) and len(found) == 2 and found[0] in ELEMENTS and _are_numbers(found[1]))
        setattr(group, name, value)


def _list(values: dict[str, Any], name: str) -> list[Any]:
    found = values.get(name)
    if not isinstance(found, list):
        raise DamagedError(name)
    return found


def _require(is_right: bool) -> None:
    if not is_right:
        raise DamagedError


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value <= LARGEST


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < math.inf


def _are_numbers(value: Any) -> bool:
    """Whether it is a list of whole numbers."""
    return isinstance(value, list) and all(map(_is_whole, value))


FITS = {
    "STRING": lambda value: isinstance(value, str),
    "BOOLEAN": lambda value: isinstance(value, bool),
    "INT": _is_whole,
    "FLOAT": lambda value: isinstance(value, (int, float)) and not isinstance(value, bool),
}


@bpy.app.handlers.persistent
def before_save(*_: object) -> None:
    """Called by Blender before it writes the file."""
    for scene in bpy.data.scenes:
        if scene.library is None:
            scene.koebe_report = packed(report_of(bpy.context)) if scene == bpy.context.scene else ""


@bpy.app.handlers.persistent
def after_load(*_: object) -> None:
    """Called by Blender after it has read a file."""
    texts = [scene.koebe_report for scene in bpy.data.scenes if scene.library is None]
    unpack(next(filter(None, texts), ""), report_of(bpy.context))


HANDLERS = ((bpy.app.handlers.save_pre, before_save), (bpy.app.handlers.load_post, after_load))


def register() -> None:
    """Add the text to the scene, and watch saving and loading."""
    bpy.types.Scene.koebe_report = StringProperty(options={"HIDDEN"}, description="The last run's report, when saved")
    for handlers, function in HANDLERS:
        handlers.append(function)


def unregister() -> None:
    """The reverse of `register`."""
    for handlers, function in HANDLERS:
        handlers.remove(function)
    del bpy.types.Scene.koebe_report
