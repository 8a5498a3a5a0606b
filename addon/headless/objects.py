# SPDX-License-Identifier: GPL-3.0-or-later
"""The objects of a batch run: which they are, how they leave Edit Mode, and their places in the world."""

import contextlib
from collections.abc import Iterator
from typing import Any

import bpy

from ..blender.mesh_object import MeshObject, mesh_objects
from .exit_and_signals import UNMAPPABLE, USAGE, Stop


def chosen_objects(names: list[str] | None) -> list[MeshObject]:
    """The mesh objects of the scene, or the named ones anywhere in the file."""
    if names is None:
        found = mesh_objects(bpy.context.scene.objects)
        if not found:
            raise Stop(UNMAPPABLE, "the scene has no mesh objects")
        return found
    return list(dict.fromkeys(_named(name, ",".join(names)) for name in names))


def _named(name: str, asked: str) -> MeshObject:
    obj = bpy.data.objects.get((name, None)) or bpy.data.objects.get(name)  # the file's own before a library's
    if obj is not None and obj.type == "MESH":
        return obj
    if obj is not None:
        raise Stop(USAGE, f"the object {name!r} is no mesh")
    whole = [other.name for other in bpy.data.objects if "," in other.name and other.name in asked]
    quoted = ['"{}"'.format(one.replace('"', '""')) for one in whole]
    hint = f"; for the object {whole[0]!r} write --objects '{quoted[0]}'" if whole else ""
    raise Stop(USAGE, f"there is no object named {name!r}{hint}")


def leave_edit_mode(objects: list[MeshObject]) -> None:
    """Leave Edit Mode, in case the file was saved in it, for these objects and for others that share their meshes."""
    meshes = {obj.data for obj in objects}
    active = bpy.context.view_layer.objects.active
    for obj in bpy.context.view_layer.objects:
        if obj.type == "MESH" and obj.data in meshes and obj.mode != "OBJECT":
            bpy.context.view_layer.objects.active = obj
            bpy.ops.object.mode_set(mode="OBJECT")
    bpy.context.view_layer.objects.active = active


@contextlib.contextmanager
def in_their_places(objects: list[MeshObject]) -> Iterator[None]:
    """Inside, the world matrices of the objects are true, also for objects that Blender does not evaluate.

    Blender skips objects that no view layer shows: disabled, excluded, or in another scene. An empty that copies the
    place of such an object makes Blender evaluate it, with parents, constraints and animation, in the current frame of
    its own scene.
    """
    bpy.context.evaluated_depsgraph_get()  # updates objects that are shown
    hidden: dict[bpy.types.Scene, list[MeshObject]] = {}
    for obj in objects:
        if not obj.visible_get():
            hidden.setdefault(_scene_of(obj), []).append(obj)
    helpers = []
    try:
        for scene, unseen in hidden.items():
            helpers += [_helper(obj, scene) for obj in unseen]
            # A view-layer update is not enough: 3.4 does not animate another scene by it.
            scene.frame_set(scene.frame_current, subframe=scene.frame_subframe)
            for obj in unseen:  # 3.4 must be set again for an object with animated visibility
                obj.update_tag(refresh={"OBJECT"})
            scene.view_layers[0].update()
        yield
    finally:
        for helper in helpers:
            bpy.data.objects.remove(helper)


def _scene_of(obj: MeshObject) -> Any:
    current = bpy.context.scene
    scenes = [scene for scene in obj.users_scene if scene.library is None]
    return current if current in scenes or not scenes else scenes[0]


def _helper(obj: MeshObject, scene: bpy.types.Scene) -> bpy.types.Object:
    helper = bpy.data.objects.new("Koebe Helper", None)
    scene.collection.objects.link(helper)
    helper.constraints.new("COPY_TRANSFORMS").target = obj
    return helper
