"""Installs the add-on's zip through Blender's own operators."""

import bpy


def install(package: str) -> str:
    """Install and enable the zip; return the add-on's module name."""
    if bpy.app.version >= (4, 2, 0):
        bpy.ops.extensions.package_install_files(filepath=package, repo="user_default", enable_on_install=True)
        return "bl_ext.user_default.koebe_uv"
    bpy.ops.preferences.addon_install(filepath=package)
    bpy.ops.preferences.addon_enable(module="koebe_uv")
    return "koebe_uv"
