# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a mesh object of a layout in the plane z = 0, or of a sphere: faces, UVs and materials of its source."""

from typing import Any, Protocol

import bmesh
import bpy
import numpy as np

from . import compat
from .mesh_object import MeshObject
from .transaction import Transaction
from .uv_layers import add_layer

CAPITALS = 0.7  # height of Blender's own font over its size


class Copied(Protocol):
    """Faces of a mesh at other places: a `FlatLayout` or a `SphereCopy`.

    points  (n, 2) or (n, 3)
    """

    @property
    def points(self) -> np.ndarray: ...
    @property
    def corner_vertex(self) -> np.ndarray: ...
    @property
    def corners(self) -> np.ndarray: ...
    @property
    def faces(self) -> np.ndarray: ...
    @property
    def face_size(self) -> np.ndarray: ...


def add_copied_object(
    run: Transaction,
    context: bpy.types.Context,
    source: MeshObject,
    layout: Copied,
    layer: str,
    uv: np.ndarray,
    place: tuple[float, float, float],
    ending: str,
) -> bpy.types.Object:
    """A new object with the layout as its mesh, at a place of the world, in the scene's active collection.

    uv      (C, 2) of the source's corners: the new mesh has them in a layer of the same name
    ending  of its name, after the source's name
    """
    note_new_objects(run)
    mesh = bpy.data.meshes.new(f"{source.data.name} {ending}")
    points = np.zeros((len(layout.points), 3), dtype=np.float32)
    points[:, : layout.points.shape[1]] = layout.points
    fill_mesh(mesh, points, layout.corner_vertex, layout.face_size)
    add_layer(mesh, layer, uv[layout.corners])
    number = _material_numbers(source.data)[layout.faces]
    for slot in source.material_slots:
        mesh.materials.append(slot.material)
    if number.any():  # else Blender would keep an attribute of zeros, which goes when a checker is taken off
        mesh.polygons.foreach_set("material_index", number)
    mesh.update()
    obj = bpy.data.objects.new(f"{source.name} {ending}", mesh)
    obj.location = place
    context.collection.objects.link(obj)
    return obj


def add_text(
    parent: bpy.types.Object, text: str, at: tuple[float, float], height: float, angle: float
) -> None:
    """A text object that moves with its parent, in the parent's plane. Call it in a transaction that notes new objects.

    at      the middle of the text
    height  of capitals
    angle   radians, counter-clockwise
    """
    curve = bpy.data.curves.new(f"{parent.name} {text}", "FONT")
    curve.body, curve.size, curve.align_x, curve.align_y = text, height / CAPITALS, "CENTER", "CENTER"
    obj = bpy.data.objects.new(curve.name, curve)
    obj.location, obj.rotation_euler, obj.parent = (*at, 0.0), (0.0, 0.0, angle), parent
    for collection in parent.users_collection:
        collection.objects.link(obj)


def _material_numbers(mesh: bpy.types.Mesh) -> np.ndarray:
    """The slot (P,) of each face."""
    if mesh.is_editmode:
        return np.array([face.material_index for face in bmesh.from_edit_mesh(mesh).faces], dtype=np.int32)
    return compat.read(mesh.polygons, "material_index", np.int32)


def note_new_objects(run: Transaction) -> None:
    """Note the objects, meshes and texts that are there, before others are added."""
    for collection in (bpy.data.meshes, bpy.data.curves, bpy.data.objects):
        run.before_write(_keep_only, collection, set(collection.keys()))


def _keep_only(collection: Any, names: set[str]) -> None:
    for one in [one for one in collection if one.name not in names]:
        collection.remove(one)


def fill_mesh(mesh: bpy.types.Mesh, points: np.ndarray, corner_vertex: np.ndarray, face_size: np.ndarray) -> None:
    """Give an empty mesh vertices at points (n, 3) in 32 bits, and faces of a vertex (C,) for each corner."""
    start = np.cumsum(face_size) - face_size
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.add(len(corner_vertex))
    mesh.loops.foreach_set("vertex_index", corner_vertex.astype(np.int32))
    following = np.arange(1, len(corner_vertex) + 1)
    following[start + face_size - 1] = start
    ends = np.sort(np.stack([corner_vertex, corner_vertex[following]], axis=1), axis=1)
    edges, corner_edge = np.unique(ends, axis=0, return_inverse=True)  # Blender finds them in another order each time
    mesh.edges.add(len(edges))
    mesh.edges.foreach_set("vertices", edges.astype(np.int32).ravel())
    mesh.loops.foreach_set("edge_index", corner_edge.ravel().astype(np.int32))
    mesh.polygons.add(len(start))
    mesh.polygons.foreach_set("loop_start", start.astype(np.int32))
    if "loop_total" in mesh.polygons[0].bl_rna.properties and not mesh.polygons[0].is_property_readonly("loop_total"):
        mesh.polygons.foreach_set("loop_total", face_size.astype(np.int32))  # before 4.0
    mesh.update()
