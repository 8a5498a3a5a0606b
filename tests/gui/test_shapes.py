"""Two faces: compared, and the texture of one carried to the other, by the buttons of the panel."""

from conftest import SAMPLES

OTHERS = "[(s.name, s.measured) for s in bpy.context.window_manager.koebe_shapes.others]"
CARRIED = "[s.name for s in bpy.context.window_manager.koebe_shapes.carried]"
BESIDE = f"""
with bpy.data.libraries.load({str(SAMPLES / "face_surprised.blend")!r}) as (there, here):
    here.objects = ["face_surprised"]
other = here.objects[0]
bpy.context.scene.collection.objects.link(other)
other.location.x = 2.6
other.select_set(True)
"""


def test_two_faces_compared_and_one_texture_for_both(window, open_sample):
    open_sample("face_five_holes")
    window.run(BESIDE)
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_Decimal")
    window.open_part("shapes")
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait("not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) > 0")
    window.scroll_down()
    window.click(*window.find_button("VIEW_3D", "koebe_compare_shapes"))
    window.wait("len(bpy.context.window_manager.koebe_shapes.others) > 0")
    assert window.ask(OTHERS) == [["face_surprised", True]]
    window.scroll_down()
    window.click(*window.find_button("VIEW_3D", "koebe_carry_texture"))
    window.wait("len(bpy.context.window_manager.koebe_shapes.carried) > 0")
    assert window.ask(CARRIED) == ["face_surprised"]
    window.scroll_down()
    window.picture("15_shapes")
