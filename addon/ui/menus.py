# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's entries in Blender's menus: U, UV, Clean Up, Object, and Export."""

import bpy

from ..operators.domains import OPERATORS
from ..operators.fill_holes import MESH_OT_koebe_fill_holes
from ..operators.flat_copy import OBJECT_OT_koebe_flat_copy, UV_OT_koebe_flat_svg
from ..operators.parts import UV_OT_koebe_parts
from ..operators.sequence import UV_OT_koebe_sequence
from ..operators.symmetrize import UV_OT_koebe_symmetrize
from ..operators.uniformize import UV_OT_koebe_uniformize
from ..state.option_properties import copy_options, settings_of


def draw_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entries in the U menu and in the UV Editor's UV menu, with the panel's options."""
    layout = self.layout
    layout.separator()
    layout.operator_context = "INVOKE_DEFAULT"
    copy_options(settings_of(context), layout.operator(UV_OT_koebe_uniformize.bl_idname))
    copy_options(settings_of(context), layout.operator(UV_OT_koebe_parts.bl_idname), "parts")
    for domain, operator in OPERATORS.items():
        copy_options(settings_of(context), layout.operator(operator.bl_idname), domain)
    copy_options(settings_of(context), layout.operator(UV_OT_koebe_sequence.bl_idname), "sequence")
    layout.operator(UV_OT_koebe_symmetrize.bl_idname)


def draw_clean_up_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry beside Blender's own Fill Holes."""
    self.layout.operator(MESH_OT_koebe_fill_holes.bl_idname)


def draw_object_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in the Object menu of the 3D View."""
    self.layout.separator()
    self.layout.operator(OBJECT_OT_koebe_flat_copy.bl_idname)


def draw_export_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in File ▸ Export."""
    self.layout.operator(UV_OT_koebe_flat_svg.bl_idname, text="Koebe Flat Pieces (.svg)")


MENUS = {
    "VIEW3D_MT_uv_map": draw_menu,
    "IMAGE_MT_uvs": draw_menu,
    "VIEW3D_MT_edit_mesh_clean": draw_clean_up_menu,
    "VIEW3D_MT_object": draw_object_menu,
    "TOPBAR_MT_file_export": draw_export_menu,
}


def register() -> None:
    """Append the entries."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """The reverse of `register`."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).remove(draw)
