# SPDX-License-Identifier: GPL-3.0-or-later
"""The options as Blender properties: of the operator (redo panel) and of the scene (panel, before the run)."""

import dataclasses
import math
from typing import Any

import bpy
import numpy as np
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, StringProperty

from ..maps.domain_table import DOMAINS
from ..maps.option_table import ROWS, Row, rows_of
from ..maps.options import WRITTEN, Options, PartsChoice
from .registering import added_to

PROPERTIES = {"number": FloatProperty, "integer": IntProperty, "flag": BoolProperty, "text": StringProperty,
              "weights": StringProperty}  # fmt: skip
OWN = ("precision", "subtype", "maxlen", "soft_max")  # keys of a property in the table


def option(name: str) -> Any:
    """The Blender property of an option."""
    return property_of(ROWS[name])


def property_of(row: Row) -> Any:
    """The Blender property of a row of the table. Its degrees are Blender's radians."""
    own: dict[str, Any] = {key: row.blender[key] for key in OWN if key in row.blender}
    if "options" in row.blender:
        own["options"] = set(row.blender["options"])
    if row.choices:
        own["items"] = [(word, label, _sentence(means)) for word, label, means in row.choices]
    elif row.kind in ("number", "integer"):
        angle = row.blender.get("subtype") == "ANGLE"
        bounds = row.blender.get("range", row.range).items()
        own.update({end: math.radians(value) if angle else value for end, value in bounds})
    kind = EnumProperty if row.choices else PROPERTIES[row.kind]
    description = ". ".join(map(_sentence, (row.does, *row.more)))
    return kind(name=row.blender["label"], description=description, default=row.default, **own)


def _sentence(text: str) -> str:
    return text[0].upper() + text[1:]


def option_names(of: str) -> tuple[str, ...]:
    """The options of a map's operator."""
    return tuple(row.name for row in rows_of(of) if row.is_property)


def mixin(name: str, names: tuple[str, ...]) -> Any:
    """A class with these options as properties."""
    return type(name, (), {"__annotations__": {name: option(name) for name in names}})


ACCURACY_NAMES = ("method", "engine", "tolerance", "max_sweeps", "most_lost")  # most runs do not change these
RANGE_NAMES = ("frame_start", "frame_end", "frame_step")  # the scene's frames by default
OPTION_NAMES = option_names("uniformize")
PART_OPTION_NAMES = option_names("parts")
SEQUENCE_OPTION_NAMES = option_names("sequence")
UNWRAP_OPTION_NAMES = ("shape", *dict.fromkeys(name for of in ("uniformize", "parts", *DOMAINS)
                                               for name in option_names(of)))  # fmt: skip
SETTING_NAMES = tuple(row.name for row in ROWS.values() if row.is_property)

UniformizeProperties = mixin("UniformizeProperties", OPTION_NAMES)
PartsProperties = mixin("PartsProperties", PART_OPTION_NAMES)
SequenceProperties = mixin("SequenceProperties", SEQUENCE_OPTION_NAMES)


class KoebeSettings(mixin("SettingProperties", SETTING_NAMES), bpy.types.PropertyGroup):
    """The scene's settings, shown in the panel."""


def settings_of(context: bpy.types.Context) -> KoebeSettings:
    """The scene's settings."""
    return context.scene.koebe_uv


def copy_options(source: Any, target: Any, of: str = "uniformize") -> None:
    """Copy the options of a map's operator, or of "unwrap", from the settings, or back.

    A sequence's frames are copied only if they are not the scene's.
    """
    for name in UNWRAP_OPTION_NAMES if of == "unwrap" else option_names(of):
        if name not in RANGE_NAMES or not source.scene_range:
            setattr(target, name, getattr(source, name))


def _value(properties: Any, name: str) -> Any:
    """An option as Blender shows it: 0.3, and not the nearest 32-bit number. So the command makes the same map."""
    return shown_number(getattr(properties, name))


def shown_number(value: Any) -> Any:
    """The number as Blender shows it, if it is one with a fraction."""
    return float(str(np.float32(value))) if isinstance(value, float) else value


def sequence_options_of(properties: Any) -> Options:
    """The `Options` of the sequence operator. Raises OptionError."""
    values = {name: _value(properties, name) for name in SEQUENCE_OPTION_NAMES if name in OPTION_NAMES}
    return Options(**values, placement="pack")


def choice_of(of: str, properties: Any) -> Any:
    """The `PartsChoice` of an operator, or its domain's choice. Raises OptionError."""
    kind: Any = PartsChoice if of == "parts" else DOMAINS[of].choice
    known = {field.name for field in dataclasses.fields(kind)}.intersection(option_names(of))
    return kind(**{name: _value(properties, name) for name in known})


def written_options_of(properties: Any, **others: Any) -> Options:
    """The `Options` for writing: layer and checker, and those that are given. Raises OptionError."""
    return Options(**{name: _value(properties, name) for name in WRITTEN}, **others)


def options_of(properties: Any, **others: Any) -> Options:
    """The `Options` of a property group, but for those that are given. Raises OptionError."""
    return Options(**{**{name: _value(properties, name) for name in OPTION_NAMES}, **others})


register, unregister = added_to(bpy.types.Scene, "koebe_uv", KoebeSettings)
