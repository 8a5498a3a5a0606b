# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds property groups to Blender's types."""

from collections.abc import Callable

import bpy
from bpy.props import PointerProperty


def added_to(
    owner: type[bpy.types.Scene] | type[bpy.types.WindowManager], name: str, *classes: type[bpy.types.PropertyGroup]
) -> tuple[Callable[[], None], Callable[[], None]]:
    """Functions that register property classes, add the last one to the scene or, as undo does not change that, to the
    window manager by this name, and undo that."""

    def register() -> None:
        for cls in classes:
            bpy.utils.register_class(cls)
        setattr(owner, name, PointerProperty(type=classes[-1]))

    def unregister() -> None:
        delattr(owner, name)
        for cls in reversed(classes):
            bpy.utils.unregister_class(cls)

    return register, unregister
