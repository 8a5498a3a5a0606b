# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of comparing shapes, kept with the window manager for the panel."""

import bpy
from bpy.props import BoolProperty, CollectionProperty, FloatProperty, StringProperty

from .registering import added_to


class KoebeModuleNumber(bpy.types.PropertyGroup):
    """A number of a conformal module."""

    value: FloatProperty(precision=6, description="Length in the unit disk")  # its name: r_1, y_2, ...


class KoebeShape(bpy.types.PropertyGroup):
    """A shape that was compared; its name is that of its object."""

    measured: BoolProperty(description="Whether there is a distance")
    distance: FloatProperty(precision=6, description="L2 distance of the conformal modules")
    message: StringProperty(description="Why there is none, or what to watch out for")


class KoebeShapes(bpy.types.PropertyGroup):
    """The last comparison: the first shape, and the others with their distances from it."""

    source: StringProperty(description="Name of the object whose module it is")
    module: CollectionProperty(type=KoebeModuleNumber, description="Its conformal module")
    others: CollectionProperty(type=KoebeShape, description="What it was compared with")
    carried: CollectionProperty(type=KoebeShape, description="What its texture was carried to, and how well it fits")


def shapes_of(context: bpy.types.Context) -> KoebeShapes:
    """The shown results."""
    return context.window_manager.koebe_shapes


register, unregister = added_to(bpy.types.WindowManager, "koebe_shapes", KoebeModuleNumber, KoebeShape, KoebeShapes)
