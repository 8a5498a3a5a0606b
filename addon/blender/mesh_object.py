# SPDX-License-Identifier: GPL-3.0-or-later
"""Objects that have a mesh, and their type for hints: Blender's own says only that an object has data."""

from collections.abc import Iterable
from typing import TYPE_CHECKING, cast

import bpy

if TYPE_CHECKING:

    class MeshObject(bpy.types.Object):
        """An object of the type "MESH"."""

        data: bpy.types.Mesh
else:
    MeshObject = bpy.types.Object


def mesh_objects(objects: Iterable[bpy.types.Object]) -> list[MeshObject]:
    """The objects that have a mesh."""
    return [cast(MeshObject, obj) for obj in objects if obj.type == "MESH"]
