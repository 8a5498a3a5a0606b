# SPDX-License-Identifier: GPL-3.0-or-later
"""The material "Koebe Checker": squares that show a UV layer."""

from collections.abc import Callable
from typing import Any

import bpy

from . import compat
from .noted_properties import set_property
from .transaction import Transaction

NAME = "Koebe Checker"
LAYER_KEY = "koebe_checker_layer"  # on the material: the UV layer that it shows
SIZE_KEY = "koebe_checker_size"  # on the material: its squares across the UV square

PAPER = (0.80, 0.76, 0.68, 1.0)
INK = (0.045, 0.20, 0.26, 1.0)
# One square of the coarse pattern is this many of the fine one: it shows scale from far away.
COARSE = 4.0
COARSE_SHADE = (0.68, 0.68, 0.68, 1.0)


def is_checker(material: bpy.types.Material | None) -> bool:
    """Whether that is a checker of ours; None is not."""
    return material is not None and LAYER_KEY in material


def checker_materials(
    run: Transaction, layer: str, sizes: list[float], free: Callable[[bpy.types.Material], bool]
) -> list[bpy.types.Material]:
    """The checker of a UV layer for each of some numbers of squares across the UV square.

    One of that size is used again, else one for which `free(material)` says that nobody else wears it, else a new one.
    """
    mine = [one for one in bpy.data.materials if one.library is None and one.get(LAYER_KEY) == layer and one.node_tree]
    chosen: dict[float, bpy.types.Material] = {}
    for size in dict.fromkeys(sizes):
        left = [one for one in mine if one not in chosen.values()]
        material = next((one for one in left if one.get(SIZE_KEY) == size), None)
        if material is None:
            others = [one for one in left if one.get(SIZE_KEY) not in sizes]
            material = next(filter(free, others), None) or _new_material(run, layer)
        if material.get(SIZE_KEY) != size:
            run.before_write(_set_sizes, material.node_tree, _sizes(material.node_tree))
            set_property(run, material, SIZE_KEY, size)
            _set_sizes(material.node_tree, {"Fine": size, "Coarse": size / COARSE})
        chosen[size] = material
    return [chosen[size] for size in sizes]


def _new_material(run: Transaction, layer: str) -> bpy.types.Material:
    run.before_write(_remove_new, {material.name for material in bpy.data.materials if material.library is None})
    material = bpy.data.materials.new(NAME)
    material[LAYER_KEY] = layer
    compat.enable_nodes(material)
    _build(material.node_tree, layer)
    return material


def _remove_new(names: set[str]) -> None:
    for material in list(bpy.data.materials):
        if material.library is None and material.name not in names and material.name.startswith(NAME):
            bpy.data.materials.remove(material)


def _build(tree: Any, layer: str) -> None:
    tree.nodes.clear()
    uv = _node(tree, "ShaderNodeUVMap", (-800, 0), uv_map=layer)
    fine = _node(tree, "ShaderNodeTexChecker", (-560, 120), name="Fine")
    coarse = _node(tree, "ShaderNodeTexChecker", (-560, -120), name="Coarse")
    shade = _node(tree, "ShaderNodeMixRGB", (-320, 0), blend_type="MULTIPLY")
    surface = _node(tree, "ShaderNodeBsdfPrincipled", (-120, 0))
    output = _node(tree, "ShaderNodeOutputMaterial", (180, 0))
    fine.inputs["Color1"].default_value = PAPER
    fine.inputs["Color2"].default_value = INK
    coarse.inputs["Color1"].default_value = (1.0, 1.0, 1.0, 1.0)
    coarse.inputs["Color2"].default_value = COARSE_SHADE
    shade.inputs["Fac"].default_value = 1.0
    surface.inputs["Roughness"].default_value = 0.55
    link = tree.links.new
    link(uv.outputs["UV"], fine.inputs["Vector"])
    link(uv.outputs["UV"], coarse.inputs["Vector"])
    link(fine.outputs["Color"], shade.inputs["Color1"])
    link(coarse.outputs["Color"], shade.inputs["Color2"])
    link(shade.outputs["Color"], surface.inputs["Base Color"])
    link(surface.outputs["BSDF"], output.inputs["Surface"])


def _node(tree: bpy.types.NodeTree, kind: str, location: tuple[float, float], **values: Any) -> bpy.types.Node:
    node = tree.nodes.new(kind)
    node.location = location
    for key, value in values.items():
        setattr(node, key, value)
    return node


def _sizes(tree: Any) -> dict[str, float]:
    """The squares of the nodes that are still there: the user may have edited the material."""
    found = {name: tree.nodes.get(name) for name in ("Fine", "Coarse")}
    return {name: node.inputs["Scale"].default_value for name, node in found.items() if node and "Scale" in node.inputs}


def _set_sizes(tree: Any, sizes: dict[str, float]) -> None:
    for name in _sizes(tree).keys() & sizes.keys():
        tree.nodes[name].inputs["Scale"].default_value = sizes[name]


