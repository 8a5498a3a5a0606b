# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the islands of one object's UV layer, as they are."""

from types import ModuleType
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import Transaction


def pack(
    run: Transaction, koebe: ModuleType, obj: MeshObject, layer: str, selected_only: bool, options: dict[str, Any]
) -> Any:
    """Write the packed islands. Returns the result of `koebe.pack`.

    layer    that is packed. Without a name the active one
    options  of `koebe.pack`
    Raises TransferError, and the errors of `koebe.pack`.
    """
    check_mesh(obj)
    surface = mesh_reading.read_surface(obj, selected_only)
    layer = layer or getattr(obj.data.uv_layers.active, "name", "")
    if layer not in obj.data.uv_layers:
        raise TransferError(f"{obj.name}: it has no UV layer {layer!r}" if layer else f"{obj.name}: it has no UVs")
    chosen = surface.selected[surface.triangle_face]
    if not chosen.any():
        raise TransferError(f"{obj.name}: no face is selected" if selected_only else f"{obj.name}: it has no faces")
    target, uv = Target.of(obj), mesh_reading.read_layer(obj, layer).astype(np.float64)
    corners = surface.triangle_corners[chosen]
    result = koebe.pack(
        surface.positions, surface.corner_vertex[corners], uv=uv[corners], polygon=surface.triangle_face[chosen],
        **options,
    )  # fmt: skip
    uv[corners] = result.uv
    written = np.unique(corners)
    map_writing.write(run, map_writing.plan(target, layer, surface, written, uv[written]), select=False)
    return result
