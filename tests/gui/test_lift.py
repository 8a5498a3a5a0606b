"""Lift Pattern in the window: from the panel, with Esc, and again in the redo panel."""

from test_escape import escape

LIFTED = "[obj.name for obj in bpy.context.scene.objects if obj.name.endswith('Lift')]"
SETTINGS = "settings = bpy.context.scene.koebe_lift\n"


def test_a_pattern_is_lifted_from_the_panel(window, open_sample):
    name = open_sample("face_five_holes")
    window.run(SETTINGS + "settings.pattern, settings.even = 'voronoi', 0.6")
    window.open_part("lift")
    window.scroll_down()
    window.click(*window.find_button("VIEW_3D", "koebe_lift"))
    window.wait(f"{LIFTED} != []", 240.0)
    window.settle()
    assert window.ask(LIFTED) == [f"{name} Lift"]
    window.move(*window.middle("VIEW_3D"))
    window.run("for obj in bpy.context.scene.objects: obj.select_set(False)")
    window.settle()
    window.picture("70_lift")
    window.key("ctrl+z")
    window.wait(f"{LIFTED} == []")


def test_escape_leaves_everything_as_it_was(window, open_sample):
    open_sample("face_five_holes")
    escape(window, "object.koebe_lift", "iterate")
    assert window.ask(LIFTED) == []
