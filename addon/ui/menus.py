# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's entries in Blender's menus: U, UV, Clean Up, Object, and Export."""

from typing import Any

import bpy

from ..blender import checker
from ..blender.mesh_object import mesh_objects
from ..layers.arrange import MODES
from ..maps.option_table import ROWS
from ..maps.presets import PRESETS
from ..operators.arrange import UV_OT_koebe_arrange, UV_OT_koebe_trims
from ..operators.bake_texture import UV_OT_koebe_bake_texture
from ..operators.carry_texture import UV_OT_koebe_carry_texture
from ..operators.checker import UV_OT_koebe_checker
from ..operators.compare_shapes import UV_OT_koebe_compare_shapes
from ..operators.distortion import UV_OT_koebe_distortion
from ..operators.even_slider import UV_OT_koebe_even
from ..operators.fill_holes import MESH_OT_koebe_fill_holes
from ..operators.flat_copy import OBJECT_OT_koebe_flat_copy, UV_OT_koebe_flat_svg
from ..operators.hole_rings import MESH_OT_koebe_loops_around_holes
from ..operators.lift import OBJECT_OT_koebe_lift
from ..operators.moebius import UV_OT_koebe_moebius
from ..operators.node_groups import NODE_OT_koebe_add_groups, NODE_OT_koebe_remove_groups
from ..operators.option_presets import UV_OT_koebe_preset, UV_OT_koebe_reset
from ..operators.relax_brush import UV_OT_koebe_relax
from ..operators.render_layer import UV_OT_koebe_use_for_rendering
from ..operators.select_from_report import (
    UV_OT_koebe_select_cuts,
    UV_OT_koebe_select_flipped,
    UV_OT_koebe_select_loop,
    UV_OT_koebe_select_offenders,
    UV_OT_koebe_select_torn,
)
from ..operators.sequence import UV_OT_koebe_sequence
from ..operators.symmetrize import UV_OT_koebe_symmetrize
from ..operators.texel_density import (
    UV_OT_koebe_copy_density,
    UV_OT_koebe_measure_density,
    UV_OT_koebe_set_density,
)
from ..operators.unwrap import MAPS
from ..state.lift_properties import copy_lift_options, lift_settings_of
from ..state.option_properties import copy_options, settings_of
from .panel_parts import BUTTONS, draw_pack, draw_sew, draw_unwrap


class KOEBE_MT_unwrap(bpy.types.Menu):
    """All shapes, with the panel's options."""

    bl_label = "Koebe"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, settings_of(context)
        assert layout is not None
        layout.operator_context = "INVOKE_DEFAULT"
        draw_unwrap(layout, settings, "AUTO", "Unwrap", "UV")
        draw_unwrap(layout, settings, settings.shape, "Unwrap In Place", "NONE").placement = "keep"
        draw_unwrap(layout, settings, "PARTS", "Unwrap Along Seams", "UV_ISLANDSEL").seams = "only"
        layout.separator()
        for shape, label, _ in ROWS["shape"].choices[1:]:
            draw_unwrap(layout, settings, shape, label, BUTTONS[MAPS[shape]][1])
        layout.separator()
        sequence = layout.operator(UV_OT_koebe_sequence.bl_idname, text="Animation", icon="RENDER_ANIMATION")
        copy_options(settings, sequence, "sequence")
        layout.operator(UV_OT_koebe_symmetrize.bl_idname, text="Symmetrize", icon="MOD_MIRROR")
        draw_pack(layout, settings)
        draw_pack(layout, settings, "Pack Beside the Rest").keep_places = "OTHERS"
        draw_sew(layout, settings)
        layout.prop(context.window_manager, "koebe_live")
        layout.separator()
        layout.menu("KOEBE_MT_tools")


class KOEBE_MT_tools(bpy.types.Menu):
    """All other tools of the panel: Blender's search (F3) looks in menus."""

    bl_label = "Koebe Tools"

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, settings_of(context)
        assert layout is not None
        layout.operator_context = "INVOKE_DEFAULT"
        # Buttons that take settings of the panel.
        checker_button = layout.operator(UV_OT_koebe_checker.bl_idname, text="Checker On or Off", icon="TEXTURE")
        for name in ("layer", "checker_size", "checker_even"):
            setattr(checker_button, name, getattr(settings, name))
        for kind, text in (("angle", "Distortion: Angle"), ("area", "Distortion: Texels"), ("none", "Distortion: Off")):
            button = layout.operator(UV_OT_koebe_distortion.bl_idname, text=text)
            button.kind, button.layer = kind, settings.layer
        layout.operator(UV_OT_koebe_use_for_rendering.bl_idname, text="Use for Rendering").layer = settings.layer
        bake = layout.operator(UV_OT_koebe_bake_texture.bl_idname, text="Bake to New UVs")
        bake.layer, bake.margin = settings.layer, settings.margin
        layout.operator(UV_OT_koebe_measure_density.bl_idname, text="Measure Texel Density")
        button = layout.operator(UV_OT_koebe_set_density.bl_idname, text="Set Texel Density")
        button.density, button.pixels = settings.density, settings.pixels
        layout.separator()
        for mode, (label, _) in MODES.items():
            button = layout.operator(UV_OT_koebe_arrange.bl_idname, text=f"Arrange: {label}")
            button.mode, button.margin, button.pixels = mode, settings.margin, settings.pixels
        layout.operator(UV_OT_koebe_trims.bl_idname, text="Make Trim Grid").action = "GRID"
        for group in TOOLS:
            layout.separator()
            for operator, text in group:
                layout.operator(operator.bl_idname, text=text)
        layout.separator()
        for word, row in PRESETS.items():
            layout.operator(UV_OT_koebe_preset.bl_idname, text=f"{row.label} Preset").preset = word


# Tools without options of the panel, and their words there.
TOOLS: tuple[tuple[tuple[Any, str], ...], ...] = (
    ((UV_OT_koebe_copy_density, "Copy Texel Density"), (UV_OT_koebe_even, "Drag Even"),
     (UV_OT_koebe_moebius, "Move Circles by Numbers"), (UV_OT_koebe_relax, "Relax at a Place")),
    ((MESH_OT_koebe_fill_holes, "Fill Holes"), (MESH_OT_koebe_loops_around_holes, "Loops Around Holes"),
     (OBJECT_OT_koebe_flat_copy, "Flat Copy"), (UV_OT_koebe_flat_svg, "Flat SVG")),
    ((UV_OT_koebe_compare_shapes, "Compare Shapes"), (UV_OT_koebe_carry_texture, "Carry Texture"),
     (NODE_OT_koebe_add_groups, "Add Node Groups"), (NODE_OT_koebe_remove_groups, "Remove Node Groups")),
    ((UV_OT_koebe_select_cuts, "Select Cuts"), (UV_OT_koebe_select_flipped, "Select Flipped Faces"),
     (UV_OT_koebe_select_torn, "Select Torn Faces"), (UV_OT_koebe_select_offenders, "Select Elements at Fault"),
     (UV_OT_koebe_select_loop, "Select Boundary")),
    ((UV_OT_koebe_reset, "Reset to Defaults"),),
)  # fmt: skip


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
    self.layout.menu("KOEBE_MT_unwrap")
    self.layout.operator(OBJECT_OT_koebe_flat_copy.bl_idname)
    copy_lift_options(lift_settings_of(context), self.layout.operator(OBJECT_OT_koebe_lift.bl_idname))


def draw_export_menu(self: bpy.types.Menu, context: bpy.types.Context) -> None:
    """The entry in File ▸ Export."""
    self.layout.operator(UV_OT_koebe_flat_svg.bl_idname, text="Koebe Flat Pieces (.svg)")
    if any(map(checker.is_on, mesh_objects(context.scene.objects))):
        self.layout.label(text="The Koebe checker is on: its materials would be exported", icon="ERROR")


CLASSES = (KOEBE_MT_tools, KOEBE_MT_unwrap)
MENUS = {
    "VIEW3D_MT_uv_map": draw_menu,
    "IMAGE_MT_uvs": draw_menu,
    "VIEW3D_MT_edit_mesh_clean": draw_clean_up_menu,
    "VIEW3D_MT_object": draw_object_menu,
    "TOPBAR_MT_file_export": draw_export_menu,
}


def register() -> None:
    """Append the entries."""
    for menu_class in CLASSES:
        bpy.utils.register_class(menu_class)
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).append(draw)


def unregister() -> None:
    """The reverse of `register`."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).remove(draw)
    for menu_class in reversed(CLASSES):
        bpy.utils.unregister_class(menu_class)
