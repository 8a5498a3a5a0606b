# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel for where islands lie, how large they are, and how many pixels they get."""

import bpy

from ..operators.run_operator import draw_option
from ..operators.texel_density import (
    UV_OT_koebe_copy_density,
    UV_OT_koebe_measure_density,
    UV_OT_koebe_set_density,
)
from ..state.density_report import density_of, density_words
from ..state.option_properties import KoebeSettings, settings_of
from .panel_parts import ClosedPanel, draw_pack, draw_weights

NAMES = 0.4  # of a row's width, as Blender gives to names


class PackingPanel(ClosedPanel):
    """Texture size, margin, texel density, tiles, and packing without a new map."""

    bl_label = "Packing"
    help_at = "packing-and-texel-density"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        draw_flags(column, settings, "pixels")
        for name in ("margin", "placement", "tiles"):
            draw_option(column, settings, name, context)
        draw_flags(column, settings, "stack", "stack_mirrored", "atlas", "rectify")
        column.separator()
        draw_density(column, context, settings)
        column.separator()
        draw_pack(column, settings)
        if context.mode == "EDIT_MESH":
            draw_pack(column, settings, "Pack Beside the Rest").keep_places = "OTHERS"
        draw_flags(column, settings, "average_scale")
        for name in ("keep_places", "seconds"):
            draw_option(column, settings, name, context)


def draw_flags(column: bpy.types.UILayout, settings: KoebeSettings, *names: str) -> None:
    """Options that have the whole width for their names."""
    flags = column.column()
    flags.use_property_split = False
    for name in names:
        flags.prop(settings, name)


def draw_density(column: bpy.types.UILayout, context: bpy.types.Context, settings: KoebeSettings) -> None:
    """The density that was measured, the density to set, and that of parts."""
    found = density_of(context)
    obj = context.active_object
    if found.object_name and obj is not None and found.object_name == obj.name:
        draw_line(column, "Object", density_words(context, found.whole))
        if found.chosen:
            draw_line(column, "Selection", density_words(context, found.chosen))
        if found.islands > 1:
            draw_line(column, "Least Island", density_words(context, found.least))
            draw_line(column, "Most Island", density_words(context, found.most))
    column.operator(UV_OT_koebe_measure_density.bl_idname, text="Measure Density", icon="DRIVER_DISTANCE").take = False
    row = column.row(align=True)
    row.prop(settings, "density", text="Px per Unit")
    row.operator(UV_OT_koebe_measure_density.bl_idname, text="", icon="EYEDROPPER").take = True
    button = column.operator(UV_OT_koebe_set_density.bl_idname, text="Set Density")
    button.density, button.pixels = settings.density, settings.pixels
    column.operator(UV_OT_koebe_copy_density.bl_idname, text="Copy from Active")
    for name in ("texels", *(("like",) if settings.texels == "layer" else ())):
        draw_option(column, settings, name, context)
    draw_weights(column, settings, "importance", context)


def draw_line(column: bpy.types.UILayout, name: str, value: str) -> None:
    """A name, as of the fields, and a value."""
    split = column.split(factor=NAMES)
    label = split.row()
    label.alignment = "RIGHT"
    label.label(text=name)
    split.label(text=value)
