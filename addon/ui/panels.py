# SPDX-License-Identifier: GPL-3.0-or-later
"""The panel "Koebe UV" in the sidebars of the 3D View and the UV Editor: its main part, and the registration."""

from typing import Any

import bpy

from ..blender import checker, distortion_attribute, rendered_layer
from ..blender.mesh_reading import shows_pins
from ..blender.targets import makes_faces, target_objects
from ..operators.checker import UV_OT_koebe_checker
from ..operators.distortion import UV_OT_koebe_distortion
from ..operators.even_slider import UV_OT_koebe_even
from ..operators.render_layer import UV_OT_koebe_use_for_rendering
from ..operators.run_operator import is_used
from ..operators.unwrap import MAPS
from ..state.option_properties import KoebeSettings, option_names, settings_of
from ..state.run_report import report_of
from .arrange_panel import ArrangePanel, KOEBE_UL_trims
from .circle_tool import CIRCLES_TOOL
from .lift_panel import LiftPanel
from .option_panels import AccuracyPanel, DiskPanel, DomainsPanel, LayerPanel, PartsPanel, SequencePanel, ToolsPanel
from .packing_panel import PackingPanel
from .panel_parts import KoebePanel, draw_map_button, draw_message, draw_unwrap
from .preset_menu import KOEBE_PT_presets
from .report_panel import DetailsPanel, KOEBE_UL_islands, ReportPanel
from .shape_panel import ShapesPanel

NAMES = 0.32  # of the panel's width, where names stand on the left
OF_PARTS = ("AUTO", "PARTS")  # shapes that may be parts


class MainPanel(KoebePanel):
    """The button, what it makes, and what judges a map."""

    bl_label = "Koebe UV"
    help_at = "2-map"

    def draw_header_preset(self, context: bpy.types.Context) -> None:
        KOEBE_PT_presets.draw_panel_header(self.layout)
        super().draw_header_preset(context)

    def draw(self, context: bpy.types.Context) -> None:
        layout, settings = self.layout, settings_of(context)
        run = layout.column()
        run.scale_y = 1.6
        if context.mode == "EDIT_MESH":
            split = run.split(factor=0.62, align=True)
            draw_unwrap(split, settings, settings.shape, "Unwrap", "UV")
            draw_unwrap(split, settings, settings.shape, "In Place", "NONE").placement = "keep"
        else:
            draw_unwrap(run, settings, settings.shape, "Unwrap", "UV")
        split = layout.split(factor=NAMES)
        split.label(text="Shape")
        split.prop(settings, "shape", text="")
        draw_dials(layout.column(align=True), settings)
        draw_pins(layout.column(align=True), context, settings)
        draw_modifiers(layout.column(align=True), context)
        draw_judges(layout.column(), context, settings)


def draw_dials(column: bpy.types.UILayout, settings: KoebeSettings) -> None:
    """The sliders of the shape: how many parts, and how even their texels."""
    if settings.shape in OF_PARTS:
        column.prop(settings, "evenness", slider=True)
        column.prop(settings, "keep_angles")
    if settings.shape in OF_PARTS or "even" in option_names(MAPS[settings.shape]):
        row = column.row()
        row.active = is_used(settings, "even")
        row.prop(settings, "even", slider=True)
        column.operator(UV_OT_koebe_even.bl_idname, text="Drag Even", icon="ARROW_LEFTRIGHT")


def draw_modifiers(column: bpy.types.UILayout, context: bpy.types.Context) -> None:
    """What of an object with modifiers or shape keys is unwrapped."""
    objects = target_objects(context)
    if any(map(makes_faces, objects)):
        draw_message(column, "The mesh before its modifiers is unwrapped: apply them to unwrap what they make")
    elif any(obj.data.shape_keys or any(one.show_viewport for one in obj.modifiers) for obj in objects):
        column.prop(settings_of(context), "deformed")


def draw_pins(column: bpy.types.UILayout, context: bpy.types.Context, settings: KoebeSettings) -> None:
    """Before a run that would move pinned UVs: the button of the map that keeps them."""
    if settings.shape not in OF_PARTS and any(shows_pins(obj, settings.layer) for obj in target_objects(context)):
        most = "A disk keeps two pinned UVs" if settings.shape == "DISK" else "This shape keeps no pinned UVs"
        draw_message(column, f"{most}. Parts keep all")
        draw_map_button(column, settings, "parts")


def draw_judges(column: bpy.types.UILayout, context: bpy.types.Context, settings: KoebeSettings) -> None:
    """Draw the buttons to judge a map: checker, distortion, circles."""
    objects = target_objects(context)
    worn = any(checker.is_on(obj) for obj in objects)
    text = "Take Checker Off" if worn else "Put Checker On"
    switch = column.operator(UV_OT_koebe_checker.bl_idname, text=text, icon="TEXTURE", depress=worn)
    switch.layer, switch.checker_size, switch.checker_even = (
        settings.layer, settings.checker_size, settings.checker_even,
    )  # fmt: skip
    if worn:
        draw_message(column, "Take it off before you export")
    if objects and rendered_layer.hidden_by(objects[0], settings.layer):
        icon: Any = "RESTRICT_RENDER_OFF"
        render = column.operator(UV_OT_koebe_use_for_rendering.bl_idname, text="Use for Rendering", icon=icon)
        render.layer = settings.layer
    shading = getattr(context.space_data, "shading", None)
    if worn and shading is not None and shading.type in {"WIREFRAME", "SOLID"}:
        row = column.row()
        row.use_property_split = False
        row.prop_enum(shading, "type", "MATERIAL", text="See It in Material Preview")
    kind = distortion_attribute.shown(objects[0].data) if objects else None
    split = column.split(factor=NAMES)
    split.label(text="Distortion")
    row = split.row(align=True)
    for value, text in (("angle", "Angle"), ("area", "Texel"), ("none", "Off")):
        button = row.operator(UV_OT_koebe_distortion.bl_idname, text=text, depress=kind == value)
        button.kind, button.layer = value, settings.layer
    if context.space_data.type == "IMAGE_EDITOR":
        column.operator("wm.tool_set_by_id", text="Move Circles", icon="MESH_CIRCLE").name = CIRCLES_TOOL
        column.prop(report_of(context), "show_circles")


class View3D:
    """Panels of the 3D View."""

    bl_space_type = "VIEW_3D"


class UVEditor:
    """Panels of the UV Editor, which shares its space type with the Image Editor."""

    bl_space_type = "IMAGE_EDITOR"


class VIEW3D_PT_koebe(View3D, MainPanel, bpy.types.Panel):
    pass


class IMAGE_PT_koebe(UVEditor, MainPanel, bpy.types.Panel):
    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.space_data.mode == "UV"


# The parts of the panel, from top to bottom.
CHILDREN = {
    "report": ReportPanel,
    "disk": DiskPanel,
    "parts": PartsPanel,
    "domains": DomainsPanel,
    "packing": PackingPanel,
    "arrange": ArrangePanel,
    "layer": LayerPanel,
    "tools": ToolsPanel,
    "lift": LiftPanel,
    "shapes": ShapesPanel,
    "sequence": SequencePanel,
    "accuracy": AccuracyPanel,
}
WITHIN = {"report": {"details": DetailsPanel}}  # parts that have parts


def children(parent: type, editor: type) -> list[type]:
    """A class of each part for the panel of one editor."""
    found = []
    for end, part in CHILDREN.items():
        found.append(_child(parent.__name__, editor, end, part))
        found += [_child(found[-1].__name__, editor, *one) for one in WITHIN.get(end, {}).items()]
    return found


def _child(parent: str, editor: type, end: str, part: type) -> type:
    own = {"bl_parent_id": parent, "__doc__": part.__doc__}
    return type(f"{parent}_{end}", (editor, part, bpy.types.Panel), own)


CLASSES = (
    KOEBE_UL_islands,
    KOEBE_UL_trims,
    VIEW3D_PT_koebe,
    *children(VIEW3D_PT_koebe, View3D),
    IMAGE_PT_koebe,
    *children(IMAGE_PT_koebe, UVEditor),
)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
