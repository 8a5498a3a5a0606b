# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes a mesh object of a flat layout: faces, UVs and materials of its source, in the plane z = 0."""

from typing import Any

import bpy
import numpy as np

from ..maps.flat_layout import FlatLayout
from . import compat
from .mesh_object import MeshObject
from .transaction import Transaction


def add_flat_object(
    run: Transaction,
    context: bpy.types.Context,
    source: MeshObject,
    layout: FlatLayout,
    layer: str,
    uv: np.ndarray,
    place: tuple[float, float, float],
) -> bpy.types.Object:
    """A new object with the layout as its mesh, at a place of the world; it is in the scene's active collection.

    uv  (C, 2) of the source's corners: the new mesh has them in a layer of the same name
    """
    for collection in (bpy.data.meshes, bpy.data.objects):
        run.before_write(_keep_only, collection, set(collection.keys()))
    mesh = bpy.data.meshes.new(f"{source.data.name} Flat")
    _fill(mesh, layout)
    made = mesh.uv_layers.new(name=layer, do_init=False)
    compat.set_corner_uv(made, uv[layout.corners])
    number = compat.read(source.data.polygons, "material_index", np.int32)[layout.faces]
    for slot in source.material_slots:
        mesh.materials.append(slot.material)
    if number.any():  # else Blender would keep an attribute of zeros, which goes when a checker is taken off
        mesh.polygons.foreach_set("material_index", number)
    mesh.update()
    obj = bpy.data.objects.new(f"{source.name} Flat", mesh)
    obj.location = place
    context.collection.objects.link(obj)
    return obj


def _keep_only(collection: Any, names: set[str]) -> None:
    for one in [one for one in collection if one.name not in names]:
        collection.remove(one)


def _fill(mesh: bpy.types.Mesh, layout: FlatLayout) -> None:
    """Give an empty mesh the vertices and faces of a layout."""
    points = np.zeros((len(layout.points), 3), dtype=np.float32)
    points[:, :2] = layout.points
    start = np.cumsum(layout.face_size) - layout.face_size
    mesh.vertices.add(len(points))
    mesh.vertices.foreach_set("co", points.ravel())
    mesh.loops.add(len(layout.corners))
    mesh.loops.foreach_set("vertex_index", layout.corner_vertex.astype(np.int32))
    following = np.arange(1, len(layout.corners) + 1)
    following[start + layout.face_size - 1] = start
    ends = np.sort(np.stack([layout.corner_vertex, layout.corner_vertex[following]], axis=1), axis=1)
    edges, corner_edge = np.unique(ends, axis=0, return_inverse=True)  # Blender finds them in another order each time
    mesh.edges.add(len(edges))
    mesh.edges.foreach_set("vertices", edges.astype(np.int32).ravel())
    mesh.loops.foreach_set("edge_index", corner_edge.ravel().astype(np.int32))
    mesh.polygons.add(len(start))
    mesh.polygons.foreach_set("loop_start", start.astype(np.int32))
    if "loop_total" in mesh.polygons[0].bl_rna.properties and not mesh.polygons[0].is_property_readonly("loop_total"):
        mesh.polygons.foreach_set("loop_total", layout.face_size.astype(np.int32))  # before 4.0
    mesh.update()
