# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the coordinates and the selection of one UV layer, in Object Mode and in Edit Mode, and no other data."""

import itertools
import struct
from typing import Any

import bmesh
import bpy
import numpy as np

from ..surfaces.surface import Surface
from . import compat
from .errors import TransferError
from .mesh_object import MeshObject
from .mesh_reading import arrays
from .transaction import Transaction


def check_layer(obj: MeshObject, layer_name: str) -> None:
    """Raise TransferError unless the mesh has that UV layer, or could get it."""
    mesh = obj.data
    if layer_name in mesh.uv_layers:
        return
    if len(mesh.uv_layers) >= compat.MAX_UV_LAYERS:
        raise TransferError(
            f"{obj.name}: it has {compat.MAX_UV_LAYERS} UV layers, and Blender allows no more: delete a layer"
        )
    if compat.GROUPS_TAKE_NAMES and layer_name in obj.vertex_groups:
        raise TransferError(
            f"{obj.name}: the name {layer_name!r} is used by a vertex group: choose another layer name"
        )
    if layer_name in mesh.attributes:
        raise TransferError(
            f"{obj.name}: the attribute {layer_name!r} is not a UV layer: choose another layer name"
        )


def check_layers(obj: MeshObject, names: list[str]) -> None:
    """Raise TransferError unless the mesh has all these UV layers, or could get them."""
    layers = obj.data.uv_layers
    new, left = [name for name in names if name not in layers], compat.MAX_UV_LAYERS - len(layers)
    if len(new) > left:
        raise TransferError(
            f"{obj.name}: {len(new)} new UV layers are needed, and there is room for {left}, as Blender allows "
            f"{compat.MAX_UV_LAYERS}: choose Target: Attributes, which has no limit"
        )
    for name in names:
        check_layer(obj, name)


def planned_uv(obj: MeshObject, layer_name: str, count: int, corners: np.ndarray, uv: np.ndarray) -> np.ndarray:
    """The UVs (count, 2) of all corners after some of them became `uv` (m, 2). In a new layer the others are zero.

    In Edit Mode the others are as of the last update of the mesh's arrays.
    """
    values = np.zeros((count, 2), dtype=np.float32)
    if layer_name in obj.data.uv_layers:
        with arrays(obj) as mesh:
            values = compat.corner_uv(mesh.uv_layers[layer_name])
    # Take each point as one number, which NumPy moves five times as fast as a pair.
    points = np.ascontiguousarray(uv, dtype=np.float32).view(np.complex64)[:, 0]
    values.view(np.complex64)[:, 0][corners] = points
    return values


def write_uv(
    run: Transaction,
    obj: MeshObject,
    layer_name: str,
    values: np.ndarray,
    surface: Surface,
    faces: np.ndarray,
    select: bool = True,
) -> None:
    """Set the UVs (C, 2) of all corners in the layer of that name, make it if missing, make it active.

    In Edit Mode only the corners of the `faces` (P,) bool of the surface that was read are written. With `select` the
    UVs of these faces are selected, as Blender's own unwrap leaves them. The UVs of other faces stay as they are.
    """
    mesh = obj.data
    # What a rollback needs: the layer's UVs and selection.
    with arrays(obj) as old:
        known = old.uv_layers.get(layer_name)
        uv = None if known is None else compat.corner_uv(known)
        selected = compat.selected_uv(old, layer_name) if select else []
    run.before_write(_restore_layers, mesh, *_layers(mesh))
    if layer_name not in mesh.uv_layers:
        compat.new_uv_layer(mesh, layer_name)
        if layer_name not in mesh.uv_layers:
            raise TransferError(f"{obj.name}: the name {layer_name!r} is taken: choose another layer name")
    elif uv is not None:
        run.before_write(_write, obj, layer_name, uv, surface, faces)
    # Write, and select as Blender's unwrap does.
    _write(obj, layer_name, values, surface, faces)
    if select:
        run.before_write(_select, obj, layer_name, selected, surface, faces)
        corners = np.repeat(faces, surface.face_size)
        more = [flags | chosen for flags, chosen in zip(selected, (corners, corners, faces))]
        _select(obj, layer_name, more, surface, faces)
    mesh.uv_layers.active = mesh.uv_layers[layer_name]


def _write(obj: MeshObject, layer_name: str, values: np.ndarray, surface: Surface, faces: np.ndarray) -> None:
    if obj.mode != "EDIT":
        compat.set_corner_uv(obj.data.uv_layers[layer_name], values)
        obj.data.update()
        return
    # Blender hands over an edited mesh's corners one by one.
    edited = bmesh.from_edit_mesh(obj.data)
    layer = edited.loops.layers.uv[layer_name]
    chosen = np.ascontiguousarray(values[np.repeat(faces, surface.face_size)])
    points = struct.iter_unpack("=2f", chosen)  # type: ignore[arg-type]  # an array is a buffer
    for face in itertools.compress(edited.faces, faces.tolist()):
        for corner in face.loops:
            corner[layer].uv = next(points)
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def set_edited_corners(
    obj: MeshObject, layer_name: str, faces: np.ndarray, in_face: np.ndarray, uv: np.ndarray
) -> None:
    """Set the UVs (m, 2) of some corners of an object in Edit Mode, by face (m,) and number in it (m,). Raises
    TransferError if they are not there."""
    edited = bmesh.from_edit_mesh(obj.data)
    layer = edited.loops.layers.uv.get(layer_name)
    if layer is None or (len(faces) and faces.max() >= len(edited.faces)):
        raise TransferError(f"{obj.name}: its mesh has changed during the run")
    edited.faces.ensure_lookup_table()
    for face, number, place in zip(faces.tolist(), in_face.tolist(), uv.tolist(), strict=True):
        edited.faces[face].loops[number][layer].uv = place
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def _select(
    obj: MeshObject, layer_name: str, selected: list[np.ndarray], surface: Surface, faces: np.ndarray
) -> None:
    """Set the selection in the layer. @param selected as `compat.selected_uv` returns it"""
    if obj.mode != "EDIT":
        compat.set_selected_uv(obj.data, layer_name, selected)
        return
    edited = bmesh.from_edit_mesh(obj.data)
    layer = edited.loops.layers.uv.get(layer_name)
    if layer is None:  # it was removed before
        return
    corners = np.repeat(faces, surface.face_size)
    corner, edge, *of_face = selected
    chosen = [corner[corners], edge[corners], *(flags[faces] for flags in of_face)]
    values = [iter(flags.tolist()) for flags in chosen]
    for face in itertools.compress(edited.faces, faces.tolist()):
        compat.select_edited_uv(face, layer, values)
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def add_layer(mesh: bpy.types.Mesh, layer_name: str, values: np.ndarray) -> None:
    """Give a new mesh a layer with these UVs (C, 2), all of them selected. Not in Edit Mode."""
    compat.set_corner_uv(compat.new_uv_layer(mesh, layer_name), values)
    selected = [np.ones_like(flags) for flags in compat.selected_uv(mesh, layer_name)]
    compat.set_selected_uv(mesh, layer_name, selected)


def _layers(mesh: bpy.types.Mesh) -> tuple[list[str], Any, list[bool], list[bool]]:
    """Names of the UV layers, and which are active, for rendering and for cloning."""
    layers = list(mesh.uv_layers)
    render, clone = ([getattr(layer, flag) for layer in layers] for flag in ("active_render", "active_clone"))
    return [layer.name for layer in layers], mesh.uv_layers.active_index, render, clone


def _restore_layers(mesh: bpy.types.Mesh, names: list[str], active: int, render: list[bool], clone: list[bool]) -> None:
    for name in [layer.name for layer in mesh.uv_layers if layer.name not in names]:
        compat.remove_uv_layer(mesh, name)
    for layer, for_render, for_clone in zip(mesh.uv_layers, render, clone):
        if for_render:
            layer.active_render = True
        if for_clone:
            layer.active_clone = True
    if names:
        mesh.uv_layers.active_index = active
    mesh.update()
