"""Unwrap Sequence by its button, and Esc while the frames are read and while they are mapped."""

import subprocess

import pytest
from test_escape import HOLD
from window import PICTURES, ROOT, xdotool

MODEL = f"""
import sys
sys.path.insert(0, {str(ROOT / "tests" / "blender")!r})
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
import scenes
obj = scenes.add_panel(size=60)
wave = obj.modifiers.new("Wave", "WAVE")
wave.height, wave.width, wave.time_offset = 0.3, 1.0, -20.0
scene = bpy.context.scene
scene.frame_start, scene.frame_end = 1, 12
scene.frame_set(7)
bpy.context.scene.koebe_uv.property_unset("target")
"""
REPORT = "bpy.context.window_manager.koebe_uv.islands"
FRAME = "bpy.context.scene.frame_current"


def test_the_button_maps_the_frames_of_the_scene(window):
    window.prepare(MODEL)
    window.open_part("sequence")
    window.picture("90_sequence_options")
    window.choose(target="LAYERS", scene_range=False, frame_start=1, frame_end=4)
    window.click(*window.find_button("VIEW_3D", "koebe_sequence"))
    window.wait(f"not heart.computing and len({REPORT}) == 4", 240.0)
    window.show_textures()
    window.picture_of_uvs("91_sequence")
    layers = "[layer.name for layer in bpy.context.view_layer.objects.active.data.uv_layers]"
    assert window.ask(layers) == [f"Koebe {frame:04d}" for frame in range(1, 5)]
    assert window.ask(f"[[e.mapped, e.flipped] for e in {REPORT}]") == [[True, 0]] * 4
    assert window.ask(FRAME) == 7
    window.move(*window.middle("VIEW_3D"))
    window.key("ctrl+z")
    window.wait(f"{layers} == []", 240.0)


def pixels(window, name, area):
    """The pixels of an area's main region in a picture."""
    x, y, width, height = window.region(area, "WINDOW")
    cut = ["-crop", f"{width}x{height}+{x}+{y}", "-depth", "8", "rgb:-"]
    return subprocess.run(["convert", str(PICTURES / f"{name}.png"), *cut], check=True, capture_output=True).stdout


def test_the_window_plays_the_frames(window):
    """After the run, from frame to frame the checker moves on the model, and the outlines in the UV Editor."""
    window.prepare(MODEL)
    window.move(*window.middle("VIEW_3D"))
    window.choose(checker_size=12)
    window.press("uv.koebe_sequence", frame_start=1, frame_end=12, checker_size=12)
    window.wait(f"not heart.computing and len({REPORT}) == 12", 120.0)
    window.show_textures()
    window.run("for area in bpy.context.window_manager.windows[0].screen.areas:\n"
               "    if area.type == 'VIEW_3D': area.spaces.active.overlay.show_overlays = False")  # fmt: skip
    window.run("bpy.context.scene.frame_set(1)")
    window.move(*window.middle("IMAGE_EDITOR"))
    window.key("Home")
    window.picture("92_frame_1")
    window.run("bpy.context.scene.frame_set(5)")
    window.picture("93_frame_5")
    for area in ("VIEW_3D", "IMAGE_EDITOR"):
        assert pixels(window, "92_frame_1", area) != pixels(window, "93_frame_5", area), area
    window.run("bpy.context.scene.frame_set(1)")
    window.picture("94_frame_1_again")
    assert pixels(window, "92_frame_1", "IMAGE_EDITOR") == pixels(window, "94_frame_1_again", "IMAGE_EDITOR")
    window.move(*window.middle("VIEW_3D"))
    window.key("space")  # plays
    seen = set()
    for _ in range(6):
        window.picture("95_played")
        seen.add(pixels(window, "95_played", "IMAGE_EDITOR"))
    window.key("space")
    assert len(seen) > 1


@pytest.mark.parametrize("mode", ["OBJECT", "EDIT"])
@pytest.mark.parametrize("while_it", ["reads", "maps"])
def test_esc(window, mode, while_it):
    window.prepare(MODEL)
    window.run(HOLD)
    if mode == "EDIT":
        window.move(*window.middle("VIEW_3D"))
        window.key("Tab", "a")
    stage = "mapping frame 3" if while_it == "maps" else None
    window.run(f"heart.hold = {stage!r}; heart.before = heart.fingerprint()")
    first, last = (1, 12) if while_it == "maps" else (10, 100000)
    window.press("uv.koebe_sequence", frame_start=first, frame_end=last, frame_step=1)
    window.wait("heart.held.is_set()" if while_it == "maps" else f"{FRAME} > 20")
    xdotool("key", "Escape")
    window.wait("any(answer == 'CANCELLED' for _, answer in heart.answers)")
    window.run("heart.go.set(); heart.hold = None")
    window.settle()
    assert window.ask("heart.differences()") == []
    assert window.ask(FRAME) == 7 and window.ask("bpy.context.mode").startswith(mode)
    if mode == "EDIT":
        window.move(*window.middle("VIEW_3D"))
        window.key("Tab")
