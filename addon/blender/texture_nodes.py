# SPDX-License-Identifier: GPL-3.0-or-later
"""The image textures of a material that UV layers lay onto a mesh, and the material that bakes one of them."""

import dataclasses
from collections.abc import Iterator
from typing import Any

import bpy

from . import compat

# Keeps the colour of transparent pixels: Cycles gives it whole only to a node whose alpha is used.
ALMOST_NOTHING = 1e-20


@dataclasses.dataclass(frozen=True)
class LaidImage:
    """An image texture of a material that lies by other UVs than those of the new layer.

    number  among the material's laid images with the same image
    normal  its colours are directions, which a Normal Map node reads
    """

    material: bpy.types.Material
    node: str
    image: bpy.types.Image
    number: int
    normal: bool
    alpha: bool


def laid_images(material: bpy.types.Material, rendered: str, layers: set[str], new: str) -> list[LaidImage]:
    """The images that lie by another UV layer than the new one. @param rendered, layers of the mesh"""
    found: list[LaidImage] = []
    for node in compat.used_nodes(material):
        if node.type != "TEX_IMAGE" or node.image is None or node.image.source in {"MOVIE", "SEQUENCE"}:
            continue
        if set(_layers_of(node.inputs["Vector"], rendered, layers)) - {new}:
            number = sum(one.image == node.image for one in found)
            normal, alpha = bool(_normal_maps(node)), node.outputs["Alpha"].is_linked
            found.append(LaidImage(material, node.name, node.image, number, normal, alpha))
    return found


def has_other_images(material: bpy.types.Material) -> bool:
    """Whether films, or images inside of node groups, are among its nodes: they are not carried."""
    return any(
        (node.type == "TEX_IMAGE" and node.image is not None and node.image.source in {"MOVIE", "SEQUENCE"})
        or (node.type == "GROUP" and node.node_tree is not None
            and any(one.type == "TEX_IMAGE" for one in node.node_tree.nodes))
        for node in compat.used_nodes(material)
    )  # fmt: skip


def _layers_of(socket: Any, rendered: str, layers: set[str]) -> Iterator[str]:
    """The UV layers that a vector comes from. A texture without a vector takes the layer that renders."""
    if not socket.is_linked and socket.node.type == "TEX_IMAGE":
        yield rendered
    for link in socket.links:
        node = link.from_node
        if node.type == "UVMAP":
            yield node.uv_map or rendered
        elif node.type == "TEX_COORD" and link.from_socket.name == "UV":
            yield rendered
        elif node.type == "ATTRIBUTE" and node.attribute_name in layers:
            yield node.attribute_name
        else:
            for before in node.inputs:
                if before.is_linked:
                    yield from _layers_of(before, rendered, layers)


def _normal_maps(node: Any) -> list[Any]:
    """The Normal Map nodes that read this texture as directions in tangent space, if they alone read its colours."""
    readers = [link.to_node for link in node.outputs["Color"].links]
    tangent = [one for one in readers if one.type == "NORMAL_MAP" and one.space == "TANGENT"]
    return tangent if len(tangent) == len(readers) else []


def baking_material(laid: LaidImage, alpha: bool, target: bpy.types.Image) -> bpy.types.Material:
    """A copy of the material whose surface shows only that image, and which bakes into the target.

    alpha  how opaque the image is, not its colour
    """
    copy = laid.material.copy()
    tree: Any = copy.node_tree
    node = tree.nodes[laid.node]
    for output in [one for one in tree.nodes if one.type == "OUTPUT_MATERIAL"]:
        tree.nodes.remove(output)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    # Normals are baked from a surface, at full strength; colours as light.
    if laid.normal and not alpha:
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        reader = _normal_maps(node)[0]
        reader.inputs["Strength"].default_value = 1.0
        for link in list(reader.inputs["Strength"].links):
            tree.links.remove(link)
        tree.links.new(reader.outputs["Normal"], shader.inputs["Normal"])
    else:
        shader = tree.nodes.new("ShaderNodeEmission")
        tree.links.new(node.outputs["Alpha" if alpha else "Color"], shader.inputs["Color"])
        if laid.alpha and not alpha:
            strength = tree.nodes.new("ShaderNodeMath")
            strength.operation = "MULTIPLY_ADD"
            strength.inputs[1].default_value, strength.inputs[2].default_value = ALMOST_NOTHING, 1.0
            tree.links.new(node.outputs["Alpha"], strength.inputs[0])
            tree.links.new(strength.outputs["Value"], shader.inputs["Strength"])
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    _aim(tree, target)
    return copy


def blank_material(target: bpy.types.Image) -> bpy.types.Material:
    """A black material that bakes into the target."""
    made = bpy.data.materials.new("Koebe bake")
    compat.enable_nodes(made)
    _aim(made.node_tree, target)
    return made


def _aim(tree: Any, target: bpy.types.Image) -> None:
    """Let a bake write into the image."""
    aim = tree.nodes.new("ShaderNodeTexImage")
    aim.image = target
    for node in tree.nodes:
        node.select = node == aim
    tree.nodes.active = aim


def lay_by(tree: Any, node_name: str, image: bpy.types.Image, layer: str) -> None:
    """Let a texture of the tree show another image, by the UVs of a layer."""
    node = tree.nodes[node_name]
    for reader in _normal_maps(node):
        reader.uv_map = layer
    node.image, node.projection = image, "FLAT"
    for link in list(node.inputs["Vector"].links):
        tree.links.remove(link)
    uv = tree.nodes.new("ShaderNodeUVMap")
    uv.uv_map, uv.location = layer, (node.location.x - 200.0, node.location.y)
    tree.links.new(uv.outputs["UV"], node.inputs["Vector"])
