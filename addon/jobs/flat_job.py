# SPDX-License-Identifier: GPL-3.0-or-later
"""Reads UV layouts of objects as flat pieces, for new objects or a drawing."""

import dataclasses

import numpy as np

from ..blender import mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import check_readable, reason
from ..maps.flat_layout import FlatLayout, flat_layout


@dataclasses.dataclass(frozen=True)
class Flat:
    """An object's layout, and the UVs (C, 2) of its layer."""

    obj: MeshObject
    layer: str
    uv: np.ndarray
    layout: FlatLayout

    def describe(self) -> str:
        """How true to scale it is, and which faces were left out."""
        left_out = f"; {self.layout.left_out} faces without UVs are left out" if self.layout.left_out else ""
        return f"{self.obj.name}: {self.layout.describe()}{left_out}"


def read_flat(objects: list[MeshObject], layer: str) -> tuple[list[Flat], list[str]]:
    """The objects' layouts in the layer of that name, or in their active one; why other objects have none."""
    found, problems = [], []
    for obj in objects:
        try:
            found.append(_read(obj, layer))
        except Exception as error:
            problems.append(reason(obj.name, error))
    return found, problems


def _read(obj: MeshObject, layer: str) -> Flat:
    check_readable(obj)
    if not layer and obj.data.uv_layers.active is None:
        raise TransferError(f"{obj.name}: it has no UVs: map it first")
    layer = layer or obj.data.uv_layers.active.name
    if layer not in obj.data.uv_layers:
        raise TransferError(f"{obj.name}: it has no UV layer {layer!r}: map it first")
    surface = mesh_reading.read_surface(obj, selected_only=False)
    uv = mesh_reading.read_layer(obj, layer)
    return Flat(obj, layer, uv, flat_layout(surface, uv))
