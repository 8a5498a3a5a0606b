"""Koebe Unwrap to Disk of a model that is closed: its button, the report's cuts, and a circle tool on the result."""

from window import ENTRY, only


def test_a_closed_model_is_mapped_by_the_button_and_its_cuts_are_shown(window):
    window.run(only("primitive_torus_add(major_segments=64, minor_segments=24)"))
    window.workspace("UV Editing")
    window.look_at_model()
    window.choose(shape="DISK")
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait("len(bpy.context.window_manager.koebe_uv.islands) == 1", 240.0)
    assert window.ask(f"{ENTRY}.mapped") and window.ask(f"{ENTRY}.flipped") == 0
    assert "cut through 1 handle" in window.ask(f"{ENTRY}.note")
    window.picture("65_cut")
    window.run("bpy.ops.uv.koebe_select_cuts()")
    window.settle()
    window.picture_of_uvs("66_cuts_selected")
    assert window.ask("bpy.context.mode") == "EDIT_MESH"
