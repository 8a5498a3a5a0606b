# SPDX-License-Identifier: GPL-3.0-or-later
"""What the panels have in common."""

import textwrap
from typing import TYPE_CHECKING

import bpy

CHARACTER = 7.8  # pixels of the sidebar's width for each character of a line of text, at a resolution scale of 1


if TYPE_CHECKING:  # what is mixed into panels is one for the type checker alone

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
        """The layout with names on the left and without keyframe dots."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


def draw_message(layout: bpy.types.UILayout, message: str) -> None:
    """Lines of text, as long as the sidebar is wide."""
    context = bpy.context
    width = context.region.width / context.preferences.system.ui_scale / CHARACTER
    lines = layout.column(align=True)
    lines.scale_y = 0.8
    for line in textwrap.wrap(message, max(20, int(width))):
        lines.label(text=line)
