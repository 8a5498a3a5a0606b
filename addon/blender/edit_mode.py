# SPDX-License-Identifier: GPL-3.0-or-later
"""Enters and leaves Edit Mode, and restores the modes and the selection of objects."""

import contextlib
import functools
from collections.abc import Callable, Iterator
from typing import Any

import bpy

from . import compat
from .errors import TransferError
from .mesh_object import MeshObject
from .selection import Selection
from .targets import check_mesh
from .transaction import Transaction


def check(context: bpy.types.Context, obj: MeshObject) -> None:
    """Raise TransferError unless Edit Mode can be entered with the object."""
    check_mesh(obj)
    if obj.library is not None or obj.override_library is not None:
        raise TransferError(f"{obj.name}: it is linked from another file: make it local first")
    if not _visible(context, obj):
        raise TransferError(
            f"{obj.name}: it is not in the local view: leave the local view first" if _out_of_local_view(context, obj)
            else f"{obj.name}: it is hidden: show it first"
        )  # fmt: skip


def _out_of_local_view(context: bpy.types.Context, obj: MeshObject) -> bool:
    space: Any = context.space_data
    local = space is not None and space.type == "VIEW_3D" and space.local_view is not None
    return local and not obj.local_view_get(space)


def _visible(context: bpy.types.Context, obj: bpy.types.Object) -> bool:
    space: Any = context.space_data
    if space is not None and space.type == "VIEW_3D":
        return obj.visible_get(view_layer=context.view_layer, viewport=space)  # the view may be local
    return obj.visible_get(view_layer=context.view_layer)


def enter(run: Transaction, context: bpy.types.Context, obj: MeshObject) -> None:
    """Make the object active and enter Edit Mode with it alone, unless it is there. Call `check` first."""
    if obj.mode == "EDIT":
        return
    for elements in (obj.data.vertices, obj.data.edges, obj.data.polygons):  # Edit Mode makes them consistent
        run.before_write(elements.foreach_set, "select", compat.read(elements, "select", bool))
    layer = context.view_layer
    run.before_write(_restore, layer, *_state(layer))
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    _select_objects(layer, [obj.name])
    layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")
    if obj.mode != "EDIT":
        raise TransferError(f"{obj.name}: Blender cannot enter Edit Mode with this object")


def undo_all(context: bpy.types.Context) -> None:
    """Make the running operator's undo step hold the whole file, as in Object Mode.

    In Edit Mode it holds only the edited meshes, without slots, custom properties, selected objects and settings. But
    Blender keeps the whole file, too, once a data-block was added or removed.
    """
    if context.mode == "EDIT_MESH":
        bpy.data.meshes.remove(bpy.data.meshes.new("Koebe undo"))


@contextlib.contextmanager
def left_if_faster(run: Transaction, context: bpy.types.Context) -> Iterator[None]:
    """Object Mode inside, if Blender writes faster there and can return for sure."""
    back = None if compat.slow_mode_change() else leave(run, context)
    yield
    if back is not None:
        back()


def leave(run: Transaction, context: bpy.types.Context) -> Callable[[], None] | None:
    """Leave Edit Mode, if Blender can return for sure. Returns the way back, or None if nothing was done."""
    layer = context.view_layer
    if context.mode != "EDIT_MESH" or not can_leave(context):
        return None
    back = functools.partial(_restore, layer, *_state(layer))
    run.before_write(back)
    bpy.ops.object.mode_set(mode="OBJECT")
    return back


def can_leave(context: bpy.types.Context) -> bool:
    """Whether Blender can return: it enters Edit Mode only with meshes that are visible and selected."""
    edited = [obj for obj in bpy.data.objects if obj.mode == "EDIT"]
    return all(
        obj.type == "MESH" and obj.name in context.view_layer.objects and obj.select_get() and _visible(context, obj)
        for obj in edited
    )


def _state(layer: Any) -> tuple[list[str], dict[str, Selection | None], str | None]:
    """Names of the objects that are selected, of those in Edit Mode with their selection, and of the active one."""
    selected = [obj.name for obj in layer.objects if obj.select_get(view_layer=layer)]
    edited = {
        obj.name: Selection.of(obj) if obj.type == "MESH" else None for obj in layer.objects if obj.mode == "EDIT"
    }
    return selected, edited, layer.objects.active and layer.objects.active.name


def _restore(layer: Any, selected: list[str], edited: dict[str, Selection | None], active: str | None) -> None:
    now = [obj for obj in layer.objects if obj.mode == "EDIT"]
    if now:
        layer.objects.active = now[0]
        bpy.ops.object.mode_set(mode="OBJECT")
    if edited:
        objects = [layer.objects[name] for name in edited]
        with _in_sight(objects):
            _select_objects(layer, [*edited])
            layer.objects.active = layer.objects[active] if active in edited else objects[0]
            bpy.ops.object.mode_set(mode="EDIT")
        # Blender gives all meshes the scene's select mode, and flags that suit it.
        settings = bpy.context.tool_settings
        mode = tuple(settings.mesh_select_mode)
        own_modes = [(obj, own.mode_flags) for obj, own in zip(objects, edited.values(), strict=True) if own]
        for obj, own_mode in own_modes:
            if own_mode != mode:
                layer.objects.active = obj  # whose mode the setting changes
                settings.mesh_select_mode = own_mode
        layer.objects.active = layer.objects.get(active) if active else None
        settings.mesh_select_mode = mode
        for obj, own in zip(objects, edited.values(), strict=True):
            if own is not None:
                own.restore(obj)
    _select_objects(layer, selected)
    layer.objects.active = layer.objects.get(active) if active else None


def _select_objects(layer: Any, names: list[str]) -> None:
    for obj in layer.objects:
        if obj.select_get(view_layer=layer) != (obj.name in names):
            obj.select_set(obj.name in names, view_layer=layer)


@contextlib.contextmanager
def _in_sight(objects: list[bpy.types.Object]) -> Iterator[None]:
    """Shows these objects and makes them selectable: Blender enters Edit Mode only with such objects."""
    hidden = [(obj, obj.hide_get(), obj.hide_viewport, obj.hide_select) for obj in objects]
    for obj in objects:
        obj.hide_set(False)
        obj.hide_viewport = obj.hide_select = False
    try:
        yield
    finally:
        for obj, eye, screen, arrow in hidden:
            obj.hide_set(eye)
            obj.hide_viewport, obj.hide_select = screen, arrow
