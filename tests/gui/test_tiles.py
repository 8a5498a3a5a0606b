"""Unwrap to Torus Tile and Unwrap to Cylinder, by their buttons, and the button that helps where there is no handle."""

MODEL = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_torus_add(major_segments=48, minor_segments=24, major_radius=1.0, minor_radius=0.45)
obj = bpy.context.object
while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])
bpy.ops.object.shade_smooth()
"""
TUBE = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_cylinder_add(vertices=48, depth=2.5, end_fill_type="NOTHING")
obj = bpy.context.object
while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])
obj.modifiers.new("Finer", "SUBSURF").levels = 2
obj.modifiers["Finer"].subdivision_type = "SIMPLE"
bpy.ops.object.modifier_apply(modifier="Finer")
"""
ENTRY = "bpy.context.window_manager.koebe_uv.islands[0]"
DONE = "not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) == 1"


def prepare(window, model):
    """The model selected in the 3D View, the sidebar open, and no report."""
    window.run(model)
    window.run("bpy.ops.ed.undo_push(message='made')\nbpy.context.window_manager.koebe_uv.islands.clear()")
    window.open_tab("VIEW_3D")
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_Decimal")


def test_a_torus_by_its_button(window):
    window.workspace("UV Editing")
    prepare(window, MODEL)
    window.open_part("domains")
    window.picture("70_other_domains")
    window.click(*window.find_button("VIEW_3D", "shape='TORUS'"))
    window.wait(DONE, 30.0)
    window.show_textures()
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.picture("71_torus")
    assert window.ask(f"[{ENTRY}.domain, {ENTRY}.mapped, {ENTRY}.flipped]") == ["torus", True, 0]
    window.move(*window.middle("VIEW_3D"))
    layers = "len(bpy.context.view_layer.objects.active.data.uv_layers)"
    assert window.ask(layers) == 1
    window.key("ctrl+z")
    window.wait(f"{layers} == 0", 20.0)


def test_a_tube_is_no_torus_and_the_report_has_the_button(window):
    window.workspace("UV Editing")
    prepare(window, TUBE)
    window.press("uv.koebe_torus")
    window.wait(DONE, 30.0)
    window.settle()
    window.picture("72_no_torus")
    assert window.ask(f"[{ENTRY}.mapped, {ENTRY}.offer]") == [False, "ring"]
    window.click(*window.find_button("VIEW_3D", "shape='RING'"))
    window.wait(f"{DONE} and {ENTRY}.domain == 'ring'", 30.0)
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.picture("73_cylinder")
    assert window.ask(f"[{ENTRY}.mapped, {ENTRY}.flipped, len({ENTRY}.loops)]") == [True, 0, 2]
