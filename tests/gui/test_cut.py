"""Koebe Uniformize of a model that is closed: its button, the report's cuts, and a circle tool on the result."""

from window import ENTRY

MODEL = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_torus_add(major_segments=64, minor_segments=24)
obj = bpy.context.object
while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])
bpy.ops.object.shade_smooth()
"""


def test_a_closed_model_is_mapped_by_the_button_and_its_cuts_are_shown(window):
    window.run(MODEL)
    window.workspace("UV Editing")
    window.open_tab("VIEW_3D")
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_1", "KP_Decimal")
    window.choose(shape="DISK")
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait("len(bpy.context.window_manager.koebe_uv.islands) == 1", 30.0)
    assert window.ask(f"{ENTRY}.mapped") and window.ask(f"{ENTRY}.flipped") == 0
    assert "cut through 1 handle" in window.ask(f"{ENTRY}.note")
    window.picture("65_cut")
    window.run("bpy.ops.uv.koebe_select_cuts()")
    window.settle()
    window.picture_of_uvs("66_cuts_selected")
    assert window.ask("bpy.context.mode") == "EDIT_MESH"
