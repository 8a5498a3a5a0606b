# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Koebe UV" in the sidebars of the 3D View and the UV Editor: its main part, and what is registered."""

import bpy

from ..blender import checker, distortion_attribute
from ..blender.targets import target_objects
from ..operators.checker import UV_OT_koebe_checker
from ..operators.distortion import UV_OT_koebe_distortion
from ..operators.fill_holes import MESH_OT_koebe_fill_holes
from ..operators.option_presets import UV_OT_koebe_reset
from ..operators.parts import UV_OT_koebe_parts
from ..operators.run_operator import draw_option
from ..operators.symmetrize import UV_OT_koebe_symmetrize
from ..operators.uniformize import UV_OT_koebe_uniformize
from ..state.option_properties import KoebeSettings, copy_options, copy_part_options, settings_of
from ..state.run_report import report_of
from .circle_tool import CIRCLES_TOOL
from .panel_parts import KoebePanel
from .preset_menu import KOEBE_PT_presets
from .report_panel import KOEBE_UL_islands, ReportPanel
from .shape_panel import ShapesPanel


class MainPanel(KoebePanel):
    """Options before the run, the run, and the checker."""

    bl_label = "Koebe UV"

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        KOEBE_PT_presets.draw_panel_header(self.layout)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.aligned_layout()
        settings = settings_of(context)
        column = layout.column()
        for name in (
            "cut", "outer", "center", "point", "balance", "importance", "tube", "upright", "symmetry", "placement",
            "margin", "layer",
        ):  # fmt: skip
            draw_option(column, settings, name, context)
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
        parts = layout.column(align=True)
        parts.prop(settings, "evenness", text="Parts")
        parts.prop(settings, "seams")
        parts.prop(settings, "write_seams")
        copy_part_options(settings, parts.operator(UV_OT_koebe_parts.bl_idname, text="Unwrap to Parts", icon="UV_DATA"))
        draw_judges(layout.column(), context, settings)
        fill = layout.row(align=True)
        fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Fill Holes", icon="MESH_DATA").which = "holes"
        if context.mode == "EDIT_MESH":
            fill.operator(MESH_OT_koebe_fill_holes.bl_idname, text="Selected").which = "selected"


def draw_judges(column: bpy.types.UILayout, context: bpy.types.Context, settings: KoebeSettings) -> None:
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
    kind = distortion_attribute.shown(objects[0].data) if objects else None
    split = column.split(factor=0.32)
    split.label(text="Distortion")
    row = split.row(align=True)
    for value, text in (("angle", "Angle"), ("area", "Area"), ("none", "Off")):
        button = row.operator(UV_OT_koebe_distortion.bl_idname, text=text, depress=kind == value)
        button.kind, button.layer = value, settings.layer
    column.operator(UV_OT_koebe_symmetrize.bl_idname, icon="MOD_MIRROR")
    if context.space_data.type == "IMAGE_EDITOR":
        row = column.row()
        row.prop(report_of(context), "show_circles")
        row.operator("wm.tool_set_by_id", text="Move Circles", icon="MESH_CIRCLE").name = CIRCLES_TOOL


class AccuracyPanel(KoebePanel):
    """What most runs leave alone."""

    bl_label = "Accuracy"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.aligned_layout()
        settings = settings_of(context)
        for name in ("method", "engine", "tolerance", "max_sweeps", "polish"):
            layout.prop(settings, name)
        layout.operator(UV_OT_koebe_reset.bl_idname, icon="LOOP_BACK")


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


class VIEW3D_PT_koebe_shapes(View3D, ShapesPanel, bpy.types.Panel):
    bl_parent_id = "VIEW3D_PT_koebe"


class IMAGE_PT_koebe(UVEditor, MainPanel, bpy.types.Panel):
    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.space_data.mode == "UV"


class IMAGE_PT_koebe_accuracy(UVEditor, AccuracyPanel, bpy.types.Panel):
    bl_parent_id = "IMAGE_PT_koebe"


class IMAGE_PT_koebe_report(UVEditor, ReportPanel, bpy.types.Panel):
    bl_parent_id = "IMAGE_PT_koebe"


class IMAGE_PT_koebe_shapes(UVEditor, ShapesPanel, bpy.types.Panel):
    bl_parent_id = "IMAGE_PT_koebe"


CLASSES = (
    KOEBE_UL_islands,
    VIEW3D_PT_koebe,
    VIEW3D_PT_koebe_accuracy,
    VIEW3D_PT_koebe_report,
    VIEW3D_PT_koebe_shapes,
    IMAGE_PT_koebe,
    IMAGE_PT_koebe_accuracy,
    IMAGE_PT_koebe_report,
    IMAGE_PT_koebe_shapes,
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
