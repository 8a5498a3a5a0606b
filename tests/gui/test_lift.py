"""Patterned Copy in the window: from the panel, with Esc, and again in the redo panel."""

from test_escape import escape
from window import xdotool

LIFTED = "[obj.name for obj in bpy.context.scene.objects if obj.name.endswith('Pattern')]"
SETTINGS = "settings = bpy.context.scene.koebe_lift\n"


def drag_even_in_the_redo_panel(window):
    """While the slider is dragged the copy follows."""
    x, top, _, height = window.region("VIEW_3D", "WINDOW")
    window.click(x + 130, top + height - 15)  # its folded title
    window.settle()
    places = "[list(v.co) for v in bpy.context.active_object.data.vertices][::500]"
    before, y = window.ask(places), top + height - 70  # Even
    window.move(x + 270, y)
    xdotool("mousedown", 1)
    window.ask("True")  # a busy machine sees the press before the slider moves
    for step in (10, 30, 50):
        xdotool("mousemove", x + 270 - step, y, "sleep", "0.3")
        window.ask("True")
    window.wait(f"{places} != {before}", 60.0)
    window.picture("71_lift_while_dragged")
    xdotool("mouseup", 1)
    window.settle()


def test_a_pattern_is_lifted_from_the_panel(window, open_sample):
    name = open_sample("face_five_holes")
    window.run(SETTINGS + "settings.pattern, settings.even = 'circles', 0.6")
    window.open_part("lift")
    window.scroll_down()
    window.click(*window.find_button("VIEW_3D", "koebe_lift"))
    window.wait(f"{LIFTED} != []", 240.0)
    window.settle()
    assert window.ask(LIFTED) == [f"{name} Pattern"]
    drag_even_in_the_redo_panel(window)
    assert window.ask(LIFTED) == [f"{name} Pattern"]
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


SCATTER = """
import math
bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.5, location=(9, 0, 0))
ball = bpy.context.object
ball.data.polygons.foreach_set("use_smooth", [True] * len(ball.data.polygons))
face = bpy.data.objects["face_five_holes"]
modifier = face.modifiers.new("Scatter", "NODES")
group = modifier.node_group = bpy.data.node_groups["Koebe Scatter"]
items = group.interface.items_tree if hasattr(group, "interface") else group.inputs
keys = {one.name: one.identifier for one in items if getattr(one, "in_out", "INPUT") == "INPUT"}
for name, value in {"Instance": ball, "Count": 34, "Size": 0.8}.items():
    if hasattr(modifier, "properties"):
        getattr(modifier.properties.inputs, keys[name]).value = value
    else:
        modifier[keys[name]] = value
for obj in bpy.context.scene.objects: obj.select_set(False)
bpy.context.view_layer.objects.active = face
face.update_tag()
"""


def test_scattered_balls_are_as_large_as_the_map_is(window, open_sample):
    open_sample("face_five_holes")
    window.run("bpy.ops.uv.koebe_unwrap(shape='DISK', even=0.4, checker=False)")
    assert window.press("node.koebe_add_groups") is None
    window.run(SCATTER)
    window.settle()
    window.picture("71_scatter")
    count = "sum(one.is_instance for one in bpy.context.evaluated_depsgraph_get().object_instances)"
    assert window.ask(count) > 300


def test_loops_are_selected_around_eyes_and_mouth(window, open_sample):
    open_sample("face_five_holes")
    window.run("bpy.ops.uv.koebe_unwrap(shape='DISK', checker=False)")
    assert window.press("mesh.koebe_loops_around_holes") is None
    window.settle()
    window.picture("72_loops")
    assert window.ask("bpy.context.mode") == "EDIT_MESH"
