# SPDX-License-Identifier: GPL-3.0-or-later
"""Distortion as a colour attribute of the mesh, on and off, and the legend in the 3D View."""

import bpy
import numpy as np

from . import distortion, drawing, transfer
from .modes import object_mode, target_objects

ATTRIBUTE = "Koebe Distortion"
MEMORY_KEY = "koebe_distortion"  # on the mesh: what is shown, and which colour attribute was active before


def shown(obj):
    """The kind of distortion that the object's colours show, or None."""
    memory = obj.data.get(MEMORY_KEY)
    return None if memory is None or ATTRIBUTE not in obj.data.attributes else memory["kind"]


def check(obj, layer_name):
    """Raise TransferError unless `put_on` can be done."""
    mesh = obj.data
    if mesh.library is not None:
        raise transfer.TransferError(f"{obj.name}: its mesh is linked from another file: make it local first")
    if layer_name not in mesh.uv_layers:
        raise transfer.TransferError(f"{obj.name}: it has no UV layer {layer_name!r}: map it first")
    if shown(obj) is None and ATTRIBUTE in mesh.attributes:
        raise transfer.TransferError(f"{obj.name}: it has an attribute {ATTRIBUTE!r} of its own: rename that")


def put_on(obj, layer_name, kind):
    """Colour the object's faces by the distortion of a UV layer; call `check` first. Not in Edit Mode."""
    mesh = obj.data
    surface = transfer.read_surface(obj, selected_only=False)
    values = distortion.face_values(surface, transfer.read_uv(obj, layer_name), kind)
    take_off(obj)
    active = mesh.color_attributes.active_color
    mesh[MEMORY_KEY] = {"kind": kind, "active": "" if active is None else active.name}
    colors = np.ones((len(surface.corner_vertex), 4), dtype=np.float32)
    colors[:, :3] = np.repeat(distortion.linear(distortion.colors(values, kind)), surface.face_size, axis=0)
    attribute = mesh.color_attributes.new(ATTRIBUTE, "FLOAT_COLOR", "CORNER")
    attribute.data.foreach_set("color", colors.ravel())
    mesh.color_attributes.active_color = mesh.color_attributes[ATTRIBUTE]
    mesh.update()


def take_off(obj):
    """Remove the colours and make the attribute active that was so before."""
    mesh = obj.data
    memory = mesh.get(MEMORY_KEY)
    if memory is None:
        return
    if ATTRIBUTE in mesh.color_attributes:
        mesh.color_attributes.remove(mesh.color_attributes[ATTRIBUTE])
    before = mesh.color_attributes.get(memory["active"]) if memory["active"] else None
    if before is not None:
        mesh.color_attributes.active_color = before
    del mesh[MEMORY_KEY]
    mesh.update()


KINDS = [
    ("none", "Off", "Take the colours off and show the materials again"),
    (distortion.ANGLE, "Angle", "Colour the faces by how far the angles of the UVs are from those of the surface"),
    (distortion.AREA, "Area", "Colour the faces by how many texels they get, compared with the mean"),
]


class UV_OT_koebe_distortion(bpy.types.Operator):
    """Colour the faces of the selected objects by the distortion of their UVs, or take the colours off again"""

    bl_idname = "uv.koebe_distortion"
    bl_label = "Koebe Distortion"
    bl_options = {"REGISTER", "UNDO"}

    kind: bpy.props.EnumProperty(name="Distortion", items=KINDS, default=distortion.ANGLE)
    layer: bpy.props.StringProperty(name="UV Layer", default="Koebe", description="UV layer to judge")

    @classmethod
    def description(cls, context, properties):
        """The tooltip of each button is its own."""
        return next(text for kind, _, text in KINDS if kind == properties.kind)

    @classmethod
    def poll(cls, context):
        if context.mode not in {"OBJECT", "EDIT_MESH"} or not target_objects(context):
            cls.poll_message_set("Select a mesh object, in Object Mode or in Edit Mode")
            return False
        return True

    def execute(self, context):
        objects = target_objects(context)
        try:
            for obj in objects if self.kind != "none" else ():
                check(obj, self.layer)
            with object_mode(context):
                for obj in objects:
                    if self.kind == "none":
                        take_off(obj)
                    else:
                        put_on(obj, self.layer, self.kind)
        except transfer.TransferError as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return {"CANCELLED"}
        show_colors(context, self.kind != "none")
        return {"FINISHED"}


def show_colors(context, on):
    """Let the 3D Views of the screen show colour attributes in Solid shading, or the materials again."""
    for area in context.screen.areas if context.screen else ():
        if area.type == "VIEW_3D":
            shading = area.spaces.active.shading
            if on:
                shading.color_type = "VERTEX"
            elif shading.color_type == "VERTEX":
                shading.color_type = "MATERIAL"
            area.tag_redraw()


def draw_legend():
    """The legend of the active object's colours, at the upper left of the 3D View."""
    context = bpy.context
    obj = context.active_object
    if obj is None or obj.type != "MESH" or not context.space_data.overlay.show_overlays:
        return
    kind = shown(obj)
    if kind is not None:
        title, marks = distortion.legend(kind)
        ramp = distortion.ANGLE_RAMP if kind == distortion.ANGLE else distortion.AREA_RAMP
        drawing.color_bar(title, ramp, marks)


def register():
    """Register the operator and the legend."""
    bpy.utils.register_class(UV_OT_koebe_distortion)
    drawing.add("VIEW_3D", "legend", draw_legend)


def unregister():
    """Undo `register`."""
    drawing.remove("VIEW_3D", "legend")
    bpy.utils.unregister_class(UV_OT_koebe_distortion)
