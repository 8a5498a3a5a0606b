# SPDX-License-Identifier: GPL-3.0-or-later
"""The common part of the panels."""

import textwrap
from typing import TYPE_CHECKING, Any

import bpy

from ..maps.domain_table import DOMAINS
from ..maps.option_table import ROWS
from ..operators.pack import UV_OT_koebe_pack
from ..operators.run_operator import is_used
from ..operators.sew import UV_OT_koebe_sew
from ..operators.unwrap import SHAPE_OF, UV_OT_koebe_unwrap
from ..state.option_properties import KoebeSettings, copy_options
from ..surfaces.stored import SERVES
from .help import draw_help

CHARACTER = 7.8  # pixels of the sidebar's width per character of text, at a resolution scale of 1


if TYPE_CHECKING:  # mixins have this base for the type checker only

    class PanelBase(bpy.types.Panel):
        """A panel that is drawn."""

        layout: bpy.types.UILayout
else:
    PanelBase = object


class KoebePanel(PanelBase):
    """The common part of the panels, mixed into one class for each editor."""

    bl_region_type = "UI"
    bl_category = "Koebe"
    help_at: str  # the heading of the guide about it

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        """The button that opens the guide."""
        draw_help(self.layout, self.help_at)

    def aligned_layout(self) -> bpy.types.UILayout:
        """A layout with names on the left and without keyframe dots."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


class ClosedPanel(KoebePanel):
    """Closed at first."""

    bl_options = {"DEFAULT_CLOSED"}


BUTTONS: dict[str, tuple[str, Any]] = {
    "uniformize": (SERVES["uniformize"], "MESH_CIRCLE"), "parts": (SERVES["parts"], "UV_DATA"),
    **{name: (domain.button, domain.icon) for name, domain in DOMAINS.items()},
}  # fmt: skip


def draw_map_button(column: bpy.types.UILayout, settings: KoebeSettings, of: str) -> Any:
    """The button of one kind of map, whatever shape the panel has: the operator's options."""
    text, icon = BUTTONS[of]
    return draw_unwrap(column, settings, SHAPE_OF[of], text, icon)


def draw_pack(layout: bpy.types.UILayout, settings: KoebeSettings, text: str = "Pack Only") -> Any:
    """The button that packs a UV layer, with the panel's options: the operator's options."""
    button = layout.operator(UV_OT_koebe_pack.bl_idname, text=text, icon="PACKAGE")
    for name in ("margin", "pixels", "average_scale", "tiles", "seconds", "keep_places", "atlas"):
        setattr(button, name, getattr(settings, name))
    return button


def draw_sew(layout: bpy.types.UILayout, settings: KoebeSettings) -> None:
    """The button that joins islands, with the panel's options."""
    button = layout.operator(UV_OT_koebe_sew.bl_idname, text="Sew", icon="UV_EDGESEL")
    button.keep_angles, button.even = settings.keep_angles, settings.even


def draw_unwrap(layout: bpy.types.UILayout, settings: KoebeSettings, shape: str, text: str, icon: Any) -> Any:
    """A button or a menu's entry that unwraps to a shape, with the panel's options: the operator's options."""
    button = layout.operator(UV_OT_koebe_unwrap.bl_idname, text=text, icon=icon)
    copy_options(settings, button, "unwrap")
    button.shape = shape
    return button


def draw_message(layout: bpy.types.UILayout, message: str, most: int = 0) -> int:
    """Draw text in lines as wide as the sidebar, with `most` at most so many. Returns the total number of lines."""
    context = bpy.context
    width = context.region.width / context.preferences.system.ui_scale / CHARACTER
    wrapped = textwrap.wrap(message[:1].upper() + message[1:], max(20, int(width)))
    if wrapped:
        lines = layout.column(align=True)
        lines.scale_y = 0.8
    for line in wrapped[: most or None]:
        lines.label(text=line)
    return len(wrapped)


def draw_weights(column: bpy.types.UILayout, settings: KoebeSettings, option: str, context: bpy.types.Context) -> None:
    """Draw the vertex group of an option, and under it the button to Weight Paint, or back."""
    obj: Any = context.active_object
    row = column.row()
    row.use_property_split = False
    row.active = is_used(settings, option)
    split = row.split(factor=0.44)  # a little more room than Blender gives to names, as More Texels needs it
    name = split.row()
    name.alignment = "RIGHT"
    name.label(text=ROWS[option].blender["label"])
    if obj is None or obj.type != "MESH":
        split.prop(settings, option, text="")
        return
    value = split.column(align=True)
    value.prop_search(settings, option, obj, "vertex_groups", text="")
    painting = obj.mode == "WEIGHT_PAINT"
    text = "Stop Painting" if painting else "Paint It"
    value.operator("paint.weight_paint_toggle", text=text, depress=painting)
