# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes material slots, and notes each before.

A slot has two sides: the mesh's material, which all its objects share, and the object's own. The slot's link chooses
the side that is shown. A slot is named by its object and its number, as Blender moves slots in memory.
"""

from typing import Any

import bmesh
import bpy
import numpy as np

from . import compat
from .mesh_object import MeshObject, mesh_objects
from .transaction import Transaction


def set_link(run: Transaction, obj: MeshObject, index: int, link: str) -> None:
    """Show the mesh's side ("DATA") or the object's ("OBJECT") of a slot."""
    was = obj.material_slots[index].link
    if was != link:
        run.before_write(_set_link, obj, index, was)
        _set_link(obj, index, link)


def set_own(
    run: Transaction, obj: MeshObject, index: int, material: bpy.types.Material | None
) -> bpy.types.Material | None:
    """Set and show the object's side of a slot. Returns the material that was there."""
    set_link(run, obj, index, "OBJECT")
    was = obj.material_slots[index].material
    run.before_write(_set_shown, obj, index, was)
    _set_shown(obj, index, material)
    return was


def set_of_mesh(run: Transaction, mesh: bpy.types.Mesh, index: int, material: bpy.types.Material | None) -> None:
    """Set one of a mesh's materials."""
    run.before_write(mesh.materials.__setitem__, index, mesh.materials[index])
    mesh.materials[index] = material


def add_to_mesh(run: Transaction, obj: MeshObject, material: bpy.types.Material) -> None:
    """Give a mesh without materials this one."""
    run.before_write(_clear, obj, _face_numbers(obj))
    obj.data.materials.append(material)
    set_link(run, obj, 0, "DATA")  # the preferences may set another link


def clear_mesh(run: Transaction, obj: MeshObject) -> None:
    """Remove all materials from the mesh, and so all slots from its objects. The faces keep their numbers.

    If one of the objects has a material of its own in a slot, the slots stay, empty.
    """
    mesh = obj.data
    users = [user for user in mesh_objects(bpy.data.objects) if user.data == mesh]
    if any(_has_own(run, user) for user in users):
        for index in range(len(mesh.materials)):
            set_of_mesh(run, mesh, index, None)
        return
    numbers = _face_numbers(obj)
    run.before_write(_restore_materials, obj, list(mesh.materials), numbers)
    _clear(obj, numbers)


def own_side(run: Transaction, obj: MeshObject, index: int) -> bpy.types.Material | None:
    """The material on the object's side of a slot, whether it is shown or not."""
    if obj.material_slots[index].link == "OBJECT":
        return obj.material_slots[index].material
    run.before_write(_set_link, obj, index, "DATA")  # only the shown side can be read
    _set_link(obj, index, "OBJECT")
    own = obj.material_slots[index].material
    _set_link(obj, index, "DATA")
    return own


def _has_own(run: Transaction, obj: MeshObject) -> bool:
    """Whether a slot shows the object's side, or has a material on it."""
    return any(
        slot.link == "OBJECT" or own_side(run, obj, index) is not None for index, slot in enumerate(obj.material_slots)
    )


def _set_link(obj: MeshObject, index: int, link: Any) -> None:
    obj.material_slots[index].link = link


def _set_shown(obj: MeshObject, index: int, material: bpy.types.Material | None) -> None:
    obj.material_slots[index].link = "OBJECT"
    obj.material_slots[index].material = material


def _clear(obj: MeshObject, numbers: np.ndarray) -> None:
    obj.data.materials.clear()  # pop would leave the objects' slots
    _set_face_numbers(obj, numbers)  # which clear sets to 0


def _restore_materials(obj: MeshObject, materials: list[bpy.types.Material | None], numbers: np.ndarray) -> None:
    obj.data.materials.clear()
    for material in materials:
        obj.data.materials.append(material)
    _set_face_numbers(obj, numbers)


def _face_numbers(obj: MeshObject) -> np.ndarray:
    """Number of the slot of each face (P,)."""
    if obj.mode == "EDIT":
        faces = bmesh.from_edit_mesh(obj.data).faces
        return np.fromiter((face.material_index for face in faces), np.int32, len(faces))
    return compat.read(obj.data.polygons, "material_index", np.int32)


def _set_face_numbers(obj: MeshObject, numbers: np.ndarray) -> None:
    if not numbers.any():
        return
    if obj.mode != "EDIT":
        obj.data.polygons.foreach_set("material_index", numbers)
        return
    for face, number in zip(bmesh.from_edit_mesh(obj.data).faces, numbers.tolist(), strict=True):
        face.material_index = number
