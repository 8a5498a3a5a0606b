# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's preferences: an optional keyboard shortcut, and its asset library."""

from typing import Any

import bpy

from .. import __name__ as addon_name
from ..operators.node_groups import NODE_OT_koebe_add_library, NODE_OT_koebe_remove_library
from .help import draw_help

OPERATOR = "uv.koebe_unwrap"
# Where the shortcut Shift Alt U works: keymap and its space type.
KEYMAPS: tuple[tuple[str, Any], ...] = (("Mesh", "EMPTY"), ("Object Mode", "EMPTY"), ("UV Editor", "EMPTY"))


def update_shortcut(preferences: "KoebePreferences", context: bpy.types.Context) -> None:
    """Add or remove the shortcut, according to the preference."""
    remove_shortcut()
    keyconfig = context.window_manager.keyconfigs.addon
    if not preferences.shortcut or keyconfig is None:  # it does not exist in the background
        return
    for name, space in KEYMAPS:
        keymap = keyconfig.keymaps.new(name=name, space_type=space)
        keymap.keymap_items.new(OPERATOR, "U", "PRESS", shift=True, alt=True)


def remove_shortcut() -> None:
    """Remove the shortcut everywhere."""
    keyconfig = bpy.context.window_manager.keyconfigs.addon
    if keyconfig is None:
        return
    for name, _ in KEYMAPS:
        keymap = keyconfig.keymaps.get(name)
        items = [] if keymap is None else [item for item in keymap.keymap_items if item.idname == OPERATOR]
        for item in items:
            keymap.keymap_items.remove(item)


class KoebePreferences(bpy.types.AddonPreferences):
    """Shown under the add-on's entry in Blender's preferences."""

    bl_idname = addon_name

    shortcut: bpy.props.BoolProperty(
        name="Shift Alt U Unwraps",
        default=False,
        update=update_shortcut,
        description="Shift Alt U unwraps in Object Mode, in Edit Mode and in the UV Editor",
    )

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.label(text="In the 3D View press N and open the tab Koebe", icon="INFO")
        self.layout.prop(self, "shortcut")
        row = self.layout.row(align=True)
        draw_help(row, "", text="Guide")
        draw_help(row, "", "troubleshooting", "Troubleshooting")
        row = self.layout.row(align=True)
        row.operator(NODE_OT_koebe_add_library.bl_idname, text="Add Node Groups as Asset Library", icon="ASSET_MANAGER")
        row.operator(NODE_OT_koebe_remove_library.bl_idname, text="", icon="X")


def register() -> None:
    """Register the preferences and set their shortcut."""
    bpy.utils.register_class(KoebePreferences)
    addon = bpy.context.preferences.addons.get(addon_name)
    if addon is not None and addon.preferences is not None:
        update_shortcut(addon.preferences, bpy.context)


def unregister() -> None:
    """The reverse of `register`."""
    remove_shortcut()
    bpy.utils.unregister_class(KoebePreferences)
