# SPDX-License-Identifier: GPL-3.0-or-later
"""Koebe UV: conformal UV maps of surfaces with holes, every hole a perfect circle."""

bl_info = {
    "name": "Koebe UV",
    "description": "Conformal UV maps with every hole a perfect circle",
    "author": "The Koebe UV developers",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "3D View and UV Editor > Sidebar > Koebe; U menu; UV menu",
    "category": "UV",
}


def _parts():
    """The modules with something to register. Imported late: the rest of the package needs no bpy."""
    from . import (
        circles,
        distortion_operator,
        fill_operator,
        operators,
        panels,
        preferences,
        presets,
        properties,
        results,
        select_operators,
        shape_operators,
    )

    return (
        properties, results, operators, select_operators, distortion_operator, circles, fill_operator, shape_operators,
        presets, panels, preferences,
    )  # fmt: skip


def register():
    """Called by Blender when the add-on is enabled."""
    for part in _parts():
        part.register()


def unregister():
    """Called by Blender when the add-on is disabled."""
    for part in reversed(_parts()):
        part.unregister()
