# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide's films, in a real window: press Unwrap, drag a circle, move the slider Even, press Unwrap again; or Live.

    xvfb-run -a -s '-screen 0 880x560x24' /usr/bin/python3 scripts/guide_film.py OUT.gif [live]

It needs what tests/gui needs: the zip of `make package`, a display, xdotool, ImageMagick. Each picture is taken when
the window is drawn, and the pointer is painted into it.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "gui"))

import window as gui  # noqa: E402

SCREEN = (880, 560)
COLORS = 40
TOP = 26  # pixels of Blender's menus, which are cut off
SHORT, LONG = 12, 110  # hundredths of a second that a picture is shown
STEPS = 5  # pictures of a drag
ARROW = ((0, 0), (0, 17), (4, 13), (7, 20), (10, 19), (7, 12), (12, 12))
SCENE = f"""
bpy.ops.wm.open_mainfile(filepath={str(ROOT / "blend_samples" / "suzanne_mask.blend")!r}, load_ui=False)
view = bpy.context.window_manager.windows[0].view_layer
obj = next(obj for obj in view.objects if obj.type == 'MESH')
view.objects.active = obj
obj.select_set(True)
for polygon in obj.data.polygons: polygon.use_smooth = True
bpy.context.scene.koebe_uv.shape = 'DISK'
bpy.context.scene.koebe_uv.checker_size = 24
bpy.context.preferences.system.use_region_overlap = False
bpy.context.scene.render.dither_intensity = 0
bpy.context.preferences.themes[0].view_3d.space.gradients.background_type = 'SINGLE_COLOR'
"""
# Two editors alone: the UV Editor on the left, the 3D View on the right.
EDITORS = """
window = bpy.context.window_manager.windows[0]
for kind in ('PROPERTIES', 'OUTLINER'):
    for area in [area for area in window.screen.areas if area.type == kind]:
        with bpy.context.temp_override(window=window, area=area, region=area.regions[-1]):
            bpy.ops.screen.area_close()
"""
TIDY = """
window = bpy.context.window_manager.windows[0]
bpy.ops.object.mode_set(mode='OBJECT')
for area in window.screen.areas:
    space, region = area.spaces.active, next(r for r in area.regions if r.type == 'WINDOW')
    with bpy.context.temp_override(window=window, area=area, region=region):
        space.show_region_toolbar = False
        if area.type == 'VIEW_3D':
            space.overlay.show_overlays = space.show_gizmo = False
            bpy.ops.view3d.view_axis(type='FRONT')
            bpy.ops.view3d.view_selected()
            space.shading.type = 'MATERIAL'
            space.show_region_tool_header = False
        elif area.type == 'IMAGE_EDITOR':
            bpy.ops.wm.tool_set_by_id(name='koebe_uv.circles', space_type='IMAGE_EDITOR')
            bpy.ops.image.view_all(fit_view=True)
            space.show_region_tool_header = False
"""
IN_UV = """
window = bpy.context.window_manager.windows[0]
area = next(a for a in window.screen.areas if a.type == 'IMAGE_EDITOR')
region = next(r for r in area.regions if r.type == 'WINDOW')
"""
# A dome, whose UVs follow.
SHEET = """
for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)
bpy.ops.mesh.primitive_grid_add(x_subdivisions=14, y_subdivisions=14)
obj = bpy.context.object
for vertex in obj.data.vertices: vertex.co.z = -0.9 * (vertex.co.x ** 2 + vertex.co.y ** 2)
while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])
bpy.ops.uv.koebe_parts(seams="only", checker=False, margin=60)
bpy.context.window_manager.koebe_uv.islands.clear()
bpy.context.preferences.system.use_region_overlap = False
bpy.context.preferences.themes[0].view_3d.space.gradients.background_type = 'SINGLE_COLOR'
"""
EDITED = """
space = area.spaces.active
space.overlay.show_overlays = True
space.shading.type = 'SOLID'
bpy.ops.view3d.view_axis(type='FRONT')
bpy.ops.view3d.view_orbit(angle=0.8, type='ORBITUP')
bpy.context.tool_settings.mesh_select_mode = (True, False, False)
bpy.context.tool_settings.use_uv_select_sync = True
bpy.ops.object.mode_set(mode='EDIT')
bpy.ops.mesh.select_all(action='DESELECT')
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.object.data)
near = min(mesh.verts, key=lambda vertex: (vertex.co.xy - vertex.co.xy.__class__((0.4, -0.3))).length)
near.select_set(True)
bmesh.update_edit_mesh(bpy.context.object.data)
bpy.context.window_manager.koebe_live = True
"""
SEAM = """
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.object.data)
bpy.ops.mesh.select_all(action='DESELECT')
bpy.context.tool_settings.mesh_select_mode = (False, True, False)
for edge in mesh.edges: edge.select_set(all(abs(v.co.x) < 1e-2 and v.co.y < 0.05 for v in edge.verts))
bmesh.update_edit_mesh(bpy.context.object.data)
"""
UVS = """
import bmesh
mesh = bmesh.from_edit_mesh(bpy.context.view_layer.objects.active.data)
layer = mesh.loops.layers.uv.active
result = [tuple(loop[layer].uv) for face in mesh.faces for loop in face.loops]
"""
HOLE = "bpy.context.window_manager.koebe_uv.islands[0].loops[{}].uv_center"


class Film:
    """Takes pictures of the window, with the pointer in each."""

    def __init__(self, window, folder):
        self.window, self.folder = window, folder
        self.at = (SCREEN[0] // 2, SCREEN[1] - 60)
        self.pictures = []

    def take(self, hundredths=SHORT):
        """A picture, shown for so long."""
        for _ in range(3):
            self.window.ask("True")  # an answer comes once in a turn of Blender's main loop, which ends with drawing
        path = self.folder / f"{len(self.pictures):03d}.miff"
        subprocess.run(["import", "-window", "root", str(path)], check=True)
        arrow = " ".join(f"{self.at[0] + x},{self.at[1] + y}" for x, y in ARROW)
        self.pictures.append(["(", "-delay", str(hundredths), str(path), "-draw", f"polygon {arrow}", ")"])

    def glide(self, x, y, steps=4):
        """Bring the pointer there in steps, with a picture of each."""
        begin = self.at
        for step in range(1, steps + 1):
            self.at = tuple(int(a + (b - a) * step / steps) for a, b in zip(begin, (x, y), strict=True))
            gui.xdotool("mousemove", *self.at, "sleep", "0.12")
            self.take()

    def press(self):
        """Press the button of the mouse."""
        self.window.move(*self.at)
        self.window.settle()
        gui.xdotool("mousedown", 1, "sleep", "0.5")
        self.take(3 * SHORT)

    def let_go(self, hundredths=SHORT):
        """Let it go."""
        gui.xdotool("mouseup", 1, "sleep", "0.1", "mousemove_relative", "1", "0", "sleep", "0.1")
        self.window.settle()
        self.take(hundredths)

    def save(self, path):
        """All pictures as a GIF that repeats, in the colours of three of them."""
        shown = [word for picture in self.pictures for word in picture]
        some = [self.pictures[number][3] for number in (0, len(self.pictures) // 2, -1)]
        palette = str(self.folder / "palette.png")
        subprocess.run(["convert", *some, "+append", "+dither", "-colors", str(COLORS), "-unique-colors", palette],
                       check=True)  # fmt: skip
        subprocess.run(["convert", "-fill", "white", "-stroke", "black", *shown, "-crop",
                        f"{SCREEN[0]}x{SCREEN[1] - TOP}+0+{TOP}", "+repage", "+dither", "-remap", palette,
                        "-layers", "OptimizePlus", "-loop", "0", str(path)], check=True)  # fmt: skip


def pixel(window, u, v):
    """Where a place of the UVs is on the screen."""
    x, y = window.run(IN_UV + f"result = [c + o for c, o in zip("
                      f"region.view2d.view_to_region({u}, {v}, clip=False), (region.x, region.y))]")  # fmt: skip
    return x, SCREEN[1] - 1 - y


def unwrap(window, film, x, y):
    """Click the button, and wait for the map."""
    film.glide(x, y)
    film.press()
    window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
    film.let_go()
    window.wait(gui.DONE, 240.0)
    window.settle()
    film.take(LONG)


def main():
    gui.WIDTH, gui.HEIGHT = SCREEN
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        (package,) = (path for path in (ROOT / "dist").glob("koebe_uv-*.zip") if path.stem.count("-") == 1)
        window = gui.Window(str(package), home / "blender")
        try:
            film = Film(window, home)
            (play_live if sys.argv[2:] == ["live"] else play)(window, film)
        finally:
            window.close()
        film.save(sys.argv[1])


def play(window, film):
    """What is done in the film."""
    window.run(SCENE)
    window.workspace("UV Editing")
    window.run(EDITORS)
    window.settle()
    window.run(TIDY)
    window.settle()
    window.open_tab("VIEW_3D")
    button = window.find_button("VIEW_3D", "koebe_unwrap", step=10)
    x, top, width, _ = window.region("VIEW_3D", "UI")
    slider = next(y for y in range(button[1], top + 300, 6) if is_slider(window, x + width // 2, y))
    gui.xdotool("mousemove", *film.at)
    window.settle()
    film.take(LONG)
    unwrap(window, film, *button)
    hole = pixel(window, *window.ask(f"list({HOLE.format(1)})"))
    film.glide(*hole)
    film.press()
    film.glide(hole[0] - 45, hole[1] + 70, STEPS)
    film.glide(hole[0] + 60, hole[1] + 30, STEPS)
    film.let_go(LONG)
    film.glide(x + int(0.3 * width), slider)
    film.press()
    film.glide(x + int(0.52 * width), slider, 5)
    film.let_go(4 * SHORT)
    unwrap(window, film, *button)
    film.take(2 * LONG)


def play_live(window, film):
    """Live is on: a vertex is dragged, a seam is marked and cleared, and the UVs follow."""
    window.run(SHEET)
    window.workspace("UV Editing")
    window.run(EDITORS)
    window.settle()
    window.run(TIDY)
    window.run(in_view(EDITED))
    window.settle()
    x, y = window.middle("VIEW_3D")
    gui.xdotool("mousemove", *film.at)
    window.settle()
    film.take(LONG)
    film.glide(x, y)
    before = window.run(UVS)
    gui.xdotool("key", "g", "sleep", "0.2")
    film.glide(x, y - 14, 3)
    gui.xdotool("click", 1)
    follow(window, film, before)
    for clear in (False, True):
        before = window.run(UVS)
        window.run(in_view(f"{SEAM}bpy.ops.mesh.mark_seam('EXEC_DEFAULT', True, clear={clear})"))
        film.take(4 * SHORT)
        follow(window, film, before)


def follow(window, film, before):
    """Wait until the UVs have changed, and show them."""
    for _ in range(100):
        window.settle()
        if window.run(UVS) != before:
            break
    else:
        raise AssertionError("the UVs did not follow")
    film.take(LONG)


def in_view(code):
    """The code with the 3D View as context."""
    inside = "".join(f"    {line}\n" for line in code.strip().splitlines())
    return gui.IN_VIEW.format(window=0) + inside


def is_slider(window, x, y):
    """Whether the slider Even is at this place."""
    window.run("bpy.context.window_manager.clipboard = ''")
    window.move(x, y)
    gui.xdotool("key", "ctrl+shift+alt+c", "sleep", "0.05")
    return "koebe_uv.even" in window.ask("bpy.context.window_manager.clipboard")


if __name__ == "__main__":
    main()
