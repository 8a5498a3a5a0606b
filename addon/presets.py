# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of the panel's options, and back to the defaults."""

import contextlib
import os

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from . import edit_mode
from .noted import note_group
from .properties import OPTION_NAMES
from .transaction import transaction

FOLDER = "koebe_uv"


class KOEBE_PT_presets(PresetPanel, bpy.types.Panel):
    """The list behind the button in the panel's header."""

    bl_label = "Koebe UV Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "uv.koebe_preset_add"


class KOEBE_MT_presets(bpy.types.Menu):
    """What `AddPresetBase` names the active preset by."""

    bl_label = "Koebe UV Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    draw = bpy.types.Menu.draw_preset


class UV_OT_koebe_preset_add(AddPresetBase, bpy.types.Operator):
    """Keep the options of the panel under a name, or remove a preset"""

    bl_idname = "uv.koebe_preset_add"
    bl_label = "Add Koebe UV Preset"
    preset_menu = "KOEBE_MT_presets"
    preset_subdir = FOLDER

    def execute(self, context):
        try:
            return super().execute(context)
        except OSError as error:
            self.report({"ERROR"}, f"Koebe UV: the preset cannot be written or removed: {error.strerror or error}")
            return {"CANCELLED"}

    def add(self, context, path):
        """Write the file, which may replace another, as a whole or not at all. `AddPresetBase` calls this."""
        settings = context.scene.koebe_uv
        lines = [f"bpy.context.scene.koebe_uv.{name} = {getattr(settings, name)!r}\n" for name in OPTION_NAMES]
        temporary = f"{path}.part"
        try:
            with open(temporary, "w", encoding="utf-8") as file:
                file.writelines(["import bpy\n", *lines])
            os.replace(temporary, path)
        finally:
            with contextlib.suppress(OSError):
                os.unlink(temporary)


class UV_OT_koebe_reset(bpy.types.Operator):
    """Give all options of the panel their default values"""

    bl_idname = "uv.koebe_reset"
    bl_label = "Reset to Defaults"
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context):
        with transaction() as run:
            note_group(run, context.scene.koebe_uv)
            for name in OPTION_NAMES:
                context.scene.koebe_uv.property_unset(name)
            edit_mode.undo_all(context)
            return {"FINISHED"}


CLASSES = (KOEBE_PT_presets, KOEBE_MT_presets, UV_OT_koebe_preset_add, UV_OT_koebe_reset)


def register():
    """Register the presets."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Undo `register`."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
