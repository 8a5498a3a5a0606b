# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a map to one object: its UVs and, if the object shows distortion, their colours."""

import dataclasses

import numpy as np

from ..layers.distortion import texel_density
from ..surfaces.surface import Surface
from . import distortion_attribute, uv_layers
from .mesh_object import MeshObject
from .targets import Target
from .transaction import Transaction


@dataclasses.dataclass
class Plan:
    """The data to write to one object.

    surface  the whole mesh, with every face selected
    uv       (C, 2) of all its corners
    faces    (P,) bool, the faces with new UVs
    colors   (C, 4) of all corners, or None
    """

    obj: MeshObject
    layer: str
    surface: Surface
    uv: np.ndarray
    faces: np.ndarray
    colors: np.ndarray | None = None
    kind: str | None = None

    @property
    def density(self) -> float:
        """Mean length in the UVs over length in space; 0 without UVs."""
        return texel_density(self.surface, self.uv)


def plan(target: Target, layer: str, surface: Surface, corners: np.ndarray, uv: np.ndarray) -> Plan:
    """The plan for a target whose surface was read, with UVs (m, 2) at some corners. Raises TransferError."""
    obj = target.find()
    uv_layers.check_layer(obj, layer)
    values = uv_layers.planned_uv(obj, layer, len(surface.corner_vertex), corners, uv)
    whole = dataclasses.replace(surface, selected=np.ones_like(surface.selected))
    mapped = np.zeros(len(values), dtype=bool)
    mapped[corners] = True
    kind = distortion_attribute.shown(obj.data)
    colors = None if kind is None else distortion_attribute.corner_colors(whole, values, kind)
    return Plan(obj, layer, whole, values, mapped[surface.face_start], colors, kind)


def write(run: Transaction, made: Plan, select: bool = True) -> None:
    """Write the plan. @param select the new UVs, too"""
    uv_layers.write_uv(run, made.obj, made.layer, made.uv, made.surface, made.faces, select)
    if made.kind is not None and made.colors is not None:
        distortion_attribute.put_on(run, made.obj, made.kind, made.colors)


def write_several(run: Transaction, plans: list[Plan]) -> None:
    """Write several plans for one object. The layer of the first becomes active."""
    for made in plans:
        uv_layers.write_uv(run, made.obj, made.layer, made.uv, made.surface, made.faces)
    first = plans[0]
    first.obj.data.uv_layers.active = first.obj.data.uv_layers[first.layer]
    if first.kind is not None and first.colors is not None:
        distortion_attribute.put_on(run, first.obj, first.kind, first.colors)
