"""Two faces: compared, and the texture of one carried to the other, by the buttons of the panel."""

from conftest import SAMPLES
from window import xdotool

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


def scroll_down(window):
    """To the end of the sidebar."""
    x, top, width, height = window.region("VIEW_3D", "UI")
    window.move(x + 4, top + height // 2)
    for _ in range(30):
        xdotool("click", 5)
    window.settle()


def test_two_faces_compared_and_one_texture_for_both(window, open_sample):
    open_sample("face_five_holes")
    window.run(BESIDE)
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_Decimal")
    x, top, width, height = window.region("VIEW_3D", "UI")
    window.click(*window.find_button("VIEW_3D", "koebe_uniformize"))
    window.wait("not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) > 0")
    scroll_down(window)
    window.click(x + 60, top + height - 14)  # the folded panel's title, the last line
    scroll_down(window)
    window.click(*window.find_button("VIEW_3D", "koebe_compare_shapes"))
    window.wait("len(bpy.context.window_manager.koebe_shapes.others) > 0")
    assert window.ask(OTHERS) == [["face_surprised", True]]
    scroll_down(window)
    window.click(*window.find_button("VIEW_3D", "koebe_carry_texture"))
    window.wait("len(bpy.context.window_manager.koebe_shapes.carried) > 0")
    assert window.ask(CARRIED) == ["face_surprised"]
    scroll_down(window)
    window.picture("15_shapes")
