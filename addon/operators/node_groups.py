# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that add and remove the node groups for Geometry Nodes, in this file and in an asset library."""

from pathlib import Path

import bpy

from .. import __name__ as addon_name
from ..blender import compat
from ..blender.asset_library import add_library, find_library, remove_library
from ..blender.node_groups import add_groups, find_groups, remove_groups
from ..blender.transaction import transaction
from .answers import refused


class NODE_OT_koebe_add_groups(bpy.types.Operator):
    """Add node groups for Geometry Nodes, as assets of this file: Koebe Bend onto Surface bends geometry onto a mapped
    surface, Koebe Scatter puts instances on it, Koebe Move Circles moves its circles, Koebe UV by Attribute
    plays stored UVs"""

    bl_idname = "node.koebe_add_groups"
    bl_label = "Add Koebe Node Groups"
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


def _library_folder() -> Path:
    return Path(compat.user_folder(addon_name)) / "assets"


class NODE_OT_koebe_add_library(bpy.types.Operator):
    """Add an asset library with the node groups of Koebe UV to the preferences: they are in the Asset Browser of every
    file. This file stays as it is"""

    bl_idname = "node.koebe_add_library"
    bl_label = "Add Koebe Asset Library"
    bl_options = {"REGISTER", "INTERNAL"}

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            with transaction() as run:
                add_library(run, _library_folder())
        except (OSError, RuntimeError) as error:
            return refused(self, f"the asset library could not be written: {error}")
        self.report({"INFO"}, f"Koebe UV: the asset library is in {_library_folder()}")
        return {"FINISHED"}


class NODE_OT_koebe_remove_library(bpy.types.Operator):
    """Remove the asset library of Koebe UV from the preferences, and its file. Files that use its node groups keep
    them if they were appended"""

    bl_idname = "node.koebe_remove_library"
    bl_label = "Remove Koebe Asset Library"
    bl_options = {"REGISTER", "INTERNAL"}

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if find_library(_library_folder()) is None:
            cls.poll_message_set("The preferences have no asset library of Koebe UV")
            return False
        return True

    def execute(self, context: bpy.types.Context) -> set[str]:
        remove_library(_library_folder())
        self.report({"INFO"}, "Koebe UV: the asset library is removed")
        return {"FINISHED"}
