# SPDX-License-Identifier: GPL-3.0-or-later
"""The tool "Koebe Circles" in the UV Editor's toolbar: a mouse press holds the circle or point there."""

import bpy

from ..operators.moebius import UV_OT_koebe_moebius

CIRCLES_TOOL = "koebe_uv.circles"


class CirclesTool(bpy.types.WorkSpaceTool):
    """What the toolbar shows."""

    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = CIRCLES_TOOL
    bl_label = "Koebe Circles"
    bl_description = (
        "Move the circles of a map: drag the disk or a hole, click a hole to make it the rim,\n"
        "drag outside the disk to turn it. Circles stay circles, angles are kept"
    )
    bl_icon = "ops.transform.tosphere"
    bl_widget = None
    bl_keymap = ((UV_OT_koebe_moebius.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),)

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, tool: object) -> None:
        """A line of help in the header."""
        layout.label(text="Drag the disk or a hole. Click a hole to make it the rim. Drag outside to turn the disk")


def register() -> None:
    """Add the tool after Blender's select and cursor tools. Without a window there may be no toolbar."""
    if bpy.context.window_manager.keyconfigs.addon is not None:
        bpy.utils.register_tool(CirclesTool, after={"builtin.cursor"}, separator=True)


def unregister() -> None:
    """Remove it, if it is there."""
    if hasattr(CirclesTool, "_bl_tool"):
        bpy.utils.unregister_tool(CirclesTool)
