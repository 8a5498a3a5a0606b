# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that save the panel's options as a preset, take one that comes with the add-on, and reset them."""

import contextlib
import os
from typing import Any

import bpy
from bl_operators.presets import AddPresetBase

from ..blender import edit_mode
from ..blender.noted_properties import note_group
from ..blender.transaction import transaction
from ..maps.presets import PRESETS
from ..state.option_properties import SETTING_NAMES, settings_of
from .answers import refused

FOLDER = "koebe_uv"  # of the presets, within the user's presets


class UV_OT_koebe_preset_add(AddPresetBase, bpy.types.Operator):
    """Keep the options of the panel under a name, or remove a preset"""

    bl_idname = "uv.koebe_preset_add"
    bl_label = "Add Koebe UV Preset"
    preset_menu = "KOEBE_MT_presets"
    preset_subdir = FOLDER

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            return super().execute(context)  # type: ignore[return-value]
        except OSError as error:
            return refused(self, f"the preset cannot be written or removed: {error.strerror or error}")

    def add(self, context: bpy.types.Context, path: str) -> None:
        """Write the file, completely or not at all. It may replace another. `AddPresetBase` calls this."""
        settings = settings_of(context)
        lines = [f"bpy.context.scene.koebe_uv.{name} = {getattr(settings, name)!r}\n" for name in SETTING_NAMES]
        temporary = f"{path}.part"
        try:
            with open(temporary, "w", encoding="utf-8") as file:
                file.writelines(["import bpy\n", *lines])
            os.replace(temporary, path)
        finally:
            with contextlib.suppress(OSError):
                os.unlink(temporary)


class UV_OT_koebe_preset(bpy.types.Operator):
    """Set the options of the panel for a purpose. Texture Size stays, and all other options get their defaults"""

    bl_idname = "uv.koebe_preset"
    bl_label = "Koebe Preset"
    bl_options = {"REGISTER", "UNDO"}

    preset: bpy.props.EnumProperty(
        name="Preset",
        items=[(word, row.label, row.does[0].upper() + row.does[1:]) for word, row in PRESETS.items()],
        description="Purpose of the UVs",
    )

    @classmethod
    def description(cls, context: bpy.types.Context, properties: bpy.types.OperatorProperties) -> str:
        """Each preset has its own tooltip."""
        does = PRESETS[properties.preset].does
        return does[0].upper() + does[1:]

    def execute(self, context: bpy.types.Context) -> set[str]:
        return _set_options(context, PRESETS[self.preset].values(settings_of(context).pixels))


class UV_OT_koebe_reset(bpy.types.Operator):
    """Give all options of the panel their default values"""

    bl_idname = "uv.koebe_reset"
    bl_label = "Reset to Defaults"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        return _set_options(context, {})


def _set_options(context: bpy.types.Context, values: dict[str, Any]) -> set[str]:
    """Give the options of the panel these values, and the others their defaults."""
    settings = settings_of(context)
    with transaction() as run:
        note_group(run, settings)
        for name in SETTING_NAMES:
            settings.property_unset(name)
        for name, value in values.items():
            setattr(settings, name, value)
        edit_mode.undo_all(context)
        return {"FINISHED"}
