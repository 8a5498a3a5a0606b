"""Flat Copy from the Object menu: the vase unrolled beside itself."""

OBJECTS = "sorted(o.name for o in bpy.context.scene.objects if o.type == 'MESH')"


def test_a_flat_copy_from_the_object_menu(window, open_sample):
    open_sample("vase")
    window.run("bpy.ops.uv.koebe_uniformize(tube='unroll', checker_size=48)\n"
               "bpy.context.scene.cursor.location = (1.6, 0, -1)")  # fmt: skip
    window.show_textures()
    assert window.press("object.koebe_flat_copy") is None
    assert window.ask(OBJECTS) == ["vase", "vase Flat"]
    window.run("import math\n"
               "obj = bpy.context.view_layer.objects.active\n"
               "obj.rotation_euler.x = math.radians(90)\n"
               "for obj in bpy.context.scene.objects: obj.select_set(obj.type == 'MESH')")  # fmt: skip
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_Decimal")
    window.picture("50_flat_copy")
    window.run("for obj in bpy.context.scene.objects: obj.select_set(False)")
    window.picture("51_flat_copy")
