# SPDX-License-Identifier: GPL-3.0-or-later
"""The material "Koebe Checker", and putting it on objects so that it comes off again without a trace.

An object with material slots keeps them: the checker lies over them on the object's side (slot link
"Object"), the materials of the mesh and the faces' slot numbers stay. What was there is remembered in
a custom property of the object. An object without slots gets one.
"""

import bpy

from . import compat, transfer

NAME = "Koebe Checker"
LAYER_KEY = "koebe_checker_layer"  # on the material: the UV layer that it shows
SIZE_KEY = "koebe_checker_size"  # on the material: its squares across the UV square
MEMORY_KEY = "koebe_checker_slots"  # on the object: what its slots were

PAPER = (0.80, 0.76, 0.68, 1.0)
INK = (0.045, 0.20, 0.26, 1.0)
# One square of the coarse pattern is this many of the fine one: it shows scale from far away.
COARSE = 4.0
COARSE_SHADE = (0.68, 0.68, 0.68, 1.0)


def dress(objects, layer, size, even):
    """Put the checker of a UV layer on objects, `size` squares across the UV square of the first one.

    With `even` the squares of the others are as large in space as those of the first; else all have the same number,
    and the squares' size shows where texels are dense. Objects must not be in Edit Mode if `even`.
    """
    for obj in objects:
        if is_on(obj):
            take_off(obj)
    sizes = [size] * len(objects)
    if even and len(objects) > 1:
        density = [transfer.texel_density(obj, layer) for obj in objects]
        sizes = [size * density[0] / one if density[0] * one > 0.0 else size for one in density]
    materials = {}
    for obj, own_size in zip(objects, sizes, strict=True):
        key = f"{own_size:.3g}"  # sizes that cannot be told apart share a material
        if key not in materials:
            materials[key] = checker_material(layer, own_size)
        put_on(obj, materials[key])


def checker_material(layer, size):
    """The checker of a UV layer, `size` squares across the UV square: one that nobody wears, or else a new one."""
    for material in bpy.data.materials:
        mine = material.get(LAYER_KEY) == layer and material.library is None and material.node_tree
        if mine and (material.users == 0 or material.get(SIZE_KEY) == size):
            break
    else:
        material = bpy.data.materials.new(NAME)
        material[LAYER_KEY] = layer
        compat.enable_nodes(material)
        _build(material.node_tree, layer)
    material[SIZE_KEY] = size
    _set_size(material.node_tree, size)
    return material


def _build(tree, layer):
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


def _node(tree, kind, location, **values):
    node = tree.nodes.new(kind)
    node.location = location
    for key, value in values.items():
        setattr(node, key, value)
    return node


def _set_size(tree, size):
    for name, squares in (("Fine", size), ("Coarse", size / COARSE)):
        node = tree.nodes.get(name)
        if node is not None:  # the user may have edited the material
            node.inputs["Scale"].default_value = squares


def is_on(obj):
    """Whether the object wears the checker."""
    return MEMORY_KEY in obj


def put_on(obj, material):
    """Cover all of the object's slots with the checker, or give it one if it has none."""
    if is_on(obj):
        take_off(obj)
    if len(obj.material_slots) == 0:
        obj.data.materials.append(material)
        obj[MEMORY_KEY] = {"added": True}
        return
    memory = {}
    for index, slot in enumerate(obj.material_slots):
        was = {"link": slot.link}
        slot.link = "OBJECT"
        if slot.material is not None:
            was["material"] = slot.material
        slot.material = material
        memory[str(index)] = was
    obj[MEMORY_KEY] = memory


def take_off(obj):
    """Give the object its slots back."""
    memory = obj[MEMORY_KEY]
    if "added" in memory:
        materials = obj.data.materials
        if len(materials) == 1 and materials[0] is not None and LAYER_KEY in materials[0]:
            materials.clear()  # pop would leave the objects' slots
    else:
        for index, was in memory.items():
            if int(index) < len(obj.material_slots):
                slot = obj.material_slots[int(index)]
                slot.link = "OBJECT"
                slot.material = was.get("material")
                slot.link = was["link"]
    del obj[MEMORY_KEY]
