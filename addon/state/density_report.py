# SPDX-License-Identifier: GPL-3.0-or-later
"""The texel density that was measured last, for the panel to show."""

import bpy
from bpy.props import FloatProperty, IntProperty, StringProperty

from ..layers.uv_density import in_words
from .option_properties import settings_of
from .registering import added_to


class KoebeDensity(bpy.types.PropertyGroup):
    """Densities in sides of the UV square per unit of length."""

    object_name: StringProperty(description="Name of the object that was measured, empty if none was")
    layer: StringProperty(description="UV layer that was measured")
    whole: FloatProperty(description="Mean over the whole object")
    chosen: FloatProperty(description="In Edit Mode: mean over the selected faces, else 0")
    least: FloatProperty(description="Of the island with the fewest texels")
    most: FloatProperty(description="Of the island with the most texels")
    islands: IntProperty(description="Number of islands")


def density_of(context: bpy.types.Context) -> KoebeDensity:
    """The last measurement."""
    return context.window_manager.koebe_density


def density_words(context: bpy.types.Context, density: float) -> str:
    """A density in the scene's units, for the panel's Texture Size."""
    units = context.scene.unit_settings
    return in_words(density, settings_of(context).pixels, units.system, units.scale_length)


register, unregister = added_to(bpy.types.WindowManager, "koebe_density", KoebeDensity)
