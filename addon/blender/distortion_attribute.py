# SPDX-License-Identifier: GPL-3.0-or-later
"""Distortion as a colour attribute of the mesh, on and off, in Object Mode and in Edit Mode."""

import itertools
from collections.abc import Sequence
from typing import Any

import bmesh
import bpy
import numpy as np

from ..layers import distortion, distortion_colors
from ..surfaces.surface import Surface
from . import compat
from .errors import TransferError
from .mesh_object import MeshObject
from .mesh_reading import arrays, bring_up_to_date
from .noted_properties import set_property
from .targets import check_mesh
from .transaction import Transaction

NAME = "Koebe Distortion"
MEMORY_KEY = "koebe_distortion"  # on the mesh: the distortion shown, its attribute, and the attribute active before


def shown(mesh: bpy.types.Mesh) -> str | None:
    """The kind of distortion in the mesh's colours, or None."""
    memory = mesh.get(MEMORY_KEY)
    return None if memory is None or _own_name(mesh) is None else memory["kind"]


def _own_name(mesh: bpy.types.Mesh) -> str | None:
    """Name of the add-on's own colour attribute, or None."""
    memory = mesh.get(MEMORY_KEY)
    name = "" if memory is None else memory.get("name", NAME)
    return name if name in mesh.color_attributes else None


def is_on(mesh: bpy.types.Mesh) -> bool:
    """Whether the mesh shows distortion, or remembers its colours before."""
    return MEMORY_KEY in mesh


def check(obj: MeshObject, layer_name: str) -> None:
    """Raise TransferError unless `put_on` can be done."""
    check_mesh(obj)
    if layer_name not in obj.data.uv_layers:
        raise TransferError(f"{obj.name}: it has no UV layer {layer_name!r}: map it first")


def corner_colors(surface: Surface, uv: np.ndarray, kind: str) -> np.ndarray:
    """Colours (C, 4) of the corners for the distortion of UVs (C, 2)."""
    values = distortion_colors.colors(distortion.face_values(surface, uv, kind), kind)
    colors = np.ones((len(surface.corner_vertex), 4), dtype=np.float32)
    colors[:, :3] = np.repeat(distortion_colors.linear(values), surface.face_size, axis=0)
    return colors


def put_on(run: Transaction, obj: MeshObject, kind: str, colors: np.ndarray) -> None:
    """Give the mesh's corners these colours, and make them active."""
    mesh, own = obj.data, _own_name(obj.data)
    active, render = _active(mesh)
    if own is None:
        run.before_write(_restore_names, mesh, list(mesh.color_attributes.keys()), (active, render))
        own = _new_attribute(obj)
        memory = {"kind": kind, "name": own, "active": active, "render": render}
    else:
        with arrays(obj) as old:
            run.before_write(_write, obj, own, _read(old, own))
        run.before_write(_set_active, mesh, (active, render))
        memory = {**mesh[MEMORY_KEY].to_dict(), "kind": kind}
    set_property(run, mesh, MEMORY_KEY, memory)
    _write(obj, own, colors)
    _set_active(mesh, (own, render or own))
    mesh.update()


def _new_attribute(obj: MeshObject) -> str:
    """Make the attribute, under another name if its own is taken; return that name."""
    mesh = obj.data
    names = (f"{NAME}.{number:03d}" if number else NAME for number in itertools.count())
    # If a vertex group has the name, some versions make no attribute, others two with the same name.
    free = next(n for n in names if n not in mesh.attributes and n not in mesh.uv_layers and n not in obj.vertex_groups)
    made = mesh.color_attributes.new(free, "FLOAT_COLOR", "CORNER")
    if made is None:
        raise TransferError(f"{obj.name}: Blender could not make a colour attribute")
    return made.name


def take_off(run: Transaction, obj: MeshObject) -> None:
    """Remove the colours and make the formerly active attribute active again."""
    mesh, own = obj.data, _own_name(obj.data)
    if not is_on(mesh):
        return
    memory, now = mesh[MEMORY_KEY].to_dict(), _active(mesh)
    if own is not None:
        bring_up_to_date(obj)  # the colours may be new
        with arrays(obj) as old:
            run.before_write(_restore_attribute, obj, own, _read(old, own), now)
        mesh.color_attributes.remove(mesh.color_attributes[own])
        before = memory.get("active", ""), memory.get("render", "")
        _set_active(mesh, [was if name == own else name for was, name in zip(before, now, strict=True)])
    set_property(run, mesh, MEMORY_KEY, None)
    mesh.update()


def _active(mesh: bpy.types.Mesh) -> tuple[Any, Any]:
    """Names of the colour attributes that are active and for rendering. An attribute of that name may be missing."""
    return mesh.color_attributes.active_color_name, mesh.color_attributes.default_color_name


def _set_active(mesh: bpy.types.Mesh, names: Sequence[Any]) -> None:
    colors = mesh.color_attributes
    colors.active_color_name, colors.default_color_name = names
    for name, index in zip(names, ("active_color_index", "render_color_index"), strict=True):
        place = colors.find(name)
        if place >= 0 and getattr(colors, index) != place:  # before 4.0 the names can only be read
            setattr(colors, index, place)


def _restore_names(mesh: bpy.types.Mesh, names: list[str], active: Sequence[Any]) -> None:
    for name in set(mesh.color_attributes.keys()).difference(names):
        mesh.color_attributes.remove(mesh.color_attributes[name])
    _set_active(mesh, active)
    mesh.update()


def _restore_attribute(obj: MeshObject, name: str, colors: np.ndarray, active: Sequence[Any]) -> None:
    if name not in obj.data.color_attributes:
        obj.data.color_attributes.new(name, "FLOAT_COLOR", "CORNER")
    _write(obj, name, colors)
    _set_active(obj.data, active)
    obj.data.update()


def _read(mesh: bpy.types.Mesh, name: str) -> np.ndarray:
    return compat.read(mesh.attributes[name].data, "color", np.float32, 4)


def _write(obj: MeshObject, name: str, colors: np.ndarray) -> None:
    if obj.mode != "EDIT":
        obj.data.attributes[name].data.foreach_set("color", np.ascontiguousarray(colors, dtype=np.float32).ravel())
        return
    edited = bmesh.from_edit_mesh(obj.data)
    layer, values = edited.loops.layers.float_color[name], iter(colors.tolist())
    for face in edited.faces:
        for corner in face.loops:
            corner[layer] = next(values)
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
