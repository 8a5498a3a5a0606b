# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures that extensions.blender.org asks for, at its sizes, of the add-on at work.

    xvfb-run -a -s '-screen 0 1920x1080x24' /usr/bin/python3 scripts/listing/pictures.py FOLDER [KIND...]
                                                               KIND: icon, featured, window; all of them by default

It needs what tests/gui needs: the zip of `make package`, a display, xdotool, ImageMagick; and Blender and rsvg-convert.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "gui")]

import demo  # noqa: E402
import guide_film as film  # noqa: E402
import window as gui  # noqa: E402

SIZE = (1920, 1080)
ICON = 256
CELLS = 9  # of the icon's checker, across
PAPER, TEAL, INK = "#f3f0e6", "#3f7d92", "#1b2a41"
HOLES = ((-0.42, 0.3, 0.22, "#7b3fa0"), (0.42, 0.3, 0.22, "#f0a020"), (0.0, -0.52, 0.17, "#d94a3a"))
OPEN = """
bpy.ops.wm.open_mainfile(filepath={path!r}, load_ui=False)
view = bpy.context.window_manager.windows[0].view_layer
for obj in view.objects: obj.select_set(obj.type == 'MESH')
view.objects.active = next(obj for obj in view.objects if obj.type == 'MESH')
bpy.context.window_manager.koebe_uv.islands.clear()
bpy.context.scene.koebe_uv.checker_size = 24
"""


def icon() -> str:
    """A circle domain in a checker, with the rings that the add-on draws round holes."""
    side = 2 / CELLS
    cells = "".join(
        f'<rect x="{-1 + column * side}" y="{-1 + row * side}" width="{side}" height="{side}"/>'
        for row in range(CELLS) for column in range(CELLS) if (row + column) % 2)
    holes = "".join(f'<circle cx="{x}" cy="{-y}" r="{r}" fill="{INK}" stroke="{color}" stroke-width="0.07"/>'
                    for x, y, r, color in HOLES)
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="-1.1 -1.1 2.2 2.2"><clipPath id="disk"><circle r="1"/>'
            f'</clipPath><circle r="1.03" fill="{INK}"/><g clip-path="url(#disk)"><circle r="1" fill="{PAPER}"/>'
            f'<g fill="{TEAL}">{cells}</g></g><circle r="1" fill="none" stroke="{INK}" stroke-width="0.07"/>{holes}'
            "</svg>")


def draw_icon(folder: Path) -> None:
    subprocess.run(["rsvg-convert", "--width", str(ICON), "--height", str(ICON), "--output", folder / "icon.png"],
                   input=icon().encode(), check=True)  # fmt: skip


def draw_featured(folder: Path, home: Path) -> None:
    """The mask and its circle domain, drawn by Cycles."""
    mapped, picture = home / "mapped.blend", home / "featured.png"
    source = ROOT / "blend_samples" / "suzanne_mask.blend"
    demo.run_script("blender", ROOT / "addon" / "batch.py", ["--output", mapped, *demo.LOOK], source)
    drawn = ["--output", picture, "--size", f"{SIZE[0]}x{SIZE[1]}", "--samples", "16"]
    demo.run_script("blender", ROOT / "scripts" / "render_uv.py", drawn, mapped)
    save(picture, folder / "featured.jpg")


def save(picture: Path, path: Path) -> None:
    subprocess.run(["convert", picture, "-strip", "-quality", "90", path], check=True)


class Window(gui.Window):
    """Blender's window, of the size of a preview."""

    def shot(self, folder: Path, home: Path, name: str) -> None:
        gui.xdotool("mousemove", SIZE[0] // 2, SIZE[1] - 8)
        self.settle()
        subprocess.run(["import", "-window", "root", home / f"{name}.png"], check=True)
        save(home / f"{name}.png", folder / f"{name}.jpg")

    def open(self, sample: str) -> None:
        self.run(OPEN.format(path=str(ROOT / "blend_samples" / f"{sample}.blend")))

    def unwrap(self, **options: object) -> None:
        """Press the button."""
        self.choose(**options)
        self.click(*self.find_button("VIEW_3D", "koebe_unwrap"))
        self.wait("not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) > 0", 300.0)
        self.settle()


def take(window: Window, folder: Path, home: Path) -> None:
    """All pictures of the window."""
    window.open("face_five_holes")
    window.workspace("Layout")
    window.look_at_model()
    window.unwrap()
    window.show_textures()
    window.shot(folder, home, "preview_panel")
    for sample, shape, name in (("face_surprised", "DISK", "preview_disk"), ("hand", "PARTS", "preview_parts")):
        window.workspace("UV Editing")
        window.open(sample)
        window.run("for polygon in bpy.context.view_layer.objects.active.data.polygons: polygon.use_smooth = True")
        window.run(film.EDITORS)
        window.settle()
        window.run(film.TIDY)
        window.settle()
        window.open_tab("VIEW_3D")
        window.unwrap(shape=shape)
        window.run(film.TIDY)
        window.shot(folder, home, name)


def main() -> None:
    folder, wanted = Path(sys.argv[1]).absolute(), sys.argv[2:] or ["icon", "featured", "window"]
    folder.mkdir(parents=True, exist_ok=True)
    if "icon" in wanted:
        draw_icon(folder)
    with tempfile.TemporaryDirectory() as home:
        if "featured" in wanted:
            draw_featured(folder, Path(home))
        if "window" not in wanted:
            return
        (package,) = (path for path in (ROOT / "dist").glob("koebe_uv-*.zip") if path.stem.count("-") == 1)
        gui.WIDTH, gui.HEIGHT = SIZE
        window = Window(str(package), Path(home) / "blender")
        try:
            take(window, folder, Path(home))
        finally:
            window.close()


if __name__ == "__main__":
    main()
