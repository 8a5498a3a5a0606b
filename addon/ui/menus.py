# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's entries in Blender's menus: U, UV, Clean Up, Object, and Export."""

import bpy

from ..blender import checker
from ..blender.mesh_object import mesh_objects
from ..maps.option_table import ROWS
from ..operators.fill_holes import MESH_OT_koebe_fill_holes
from ..operators.flat_copy import OBJECT_OT_koebe_flat_copy, UV_OT_koebe_flat_svg
from ..operators.lift import OBJECT_OT_koebe_lift
from ..operators.sequence import UV_OT_koebe_sequence
from ..operators.symmetrize import UV_OT_koebe_symmetrize
from ..operators.unwrap import MAPS
from ..state.lift_properties import copy_lift_options, lift_settings_of
from ..state.option_properties import copy_options, settings_of
from .panel_parts import BUTTONS, draw_pack, draw_unwrap


class KOEBE_MT_unwrap(bpy.types.Menu):
    """All shapes, with the panel's options."""

    bl_label = "Koebe"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, settings_of(context)
        assert layout is not None
        layout.operator_context = "INVOKE_DEFAULT"
        draw_unwrap(layout, settings, "AUTO", "Unwrap", "UV")
        layout.separator()
        for shape, label, _ in ROWS["shape"].choices[1:]:
            draw_unwrap(layout, settings, shape, label, BUTTONS[MAPS[shape]][1])
        layout.separator()
        sequence = layout.operator(UV_OT_koebe_sequence.bl_idname, text="Animation", icon="RENDER_ANIMATION")
        copy_options(settings, sequence, "sequence")
        layout.operator(UV_OT_koebe_symmetrize.bl_idname, text="Symmetrize", icon="MOD_MIRROR")
        draw_pack(layout, settings)


def draw_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in the U menu and in the UV Editor's UV menu."""
    self.layout.separator()
    self.layout.menu("KOEBE_MT_unwrap")


def draw_clean_up_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry beside Blender's own Fill Holes."""
    self.layout.operator(MESH_OT_koebe_fill_holes.bl_idname)


def draw_object_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in the Object menu of the 3D View."""
    self.layout.separator()
    self.layout.operator(OBJECT_OT_koebe_flat_copy.bl_idname)
    copy_lift_options(lift_settings_of(context), self.layout.operator(OBJECT_OT_koebe_lift.bl_idname))


def draw_export_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in File ▸ Export."""
    self.layout.operator(UV_OT_koebe_flat_svg.bl_idname, text="Koebe Flat Pieces (.svg)")
    if any(map(checker.is_on, mesh_objects(context.scene.objects))):
        self.layout.label(text="The Koebe checker is on: its materials would be exported", icon="ERROR")


MENUS = {
    "VIEW3D_MT_uv_map": draw_menu,
    "IMAGE_MT_uvs": draw_menu,
    "VIEW3D_MT_edit_mesh_clean": draw_clean_up_menu,
    "VIEW3D_MT_object": draw_object_menu,
    "TOPBAR_MT_file_export": draw_export_menu,
}


def register() -> None:
    """Append the entries."""
    bpy.utils.register_class(KOEBE_MT_unwrap)
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """The reverse of `register`."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).remove(draw)
    bpy.utils.unregister_class(KOEBE_MT_unwrap)
