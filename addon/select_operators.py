# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that select what the report speaks of: offending elements, flipped faces, a boundary loop."""

import json

import bpy

from .offenders import EDGES, FACES
from .selection import edges_along, enter_edit_mode, select_only


def active_entry(context):
    """The island of the report whose details are shown, or None."""
    report = context.window_manager.koebe_uv
    if not 0 <= report.active < len(report.islands):
        return None
    return report.islands[report.active]


def entry_object(context, entry):
    """The mesh object that an entry of the report is about, or None if there is none of that name any more."""
    obj = context.view_layer.objects.get(entry.object_name)
    return obj if obj is not None and obj.type == "MESH" else None


class ReportOperator:
    """Mixed into the operators that act on the island which the report shows."""

    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        entry = active_entry(context)
        if entry is None or entry_object(context, entry) is None:
            cls.poll_message_set("There is no report, or its object is gone")
            return False
        return context.mode in {"OBJECT", "EDIT_MESH"}

    def select(self, context, kind, indices):
        """Show the elements in Edit Mode."""
        obj = entry_object(context, active_entry(context))
        enter_edit_mode(context, obj)
        select_only(context, [(obj, kind, indices)])
        return {"FINISHED"}


class UV_OT_koebe_select_offenders(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the elements that keep this island from being mapped"""

    bl_idname = "uv.koebe_select_offenders"
    bl_label = "Select What Is Wrong"

    def execute(self, context):
        entry = active_entry(context)
        if not entry.offenders:
            self.report({"INFO"}, "Koebe UV: nothing is wrong with this island")
            return {"CANCELLED"}
        return self.select(context, *json.loads(entry.offenders))


class UV_OT_koebe_select_flipped(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the faces of this island that are turned over in the UVs: their area there is zero
    or negative, so a texture shows mirrored or not at all"""

    bl_idname = "uv.koebe_select_flipped"
    bl_label = "Select Flipped Faces"

    def execute(self, context):
        entry = active_entry(context)
        return self.select(context, FACES, json.loads(entry.flipped_faces or "[]"))


class UV_OT_koebe_select_loop(ReportOperator, bpy.types.Operator):
    """Select, in Edit Mode, the edges of a boundary loop of this island: the rim of the disk or a hole"""

    bl_idname = "uv.koebe_select_loop"
    bl_label = "Select Boundary Loop"

    loop: bpy.props.IntProperty(
        name="Loop", min=0, description="Number of the loop: 0 is the outer one, the rim of the disk"
    )

    def execute(self, context):
        entry = active_entry(context)
        if self.loop >= len(entry.loops):
            self.report({"ERROR"}, f"Koebe UV: the island has {len(entry.loops)} loops")
            return {"CANCELLED"}
        obj = entry_object(context, entry)
        enter_edit_mode(context, obj)
        edges = edges_along(obj, json.loads(entry.loops[self.loop].vertices))
        return self.select(context, EDGES, edges)


CLASSES = (UV_OT_koebe_select_offenders, UV_OT_koebe_select_flipped, UV_OT_koebe_select_loop)


def register():
    """Register the operators."""
    for cls in CLASSES:
        bpy.utils.register_class(cls)


def unregister():
    """Undo `register`."""
    for cls in reversed(CLASSES):
        bpy.utils.unregister_class(cls)
