"""Which UV layer renders, which other layers materials name, and the preset for light maps."""

import bpy
import numpy as np
import pytest
import scenes

pytestmark = pytest.mark.alike


def old_panel():
    """A panel that has a layer already."""
    obj = scenes.add_panel(size=12)
    obj.data.uv_layers.new(name="UVMap")
    return obj


def material_with(kind, layer, **values):
    """A material with a node that names a layer, in a group."""
    group = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    node = group.nodes.new(kind)
    setattr(node, "attribute_name" if kind == "ShaderNodeAttribute" else "uv_map", layer)
    for name, value in values.items():
        setattr(node, name, value)
    material = bpy.data.materials.new("Skin")
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.new("ShaderNodeGroup").node_tree = group
    return material


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
def test_the_new_layer_renders_when_it_is_asked_for(addon, mode):
    sentences = addon("blender.rendered_layer").sentences
    obj = old_panel()
    bpy.ops.uv.koebe_uniformize()
    assert sentences(obj, "Koebe") == [
        "your materials show the UV layer 'UVMap', which renders: to see 'Koebe', press Use for Rendering"
    ]
    bpy.ops.object.mode_set(mode=mode)
    assert bpy.ops.uv.koebe_use_for_rendering() == {"FINISHED"}
    bpy.ops.object.mode_set(mode="OBJECT")
    assert [layer.name for layer in obj.data.uv_layers if layer.active_render] == ["Koebe"]
    assert sentences(obj, "Koebe") == []
    bpy.ops.uv.koebe_use_for_rendering(layer="UVMap")
    assert obj.data.uv_layers["UVMap"].active_render and obj.data.uv_layers.active.name == "Koebe"
    with pytest.raises(RuntimeError, match="Panel: it has no UV layer 'None': unwrap it first"):
        bpy.ops.uv.koebe_use_for_rendering(layer="None")


@pytest.mark.parametrize("kind, values, node", [
    ("ShaderNodeUVMap", {}, "UV Map"),
    ("ShaderNodeNormalMap", {}, "Normal Map"),
    ("ShaderNodeNormalMap", {"space": "OBJECT"}, ""),
    ("ShaderNodeTangent", {"direction_type": "UV_MAP"}, "Tangent"),
    ("ShaderNodeTangent", {"direction_type": "RADIAL"}, ""),
    ("ShaderNodeAttribute", {}, "Attribute"),
    ("ShaderNodeUVMap", {"mute": True}, ""),
])  # fmt: skip
@pytest.mark.parametrize("checker", [False, True])
def test_nodes_that_name_another_layer_are_told(addon, kind, values, node, checker):
    obj = old_panel()
    obj.data.materials.append(material_with(kind, "UVMap", **values))
    bpy.ops.uv.koebe_uniformize(checker=checker)  # which covers the material
    bpy.ops.uv.koebe_use_for_rendering()
    expected = [f"the material 'Skin' shows the UV layer 'UVMap', as its {node} node names it"] if node else []
    assert addon("blender.rendered_layer").sentences(obj, "Koebe") == expected


def test_the_end_of_a_run_says_so(addon):
    class Said:
        lines = []

        def report(self, kind, text):
            self.lines += [(kind, text)]

    obj = old_panel()
    job = addon("jobs.map_job").Job([obj], addon("maps.options").Options())
    job.compute()
    job.write()
    assert addon("operators.run_operator").MapOperator._tell(Said(), job) == {"FINISHED"}
    assert ({"INFO"}, f"Panel: {addon('blender.rendered_layer').sentences(obj, 'Koebe')[0]}") in Said.lines


def covered(obj, layer, pixels):
    """How many triangles (pixels, pixels) have each pixel's middle inside."""
    _, corners = scenes.triangles(obj.data)
    count = np.zeros((4 * pixels, 4 * pixels), int)  # the square and what lies right of it
    for triangle in scenes.corner_uv(obj.data, layer).astype(float)[corners] * pixels - 0.5:
        low, high = np.maximum(np.floor(triangle.min(axis=0)), 0).astype(int), np.ceil(triangle.max(axis=0)).astype(int)
        x, y = np.meshgrid(*(np.arange(*ends) for ends in zip(low, high, strict=True)), indexing="ij")
        ends = zip(triangle, np.roll(triangle, -1, axis=0), strict=True)
        sides = [(b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) for a, b in ends]
        count[low[0] : high[0], low[1] : high[1]] += np.all(np.array(sides) > 1e-9, axis=0)
    return count


@pytest.mark.parametrize("pixels, margin", [(256, 2), (1024, 4), (4096, 16)])
def test_a_light_map_is_a_second_layer_without_overlaps(pixels, margin):
    obj = scenes.add_cube()
    obj.data.uv_layers.new(name="UVMap")
    scenes.select(obj)
    settings = bpy.context.scene.koebe_uv
    settings.pixels, settings.stack, settings.evenness = pixels, True, 0.9
    assert bpy.ops.uv.koebe_preset(preset="LIGHTMAP") == {"FINISHED"}
    assert (settings.pixels, settings.margin, settings.stack, settings.evenness) == (pixels, margin, False, 0.5)
    names = [prop.identifier for prop in settings.bl_rna.properties if prop.identifier not in {"rna_type", "name"}]
    known = bpy.ops.uv.koebe_unwrap.get_rna_type().properties.keys()
    assert bpy.ops.uv.koebe_unwrap(**{n: getattr(settings, n) for n in names if n in known}) == {"FINISHED"}
    assert [layer.name for layer in obj.data.uv_layers] == ["UVMap", "Lightmap"]
    assert obj.data.uv_layers["UVMap"].active_render and not obj.data.materials
    assert covered(obj, "Lightmap", 200).max() == 1
    assert scenes.last_run().density < 1.2
