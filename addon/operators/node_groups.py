# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that add and remove the node groups for Geometry Nodes."""

import bpy

from ..blender.node_groups import add_groups, find_groups, remove_groups
from ..blender.transaction import transaction
from .tooltip import tooltip


class NODE_OT_koebe_add_groups(bpy.types.Operator):
    """Add node groups for Geometry Nodes, as assets of this file: Koebe Bend onto Surface bends geometry onto a mapped
    surface, Koebe Scatter puts instances on it, Koebe Move Circles moves its circles"""

    bl_idname = "node.koebe_add_groups"
    bl_label = "Add Koebe Node Groups"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        with transaction() as run:
            made = add_groups(run)
            if not made:
                self.report({"INFO"}, "Koebe UV: the node groups are there already")
                return {"CANCELLED"}
            self.report({"INFO"}, "Koebe UV: added " + ", ".join(made))
            return {"FINISHED"}


class NODE_OT_koebe_remove_groups(bpy.types.Operator):
    """Remove the node groups of Koebe UV from this file. Groups that a modifier or another group uses stay"""

    bl_idname = "node.koebe_remove_groups"
    bl_label = "Remove Koebe Node Groups"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not find_groups():
            cls.poll_message_set("This file has no node groups of Koebe UV")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        removed, kept = remove_groups()
        if kept:
            self.report({"WARNING"}, "Koebe UV: still used, and not removed: " + ", ".join(kept))
        if not removed:
            return {"CANCELLED"}
        self.report({"INFO"}, "Koebe UV: removed " + ", ".join(removed))
        return {"FINISHED"}


CLASSES = (NODE_OT_koebe_add_groups, NODE_OT_koebe_remove_groups)
register, unregister = bpy.utils.register_classes_factory(CLASSES)
