# SPDX-License-Identifier: GPL-3.0-or-later
"""The tools "Koebe Circles" and "Koebe Relax" in the UV Editor's toolbar."""

from typing import Any

import bpy
import numpy as np

from ..operators.moebius import UV_OT_koebe_moebius
from ..operators.relax_brush import UV_OT_koebe_relax
from . import drawing

CIRCLES_TOOL = "koebe_uv.circles"
RELAX_TOOL = "koebe_uv.relax"
TURN = np.linspace(0.0, 2.0 * np.pi, 49)
BRUSH = (0.9, 0.9, 0.9, 0.7)


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


class RelaxTool(bpy.types.WorkSpaceTool):
    """What the toolbar shows."""

    bl_space_type = "IMAGE_EDITOR"
    bl_context_mode = "UV"
    bl_idname = RELAX_TOOL
    bl_label = "Koebe Relax"
    bl_description = (
        "Brush over UVs to relax them: texels become more even, and the map stays one to one.\n"
        "Borders of islands and pinned UVs stay. F changes the radius"
    )
    bl_icon = "brush.uv_sculpt.relax"
    bl_widget = None
    bl_keymap = (
        (UV_OT_koebe_relax.bl_idname, {"type": "LEFTMOUSE", "value": "PRESS"}, None),
        ("wm.radial_control", {"type": "F", "value": "PRESS"},
         {"properties": [("data_path_primary", "scene.koebe_relax_radius")]}),
    )  # fmt: skip

    @staticmethod
    def draw_settings(context: bpy.types.Context, layout: bpy.types.UILayout, tool: object) -> None:
        """The radius in the header, and E, which stays for the next stroke."""
        layout.prop(context.scene, "koebe_relax_radius")
        settings: Any = tool
        layout.prop(settings.operator_properties(UV_OT_koebe_relax.bl_idname), "even", slider=True)

    @staticmethod
    def draw_cursor(context: bpy.types.Context, tool: object, xy: tuple[int, int]) -> None:
        """The circle of the brush."""
        scene: Any = context.scene
        circle = np.stack([np.cos(TURN), np.sin(TURN)], axis=1) * scene.koebe_relax_radius + xy
        drawing.lines([circle], BRUSH, 1.5)


TOOLS = (CirclesTool, RelaxTool)


def register() -> None:
    """Add the tools after Blender's select and cursor tools. Without a window there may be no toolbar."""
    if bpy.context.window_manager.keyconfigs.addon is not None:
        bpy.utils.register_tool(CirclesTool, after={"builtin.cursor"}, separator=True)
        bpy.utils.register_tool(RelaxTool, after={CIRCLES_TOOL})


def unregister() -> None:
    """Remove them, if they are there."""
    for tool in reversed(TOOLS):
        if hasattr(tool, "_bl_tool"):
            bpy.utils.unregister_tool(tool)
