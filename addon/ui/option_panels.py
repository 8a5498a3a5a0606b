# SPDX-License-Identifier: GPL-3.0-or-later
"""The parts of the panel that are closed at first: options of the runs, and tools used less often."""

import bpy

from ..blender.targets import target_objects
from ..maps.domain_table import DOMAINS
from ..maps.option_table import ROWS
from ..operators.bake_texture import UV_OT_koebe_bake_texture
from ..operators.fill_holes import MESH_OT_koebe_fill_holes
from ..operators.flat_copy import OBJECT_OT_koebe_flat_copy, UV_OT_koebe_flat_svg
from ..operators.hole_rings import MESH_OT_koebe_loops_around_holes
from ..operators.live import live
from ..operators.option_presets import UV_OT_koebe_reset
from ..operators.run_operator import draw_option
from ..operators.sequence import UV_OT_koebe_sequence
from ..operators.symmetrize import UV_OT_koebe_symmetrize
from ..state.option_properties import (
    ACCURACY_NAMES,
    RANGE_NAMES,
    SETTING_NAMES,
    KoebeSettings,
    copy_options,
    option_names,
    settings_of,
)
from .panel_parts import ClosedPanel, draw_map_button, draw_message, draw_sew, draw_unwrap, draw_weights


class DiskPanel(ClosedPanel):
    """Options of disks."""

    bl_label = "Disk, Round Holes"
    help_at = "2-map"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        draw_option(column, settings, "cut", context)
        draw_long(column, settings, "outer")
        for name in ("center", "point", "balance"):
            draw_option(column, settings, name, context)
        for name in ("loops", "tube", "upright", "symmetry", "polish"):
            draw_option(column, settings, name, context)


def draw_long(column: bpy.types.UILayout, settings: KoebeSettings, option: str) -> None:
    """Draw a choice whose name needs more room than Blender gives to names."""
    row = column.row()
    row.use_property_split = False
    split = row.split(factor=0.54)
    name = split.row()
    name.alignment = "RIGHT"
    name.label(text=ROWS[option].blender["label"])
    split.prop(settings, option, text="")


class PartsPanel(ClosedPanel):
    """Where parts are cut."""

    bl_label = "Seams and Cuts"
    help_at = "6-any-model-unwrap-to-parts"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        column.prop(settings, "darts")
        draw_weights(column, settings, "show", context)
        for name in ("seams", "write_seams", "cut_at", "hard_angle"):
            draw_option(column, settings, name, context)
        whole = column.column()
        whole.use_property_split = False  # their names need the whole width
        for name in ("cut_hard", "no_hard", "weld"):
            draw_option(whole, settings, name, context)
        draw_unwrap(column, settings, "PARTS", "Unwrap Along Seams", "UV_ISLANDSEL").seams = "only"
        draw_sew(column, settings)
        draw_live(column, context)


def draw_live(column: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """The switch of Live, and why it did not follow the last change."""
    row = column.row()
    row.use_property_split = False
    row.prop(context.window_manager, "koebe_live", toggle=True, icon="FILE_REFRESH")
    if live.message:
        draw_message(column, live.message)


class DomainsPanel(ClosedPanel):
    """Maps to domains that are no disk, and their options."""

    bl_label = "Seamless Shapes"
    help_at = "7-textures-without-a-seam-torus-tile-cylinder-sphere"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        of = {name: [domain for domain in DOMAINS if name in option_names(domain)] for name in SETTING_NAMES}
        for domain in DOMAINS:
            draw_map_button(column, settings, domain)
            for name in option_names(domain):
                if of[name] == [domain]:
                    draw_option(column, settings, name, context)
        column.label(text="Torus Tile and Cylinder")
        draw_option(column, settings, "fit", context)


class SequencePanel(ClosedPanel):
    """Maps of an animation or of shape keys, and which they are."""

    bl_label = "Animation"
    help_at = "12-a-surface-that-moves"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        draw_option(column, settings, "source", context)
        if settings.source == "FRAMES":
            column.prop(settings, "scene_range")
        if settings.source == "FRAMES" and not settings.scene_range:
            for name in RANGE_NAMES:
                column.prop(settings, name)
        draw_option(column, settings, "target", context)
        button = column.operator(UV_OT_koebe_sequence.bl_idname, text="Unwrap Sequence", icon="RENDER_ANIMATION")
        copy_options(settings, button, "sequence")


class LayerPanel(ClosedPanel):
    """What is written, and the checker that is put on."""

    bl_label = "Layer and Checker"
    help_at = "9-texture"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), settings_of(context)
        for name in ("layer", "checker", "checker_size"):
            draw_option(column, settings, name, context)
        if len(target_objects(context)) > 1:
            draw_option(column, settings, "checker_even", context)
        bake = column.operator(UV_OT_koebe_bake_texture.bl_idname, text="Bake to New UVs", icon="RENDER_STILL")
        bake.layer, bake.margin = settings.layer, settings.margin


class ToolsPanel(ClosedPanel):
    """What is made of a map that is there."""

    bl_label = "Fill, Mirror, Flatten"
    help_at = "8-fill-holes"

    def draw(self, context: bpy.types.Context) -> None:
        column = self.layout.column()
        fill = column.row(align=True)
        fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Fill Holes", icon="MESH_DATA").which = "holes"
        if context.mode == "EDIT_MESH":
            fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Selected").which = "selected"
        column.operator(UV_OT_koebe_symmetrize.bl_idname, text="Symmetrize", icon="MOD_MIRROR")
        column.operator(MESH_OT_koebe_loops_around_holes.bl_idname, text="Loops Around Holes", icon="PROP_CON")
        column.operator(OBJECT_OT_koebe_flat_copy.bl_idname, text="Flat Copy", icon="MESH_PLANE")
        column.operator(UV_OT_koebe_flat_svg.bl_idname, text="Flat SVG", icon="EXPORT")


class AccuracyPanel(ClosedPanel):
    """What most runs leave alone."""

    bl_label = "Accuracy"
    help_at = "what-is-lost"

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.aligned_layout()
        settings = settings_of(context)
        for name in ACCURACY_NAMES:
            layout.prop(settings, name)
        layout.operator(UV_OT_koebe_reset.bl_idname, icon="LOOP_BACK")
