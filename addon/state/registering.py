# SPDX-License-Identifier: GPL-3.0-or-later
"""Adds data to the window manager, which undo does not change."""

from collections.abc import Callable

import bpy
from bpy.props import PointerProperty


def on_window_manager(
    name: str, *classes: type[bpy.types.PropertyGroup]
) -> tuple[Callable[[], None], Callable[[], None]]:
    """Functions that register property classes, add the last one to the window manager by this name, and undo that."""

    def register() -> None:
        for cls in classes:
            bpy.utils.register_class(cls)
        setattr(bpy.types.WindowManager, name, PointerProperty(type=classes[-1]))

    def unregister() -> None:
        delattr(bpy.types.WindowManager, name)
        for cls in reversed(classes):
            bpy.utils.unregister_class(cls)

    return register, unregister
