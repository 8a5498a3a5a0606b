"""Drag Even in Blender's window: live UVs, Esc, and what is kept."""

import time

from window import xdotool

COUNT = """
import sys, time
name = next(n for n in sys.modules if n.endswith('koebe_uv.jobs.even_job'))
job = sys.modules[name].EvenJob
if not hasattr(heart, 'shows'):
    inner = job.show
    def show(self):
        inner(self)
        heart.shows.append(time.time())
    job.show = show
heart.shows = []
"""
HASH = """
import hashlib, numpy as np
mesh = bpy.context.view_layer.objects.active.data
uv = np.empty(2 * len(mesh.loops), np.float32); mesh.uv_layers['Koebe'].data.foreach_get('uv', uv)
result = hashlib.sha256(uv.tobytes()).hexdigest()
"""


def test_even_is_dragged_restored_and_kept(window, open_sample):
    open_sample("face_five_holes")
    window.run("bpy.context.scene.koebe_uv.shape = 'DISK'")
    window.run("bpy.ops.uv.koebe_uniformize()")
    window.workspace("UV Editing")
    window.run("bpy.ops.object.mode_set(mode='OBJECT')")
    window.show_textures()
    window.run("bpy.ops.ed.undo_push(message='mapped')")
    before = window.run(HASH)
    window.run(COUNT)
    x, y = window.middle("VIEW_3D")
    window.move(x, y)
    assert window.press("uv.koebe_even") is None
    window.settle()
    start = time.time()
    way = [("mousemove", int(x + 5 * step), int(y), "sleep", "0.03") for step in range(1, 61)]
    xdotool(*(word for step in way for word in step))
    seconds = time.time() - start
    window.wait("len(heart.shows) > 1")
    moves = window.ask("len(heart.shows)")
    faces = window.ask("len(bpy.context.view_layer.objects.active.data.polygons)")
    print(f"{moves / seconds:.1f} moves a second, {faces} faces")
    window.picture("80_even_dragged")
    assert window.run(HASH) != before
    window.key("Escape")
    window.settle()
    assert window.run(HASH) == before
    window.picture("81_even_restored")
    window.move(x, y)
    window.press("uv.koebe_even")
    window.settle()
    xdotool("mousemove", int(x + 120), int(y), "sleep", "0.3")
    window.wait("len(heart.shows) > 2")
    window.key("Return")
    window.wait("bpy.context.window_manager.operators and bpy.context.window_manager.operators[-1].bl_idname == "
                "'UV_OT_koebe_unwrap'")  # fmt: skip
    window.picture("82_even_kept")
    assert window.run(HASH) != before
    assert abs(window.ask("bpy.context.scene.koebe_uv.even") - 0.3) < 0.02
    window.key("ctrl+z")
    assert window.run(HASH) == before
