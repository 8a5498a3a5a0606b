"""The tool Koebe Circles in the UV Editor: dragged with the mouse, in Edit Mode and in Object Mode."""

import pytest
from window import HEIGHT, in_view, xdotool

LOOPS = "[[*l.uv_center, l.uv_radius] for l in bpy.context.window_manager.koebe_uv.islands[0].loops]"
OBJECT = "bpy.context.view_layer.objects.active"
HASH = """
import hashlib, numpy as np
obj = bpy.context.view_layer.objects.active
if obj.mode == 'EDIT': obj.update_from_editmode()
mesh = obj.to_mesh() if obj.mode == 'EDIT' else obj.data
uv = np.empty(2 * len(mesh.loops), np.float32); mesh.uv_layers['Koebe'].data.foreach_get('uv', uv)
if obj.mode == 'EDIT': obj.to_mesh_clear()
result = hashlib.sha256(uv.tobytes()).hexdigest()
"""


@pytest.fixture(params=["EDIT", "OBJECT"])
def mapped(window, open_sample, request):
    """The face, mapped, in the UV Editor with the tool chosen; the mode."""
    open_sample("face_five_holes")
    window.run("bpy.ops.uv.koebe_uniformize()")
    window.workspace("UV Editing")
    window.run("bpy.ops.object.mode_set(mode='EDIT'); bpy.ops.mesh.select_all(action='SELECT');"
               f"bpy.ops.object.mode_set(mode={request.param!r})")  # fmt: skip
    window.run(in_view("bpy.ops.wm.tool_set_by_id(name='koebe_uv.circles', space_type='IMAGE_EDITOR')\n"
                       "bpy.ops.image.view_all(fit_view=True)\n"
                       "area.spaces.active.show_region_ui = False; area.spaces.active.show_region_toolbar = True",
                       "IMAGE_EDITOR"))  # fmt: skip
    window.run(in_view("bpy.ops.view3d.view_axis(type='FRONT'); bpy.ops.view3d.view_selected()"))
    window.show_textures()
    return request.param


def pixel(window, u, v):
    """Where a place of the UVs is on the screen."""
    x, y = window.run(in_view(f"result = [c + o for c, o in zip(region.view2d.view_to_region({u}, {v}, clip=False), "
                              "(region.x, region.y))]", "IMAGE_EDITOR"))  # fmt: skip
    return x, HEIGHT - 1 - y


def drag(window, start, end, release=True):
    """Press, move in steps, and let go."""
    window.move(*start)
    xdotool("mousedown", 1)
    window.settle()  # Blender takes for the place of a click where the pointer is when it gets to it
    for step in range(1, 9):
        xdotool("mousemove", *(int(a + (b - a) * step / 8) for a, b in zip(start, end)), "sleep", "0.1")
    window.settle()
    if release:
        xdotool("mouseup", 1)
        window.settle()


def last(window):
    return window.ask("bpy.context.window_manager.operators[-1].bl_idname")


def test_the_disk_a_hole_and_the_turn_are_dragged_and_undone(window, mapped):
    loops, before = window.ask(LOOPS), window.run(HASH)
    window.picture(f"40_circles_{mapped}")
    hole = pixel(window, *loops[1][:2])
    drag(window, hole, pixel(window, 0.505, 0.5), release=False)
    window.picture(f"41_hole_held_{mapped}")
    xdotool("mouseup", 1)
    window.settle()
    window.picture(f"42_hole_in_the_middle_{mapped}")
    assert last(window) == "UV_OT_koebe_moebius"
    assert window.ask(OBJECT + ".mode") == mapped
    assert max(abs(c - 0.5) for c in window.ask(LOOPS)[1][:2]) < 1e-6
    moved = window.run(HASH)
    assert moved != before
    window.key("ctrl+z")
    assert window.run(HASH) == before and window.ask(LOOPS) == loops
    window.key("ctrl+shift+z")
    assert window.run(HASH) == moved and window.ask(LOOPS) != loops
    drag(window, pixel(window, 0.5, 1.08), pixel(window, 0.9, 1.0))
    window.picture(f"43_turned_{mapped}")
    assert window.run(HASH) != moved


def test_esc_restores_every_bit(window, mapped):
    loops, before = window.ask(LOOPS), window.run(HASH)
    drag(window, pixel(window, 0.5, 0.45), pixel(window, 0.8, 0.6), release=False)
    window.picture(f"44_disk_held_{mapped}")
    assert window.ask(LOOPS) != loops
    window.key("Escape")
    xdotool("mouseup", 1)
    window.settle()
    assert window.ask(OBJECT + ".mode") == mapped
    assert window.run(HASH) == before and window.ask(LOOPS) == loops


def test_a_click_makes_a_hole_the_rim(window, mapped):
    vertices = "[l.vertices for l in bpy.context.window_manager.koebe_uv.islands[0].loops]"
    loops, before = window.ask(LOOPS), window.ask(vertices)
    window.click(*pixel(window, *loops[2][:2]))
    window.picture(f"45_new_rim_{mapped}")
    after = window.ask(vertices)
    assert after[0] == before[2] and after[2] == before[0]
    window.key("ctrl+z")
    assert window.ask(vertices) == before


def test_a_click_beside_the_holes_changes_nothing(window, mapped):
    before = window.run(HASH)
    window.click(*pixel(window, 0.5, 0.06))
    window.click(*pixel(window, 0.5, 1.1))
    assert window.run(HASH) == before


def test_the_tool_is_in_the_toolbar(window, mapped):
    tool = window.ask("bpy.context.window_manager.windows[0].workspace.tools.from_space_image_mode('UV').idname")
    assert tool == "koebe_uv.circles"
