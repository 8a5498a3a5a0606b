# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Koebe UV" in the sidebars of the 3D View and the UV Editor, and the menu entries."""

import textwrap

import bpy

from . import checker, distortion_display
from .distortion_display import UV_OT_koebe_distortion
from .fill_operator import MESH_OT_koebe_fill_holes
from .modes import target_objects
from .operators import UV_OT_koebe_checker, UV_OT_koebe_uniformize
from .presets import KOEBE_PT_presets, UV_OT_koebe_reset
from .properties import copy_options
from .select_operators import (
    UV_OT_koebe_select_flipped,
    UV_OT_koebe_select_loop,
    UV_OT_koebe_select_offenders,
    active_entry,
)

MESSAGE_WIDTH = 34  # characters of a line of text in a sidebar of the usual width
MAX_LOOP_BUTTONS = 40
# Radius of an annulus's hole, in units of its rim, below which texels differ by the inverse: better unrolled.
LONG_TUBE = 0.2


class KoebePanel:
    """What the panels have in common; mixed into one class per editor."""

    bl_region_type = "UI"
    bl_category = "Koebe"

    def aligned_layout(self):
        """The layout with names on the left and without keyframe dots."""
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        return self.layout


class MainPanel(KoebePanel):
    """Options before the run, the run, and the checker."""

    bl_label = "Koebe UV"

    def draw_header_preset(self, context):
        KOEBE_PT_presets.draw_panel_header(self.layout)

    def draw(self, context):
        layout = self.aligned_layout()
        settings = context.scene.koebe_uv
        column = layout.column()
        for name in ("outer", "balance", "tube", "upright", "placement", "margin", "layer"):
            row = column.row()
            row.active = name != "margin" or settings.placement != "keep"
            row.prop(settings, name)
        row = column.row(heading="Checker")
        row.prop(settings, "checker", text="")
        size = row.row()
        size.active = settings.checker
        size.prop(settings, "checker_size", text="")
        if len(target_objects(context)) > 1:
            even = layout.row()
            even.active = settings.checker
            even.prop(settings, "checker_even")
        run = layout.column(align=True)
        run.scale_y = 1.4
        copy_options(settings, run.operator(UV_OT_koebe_uniformize.bl_idname, icon="MESH_CIRCLE"))
        draw_judges(layout.column(), context, settings)
        fill = layout.row(align=True)
        fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Fill Holes", icon="MESH_DATA").which = "holes"
        if context.mode == "EDIT_MESH":
            fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Selected").which = "selected"


def draw_judges(column, context, settings):
    """The buttons by which a map is judged: checker, distortion, circles."""
    objects = target_objects(context)
    worn = any(checker.is_on(obj) for obj in objects)
    text = "Take Checker Off" if worn else "Put Checker On"
    switch = column.operator(UV_OT_koebe_checker.bl_idname, text=text, icon="TEXTURE", depress=worn)
    switch.layer, switch.checker_size, switch.checker_even = (
        settings.layer, settings.checker_size, settings.checker_even,
    )  # fmt: skip
    shading = getattr(context.space_data, "shading", None)
    if worn and shading is not None and shading.type in {"WIREFRAME", "SOLID"}:
        row = column.row()
        row.use_property_split = False
        row.prop_enum(shading, "type", "MATERIAL", text="See It in Material Preview")
    kind = distortion_display.shown(objects[0]) if objects else None
    split = column.split(factor=0.32)
    split.label(text="Distortion")
    row = split.row(align=True)
    for value, text in (("angle", "Angle"), ("area", "Area"), ("none", "Off")):
        button = row.operator(UV_OT_koebe_distortion.bl_idname, text=text, depress=kind == value)
        button.kind, button.layer = value, settings.layer
    if context.space_data.type == "IMAGE_EDITOR":
        column.prop(context.window_manager.koebe_uv, "show_circles")


class AccuracyPanel(KoebePanel):
    """What most runs leave alone."""

    bl_label = "Accuracy"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout = self.aligned_layout()
        settings = context.scene.koebe_uv
        for name in ("method", "engine", "tolerance", "max_sweeps"):
            layout.prop(settings, name)
        layout.operator(UV_OT_koebe_reset.bl_idname, icon="LOOP_BACK")


class KOEBE_UL_islands(bpy.types.UIList):
    """The islands of the last run, one a line."""

    def draw_item(self, context, layout, data, item, icon, active_data, active_property):
        row = layout.row(align=True)
        row.label(text=f"{item.object_name} {item.island + 1}", icon=island_icon(item))
        if item.mapped:
            row.label(text=f"{item.angle_error:.2f}°")
            row.label(text=f"{item.flipped} flips" if item.flipped else "no flips")
        else:
            row.label(text="not mapped")


def island_icon(entry):
    """Good, to be looked at, or not mapped."""
    if not entry.mapped:
        return "CANCEL"
    return "CHECKMARK" if entry.converged and not entry.flipped and not entry.message else "ERROR"


class ReportPanel(KoebePanel):
    """The last run, island by island."""

    bl_label = "Report"

    def draw(self, context):
        layout = self.layout
        report = context.window_manager.koebe_uv
        if not report.islands:
            layout.label(text="No run yet")
        if len(report.islands) > 1:
            layout.template_list("KOEBE_UL_islands", "", report, "islands", report, "active", rows=3)
        entry = active_entry(context)
        if entry is None:
            return
        if entry.mapped:
            draw_result(layout.column(), entry)
            draw_unroll(layout, context, entry)
        for line in textwrap.wrap(entry.message, MESSAGE_WIDTH):
            layout.label(text=line)
        if not entry.mapped:
            layout.operator(UV_OT_koebe_select_offenders.bl_idname, icon="RESTRICT_SELECT_OFF")


def draw_result(column, entry):
    """Figures of a mapped island, and buttons that select its loops and its flipped faces."""
    column.label(text=f"{entry.object_name}, island {entry.island + 1}", icon=island_icon(entry))
    table = column.column(align=True)
    for name, value in (
        ("Angle error", f"{entry.angle_error:.2f}°"),
        ("Roundness", f"{entry.roundness:.1e}"),
        ("Sweeps", f"{entry.sweeps}" if entry.converged else f"{entry.sweeps}, not converged"),
        ("Flipped", f"{entry.flipped}"),
        ("Time", f"{entry.seconds:.2f} s"),
    ):
        split = table.split(factor=0.45)
        split.label(text=name)
        split.label(text=value)
    if entry.flipped:
        column.operator(UV_OT_koebe_select_flipped.bl_idname, icon="RESTRICT_SELECT_OFF")
    column.label(text="Select Loop")
    grid = column.grid_flow(row_major=True, columns=4, even_columns=True, align=True)
    for index in range(min(len(entry.loops), MAX_LOOP_BUTTONS)):
        text = "Rim" if index == 0 else f"{index}"
        grid.operator(UV_OT_koebe_select_loop.bl_idname, text=text).loop = index


def draw_unroll(layout, context, entry):
    """The offer to unroll a long tube."""
    if len(entry.loops) == 2 and entry.loops[1].uv_radius > 0.0 and entry.loops[1].radius < LONG_TUBE:
        button = layout.operator(UV_OT_koebe_uniformize.bl_idname, text="Long Tube: Unroll It", icon="MESH_CYLINDER")
        copy_options(context.scene.koebe_uv, button)
        button.tube = "unroll"


class View3D:
    """Panels of the 3D View."""

    bl_space_type = "VIEW_3D"


class UVEditor:
    """Panels of the UV Editor, which shares its space type with the Image Editor."""

    bl_space_type = "IMAGE_EDITOR"


class VIEW3D_PT_koebe(View3D, MainPanel, bpy.types.Panel):
    pass


class VIEW3D_PT_koebe_accuracy(View3D, AccuracyPanel, bpy.types.Panel):
    bl_parent_id = "VIEW3D_PT_koebe"


class VIEW3D_PT_koebe_report(View3D, ReportPanel, bpy.types.Panel):
    bl_parent_id = "VIEW3D_PT_koebe"


class IMAGE_PT_koebe(UVEditor, MainPanel, bpy.types.Panel):
    @classmethod
    def poll(cls, context):
        return context.space_data.mode == "UV"


class IMAGE_PT_koebe_accuracy(UVEditor, AccuracyPanel, bpy.types.Panel):
    bl_parent_id = "IMAGE_PT_koebe"


class IMAGE_PT_koebe_report(UVEditor, ReportPanel, bpy.types.Panel):
    bl_parent_id = "IMAGE_PT_koebe"


def draw_menu(self, context):
    """The entry in the U menu and in the UV Editor's UV menu, with the panel's options."""
    layout = self.layout
    layout.separator()
    layout.operator_context = "INVOKE_DEFAULT"
    copy_options(context.scene.koebe_uv, layout.operator(UV_OT_koebe_uniformize.bl_idname))


def draw_clean_up_menu(self, context):
    """The entry beside Blender's own Fill Holes."""
    self.layout.operator(MESH_OT_koebe_fill_holes.bl_idname)


CLASSES = (
    KOEBE_UL_islands,
    VIEW3D_PT_koebe,
    VIEW3D_PT_koebe_accuracy,
    VIEW3D_PT_koebe_report,
    IMAGE_PT_koebe,
    IMAGE_PT_koebe_accuracy,
    IMAGE_PT_koebe_report,
)
MENUS = {
    "VIEW3D_MT_uv_map": draw_menu,
    "IMAGE_MT_uvs": draw_menu,
    "VIEW3D_MT_edit_mesh_clean": draw_clean_up_menu,
}


def register():
    """Register the panels and append the menu entries."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).append(draw)


def unregister():
    """Undo `register`."""
    for menu, draw in MENUS.items():
        getattr(bpy.types, menu).remove(draw)
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
