# SPDX-License-Identifier: GPL-3.0-or-later
"""UV coordinates as vector attributes (u, v, 0) of a mesh's points or corners, in Object Mode."""

import dataclasses
from typing import Any, Final

import bpy
import numpy as np

from . import compat
from .errors import TransferError
from .mesh_object import MeshObject
from .transaction import Transaction

KIND: Final = "FLOAT_VECTOR"
DOMAINS = ("POINT", "CORNER")


@dataclasses.dataclass(frozen=True)
class Vectors:
    """Values (n, 2) for some elements (n,) of a domain; the others keep theirs, and have zero in a new attribute."""

    name: str
    domain: str
    elements: np.ndarray
    values: np.ndarray


def check(obj: MeshObject, name: str) -> None:
    """Raise TransferError unless the mesh has such an attribute, or could get it."""
    found = obj.data.attributes.get(name)
    if name in obj.data.uv_layers or name in obj.vertex_groups or (
        found is not None and (found.data_type != KIND or found.domain not in DOMAINS)
    ):  # fmt: skip
        raise TransferError(f"{obj.name}: the name {name!r} is taken by something else: choose another layer name")


def corner_values(obj: MeshObject, name: str) -> np.ndarray:
    """Values (C, 2) of the attribute at the mesh's corners. Not in Edit Mode."""
    domain, values = _read(obj.data, name) or ("CORNER", np.zeros((len(obj.data.loops), 3), dtype=np.float32))
    return values[compat.corner_indices(obj.data)[0] if domain == "POINT" else slice(None), :2]


def write(run: Transaction, obj: MeshObject, vectors: Vectors) -> None:
    """Write the values, into a new attribute if that domain has none of that name. Not in Edit Mode."""
    check(obj, vectors.name)
    mesh, name = obj.data, vectors.name
    old = _read(mesh, name)
    run.before_write(_restore, mesh, name, old)
    if old is None or old[0] != vectors.domain:
        _remove(mesh, name)
        made = _new(mesh, name, vectors.domain)
        if made is None or made.name != name:
            raise TransferError(f"{obj.name}: Blender cannot make the attribute {name!r}: choose another layer name")
        count = len(mesh.vertices if vectors.domain == "POINT" else mesh.loops)
        values = np.zeros((count, 3), dtype=np.float32)
    else:
        values = old[1].copy()
    values[vectors.elements, :2], values[vectors.elements, 2] = vectors.values, 0.0
    _set(mesh, name, values)


def _read(mesh: bpy.types.Mesh, name: str) -> tuple[str, np.ndarray] | None:
    """Domain and values (n, 3), or None without the attribute."""
    found = mesh.attributes.get(name)
    return None if found is None else (found.domain, compat.read(found.data, "vector", np.float32, 3))


def _new(mesh: bpy.types.Mesh, name: str, domain: Any) -> bpy.types.Attribute | None:
    return mesh.attributes.new(name, KIND, domain)


def _set(mesh: bpy.types.Mesh, name: str, values: np.ndarray) -> None:
    mesh.attributes[name].data.foreach_set("vector", np.ascontiguousarray(values, dtype=np.float32).ravel())
    mesh.update()


def _remove(mesh: bpy.types.Mesh, name: str) -> None:
    if name in mesh.attributes:
        mesh.attributes.remove(mesh.attributes[name])


def _restore(mesh: bpy.types.Mesh, name: str, old: tuple[str, np.ndarray] | None) -> None:
    if old is None:
        _remove(mesh, name)
        return
    domain, values = old
    if name in mesh.attributes and mesh.attributes[name].domain != domain:
        _remove(mesh, name)
    if name not in mesh.attributes:
        _new(mesh, name, domain)
    _set(mesh, name, values)
