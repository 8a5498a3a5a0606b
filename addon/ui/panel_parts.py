# SPDX-License-Identifier: GPL-3.0-or-later
"""The common part of the panels."""

import textwrap
from typing import TYPE_CHECKING

import bpy

from ..maps.domains import DOMAINS
from ..operators.domains import OPERATORS
from ..operators.parts import UV_OT_koebe_parts
from ..state.option_properties import KoebeSettings, copy_options

CHARACTER = 7.8  # pixels of the sidebar's width per character of text, at a resolution scale of 1


if TYPE_CHECKING:  # mixins have this base for the type checker only

    class PanelBase(bpy.types.Panel):
        """A panel that is drawn."""

        layout: bpy.types.UILayout
else:
    PanelBase = object


class KoebePanel(PanelBase):
    """What the panels have in common; mixed into one class per editor."""

    bl_region_type = "UI"
    bl_category = "Koebe"

    def aligned_layout(self) -> bpy.types.UILayout:
        """A layout with names on the left and without keyframe dots."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


def draw_parts_button(column: bpy.types.UILayout, settings: KoebeSettings, dial: bool = True) -> None:
    """Draw the button that cuts into parts, and above it the dial for their number."""
    if dial:
        column.prop(settings, "evenness", slider=True)
    button = column.column(align=True)
    button.scale_y = 1.4 if dial else 1.0
    run = button.operator(UV_OT_koebe_parts.bl_idname, text="Unwrap to Parts", icon="UV_DATA")
    copy_options(settings, run, "parts")


def draw_domain_button(column: bpy.types.UILayout, settings: KoebeSettings, domain: str) -> None:
    """Draw the button that maps to another domain than the disk."""
    of = DOMAINS[domain]
    copy_options(settings, column.operator(OPERATORS[domain].bl_idname, text=of.button, icon=of.icon), domain)


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
