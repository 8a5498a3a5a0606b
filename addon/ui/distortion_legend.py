# SPDX-License-Identifier: GPL-3.0-or-later
"""The legend of the distortion display, in the 3D View."""

from typing import Any

import bpy

from ..blender import distortion_attribute
from ..layers import distortion_colors
from . import drawing


def _upper_left(context: bpy.types.Context) -> bool:
    """Whether the region is the only one of its 3D View, or the upper left one of its quad view."""
    regions = [region for region in context.area.regions if region.type == "WINDOW"]
    return context.region == min(regions, key=lambda region: (region.x, -region.y))


def draw_legend() -> None:
    """Draw the legend of the active object's colours, at the upper left of the 3D View."""
    context = bpy.context
    obj: Any = context.active_object
    if obj is None or obj.type != "MESH" or not context.space_data.overlay.show_overlays:
        return
    kind = distortion_attribute.shown(obj.data)
    if kind is not None and _upper_left(context):
        title, marks = distortion_colors.legend(kind)
        drawing.color_bar(title, distortion_colors.ramp(kind), marks)


register, unregister = drawing.drawn("VIEW_3D", name="legend", draw=draw_legend)
