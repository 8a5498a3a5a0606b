"""The slider Even, dragged: the same operator with events of a test in place of the window's."""

import time
import types

import bpy
import numpy as np
import pytest
import scenes


class Drag:
    """The operator's functions, with an object in place of the operator, and without a window."""

    def __init__(self, addon, even=0.0):
        kind = addon("operators.even_slider").UV_OT_koebe_even
        self.said, self.unwrapped = [], []
        self.timer = object()
        self.operator = types.SimpleNamespace(report=lambda level, text: self.said.append(text), shown_errors=())
        for name in ("modal", "cancel", "_follow", "_go_on", "_step", "_keep", "_say", "_end_worker"):
            setattr(self.operator, name, types.MethodType(getattr(kind, name), self.operator))
        manager = types.SimpleNamespace(event_timer_add=lambda seconds, window: self.timer,
                                        event_timer_remove=lambda timer: None, modal_handler_add=lambda operator: None)
        self.context = types.SimpleNamespace(
            scene=bpy.context.scene, window_manager=manager, window=None, screen=None, mode="OBJECT",
            selected_objects=bpy.context.selected_objects, active_object=bpy.context.active_object,
            evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get,
            workspace=types.SimpleNamespace(status_text_set=lambda text: None),
        )  # fmt: skip
        bpy.context.scene.koebe_uv.even = even
        self.answer = kind.invoke(self.operator, self.context, self.event("LEFTMOUSE", 0))

    @staticmethod
    def event(kind, x=0, shift=False):
        return types.SimpleNamespace(type=kind, value="PRESS", mouse_x=x, shift=shift)

    def send(self, kind, x=0):
        return self.operator.modal(self.context, self.event(kind, x))

    def to(self, x, seconds=20.0):
        """Drag there, and wait until nothing moves: the number of steps."""
        self.send("MOUSEMOVE", x)
        before, until = self.operator.moves, time.monotonic() + seconds
        while time.monotonic() < until:
            self.send("TIMER")
            if self.operator._worker is None:
                break
            time.sleep(0.001)
        return self.operator.moves - before


def mapped(**options):
    obj = scenes.add_panel()
    scenes.select(obj)
    bpy.ops.uv.koebe_uniformize(checker=False, **options)
    return obj


def spread(obj):
    """Ratio of texel densities at 95 % and 5 % of the faces."""
    corner, _ = scenes.triangles(obj.data)
    areas = np.abs(scenes.signed_areas(obj.data, "Koebe"))
    points = scenes.read(obj.data.vertices, "co", np.float32, 3)[corner]
    space = np.linalg.norm(np.cross(points[:, 1] - points[:, 0], points[:, 2] - points[:, 0]), axis=1)
    low, high = np.percentile(np.sqrt(areas / space), [5, 95])
    return high / low


@pytest.mark.parametrize("key", ["ESC", "RIGHTMOUSE"])
def test_a_drag_shows_even_texels_and_esc_restores_every_bit(addon, key):
    obj = mapped()
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    even_before = spread(obj)
    drag = Drag(addon)
    assert drag.answer == {"RUNNING_MODAL"}
    assert drag.to(300) > 1
    assert not np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    assert spread(obj) < 0.8 * even_before
    assert np.sign(scenes.signed_areas(obj.data, "Koebe")).min() > 0
    assert drag.send(key) == {"CANCELLED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
    assert bpy.context.scene.koebe_uv.even == 0.0


def test_esc_in_the_middle_of_a_step_restores_every_bit(addon):
    obj = mapped()
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    drag = Drag(addon)
    drag.send("MOUSEMOVE", 200)
    drag.send("TIMER")
    assert drag.operator._worker is not None
    assert drag.send("ESC") == {"CANCELLED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)


def test_enter_unwraps_with_that_even(addon):
    obj = mapped()
    bpy.context.scene.koebe_uv.shape = "DISK"
    drag = Drag(addon)
    drag.to(160)  # of 400 pixels
    assert drag.send("RET") == {"FINISHED"}
    settings = bpy.context.scene.koebe_uv
    assert settings.even == pytest.approx(0.4)
    dragged = scenes.corner_uv(obj.data, "Koebe").copy()
    bpy.ops.uv.koebe_unwrap(shape="DISK", even=0.4)
    assert np.abs(scenes.corner_uv(obj.data, "Koebe") - dragged).max() < 1e-6


def test_a_click_without_a_drag_changes_nothing(addon):
    obj = mapped()
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    drag = Drag(addon, 0.3)
    assert drag.send("LEFTMOUSE") == {"CANCELLED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)


def test_without_uvs_it_says_so(addon):
    scenes.select(scenes.add_cube())
    drag = Drag(addon)
    assert drag.answer == {"CANCELLED"} and "it has no UVs: map it first" in drag.said[0]


def test_parts_are_dragged_where_they_lie(addon):
    obj = scenes.add_cube()
    scenes.select(obj)
    bpy.ops.uv.koebe_parts(checker=False, even=0.0, keep_angles=False)
    bpy.context.scene.koebe_uv.shape = "PARTS"
    before = scenes.corner_uv(obj.data, "Koebe").copy()
    drag = Drag(addon)
    drag.to(400)
    assert drag.send("ESC") == {"CANCELLED"}
    assert np.array_equal(scenes.corner_uv(obj.data, "Koebe"), before)
