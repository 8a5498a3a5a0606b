"""A painted model gets new UVs: all images of its materials are baked anew, and it looks the same."""

import bpy
import numpy as np
import pytest
import scenes

SIZE = 32
# From the square's corners in the old layer to those in the new one: a quarter turn, u' = 1 - v, v' = u.
OLD, NEW = [[0, 0], [1, 0], [1, 1], [0, 1]], [[1, 0], [1, 1], [0, 1], [0, 0]]


def turned(pixels):
    """The pixels (n, n, 4), rows from below, after the quarter turn."""
    return np.rot90(pixels, -1, axes=(0, 1))


def add_image(name, kind, seed=0):
    """An image of random colours, directions about (0, 0, 1), or numbers, and its pixels as they are stored."""
    image = bpy.data.images.new(name, SIZE, SIZE, alpha=True, is_data=kind != "color", float_buffer=kind == "normal")
    random = np.random.default_rng(seed)
    pixels = np.ones((SIZE, SIZE, 4), np.float32)
    pixels[..., :3] = random.random((SIZE, SIZE, 3))
    if kind == "normal":
        normal = random.uniform(-0.3, 0.3, (SIZE, SIZE, 3)) * [1, 1, 0] + [0, 0, 1]
        pixels[..., :3] = 0.5 + 0.5 * normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    if kind == "alpha":
        pixels[..., 3] = random.integers(1, 5, (SIZE, SIZE)) / 4
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    return image, pixels_of(image)


def pixels_of(image):
    """The pixels (n, n, 4) of an image, rows from below."""
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def add_texture(material, image, vector=None):
    """A texture node of the material, without filter. @param vector a socket that it takes its place from"""
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image, node.interpolation = image, "Closest"
    if vector is not None:
        tree.links.new(vector, node.inputs["Vector"])
    return node


def add_material(name="Paint"):
    """A material with the shader that Blender gives it."""
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    return material, next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")


def painted(*materials, faces=1):
    """A square of some faces side by side, each with the old and the new UVs, the old ones render."""
    vertices = [(x, y, 0) for x in range(faces + 1) for y in (0, 1)]
    obj = scenes.add_object("Square", vertices, [(2 * k, 2 * k + 2, 2 * k + 3, 2 * k + 1) for k in range(faces)])
    for name, corners in (("Old", OLD), ("New", NEW)):
        layer = obj.data.uv_layers.new(name=name)
        inside = [np.array(corners, np.float32) * (1 / faces, 1) + (k / faces, 0) for k in range(faces)]
        layer.data.foreach_set("uv", np.concatenate(inside).astype(np.float32).ravel())
    for material in materials:
        obj.data.materials.append(material)
    obj.data.polygons.foreach_set("material_index", list(range(faces)))
    obj.data.uv_layers["Old"].active_render = True
    scenes.select(obj)
    return obj


def textures(material):
    """The image textures of a material by the socket that their colours end in."""
    return {node.outputs["Color"].links[0].to_socket.name: node
            for node in material.node_tree.nodes if node.type == "TEX_IMAGE"}  # fmt: skip


def layer_of(node):
    """The UV layer of a texture."""
    return node.inputs["Vector"].links[0].from_node.uv_map if node.inputs["Vector"].is_linked else None


def blocks():
    """The names of all that a bake could leave behind."""
    return {kind: sorted(block.name for block in getattr(bpy.data, kind))
            for kind in ("scenes", "objects", "meshes", "materials", "images", "node_groups")}  # fmt: skip


def test_all_maps_are_baked_and_the_old_material_stays():
    material, shader = add_material()
    (color, colors), (rough, numbers), (normal, directions) = (
        add_image("Color", "color"), add_image("Rough", "data", 1), add_image("Normal", "normal", 2))  # fmt: skip
    tree = material.node_tree
    tree.links.new(add_texture(material, color).outputs["Color"], shader.inputs["Base Color"])
    tree.links.new(add_texture(material, rough).outputs["Color"], shader.inputs["Roughness"])
    reader = tree.nodes.new("ShaderNodeNormalMap")
    reader.inputs["Strength"].default_value = 0.3
    tree.links.new(add_texture(material, normal).outputs["Color"], reader.inputs["Color"])
    tree.links.new(reader.outputs["Normal"], shader.inputs["Normal"])
    obj = painted(material)
    before, engine = blocks(), bpy.context.scene.render.engine
    assert bpy.ops.uv.koebe_bake_texture(layer="New", margin=2) == {"FINISHED"}
    after = blocks()
    assert set(after["images"]) - set(before["images"]) == {"Color New", "Rough New", "Normal New"}
    assert after["materials"] == sorted([*before["materials"], "Paint New"])
    assert all(after[kind] == before[kind] for kind in ("scenes", "objects", "meshes", "node_groups"))
    assert bpy.context.scene.render.engine == engine
    made = obj.material_slots[0].material
    assert made.name == "Paint New" and material.use_fake_user and not made.use_fake_user
    found = textures(made)
    assert {layer_of(node) for node in found.values()} == {"New"}
    assert {layer_of(node) for node in textures(material).values()} == {None}
    assert textures(material)["Base Color"].image == color
    assert np.abs(pixels_of(found["Base Color"].image) - turned(colors)).max() < 1.5 / 255
    assert np.abs(pixels_of(found["Roughness"].image) - turned(numbers)).max() < 1.5 / 255
    # The directions turn with the square: the new tangents are a quarter turn before the old ones.
    x, y, z, _ = np.moveaxis(2 * turned(directions) - 1, -1, 0)
    expected = 0.5 + 0.5 * np.stack([-y, x, z], axis=-1)
    assert np.abs(pixels_of(found["Color"].image)[..., :3] - expected).max() < 0.01
    reader = next(node for node in made.node_tree.nodes if node.type == "NORMAL_MAP")
    assert reader.uv_map == "New" and reader.inputs["Strength"].default_value == pytest.approx(0.3)
    assert found["Base Color"].image.packed_file is not None
    assert found["Base Color"].image.colorspace_settings.name == "sRGB"
    assert found["Roughness"].image.colorspace_settings.is_data and found["Color"].image.is_float
    with pytest.raises(RuntimeError, match="nothing was baked. Square: no image of its materials lies by other UVs"):
        bpy.ops.uv.koebe_bake_texture(layer="New")


def test_the_alpha_goes_along():
    material, shader = add_material()
    image, pixels = add_image("Leaf", "alpha")
    node = add_texture(material, image)
    material.node_tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
    material.node_tree.links.new(node.outputs["Alpha"], shader.inputs["Alpha"])
    obj = painted(material)
    assert bpy.ops.uv.koebe_bake_texture(layer="New") == {"FINISHED"}
    found = pixels_of(textures(obj.material_slots[0].material)["Base Color"].image)
    assert np.abs(found - turned(pixels))[..., 3].max() < 1 / 255
    assert np.abs(found - turned(pixels)).max() < 0.04  # colours of a quarter of opacity have 6 bits


def test_mapped_vectors_named_layers_and_two_slots_with_one_image():
    """A texture that is moved by a quarter, one that names the new layer, and an image that two materials share."""
    image, pixels = add_image("Shared", "data")
    places = (np.arange(SIZE) + 0.5) / SIZE
    pixels[..., 0], pixels[..., 1] = np.meshgrid(places, places)
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    other, _ = add_image("Other", "data", 1)
    (one, one_shader), (two, two_shader) = add_material("One"), add_material("Two")
    tree = one.node_tree
    coordinates, mapping = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeMapping")
    mapping.inputs["Location"].default_value = (0.25, 0.0, 0.0)
    tree.links.new(coordinates.outputs["UV"], mapping.inputs["Vector"])
    tree.links.new(add_texture(one, image, mapping.outputs["Vector"]).outputs["Color"], one_shader.inputs["Base Color"])
    named = tree.nodes.new("ShaderNodeUVMap")
    named.uv_map = "New"
    tree.links.new(add_texture(one, other, named.outputs["UV"]).outputs["Color"], one_shader.inputs["Roughness"])
    round_it = tree.nodes.new("ShaderNodeTexCoord").outputs["Object"]
    tree.links.new(add_texture(one, other, round_it).outputs["Color"], one_shader.inputs["Metallic"])
    two.node_tree.links.new(add_texture(two, image).outputs["Color"], two_shader.inputs["Base Color"])
    again = add_texture(one, image)  # the same image, not moved: another new image
    tree.links.new(again.outputs["Color"], one_shader.inputs["Specular" if "Specular" in one_shader.inputs else "IOR"])
    obj = painted(one, two, faces=2)
    assert bpy.ops.uv.koebe_bake_texture(layer="New", margin=0) == {"FINISHED"}
    made = [slot.material for slot in obj.material_slots]
    found = [textures(material)["Base Color"].image for material in made]
    other_place = next(node.image for node in made[0].node_tree.nodes if node.name == again.name)
    assert found[0] == found[1] != other_place and [material.name for material in made] == ["One New", "Two New"]
    assert textures(made[0])["Roughness"].image == other and textures(made[0])["Metallic"].image == other
    assert layer_of(textures(made[0])["Roughness"]) == "New"
    # A face is half of the square: in the new UVs u' = (1 - v) / 2 or more by a half, and v' = 2 u.
    new_u, new_v = np.meshgrid(places, places)
    old_u, old_v = np.where(new_u < 0.5, new_v / 2 + 0.25, new_v / 2 + 0.5), 1 - (2 * new_u) % 1
    assert np.abs(pixels_of(found[0])[..., :2] - np.stack([old_u, old_v], axis=-1)).max() < 1.01 / SIZE


@pytest.mark.parametrize("prepare, words", [
    (lambda obj: obj.data.uv_layers.remove(obj.data.uv_layers["New"]), "Square: it has no UV layer 'New'"),
    (lambda obj: obj.data.uv_layers["New"].data.foreach_set("uv", np.full(8, 2.0, np.float32)),
     "Square: the UVs of New are not all in the UV square: press Pack Only first"),
    (lambda obj: bpy.ops.uv.koebe_checker(layer="New"), "Square: take the checker off first"),
    (lambda obj: obj.data.materials.clear(), "Square: no image of its materials lies by other UVs than those of New"),
    (lambda obj: [setattr(image, "source", "FILE") or setattr(image, "filepath", "/nowhere.png") or image.unpack(
        method="REMOVE") for image in bpy.data.images], "Square: the image Color has no pixels: its file is missing"),
])  # fmt: skip
def test_what_cannot_be_baked_is_told_and_nothing_changes(prepare, words):
    material, shader = add_material()
    image, _ = add_image("Color", "color")
    material.node_tree.links.new(add_texture(material, image).outputs["Color"], shader.inputs["Base Color"])
    obj = painted(material)
    prepare(obj)
    before = blocks(), [slot.material for slot in obj.material_slots]
    with pytest.raises(RuntimeError, match=f"nothing was baked. {words}"):
        bpy.ops.uv.koebe_bake_texture(layer="New")
    assert (blocks(), [slot.material for slot in obj.material_slots]) == before


def test_a_bake_that_fails_leaves_everything_as_it_was(addon, monkeypatch):
    material, shader = add_material()
    for name, socket in (("Color", "Base Color"), ("Rough", "Roughness")):
        image, _ = add_image(name, "color")
        material.node_tree.links.new(add_texture(material, image).outputs["Color"], shader.inputs[socket])
    obj = painted(material)
    before = blocks()
    stage = addon("blender.texture_bake")._Stage
    own, calls = stage.bake, []

    def fails(self, *arguments):
        calls.append(self)
        if len(calls) == 2:
            self.copy.hide_render = True  # which Blender refuses
        own(self, *arguments)

    monkeypatch.setattr(stage, "bake", fails)
    with pytest.raises(RuntimeError, match="nothing was baked. Square: Blender's bake failed"):
        bpy.ops.uv.koebe_bake_texture(layer="New")
    assert len(calls) == 2 and blocks() == before and obj.material_slots[0].material == material
    assert not material.use_fake_user
