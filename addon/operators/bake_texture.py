# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that carries an object's textures from its old UVs to its new ones."""

import bpy

from ..blender import checker, texture_bake, texture_nodes
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.mesh_reading import layer_named, read_layer
from ..blender.targets import check_mesh, target_objects
from ..blender.transaction import Transaction
from ..maps.wording import counted
from ..state.option_properties import option
from .layer_run import EACH_LAYER, LayerEdit
from .polls import in_object_mode

OUTSIDE = 1e-3  # UV units, that a layer may reach over the square


class UV_OT_koebe_bake_texture(LayerEdit, bpy.types.Operator):
    """Bake all images of the materials anew, so that a painted model looks the same with the new UVs. The object gets
    copies of its materials. The old materials, images and UVs stay in the file"""

    bl_idname = "uv.koebe_bake_texture"
    bl_label = "Koebe Bake to New UVs"
    nothing, not_done = "nothing was baked.", "not baked"
    moves_uv = False

    layer: EACH_LAYER
    margin: option("margin")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return in_object_mode(cls, context, 1)

    def execute(self, context: bpy.types.Context) -> set[str]:
        return self._edit(context, target_objects(context), self._object)

    def _object(self, run: Transaction, obj: MeshObject) -> str:
        """Bake one object. Returns what was done. Raises TransferError."""
        check_mesh(obj)
        layer = layer_named(obj, self.layer)
        if checker.is_on(obj):
            raise TransferError(f"{obj.name}: take the checker off first")
        uv = read_layer(obj, layer)
        if not (len(uv) and uv.min() >= -OUTSIDE and uv.max() <= 1.0 + OUTSIDE):
            raise TransferError(f"{obj.name}: the UVs of {layer} are not all in the UV square: press Pack Only first")
        made = texture_bake.carry(run, obj, layer, round(self.margin))
        left = any(slot.material and texture_nodes.has_other_images(slot.material) for slot in obj.material_slots)
        also = ". Films and images in node groups stay as they were" if left else ""
        return f"{obj.name}: {counted(len(made), 'image')} baked{also}"
