"""A painted model gets new UVs by the mouse: unwrapped, baked by the button, undone and done again."""

PAINTED = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_cylinder_add(vertices=24)
obj = bpy.context.object
material = bpy.data.materials.new("Paint")
if material.node_tree is None: material.use_nodes = True
tree = material.node_tree
node = tree.nodes.new("ShaderNodeTexImage")
node.image = bpy.data.images.new("Paint", 256, 256)
node.image.generated_type = "COLOR_GRID"
shader = next(one for one in tree.nodes if one.type == "BSDF_PRINCIPLED")
tree.links.new(node.outputs["Color"], shader.inputs["Base Color"])
obj.data.materials.append(material)
bpy.ops.uv.koebe_parts(checker=False)
bpy.context.window_manager.koebe_uv.islands.clear()
"""
SHOWN = "bpy.context.view_layer.objects.active.material_slots[0].material.name"
IMAGES = "sorted(image.name for image in bpy.data.images if image.name.startswith('Paint'))"


def test_a_painted_model_is_baked_by_the_button_and_undone(window):
    window.prepare(PAINTED)
    window.show_textures()
    window.picture("95_painted")
    x, y, _, _ = window.region("VIEW_3D", "UI")
    window.click(x + 70, y + 469)  # Layer and Checker, lower by the button Use for Rendering
    window.scroll_down()
    window.click(*window.find_button("VIEW_3D", "koebe_bake_texture"))
    window.wait(f"{SHOWN} == 'Paint Koebe'", 60.0)
    assert window.ask(IMAGES) == ["Paint", "Paint Koebe"]
    assert window.ask("[scene.name for scene in bpy.data.scenes]") == ["Scene"]
    window.settle()
    window.picture("96_baked")
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    assert window.ask(SHOWN) == "Paint" and window.ask(IMAGES) == ["Paint"]
    window.key("ctrl+shift+z")
    assert window.ask(SHOWN) == "Paint Koebe" and window.ask(IMAGES) == ["Paint", "Paint Koebe"]
