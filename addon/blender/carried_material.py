# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds a carried texture's material, and gives it to an object without materials. The checker stays."""

import bpy

from . import checker, material_slots
from .mesh_object import MeshObject
from .transaction import Transaction


def painted(obj: MeshObject) -> bpy.types.Material | None:
    """The material of the object's active slot, or of the first slot with one, beneath the checker; or None."""
    beneath = checker.materials_beneath(obj)
    if not beneath:
        return None
    active = beneath[min(obj.active_material_index or 0, len(beneath) - 1)]
    return active or next(filter(None, beneath), None)


def give(run: Transaction, obj: MeshObject, material: bpy.types.Material) -> None:
    """Give the object this material if it has none of its own."""
    if any(checker.materials_beneath(obj)):
        return
    worn = next((slot.material for slot in obj.material_slots if checker.is_checker(slot.material)), None)
    if worn is not None:
        checker.check(obj)
        checker.take_off(run, obj)
    if len(obj.material_slots) == 0:
        material_slots.add_to_mesh(run, obj, material)
    for index, slot in enumerate(obj.material_slots):
        if slot.material is not None:
            continue
        if slot.link == "OBJECT":
            material_slots.set_own(run, obj, index, material)
        else:
            material_slots.set_of_mesh(run, obj.data, index, material)
    if worn is not None:
        checker.cover(run, obj, worn)
