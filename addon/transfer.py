# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender mesh -> arrays -> UV layer. Reads everything, writes nothing but one UV layer's coordinates."""

import contextlib
import itertools
import struct

import bmesh
import numpy as np

from . import compat, distortion
from .surface import Surface

MAX_UV_LAYERS = 8  # Blender's limit


class TransferError(Exception):
    """A mesh that cannot be read or a UV layer that cannot be written."""


def read_surface(obj, selected_only):
    """The object's mesh as a `Surface`, in world space but for the translation.

    In Edit Mode the mesh's arrays are brought up to date first. With `selected_only` the surface is
    that of the selected faces. A mirrored object keeps its face order: lengths and angles are those
    of the world, and the UVs stay counter-clockwise in the mesh's own order.
    """
    if obj.mode == "EDIT":
        obj.update_from_editmode()
    with _arrays(obj) as mesh:
        mesh.calc_loop_triangles()
        vertex, edge = compat.corner_indices(mesh)
        size = compat.read_indices(mesh.polygons, "loop_total")
        return Surface(
            positions=_world_positions(obj, mesh),
            corner_vertex=vertex,
            corner_edge=edge,
            face_start=compat.read_indices(mesh.polygons, "loop_start"),
            face_size=size,
            seam=compat.seam_edges(mesh),
            selected=compat.chosen_faces(mesh) if selected_only else np.ones(len(mesh.polygons), dtype=bool),
            triangle_corners=compat.read_indices(mesh.loop_triangles, "loops", 3),
            triangle_face=np.repeat(np.arange(len(size), dtype=np.int32), size - 2),  # as Blender orders them
        )


@contextlib.contextmanager
def _arrays(obj):
    """The object's mesh, to be read.

    In Edit Mode that hides its UVs, and from 3.6 on hands over the rest one by one: then it is a copy for the time, in
    which Blender shares what it can.
    """
    if obj.mode != "EDIT":
        yield obj.data
        return
    try:
        yield obj.to_mesh()  # of the object itself, without modifiers and shape keys
    finally:
        obj.to_mesh_clear()


def _world_positions(obj, mesh):
    positions = compat.vertex_positions(mesh).astype(np.float64)
    to_world = np.array(obj.matrix_world, dtype=np.float64)[:3, :3]
    if np.array_equal(to_world, np.eye(3)):
        return positions
    return np.einsum("ij,kj->ik", positions, to_world)


def read_uv(obj, layer_name):
    """UVs (C, 2) of the layer of that name, or else of the active one, or None.

    In Edit Mode they are those of `read_surface`, of the last time the mesh's arrays were brought up to date.
    """
    layer = obj.data.uv_layers.get(layer_name) or obj.data.uv_layers.active
    if layer is None:
        return None
    with _arrays(obj) as mesh:
        return compat.corner_uv(mesh.uv_layers[layer.name])


def has_pins(obj, layer_name):
    """Whether UVs of that layer are pinned; in Edit Mode as of `read_surface`."""
    if layer_name not in obj.data.uv_layers:
        return False
    with _arrays(obj) as mesh:
        return compat.any_pin(mesh, mesh.uv_layers[layer_name])


def texel_density(obj, layer_name):
    """Mean length in the UVs of a layer over length in space; 0 if there are none. Not in Edit Mode."""
    if layer_name not in obj.data.uv_layers:
        return 0.0
    return distortion.texel_density(read_surface(obj, selected_only=False), read_uv(obj, layer_name))


def active_vertex(obj):
    """Index of the active vertex of an object in Edit Mode, or None."""
    if obj.mode != "EDIT":
        return None
    active = bmesh.from_edit_mesh(obj.data).select_history.active
    return active.index if isinstance(active, bmesh.types.BMVert) else None


def check_writable(obj, surface, layer_name):
    """Raise TransferError unless the UV layer can be written, or made, for the surface that was read.

    Call it for all objects before the first `write_uv`, so that all are written or none.
    """
    mesh = obj.data
    if mesh.library is not None:
        raise TransferError(f"{obj.name}: its mesh is linked from another file: make it local first")
    if not _has_counts(obj, surface):
        raise TransferError(f"{obj.name}: its mesh has changed in the meantime")
    if layer_name in mesh.uv_layers:
        return
    if len(mesh.uv_layers) >= MAX_UV_LAYERS:
        raise TransferError(
            f"{obj.name}: it has {MAX_UV_LAYERS} UV layers, which is all that Blender allows: delete one"
        )
    if layer_name in mesh.attributes:
        raise TransferError(
            f"{obj.name}: the attribute {layer_name!r} is no UV layer: choose another layer name"
        )


def _has_counts(obj, surface):
    """Whether the mesh has as many elements as the surface that was read from it."""
    if obj.mode != "EDIT":
        return len(obj.data.loops) == len(surface.corner_vertex)
    edited = bmesh.from_edit_mesh(obj.data)  # which does not count its corners
    counts = len(edited.verts), len(edited.edges), len(edited.faces)
    return counts == (len(surface.positions), len(surface.seam), len(surface.face_size))


def write_uv(obj, layer_name, corners, uv):
    """Set the UVs (m, 2) of `corners` (m,) in the layer of that name, make it if missing, make it active.

    All other corners keep their UVs; in a new layer they are zero. Not in Edit Mode.
    """
    layers = obj.data.uv_layers
    layer = layers.get(layer_name)
    if layer is None:
        layer = layers.new(name=layer_name, do_init=False)
        values = np.zeros((len(obj.data.loops), 2), dtype=np.float32)
    else:
        values = compat.corner_uv(layer)
    _put(values, corners, uv)
    compat.set_corner_uv(layer, values)
    layers.active = layer
    obj.data.update()


def write_edited_uv(obj, layer_name, surface, corners, uv):
    """Like `write_uv`, for an object in Edit Mode and all the corners of some faces of the surface that was read.

    Blender hands over the corners one by one, which still takes half the time of its change of mode before 3.5.
    """
    mesh = obj.data
    if layer_name not in mesh.uv_layers:
        mesh.uv_layers.new(name=layer_name, do_init=False)
    mesh.uv_layers.active = mesh.uv_layers[layer_name]
    values = np.empty((len(surface.corner_vertex), 2), dtype=np.float32)
    _put(values, corners, uv)
    mapped = np.zeros(len(values), dtype=bool)
    mapped[corners] = True
    edited = bmesh.from_edit_mesh(mesh)
    layer = edited.loops.layers.uv[layer_name]
    points = struct.iter_unpack("=2f", values[mapped])
    for face in itertools.compress(edited.faces, mapped[surface.face_start].tolist()):
        for corner in face.loops:
            corner[layer].uv = next(points)
    bmesh.update_edit_mesh(mesh, loop_triangles=False, destructive=False)


def _put(values, corners, uv):
    """values[corners] = uv, in 32 bits; each point as one number, which NumPy moves five times as fast as a pair."""
    points = np.ascontiguousarray(uv, dtype=np.float32).view(np.complex64)[:, 0]
    values.view(np.complex64)[:, 0][corners] = points
