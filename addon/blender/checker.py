# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts the checker on objects, and takes it off again without a trace.

An object with material slots keeps them: the checker covers them on the object's side, while the mesh's materials and
the faces' slot numbers stay. A custom property of the object remembers both sides of every slot, as joining objects
discards one side. A mesh without slots gets one, for all its objects.
"""

from typing import Any

import bpy
import numpy as np

from ..layers.sphere_pattern import sphere_pattern
from ..layers.tile_pattern import Pattern, fits, fitting_pattern, lattices_of
from ..surfaces.surface import Surface
from . import material_slots
from .checker_material import checker_materials, is_checker
from .errors import TransferError
from .mesh_object import MeshObject
from .noted_properties import set_property
from .targets import check_mesh
from .transaction import Transaction

MEMORY_KEY = "koebe_checker_slots"  # on the object: its slots before


def is_on(obj: MeshObject) -> bool:
    """Whether the object has the checker on, or remembers the materials beneath."""
    return MEMORY_KEY in obj or any(is_checker(slot.material) for slot in obj.material_slots)


def check(obj: MeshObject) -> None:
    """Raise TransferError unless the checker can be put on and taken off."""
    if obj.library is not None:
        raise TransferError(f"{obj.name}: it is linked from another file: make it local first")
    if obj.override_library is not None:
        raise TransferError(f"{obj.name}: it is a library override, which cannot keep the checker: make it local first")
    if len(obj.material_slots) == 0 or any(is_checker(material) for material in obj.data.materials):
        check_mesh(obj)


def even_sizes(size: float, densities: list[float]) -> list[float]:
    """Squares across the UV square of each object, so that all squares are as large in space as the first object's.

    densities  lengths in the UVs over lengths in space, 0 without UVs
    """
    sizes = [size * densities[0] / one if densities[0] * one > 0.0 else size for one in densities]
    alike: dict[str, float] = {}  # nearly equal sizes share a material
    return [alike.setdefault(f"{one:.3g}", one) for one in sizes]


def pattern_for(surface: Surface, uv: np.ndarray, size: float) -> tuple[Pattern, bool]:
    """The checker with about this many squares across the UV square, and whether it fits the cuts of all tiles, or of
    spheres.

    surface, uv  of a whole mesh, and its UVs (C, 2)
    """
    of_sphere = sphere_pattern(surface, uv, size)
    if of_sphere is not None:
        return of_sphere, True
    lattices = lattices_of(surface, uv)
    pattern = fitting_pattern(lattices[0], size) if lattices else Pattern(size)
    return pattern, all(fits(pattern, periods) for periods in lattices)


def materials(
    run: Transaction, objects: list[MeshObject], layer: str, patterns: list[Pattern]
) -> list[bpy.types.Material]:
    """The checker of a UV layer for each of the objects."""

    def free(material: bpy.types.Material) -> bool:
        return all(obj in objects for obj in bpy.data.objects if _wears(obj, material))

    return checker_materials(run, layer, patterns, free)


def _wears(obj: bpy.types.Object, material: bpy.types.Material) -> bool:
    return any(slot.material == material for slot in obj.material_slots)


def put_on(run: Transaction, obj: MeshObject, material: bpy.types.Material) -> None:
    """Cover all of the object's slots with a checker, or give it a slot. Call `check` first."""
    take_off(run, obj)
    cover(run, obj, material)


def cover(run: Transaction, obj: MeshObject, material: bpy.types.Material) -> None:
    """Put a checker over the materials of the object, which has no checker on."""
    if len(obj.material_slots) == 0:
        material_slots.add_to_mesh(run, obj, material)
        return
    memory = {}
    for index, slot in enumerate(obj.material_slots):
        was = {"link": slot.link, "mesh": obj.data.materials[index]}
        was["material"] = material_slots.set_own(run, obj, index, material)
        memory[str(index)] = {key: value for key, value in was.items() if value is not None}
    set_property(run, obj, MEMORY_KEY, memory)


def take_off(run: Transaction, obj: MeshObject) -> None:
    """Give the object its slots back. Call `check` first. Materials put into a slot meanwhile stay there."""
    if not is_on(obj):
        return
    memory = _memory(obj)
    for index, slot in enumerate(obj.material_slots):
        if slot.link == "OBJECT" or str(index) in memory:
            _uncover(run, obj, index, memory.get(str(index), {}))
    of_mesh = obj.data.materials
    if len(of_mesh) and not memory and all(is_checker(material) for material in of_mesh):
        material_slots.clear_mesh(run, obj)
    for index, material in enumerate(of_mesh):
        if is_checker(material):  # for example, a joined object had the checker on
            material_slots.set_of_mesh(run, obj.data, index, _beneath(memory.get(str(index), {})))
    if MEMORY_KEY in obj:
        set_property(run, obj, MEMORY_KEY, None)


def _uncover(run: Transaction, obj: MeshObject, index: int, was: dict[str, Any]) -> None:
    link = obj.material_slots[index].link
    if is_checker(material_slots.own_side(run, obj, index)):
        material_slots.set_own(run, obj, index, was.get("material"))
        material_slots.set_link(run, obj, index, was.get("link", "DATA") if link == "OBJECT" else "DATA")


def _memory(obj: MeshObject) -> dict[str, Any]:
    return obj[MEMORY_KEY].to_dict() if MEMORY_KEY in obj else {}


def _beneath(was: dict[str, Any]) -> bpy.types.Material | None:
    """The material that a remembered slot showed, or None."""
    return was.get("material" if was.get("link") == "OBJECT" else "mesh")


def materials_beneath(obj: MeshObject) -> list[bpy.types.Material | None]:
    """The material of each slot of the object without the checker; None for an empty slot."""
    memory = _memory(obj)
    return [
        _beneath(memory.get(str(index), {})) if is_checker(slot.material) else slot.material
        for index, slot in enumerate(obj.material_slots)
    ]
