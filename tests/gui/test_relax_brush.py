"""The relax brush by the mouse, in the UV Editor: a stroke, Esc in a stroke, undo, the radius by F."""

import math

from window import in_view, xdotool

SHEET = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_grid_add(x_subdivisions=40, y_subdivisions=40)
obj = bpy.context.object
for vertex in obj.data.vertices: vertex.co.z = 0.5 * vertex.co.x ** 2 + 0.3 * vertex.co.x * vertex.co.y
for loop in obj.data.uv_layers[0].data: loop.uv = (loop.uv.x ** 2, loop.uv.y)
bpy.context.window_manager.koebe_uv.islands.clear()
"""
EDIT = in_view("""
bpy.ops.object.mode_set(mode="EDIT")
bpy.ops.mesh.select_all(action="SELECT")
bpy.ops.ed.undo_push(message="edit")
""") + in_view('bpy.ops.wm.tool_set_by_id(name="koebe_uv.relax")', "IMAGE_EDITOR")
PLACES = """
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
layer = mesh.loops.layers.uv.active
result = [tuple(loop[layer].uv) for face in mesh.faces for loop in face.loops]
"""


def upright(places):
    """Whether no quadrilateral is turned over."""
    fours = [places[k : k + 4] for k in range(0, len(places), 4)]
    return all((c[0] - a[0]) * (d[1] - b[1]) - (d[0] - b[0]) * (c[1] - a[1]) > 0 for a, b, c, d in fours)


def stroke(window, *, end="mouseup"):
    """Press, and brush in a circle about the middle of the UV Editor. @param end what is done then"""
    x, y = window.middle("IMAGE_EDITOR")
    window.move(x + 40, y)
    xdotool("mousedown", 1)
    window.settle()
    for k in range(1, 25):
        angle = 2 * math.pi * k / 24
        xdotool("mousemove", int(x + 40 * math.cos(angle)), int(y + 40 * math.sin(angle)), "sleep", "0.05")
    window.ask("True")
    if end == "Escape":
        xdotool("key", "Escape")
    window.picture(f"110_relax_{end}") if end == "mouseup" else None
    xdotool("mouseup", 1)
    window.settle()


def test_a_stroke_relaxes_and_undo_goes_back(window):
    window.prepare(SHEET)
    window.run(EDIT)
    window.settle()
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    before = window.run(PLACES)
    window.picture("109_before_relaxing")
    stroke(window)
    after = window.run(PLACES)
    assert sum(p != q for p, q in zip(before, after, strict=True)) > 100 and upright(after)
    window.picture("111_relaxed")
    window.key("ctrl+z")
    assert window.run(PLACES) == before
    window.key("ctrl+shift+z")
    assert window.run(PLACES) == after


def test_escape_puts_all_back(window):
    before = window.run(PLACES)
    stroke(window, end="Escape")
    assert window.run(PLACES) == before


def test_f_changes_the_radius(window):
    before = window.ask("bpy.context.scene.koebe_relax_radius")
    x, y = window.middle("IMAGE_EDITOR")
    window.move(x, y)
    xdotool("key", "f")
    window.settle()
    xdotool("mousemove", x + 60, y, "sleep", "0.1", "mousemove", x + 80, y, "sleep", "0.1", "click", 1)
    window.settle()
    assert window.ask("bpy.context.scene.koebe_relax_radius") > before
