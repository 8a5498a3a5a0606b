# SPDX-License-Identifier: GPL-3.0-or-later
"""Tests of operators before they run: objects, a mode, the native package."""

from collections.abc import Container
from types import ModuleType
from typing import ClassVar

import bpy

from ..blender.targets import target_objects
from ..jobs import native_package
from ..solver.errors import NativeError
from .modal_run import OperatorBase


class OnTargets(OperatorBase):
    """Mixin of operators that work on the selected mesh objects.

    needs  what the user is told to do if there is no such object, or it is in another mode
    """

    bl_options = {"REGISTER", "UNDO"}
    needs: ClassVar[str] = "Select a mesh object with UVs, in Object Mode or in Edit Mode"
    modes: ClassVar[Container[str]] = ("OBJECT", "EDIT_MESH")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if context.mode in cls.modes and target_objects(context):
            return True
        cls.poll_message_set(cls.needs)
        return False


def in_object_mode(
    cls: type[bpy.types.Operator], context: bpy.types.Context, least: int, last: str = "the object that has the texture"
) -> bool:
    """Whether so many objects are selected, the active one among them. If not, tells the user what to do.

    last  what the active one of several objects is
    """
    if context.mode != "OBJECT":
        cls.poll_message_set("Works in Object Mode, on whole objects")
        return False
    if len(target_objects(context)) < least or context.active_object not in context.selected_objects:
        cls.poll_message_set(
            "Select mesh objects. One of them must be the active object" if least == 1
            else f"Select the other objects first, and last {last}"
        )  # fmt: skip
        return False
    if context.active_object.type != "MESH":
        cls.poll_message_set("The active object is no mesh")
        return False
    return True


def native_or_error(operator: bpy.types.Operator) -> ModuleType | None:
    """The native package, or None if it is missing, and then an error is reported."""
    try:
        return native_package.load()
    except NativeError as error:
        operator.report({"ERROR"}, f"Koebe UV: {error}")
        return None
