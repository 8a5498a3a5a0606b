# SPDX-License-Identifier: GPL-3.0-or-later
"""Gives a new object what its source has at the same places: UV layers, attributes and vertex groups."""

from typing import Any

import bpy
import numpy as np

from ..maps.lifting import Lifted
from . import compat
from .mesh_object import MeshObject

KINDS: dict[str, tuple[str, int, type]] = {  # of attributes: property, width, numbers; those with a fraction are mixed
    "FLOAT": ("value", 1, np.float32), "FLOAT_VECTOR": ("vector", 3, np.float32), "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32), "BYTE_COLOR": ("color", 4, np.float32),
    "INT": ("value", 1, np.int32), "INT8": ("value", 1, np.int32), "BOOLEAN": ("value", 1, bool),
}  # fmt: skip


def carry_attributes(source: MeshObject, made: bpy.types.Object, lifted: Lifted) -> None:
    """Interpolate the values of the source in its faces. Whole numbers and flags are those of the nearest corner.

    Attributes of edges, shape keys and custom normals stay behind. Layers that the new mesh has already are kept.
    """
    own: Any = source.data
    mesh: Any = made.data
    corner_vertex, _ = compat.corner_indices(own)
    at = np.zeros(len(mesh.vertices), dtype=np.int64)
    at[lifted.corner_vertex] = np.arange(len(lifted.corner_vertex))  # a corner of each vertex
    places = {
        "CORNER": (lifted.below, lifted.weights),
        "POINT": (corner_vertex[lifted.below[at]], lifted.weights[at]),
        "FACE": (lifted.face[:, None], np.ones((len(lifted.face), 1))),
    }
    _carry_uv(own, mesh, places["CORNER"])
    for attribute in own.attributes:
        name, kind = attribute.name, KINDS.get(attribute.data_type)
        taken = name.startswith(".") or name in mesh.attributes or name in own.uv_layers or name in mesh.uv_layers
        if kind is None or taken or attribute.domain not in places:
            continue
        values = _mixed(compat.read(attribute.data, kind[0], kind[2], kind[1]), *places[attribute.domain])
        new = mesh.attributes.new(name, attribute.data_type, attribute.domain)
        new.data.foreach_set(kind[0], np.ascontiguousarray(values).ravel())
    for which in ("active_color_name", "default_color_name"):
        setattr(mesh.color_attributes, which, getattr(own.color_attributes, which))
    _carry_groups(source, made, places["POINT"])


def _mixed(values: np.ndarray, below: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """The values (m,) or (m, width) at the places (n, 3), by their weights."""
    if values.dtype != np.float32:
        return values[np.take_along_axis(below, weights.argmax(axis=1)[:, None], axis=1)[:, 0]]
    rows = values.reshape(len(values), -1).astype(np.float64)
    return np.einsum("nk,nkd->nd", weights, rows[below]).astype(np.float32)


def _carry_uv(own: bpy.types.Mesh, mesh: bpy.types.Mesh, places: tuple[np.ndarray, np.ndarray]) -> None:
    first = mesh.uv_layers.active_index
    for layer in own.uv_layers:
        if layer.name in mesh.uv_layers:
            continue
        made = compat.new_uv_layer(mesh, layer.name)
        if made is None:  # Blender has no room for another one
            break
        compat.set_corner_uv(made, _mixed(compat.corner_uv(layer), *places))
    mesh.uv_layers.active_index = max(first or 0, 0)


def _carry_groups(source: MeshObject, made: bpy.types.Object, places: tuple[np.ndarray, np.ndarray]) -> None:
    if not source.vertex_groups:
        return
    of: dict[int, Any] = {group.index: ([], []) for group in source.vertex_groups}
    for number, vertex in enumerate(source.data.vertices):
        for element in vertex.groups:
            if element.group in of:
                of[element.group][0].append(number)
                of[element.group][1].append(element.weight)
    for group in source.vertex_groups:
        weights = np.zeros(len(source.data.vertices), dtype=np.float32)
        weights[of[group.index][0]] = of[group.index][1]
        new, found = made.vertex_groups.new(name=group.name), _mixed(weights, *places)[:, 0]
        for number in np.flatnonzero(found).tolist():
            new.add([number], float(found[number]), "REPLACE")
