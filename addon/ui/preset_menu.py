# SPDX-License-Identifier: GPL-3.0-or-later
"""The list of presets behind the button in the panel's header."""

import bpy
from bl_ui.utils import PresetPanel

from ..maps.presets import PRESETS
from ..operators.option_presets import FOLDER, UV_OT_koebe_preset


class KOEBE_PT_presets(PresetPanel, bpy.types.Panel):
    """The list behind the button in the panel's header."""

    bl_label = "Koebe UV Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    preset_add_operator = "uv.koebe_preset_add"

    def draw(self, context: bpy.types.Context) -> None:
        """The presets that come with the add-on, and below them the user's."""
        self.layout.emboss = "PULLDOWN_MENU"
        column = self.layout.column()
        for word, row in PRESETS.items():
            column.operator(UV_OT_koebe_preset.bl_idname, text=row.label, icon="PRESET").preset = word
        PresetPanel.draw(self, context)


class KOEBE_MT_presets(bpy.types.Menu):
    """What `AddPresetBase` names the active preset by."""

    bl_label = "Koebe UV Presets"
    preset_subdir = FOLDER
    preset_operator = "script.execute_preset"
    draw = bpy.types.Menu.draw_preset  # type: ignore[assignment]


register, unregister = bpy.utils.register_classes_factory((KOEBE_PT_presets, KOEBE_MT_presets))
