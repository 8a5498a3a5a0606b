"""Local view, quad view, two windows: what is out of sight is left alone, and what happens meanwhile breaks nothing."""

import pytest
from test_escape import HOLD
from window import HEIGHT, in_view, xdotool

REPORT = "[(i.object_name, i.mapped) for i in bpy.context.window_manager.koebe_uv.islands]"
LAYERS = "{o.name: [u.name for u in o.data.uv_layers] for o in bpy.data.objects if o.type == 'MESH'}"
TWO = """
view = bpy.context.window_manager.windows[0].view_layer
first = view.objects.active
other = bpy.data.objects.new("other", first.data.copy())
bpy.context.scene.collection.objects.link(other)
other.location.x = 2.6
"""
SECOND = "bpy.context.window_manager.windows[1]"


def uniformize(window, count=1):
    """Click the button and wait for the report."""
    window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
    window.press("uv.koebe_uniformize")
    window.wait(f"not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) >= {count}")


def test_in_local_view_only_what_is_in_it(window, open_sample):
    open_sample("suzanne_mask")
    window.run(TWO)
    window.run(in_view("bpy.ops.view3d.localview()"))  # with the first object alone
    window.settle()
    window.run(TWO.split("other =")[0] + "bpy.data.objects['other'].select_set(True)")
    window.picture("30_local_view")
    uniformize(window)
    assert window.ask(REPORT) == [["suzanne_mask", True]]
    assert window.ask(LAYERS) == {"suzanne_mask": ["Koebe"], "other": []}
    window.move(*window.middle("VIEW_3D"))
    window.key("Tab", "a")
    uniformize(window)
    assert window.ask("bpy.context.mode") == "EDIT_MESH"
    assert window.ask(LAYERS) == {"suzanne_mask": ["Koebe"], "other": []}
    window.picture("31_local_view_edit_mode")
    window.move(*window.middle("VIEW_3D"))
    window.key("Tab")
    window.run("bpy.context.window_manager.koebe_uv.islands[0].object_name = 'other'")
    assert "not in the local view" in window.press("uv.koebe_select_loop", loop=1)
    assert window.ask("(bpy.context.mode, bpy.context.view_layer.objects.active.name)") == ["OBJECT", "suzanne_mask"]
    window.move(*window.middle("VIEW_3D"))
    window.key("KP_Divide")  # out of local view
    assert window.press("uv.koebe_select_loop", loop=1) is None
    assert window.ask("(bpy.context.mode, bpy.context.view_layer.objects.active.name)") == ["EDIT_MESH", "other"]


def test_quad_view(window, open_sample):
    open_sample("suzanne_mask")
    window.press("screen.region_quadview")
    window.settle()
    uniformize(window)
    window.press("uv.koebe_distortion", kind="area")
    window.settle()
    window.picture("33_quad_view")
    assert window.ask("bpy.context.view_layer.objects.active.data['koebe_distortion']['kind']") == "area"
    window.press("screen.region_quadview")


@pytest.fixture
def second(window, open_sample):
    """Another window, with the first one's view of the scene; closed at the end."""
    open_sample("suzanne_mask")
    window.press("wm.window_new")
    window.settle()
    yield SECOND
    window.run(HOLD + "heart.go.set()")
    window.run(f"""
if len(bpy.context.window_manager.windows) > 1:
    with bpy.context.temp_override(window={SECOND}):
        bpy.ops.wm.window_close()
""")
    window.settle()


def in_second(window):
    """The middle of the second window's 3D View on the screen."""
    x, y, width, height = window.ask(
        f"[(w.x + r.x, w.y + r.y, r.width, r.height) for w in [{SECOND}] for a in w.screen.areas "
        f"if a.type == 'VIEW_3D' for r in a.regions if r.type == 'WINDOW'][0]"
    )
    return x + width // 2, HEIGHT - y - height // 2


def start_and_hold(window):
    """Click the button in the first window; the thread stands still."""
    window.run(HOLD + "heart.hold = 'any'")
    window.press("uv.koebe_uniformize")
    window.wait("heart.held.is_set()")


def test_distortion_colours_both_windows_and_off_brings_both_back(window, second):
    shading = "[s.shading.color_type for w in bpy.context.window_manager.windows for a in w.screen.areas " \
              "if a.type == 'VIEW_3D' for s in a.spaces if s.type == 'VIEW_3D']"  # fmt: skip
    window.run("bpy.ops.uv.koebe_uniformize(); bpy.ops.uv.koebe_distortion(kind='none')")
    before = window.ask(shading)
    assert len(before) == 2 and "VERTEX" not in before
    window.run("bpy.ops.uv.koebe_distortion(kind='area')")
    window.picture("34_two_windows")
    assert window.ask(shading) == ["VERTEX", "VERTEX"]
    window.run("bpy.ops.uv.koebe_distortion(kind='none')")
    assert window.ask(shading) == before


def test_what_the_other_window_does_meanwhile(window, second):
    """The object is deleted there by keys; the run says so and ends."""
    start_and_hold(window)
    window.move(*in_second(window))
    window.key("x", "Return")
    window.picture("35_deleted_in_the_other_window")
    assert window.ask("'suzanne_mask' in bpy.context.scene.objects") is False
    window.run("heart.go.set()")
    window.wait("any(answer == 'CANCELLED' for _, answer in heart.answers)")
    window.picture("36_said")
    assert "deleted" in window.ask("bpy.context.window_manager.koebe_uv.islands[0].message")


def test_a_window_that_is_closed_takes_its_run_with_it(window, second):
    window.run(HOLD + "heart.hold = 'any'")
    window.press("uv.koebe_uniformize", window=1)
    window.wait("heart.held.is_set()")
    window.run(f"""
with bpy.context.temp_override(window={SECOND}):
    bpy.ops.wm.window_close()
""")
    window.settle()
    window.run("heart.go.set()")
    window.wait("heart.ended and not heart.computing")
    window.settle()
    assert window.ask(LAYERS) == {"suzanne_mask": []}


def test_a_file_that_is_opened_ends_the_run(window, second):
    start_and_hold(window)
    window.run("bpy.ops.wm.read_homefile(load_ui=False)")
    window.settle()
    window.run("heart.go.set()")
    window.wait("heart.ended and not heart.computing")
    window.settle()
    assert window.ask(LAYERS) == {"Cube": ["UVMap"]}
    xdotool("key", "Escape")
