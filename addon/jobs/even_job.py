# SPDX-License-Identifier: GPL-3.0-or-later
"""The UV layer of an object while the slider Even is dragged: reads, computes on a thread, shows, puts back."""

import bpy
import numpy as np

from ..blender import compat, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import check_mesh
from ..layers.even_drag import EvenPreview
from . import native_package


class EvenJob:
    """A preview of one object's UV layer. In Object Mode."""

    def __init__(self, obj: MeshObject, layer: str, round: bool) -> None:
        """Read the object. @param layer without a name, or not there: the active one.

        Raises NativeError, TransferError, MapError.
        """
        koebe = native_package.load()
        check_mesh(obj)
        if layer not in obj.data.uv_layers:
            if obj.data.uv_layers.active is None:
                raise TransferError(f"{obj.name}: it has no UVs: map it first")
            layer = obj.data.uv_layers.active.name
        self.cancel_token = koebe.CancelToken()
        self.name, self.layer = obj.name, layer
        self._old = mesh_reading.read_layer(obj, layer)
        surface = mesh_reading.read_surface(obj, selected_only=False)
        self.preview = EvenPreview(koebe, surface, self._old, round, self.cancel_token)

    def show(self) -> None:
        """Write the preview into the layer."""
        self._set(self.preview.uv)

    def put_back(self) -> None:
        """Write the UVs that were read."""
        self._set(self._old)

    def _set(self, values: np.ndarray) -> None:
        obj = bpy.data.objects.get((self.name, None))
        if obj is None or obj.type != "MESH" or obj.mode == "EDIT" or self.layer not in obj.data.uv_layers:
            return
        layer = obj.data.uv_layers[self.layer]
        if len(layer.data) == len(self._old):
            compat.set_corner_uv(layer, values)
            obj.data.update_tag()
