# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel that arranges islands, with the trim sheet."""

from typing import Any

import bpy

from ..operators.arrange import UV_OT_koebe_arrange, UV_OT_koebe_trims
from ..state.option_properties import settings_of
from ..state.trims import KoebeTrim, active_trim, trims_of
from .panel_parts import ClosedPanel

# Words of `arrange.MODES` in rows of buttons.
LINES: tuple[tuple[str, Any], ...] = (
    ("LEFT", "ALIGN_LEFT"), ("COLUMN", "ALIGN_CENTER"), ("RIGHT", "ALIGN_RIGHT"),
    ("TOP", "ALIGN_TOP"), ("ROW", "ALIGN_MIDDLE"), ("BOTTOM", "ALIGN_BOTTOM"),
)  # fmt: skip
CHANGES: tuple[tuple[str, Any], ...] = (("ADD", "ADD"), ("REMOVE", "REMOVE"), ("GRID", "GRID"))
SORTED = (("SIZE", "Size"), ("MATERIAL", "Material"), ("PART", "Part"))


class KOEBE_UL_trims(bpy.types.UIList):
    """The rectangles of the trim sheet, whose names can be edited."""

    def draw_item(
        self,
        context: bpy.types.Context,
        layout: bpy.types.UILayout,
        data: Any,
        item: KoebeTrim,
        icon: int,
        active_data: Any,
        active_property: str,
    ) -> None:
        """The name."""
        layout.prop(item, "name", text="", emboss=False, icon="SELECT_SET")


class ArrangePanel(ClosedPanel):
    """Where islands go that are mapped already."""

    bl_label = "Arrange"
    help_at = "arrange"

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column()
        row = column.row(align=True)
        for mode, icon in LINES:
            row.operator(UV_OT_koebe_arrange.bl_idname, text="", icon=icon).mode = mode
        if hasattr(context.space_data, "uv_editor") and context.mode == "EDIT_MESH":
            column.operator("uv.align_rotation", text="Align Rotation", icon="DRIVER_ROTATIONAL_DIFFERENCE")
        column.label(text="Sort by")
        row = column.row(align=True)
        settings = settings_of(context)
        for mode, text in SORTED:
            button = row.operator(UV_OT_koebe_arrange.bl_idname, text=text)
            button.mode, button.margin, button.pixels = mode, settings.margin, settings.pixels
        column.operator(UV_OT_koebe_arrange.bl_idname, text="Onto Mirror Image", icon="MOD_MIRROR").mode = "MIRROR"
        draw_trims(column, context)


def draw_trims(column: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """The trim sheet: its list, how it is changed, and the buttons that take islands to it."""
    trims = trims_of(context)
    row = column.row()
    row.label(text="Trim Sheet")
    row.prop(trims, "shown", text="", icon="HIDE_OFF" if trims.shown else "HIDE_ON")
    row = column.row()
    row.template_list("KOEBE_UL_trims", "", trims, "items", trims, "active", rows=3)
    side = row.column(align=True)
    for action, icon in CHANGES:
        side.operator(UV_OT_koebe_trims.bl_idname, text="", icon=icon).action = action
    chosen = active_trim(trims)
    if chosen is None:
        return
    corners = column.column(align=True)
    corners.prop(chosen, "lower")
    corners.prop(chosen, "upper")
    row = column.row(align=True)
    for text, name in (("To Nearest", ""), (f"To {chosen.name}", chosen.name)):
        button = row.operator(UV_OT_koebe_arrange.bl_idname, text=text)
        button.mode, button.trim = "TRIM", name
