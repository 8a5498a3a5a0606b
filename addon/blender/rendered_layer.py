# SPDX-License-Identifier: GPL-3.0-or-later
"""The UV layer that renders, and the layers that nodes of materials name: these are what Material Preview shows."""

from collections.abc import Iterator
from typing import Any

import bpy

from . import checker
from .errors import TransferError
from .mesh_object import MeshObject
from .transaction import Transaction

# Nodes that name a UV layer: how they are called in a sentence.
NODES = {"UVMAP": "UV Map", "TANGENT": "Tangent", "NORMAL_MAP": "Normal Map", "ATTRIBUTE": "Attribute"}


def rendered(mesh: bpy.types.Mesh) -> str:
    """The layer that renders where no node names another one; empty without UVs."""
    return next((layer.name for layer in mesh.uv_layers if layer.active_render), "")


def hidden_by(obj: MeshObject, layer: str) -> str:
    """The layer that renders in place of this one, or empty if this one renders or is not there."""
    shown = rendered(obj.data) if layer in obj.data.uv_layers else ""
    return "" if shown == layer else shown


def use(run: Transaction, obj: MeshObject, layer: str) -> None:
    """Make a layer the one that renders. Raises TransferError if it is not there."""
    layers = obj.data.uv_layers
    if layer not in layers:
        raise TransferError(f"{obj.name}: it has no UV layer {layer!r}: unwrap it first")
    run.before_write(_render, obj.data, rendered(obj.data))
    _render(obj.data, layer)


def _render(mesh: bpy.types.Mesh, layer: str) -> None:
    mesh.uv_layers[layer].active_render = True
    mesh.update_tag()


def sentences(obj: MeshObject, layer: str) -> list[str]:
    """What an artist must know to see a layer in Material Preview and in renders; empty if it is seen there."""
    found = []
    shown = hidden_by(obj, layer)
    if shown:
        found.append(f"your materials show the UV layer {shown!r}, which renders: to see {layer!r}, press "
                     "Use for Rendering")
    for material in dict.fromkeys(filter(None, checker.materials_beneath(obj))):
        for node, name in sorted(set(_named(material.node_tree, set()))):
            if name != layer and name in obj.data.uv_layers:
                found.append(f"the material {material.name!r} shows the UV layer {name!r}, as its {node} node names it")
    return found


def _named(tree: Any, seen: set[str]) -> Iterator[tuple[str, str]]:
    """Kind of node and UV layer for each node of a tree that names one, also in groups."""
    if tree is None or tree.name in seen:
        return
    for node in tree.nodes:
        if node.type == "GROUP":
            yield from _named(node.node_tree, seen | {tree.name})
        name = _layer_of(node)
        if name and not node.mute:
            yield NODES[node.type], name


def _layer_of(node: Any) -> str:
    """The UV layer that a node names, or empty: a Tangent or Normal Map node may have another direction."""
    if node.type == "ATTRIBUTE":
        return str(node.attribute_name) if node.attribute_type == "GEOMETRY" else ""
    if node.type not in NODES or (node.type == "TANGENT" and node.direction_type != "UV_MAP"):
        return ""
    if node.type == "NORMAL_MAP" and node.space != "TANGENT":
        return ""
    return str(node.uv_map)
