# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that puts the checker on objects and takes it off."""

import bpy
import numpy as np

from ..blender import checker, edit_mode
from ..blender.mesh_object import MeshObject
from ..blender.mesh_reading import read_layer, read_surface
from ..blender.targets import attempt, target_objects
from ..blender.transaction import transaction
from ..layers.distortion import texel_density
from ..layers.tile_pattern import Pattern
from ..state.option_properties import option
from ..surfaces.surface import Surface
from .answers import finished, refused
from .run_operator import can_map


class UV_OT_koebe_checker(bpy.types.Operator):
    """Put the checker on the selected objects, or take it off again and give them their materials back"""

    bl_idname = "uv.koebe_checker"
    bl_label = "Koebe Checker"
    bl_options = {"REGISTER", "UNDO"}

    layer: option("layer")
    checker_size: option("checker_size")
    checker_even: option("checker_even")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_map(cls, context)

    def execute(self, context: bpy.types.Context) -> set[str]:
        with transaction() as run:
            objects = target_objects(context)
            problems: list[str] = []
            wearing = [obj for obj in objects if checker.is_on(obj)]
            sizes = [self.checker_size] * len(objects)
            if not wearing and self.checker_even and len(objects) > 1:
                sizes = checker.even_sizes(self.checker_size, [self._density(obj) for obj in objects])
            materials: list[bpy.types.Material | None] = [None] * len(objects)
            if not wearing:
                patterns = [self._pattern(*pair) for pair in zip(objects, sizes, strict=True)]
                materials = [*checker.materials(run, objects, self.layer, patterns)]
            for obj, material in zip(wearing or objects, materials):
                with attempt(run, obj.name, problems):
                    checker.check(obj)
                    if wearing:
                        checker.take_off(run, obj)
                    elif material and not checker.is_on(obj):  # another object of the same mesh may have got it
                        checker.put_on(run, obj, material)
            if len(problems) == len(wearing or objects):
                run.put_back()  # the new material
                return refused(self, "", problems)
            edit_mode.undo_all(context)
            return finished(self, "not done", problems)

    def _read(self, obj: MeshObject) -> tuple[Surface, np.ndarray] | None:
        """The surface and its UVs (C, 2), or None if they do not exist or cannot be read."""
        if self.layer not in obj.data.uv_layers or (obj.data.is_editmode and obj.mode != "EDIT"):
            return None
        surface = read_surface(obj, selected_only=False)
        return surface, read_layer(obj, self.layer)

    def _density(self, obj: MeshObject) -> float:
        """Lengths in the UVs over lengths in space; 0 if unknown."""
        found = self._read(obj)
        return texel_density(*found) if found else 0.0

    def _pattern(self, obj: MeshObject, size: float) -> Pattern:
        """The checker of that size, or the nearest one that continues over the cuts of a tile."""
        found = self._read(obj)
        return checker.pattern_for(*found, size)[0] if found else Pattern(size)
