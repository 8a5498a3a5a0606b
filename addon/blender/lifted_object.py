# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a mesh object of a surface with a pattern on it, at the place of its source."""

import bpy
import numpy as np

from ..maps.lifting import Lifted
from . import compat
from .carried_attributes import carry_attributes
from .copied_object import fill_mesh, note_new_objects
from .errors import TransferError
from .mesh_object import MeshObject
from .transaction import Transaction
from .uv_layers import add_layer

ENDING = "Pattern"  # of the names, after the source's name
WALLS = 2  # in `Lifted.patch`
ROUNDING = 1e-5  # of a transform, relative to its largest number


def add_lifted_object(
    run: Transaction, context: bpy.types.Context, source: MeshObject, lifted: Lifted, layer: str
) -> bpy.types.Object:
    """A new object with this mesh and the transform, slots, shading, UVs and attributes of its source, in the active
    collection.

    @param layer name of the map's UV layer; a solid has none. Raises TransferError if the source has no inverse
    transform.
    """
    note_new_objects(run)
    mesh = bpy.data.meshes.new(f"{source.data.name} {ENDING}")
    obj = bpy.data.objects.new(f"{source.name} {ENDING}", mesh)
    obj.matrix_world = source.matrix_world
    fill_mesh(mesh, _local_points(source, obj, lifted), lifted.corner_vertex, lifted.face_size)
    if lifted.uv is not None:
        add_layer(mesh, layer, lifted.uv)
    for slot in source.material_slots:
        mesh.materials.append(slot.material)
    carry_attributes(source, obj, lifted)
    _take_faces(source.data, mesh, lifted)
    mesh.update()
    context.collection.objects.link(obj)
    return obj


def _local_points(source: MeshObject, made: bpy.types.Object, lifted: Lifted) -> np.ndarray:
    """Points (n, 3) in the new object's space. Those that have not moved are the source's own, to the last bit, unless
    the source is sheared: no object by itself can be."""
    of_source, to_world = (
        np.array(matrix, dtype=np.float64)[:3, :3] for matrix in (source.matrix_world, made.matrix_basis)
    )
    try:
        found = (lifted.points @ np.linalg.inv(to_world).T).astype(np.float32)
    except np.linalg.LinAlgError:
        raise TransferError(f"{source.name}: its scale is 0 along an axis") from None
    own = compat.vertex_positions(source.data)
    stayed = lifted.original >= 0
    numbers = ((lifted.original, own), (lifted.below, source.data.loops), (lifted.face, source.data.polygons))
    if any(int(one.max()) >= len(of) for one, of in numbers):
        raise TransferError(f"{source.name}: its mesh has changed during the run")
    if np.abs(of_source - to_world).max() <= ROUNDING * np.abs(to_world).max():
        found[stayed] = own[lifted.original[stayed]]
    return found


def _take_faces(own: bpy.types.Mesh, mesh: bpy.types.Mesh, lifted: Lifted) -> None:
    """Give each new face the slot and the shading of the source's face below it. Walls are flat."""
    slots = compat.read(own.polygons, "material_index", np.int32)
    smooth = compat.read(own.polygons, "use_smooth", bool)
    if not slots.any() and not smooth.any():
        mesh.polygons.foreach_set("use_smooth", np.zeros(len(mesh.polygons), dtype=bool))
        return
    bent = smooth[lifted.face] & (lifted.patch != WALLS)
    mesh.polygons.foreach_set("use_smooth", bent)
    if slots.any():
        mesh.polygons.foreach_set("material_index", slots[lifted.face])
