# SPDX-License-Identifier: GPL-3.0-or-later
"""The material "Koebe Checker": squares that show a UV layer."""

from collections.abc import Callable
from typing import Any

import bpy

from ..layers.tile_pattern import Pattern
from . import compat
from .noted_properties import set_property
from .transaction import Transaction

NAME = "Koebe Checker"
LAYER_KEY = "koebe_checker_layer"  # on the material: its UV layer
SIZE_KEY = "koebe_checker_size"  # on the material: squares across the UV square
MATRIX_KEY = "koebe_checker_matrix"  # on the material: the linear map of the UVs, for a tile

PAPER = (0.80, 0.76, 0.68, 1.0)
INK = (0.045, 0.20, 0.26, 1.0)
# One coarse square is so many fine squares wide: it shows scale from far away.
COARSE = 4.0
COARSE_SHADE = (0.68, 0.68, 0.68, 1.0)


def is_checker(material: bpy.types.Material | None) -> bool:
    """Whether the material is a checker of ours. None is not."""
    return material is not None and LAYER_KEY in material


def checker_materials(
    run: Transaction, layer: str, patterns: list[Pattern], free: Callable[[bpy.types.Material], bool]
) -> list[bpy.types.Material]:
    """The checker of a UV layer for each of some patterns.

    Takes a checker with this pattern if there is one, else one that `free(material)` says no other object wears, else a
    new one.
    """
    mine = [one for one in bpy.data.materials if one.library is None and one.get(LAYER_KEY) == layer and one.node_tree]
    chosen: dict[Pattern, bpy.types.Material] = {}
    for pattern in dict.fromkeys(patterns):
        left = [one for one in mine if one not in chosen.values()]
        material = next((one for one in left if _pattern_of(one) == pattern), None)
        if material is None:
            others = [one for one in left if _pattern_of(one) not in patterns and _is_like(one, pattern)]
            material = next(filter(free, others), None) or _new_material(run, layer, pattern)
        if _pattern_of(material) != pattern:
            run.before_write(_set_values, material.node_tree, _values(material.node_tree))
            set_property(run, material, SIZE_KEY, pattern.size)
            if pattern.matrix is not None:
                set_property(run, material, MATRIX_KEY, list(pattern.matrix))
            _set_values(material.node_tree, _values_of(pattern))
        chosen[pattern] = material
    return [chosen[pattern] for pattern in patterns]


def _pattern_of(material: bpy.types.Material) -> Pattern | None:
    """The pattern of a checker; None for a new one."""
    size, matrix = material.get(SIZE_KEY), material.get(MATRIX_KEY)
    return None if size is None else Pattern(size, None if matrix is None else tuple(matrix))


def _is_like(material: bpy.types.Material, pattern: Pattern) -> bool:
    """Whether its nodes can show this pattern."""
    return (MATRIX_KEY in material) == (pattern.matrix is not None)


def _new_material(run: Transaction, layer: str, pattern: Pattern) -> bpy.types.Material:
    run.before_write(_remove_new, {material.name for material in bpy.data.materials if material.library is None})
    material = bpy.data.materials.new(NAME)
    material[LAYER_KEY] = layer
    compat.enable_nodes(material)
    _build(material.node_tree, layer, pattern)
    return material


def _remove_new(names: set[str]) -> None:
    for material in list(bpy.data.materials):
        if material.library is None and material.name not in names and material.name.startswith(NAME):
            bpy.data.materials.remove(material)


def _build(tree: Any, layer: str, pattern: Pattern) -> None:
    tree.nodes.clear()
    # Two checkers, the coarse one as a shade over the fine one, on a plain surface.
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
    place = uv.outputs["UV"]
    if pattern.matrix is not None:
        # A pattern that is turned or scaled: rows of a matrix, as dot products.
        point = _node(tree, "ShaderNodeCombineXYZ", (-740, 0))
        for name, axis in (("Across", "X"), ("Up", "Y")):
            row = _node(tree, "ShaderNodeVectorMath", (-920, 0), name=name, operation="DOT_PRODUCT")
            link(place, row.inputs[0])
            link(row.outputs["Value"], point.inputs[axis])
        uv.location.x -= 300
        place = point.outputs["Vector"]
    # The fine squares, shaded by the coarse ones, are the base colour.
    link(place, fine.inputs["Vector"])
    link(place, coarse.inputs["Vector"])
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


SCALES, ROWS = ("Fine", "Coarse"), ("Across", "Up")  # names of the nodes whose inputs a pattern sets


def _values_of(pattern: Pattern) -> dict[str, Any]:
    if pattern.matrix is None:
        return {"Fine": pattern.size, "Coarse": pattern.size / COARSE}
    a, b, c, d = pattern.matrix
    return {"Fine": 1.0, "Coarse": 1.0 / COARSE, "Across": (a, b, 0.0), "Up": (c, d, 0.0)}


def _inputs(tree: Any) -> dict[str, Any]:
    """The inputs of the nodes that still exist: the user may have edited the material."""
    scales = {name: tree.nodes.get(name) for name in SCALES}
    rows = {name: tree.nodes.get(name) for name in ROWS}
    return {
        **{name: node.inputs["Scale"] for name, node in scales.items() if node and "Scale" in node.inputs},
        **{name: node.inputs[1] for name, node in rows.items() if node and node.type == "VECT_MATH"},
    }


def _values(tree: Any) -> dict[str, Any]:
    values = {name: one.default_value for name, one in _inputs(tree).items()}
    return {name: value if name in SCALES else tuple(value) for name, value in values.items()}


def _set_values(tree: Any, values: dict[str, Any]) -> None:
    for name, one in _inputs(tree).items():
        if name in values:
            one.default_value = values[name]
