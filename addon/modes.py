# SPDX-License-Identifier: GPL-3.0-or-later
"""Which objects an operator is for, and leaving Edit Mode for the time of a write."""

import contextlib

import bpy


def target_objects(context):
    """The mesh objects in Edit Mode, or else the selected ones; the active one first."""
    if context.mode == "EDIT_MESH":
        objects = list(context.objects_in_mode_unique_data)
    else:
        objects = [obj for obj in context.selected_objects if obj.type == "MESH"]
    return sorted(objects, key=lambda obj: obj != context.active_object)


@contextlib.contextmanager
def object_mode(context):
    """Object Mode inside, the mode and the objects that were in it afterwards."""
    if context.mode != "EDIT_MESH":
        yield
        return
    edited = set(context.objects_in_mode)
    bpy.ops.object.mode_set(mode="OBJECT")
    try:
        yield
    finally:
        _enter_edit_mode(context, edited)


def _enter_edit_mode(context, objects):
    """Blender enters Edit Mode with all selected meshes: let these be the selected ones meanwhile."""
    others = [obj for obj in context.selected_objects if obj not in objects]
    hidden = [obj for obj in objects if not obj.select_get()]
    for obj in others:
        obj.select_set(False)
    for obj in hidden:
        obj.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    for obj in others:
        obj.select_set(True)
    for obj in hidden:
        obj.select_set(False)
