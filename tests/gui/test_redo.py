"""The redo panel does not freeze the window: the last map stays until the new one is there, and Esc keeps it."""

import time

from window import DONE, LAYERS, only, xdotool

MODEL = only("primitive_monkey_add()",
             'obj.modifiers.new("Smooth", "SUBSURF").levels = 3',
             'bpy.ops.object.modifier_apply(modifier="Smooth")')  # fmt: skip
HASH = """
import hashlib, numpy as np
mesh = bpy.context.view_layer.objects.active.data
result = ""
if "Koebe" in mesh.uv_layers:
    uv = np.empty(2 * len(mesh.loops), np.float32); mesh.uv_layers["Koebe"].data.foreach_get("uv", uv)
    result = hashlib.sha256(uv.tobytes()).hexdigest()
"""
OPTION = "bpy.context.window_manager.operators[-1].properties"
BAR = "next(m.ModalRun.bar for n, m in __import__('sys').modules.items() if n.endswith('operators.modal_run'))"
SKETCH = """next(len(m.MapOperator.sketch[1]) if m.MapOperator.sketch else 0
    for n, m in __import__('sys').modules.items() if n.endswith('operators.run_operator'))"""
ROW = {"keep_angles": (170, 88)}  # pixels from the pointer to rows of the panel that F9 opens


def unwrapped(window):
    """The map after one press of Unwrap."""
    window.prepare(MODEL)
    window.click(*window.find_button("VIEW_3D", "koebe_unwrap"))
    window.wait(DONE, 240.0)
    window.settle()
    return window.run(HASH)


def change(window, name):
    """Open the redo panel in the middle of the 3D View, click a switch, and wait until a run goes on."""
    window.move(*window.middle("VIEW_3D"))
    window.key("F9")
    window.picture("100_redo_panel")
    x, y = window.middle("VIEW_3D")
    before = window.ask(f"{OPTION}.{name}")
    window.move(x + ROW[name][0], y + ROW[name][1])
    xdotool("click", "1")
    window.wait(f"{BAR} is not None", 10.0)
    assert window.ask(f"{OPTION}.{name}") != before


def test_the_window_lives_while_the_redo_panel_computes(window):
    first = unwrapped(window)
    window.run("heart.silences.clear()")
    change(window, "keep_angles")
    assert window.run(HASH) == first, "the last map is seen"
    window.picture("101_redo_at_work")
    pressed = time.monotonic()
    xdotool("key", "Escape")
    window.wait(f"{BAR} is None")
    print(f"Esc after {time.monotonic() - pressed:.2f} s; longest silence {max(window.ask('heart.silences')):.2f} s")
    window.settle()
    assert window.run(HASH) == first, "Esc keeps it"
    change(window, "keep_angles")  # back
    xdotool("key", "Escape")
    window.wait(f"{BAR} is None")
    change(window, "keep_angles")
    window.wait(f"{BAR} is None", 240.0)
    window.settle()
    second = window.run(HASH)
    assert second != first and not window.ask(f"{OPTION}.keep_angles")
    window.picture("102_redone")
    window.move(*window.middle("IMAGE_EDITOR"))  # the panel closes
    window.settle()
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    assert window.run(HASH) == first, "one step back is the last map"
    window.key("ctrl+z")
    assert window.run(HASH) == "", "two are before it"
    window.key("ctrl+shift+z", "ctrl+shift+z")
    assert window.run(HASH) == second


def test_cuts_are_sketched_long_before_the_map_is_there(window):
    window.prepare(MODEL)
    window.choose(shape="PARTS")
    at = window.find_button("VIEW_3D", "koebe_unwrap")
    for last in (False, True):
        window.move(*at)
        pressed = time.monotonic()
        xdotool("click", "1")
        window.wait(SKETCH, 60.0)
        sketched = time.monotonic() - pressed
        assert window.ask(BAR) is not None and window.ask(LAYERS) == 0, "nothing is written yet"
        window.picture(f"103_sketch_{last}")
        if not last:
            xdotool("key", "Escape")
        window.wait(f"{BAR} is None", 240.0)
        print(f"sketch after {sketched:.2f} s, all after {time.monotonic() - pressed:.2f} s")
        window.settle()
        assert window.ask(SKETCH) == 0 and window.ask(LAYERS) == last
    window.choose(shape="AUTO")


def test_a_second_change_takes_the_place_of_the_first(window):
    first = unwrapped(window)
    change(window, "keep_angles")
    xdotool("click", "1")  # the same switch: back to the first map's options, while the other run goes on
    window.settle()
    assert window.ask(f"{OPTION}.keep_angles")
    window.wait(f"{BAR} is None", 240.0)
    window.wait("not heart.computing", 240.0)
    window.settle()
    assert window.run(HASH) == first and window.ask(f"{OPTION}.keep_angles")


def test_going_on_ends_the_run(window):
    first = unwrapped(window)
    change(window, "keep_angles")
    window.run("bpy.context.view_layer.objects.active.location.x += 1")
    window.wait(f"{BAR} is None", 10.0)
    window.wait("not heart.computing", 20.0)
    window.settle()
    assert window.run(HASH) == first
