"""Hundreds of islands and of objects: the panel stays short and quick, and a message fits on the screen."""

from window import ROOT

SECONDS = 0.05  # of the main thread to draw the window once, more than without
DRAW = """
import time
with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
    start = time.thread_time()
    bpy.ops.wm.redraw_timer(type='DRAW_WIN_SWAP', iterations=5)
    result = (time.thread_time() - start) / 5
"""
GRID = """
import sys
sys.path.insert(0, {folder!r})
import scenes
bpy.ops.wm.read_homefile(use_empty=True, load_ui=False)
vertices, faces = scenes.panel_arrays(12)
count = {count}
if {apart}:
    for number in range(count):
        obj = scenes.add_object(f"Piece {{number}}", vertices, faces)
        obj.location = (3 * (number % 20), 0, 3 * (number // 20))
        if {closed}:
            obj.data.clear_geometry()
            cube = scenes.add_cube("Cube")
            obj.data, mesh = cube.data, obj.data
            bpy.data.objects.remove(cube)
else:
    import numpy as np
    places = [(3 * (n % 20), 0, 3 * (n // 20)) for n in range(count)]
    scenes.add_object("Many", np.vstack([vertices + place for place in places]),
                      [[n * len(vertices) + v for v in face] for n in range(count) for face in faces])
bpy.context.view_layer.update()
scenes.select(*bpy.context.view_layer.objects)
"""
ISLANDS = "len(bpy.context.window_manager.koebe_uv.islands)"


def fill(window, **options):
    """A new file with so many islands, in one object or apart, all selected, with the tab open."""
    options = {"apart": False, "closed": False, **options}
    window.run(GRID.format(folder=str(ROOT / "tests" / "blender"), **options))
    window.workspace("Layout")
    window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
    window.look_at_model()


def run_all(window, count):
    window.press("uv.koebe_uniformize")
    window.wait(f"not heart.computing and {ISLANDS} == {count}", 300)
    window.settle()


def test_hundreds_of_islands_in_one_object(window):
    fill(window, count=300)
    before = window.run(DRAW)
    run_all(window, 300)
    window.picture("40_many_islands")
    drawing = window.run(DRAW)
    window.workspace("UV Editing")
    window.open_tab("IMAGE_EDITOR")
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.picture("41_many_circles")
    with_circles = window.run(DRAW)
    window.run("bpy.context.window_manager.koebe_uv.show_circles = False")
    without = window.run(DRAW)
    print(f"drawing the window {before:.3f} s, with the panel of 300 islands {drawing:.3f} s, "
          f"the UV Editor {without:.3f} s, with their circles {with_circles:.3f} s")
    assert drawing < before + SECONDS and with_circles < without + SECONDS


def test_hundreds_of_objects_compared_and_carried_to(window):
    fill(window, count=200, apart=True)
    run_all(window, 200)
    before = window.run(DRAW)
    window.run("bpy.ops.uv.koebe_compare_shapes(); bpy.ops.uv.koebe_carry_texture()")
    window.run("for o in bpy.context.view_layer.objects: o.select_set(True)")
    window.settle()
    window.picture("42_many_objects")
    window.scroll_down()
    x, top, width, height = window.region("VIEW_3D", "UI")
    window.click(x + 60, top + height - 14)  # the folded panel's title, the last line
    window.picture("43_many_shapes")
    window.scroll_down()
    window.picture("44_many_shapes_end")
    drawing = window.run(DRAW)
    print(f"drawing the window {before:.3f} s, with 200 shapes {drawing:.3f} s")
    assert drawing < before + SECONDS


def test_a_message_about_many_objects_fits_on_the_screen(window):
    fill(window, count=200, apart=True, closed=True)
    window.run("bpy.context.scene.koebe_uv.cut = False")
    window.press("uv.koebe_uniformize")
    window.wait(f"not heart.computing and {ISLANDS} == 200")
    window.settle()
    window.picture("45_many_failures")
