# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender with a window, driven by real clicks and keys. Needs a display, xdotool and ImageMagick."""

import json
import os
import socket
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
PICTURES = ROOT / "out" / os.environ.get("PICTURES", "gui")
WIDTH, HEIGHT = map(int, os.environ.get("SCREEN_SIZE", "1280x800").split("x"))
START_SECONDS = 90
TAB = {"VIEW_3D": 164, "IMAGE_EDITOR": 174}  # pixels from a sidebar's top to the tab Koebe, below Blender's own
PARTS = (  # of the panel, that are closed at first
    "disk", "parts", "domains", "packing", "arrange", "layer", "tools", "lift", "shapes", "sequence", "accuracy",
)  # fmt: skip
FIRST_PART, PART = 315, 26  # pixels from a sidebar's top to the first title before any run, and from title to title
CIRCLES = 46  # pixels of what only the UV Editor's panel has: the tool Koebe Circles
SETTLE = 0.4  # seconds until a click or a key has had its effect on the screen


ENTRY = "bpy.context.window_manager.koebe_uv.islands[0]"
DONE = "not heart.computing and len(bpy.context.window_manager.koebe_uv.islands) == 1"
LAYERS = "len(bpy.context.view_layer.objects.active.data.uv_layers)"
TAB_OPEN = """next((r.active_panel_category for a in bpy.context.window_manager.windows[0].screen.areas
    if a.type == '{area}' for r in a.regions if r.type == 'UI' and hasattr(r, 'active_panel_category')), '')"""


def in_view(code, kind="VIEW_3D", window=0):
    """The code with an editor's main region as context."""
    return "\n".join([
        f"window = bpy.context.window_manager.windows[{window}]",
        f"area = next(a for a in window.screen.areas if a.type == '{kind}')",
        "region = next(r for r in area.regions if r.type == 'WINDOW')",
        "with bpy.context.temp_override(window=window, area=area, region=region):",
        *(f"    {line}" for line in code.strip().splitlines()), "",
    ])  # fmt: skip


def only(make, *finish):
    """Code that makes this model the only object: without UVs, smooth."""
    return "\n".join([
        "for obj in list(bpy.data.objects): bpy.data.objects.remove(obj)",
        f"bpy.ops.mesh.{make}",
        "obj = bpy.context.object",
        "while obj.data.uv_layers: obj.data.uv_layers.remove(obj.data.uv_layers[0])",
        *finish,
        "bpy.ops.object.shade_smooth()",
    ])  # fmt: skip


class Window:
    """Starts Blender; `ask` looks inside, everything else is what a hand does."""

    def __init__(self, package, home):
        self.path = str(home / "socket")
        environment = {
            **os.environ, "LIBGL_ALWAYS_SOFTWARE": "1", "PATH": "/usr/bin:" + os.environ["PATH"],
            "BLENDER_USER_RESOURCES": str(home), "BLENDER_USER_CONFIG": str(home / "config"),
            "BLENDER_USER_SCRIPTS": str(home / "scripts"), "BLENDER_USER_DATAFILES": str(home / "datafiles"),
        }  # fmt: skip
        for folder in ("config", "scripts/addons", "datafiles", "extensions"):
            (home / folder).mkdir(parents=True)
        command = [
            os.environ.get("BLENDER", "blender"), *os.environ.get("BLENDER_OPTIONS", "").split(), "--factory-startup",
            "--window-geometry", "0", "0", str(WIDTH), str(HEIGHT),
            "--python-exit-code", "1", "--python", Path(__file__).with_name("inside.py"), "--", package, self.path,
        ]  # fmt: skip
        self.log = (home / "log").open("w")
        self.process = subprocess.Popen(command, env=environment, stdout=self.log, stderr=subprocess.STDOUT)
        self.wait("True", START_SECONDS)
        time.sleep(1.0)
        PICTURES.mkdir(parents=True, exist_ok=True)

    def close(self):
        """End Blender."""
        self.process.kill()
        self.process.wait()
        self.log.close()

    def run(self, code):
        """Run code inside; return what it leaves in `result`."""
        with socket.socket(socket.AF_UNIX, socket.SOCK_STREAM) as line:
            line.settimeout(120)
            line.connect(self.path)
            line.sendall(json.dumps({"code": code}).encode() + b"\n")
            with line.makefile() as answers:
                reply = json.loads(answers.readline())
        assert "error" not in reply, reply["error"]
        return reply["result"]

    def ask(self, expression):
        """Value of an expression inside."""
        return self.run(f"result = {expression}")

    def wait(self, expression, seconds=120.0):
        """Wait until an expression is true inside."""
        end = time.monotonic() + seconds
        while True:
            try:
                if self.ask(expression):
                    return
            except (FileNotFoundError, ConnectionError):
                assert self.process.poll() is None, "Blender has ended"
            assert time.monotonic() < end, f"{expression} is not true after {seconds} s"
            time.sleep(0.02)

    def settle(self):
        """Wait until what was done has had its effect, and is drawn."""
        time.sleep(SETTLE)
        for _ in range(3):  # an answer comes once in a turn of Blender's main loop, which ends with drawing
            self.ask("True")

    # ---- what a hand does

    def move(self, x, y):
        """Bring the pointer there, from beside it: Blender looks at movements, and a button wakes at the second one.

        Between two movements Blender answers once, or a busy machine makes one movement of them.
        """
        for step in (6, 3, 0):
            xdotool("mousemove", x - step, y, "sleep", "0.07")
            self.ask("True")

    def click(self, x, y, button=1):
        """Click there."""
        self.move(x, y)
        xdotool("click", button)
        self.settle()

    def press(self, operator, window=0, **options):
        """Call an operator in the 3D View of a window as its button does, where the way to the button is no subject.

        Returns the error that it reports at once, if it does.
        """
        given = ", ".join(f"{name}={value!r}" for name, value in options.items())
        call = f"try: bpy.ops.{operator}('INVOKE_DEFAULT', {given})\nexcept RuntimeError as error: result = str(error)"
        return self.run(in_view(call, window=window))

    def key(self, *keys):
        """Press keys, one after the other."""
        for name in keys:
            xdotool("key", name)
            self.settle()

    def picture(self, name):
        """Keep what the screen shows as out/gui/NAME.png."""
        xdotool("mousemove_relative", "1", "0")  # what has changed is drawn with the next event
        self.settle()
        subprocess.run(["import", "-window", "root", str(PICTURES / f"{name}.png")], check=True)

    def prepare(self, model):
        """The model of this code selected in the 3D View, the sidebar open, and no report."""
        self.workspace("UV Editing")
        self.run(model)
        self.run("bpy.ops.ed.undo_push(message='made')\nbpy.context.window_manager.koebe_uv.islands.clear()")
        self.look_at_model("KP_Decimal")

    def look_at_model(self, *keys):
        """The sidebar of the 3D View open, the hand above the view, these keys pressed: the view from the front, with
        all of the model in it."""
        self.open_tab("VIEW_3D")
        self.move(*self.middle("VIEW_3D"))
        self.key(*(keys or ("KP_1", "KP_Decimal")))

    def follow_offer(self, refusing, taking, name):
        """Press the operator of a domain that refuses the model, keep a picture, and click the operator of another
        domain in the report, a shape of the main button. Returns what the report offered."""
        shape = "HANDLES" if taking == "schottky" else taking.upper()
        self.press(f"uv.koebe_{refusing}")
        self.wait(DONE, 240.0)
        self.settle()
        self.picture(name)
        refused, offer = self.ask(f"[not {ENTRY}.mapped, {ENTRY}.offer]")
        assert refused
        self.key("Escape")  # closes the error's popup, which covers buttons
        self.click(*self.find_button("VIEW_3D", f"shape='{shape}'"))
        self.wait(f"{DONE} and {ENTRY}.domain == {taking!r}", 240.0)
        return offer

    def picture_of_uvs(self, name):
        """Keep what the screen shows with all of the UVs in view."""
        self.move(*self.middle("IMAGE_EDITOR"))
        self.key("Home")
        self.picture(name)

    def undo(self, times=1):
        """Undo in the 3D View what made the only UV layer."""
        self.move(*self.middle("VIEW_3D"))
        assert self.ask(LAYERS) == 1
        for _ in range(times):
            self.key("ctrl+z")
        self.wait(f"{LAYERS} == 0", 240.0)

    # ---- where things are

    def region(self, area, kind):
        """x, y (from the top of the screen), width, height of a region of the first area of that type."""
        x, y, width, height = self.ask(
            f"[(r.x, r.y, r.width, r.height) for a in bpy.context.window_manager.windows[0].screen.areas "
            f"if a.type == {area!r} for r in a.regions if r.type == {kind!r}][0]"
        )
        return x, HEIGHT - y - height, width, height

    def middle(self, area):
        """The middle of an area's main region, as far as the sidebar does not cover it."""
        x, y, width, height = self.region(area, "WINDOW")
        sidebar, _, covered, _ = self.region(area, "UI")
        if covered > 1:
            width = sidebar - x
        return x + width // 2, y + height // 2

    def open_tab(self, area):
        """Open the sidebar of an area at the tab Koebe, which is the last one."""
        if self.region(area, "UI")[2] <= 1:
            self.move(*self.middle(area))
            self.key("n")
        x, top, width, height = self.region(area, "UI")
        for y in range(top + TAB[area], top + height, 30):  # an extension of 5.2 has a tab before it
            self.click(x + width - 12, y)
            if self.ask(TAB_OPEN.format(area=area)) in {"Koebe", ""}:
                return
        raise AssertionError(f"no tab Koebe in {area}")

    def open_part(self, part, area="VIEW_3D"):
        """Open a part of the panel in an area that is closed at first, the report empty."""
        x, top, _, _ = self.region(area, "UI")
        self.click(x + 70, top + FIRST_PART + CIRCLES * (area == "IMAGE_EDITOR") + PART * PARTS.index(part))

    def choose(self, **options):
        """Set options of the panel, and let it be drawn again: a button has the options of when it was drawn."""
        for name, value in options.items():
            self.run(f"bpy.context.scene.koebe_uv.{name} = {value!r}\n"
                     "for area in bpy.context.window_manager.windows[0].screen.areas: area.tag_redraw()")  # fmt: skip
        self.settle()

    def workspace(self, name):
        """Show a workspace, and wait until it is there."""
        self.run(f"bpy.context.window_manager.windows[0].workspace = bpy.data.workspaces[{name!r}]")
        self.wait(f"bpy.context.window_manager.windows[0].workspace.name == {name!r}")
        self.run("for area in bpy.context.window_manager.windows[0].screen.areas:\n"
                 "    if area.type == 'VIEW_3D':  # no wires of lamps and cameras over the model\n"
                 "        overlay = area.spaces.active.overlay\n"
                 "        overlay.show_extras = overlay.show_cursor = False")  # fmt: skip
        self.settle()

    def show_textures(self):
        """Show the model with its textures. Without a GPU, Material Preview takes minutes from 4.2 on."""
        self.run("for area in bpy.context.window_manager.windows[0].screen.areas:\n"
                 "    if area.type == 'VIEW_3D':\n"
                 "        shading = area.spaces.active.shading\n"
                 "        shading.type = 'MATERIAL' if bpy.app.version < (4, 2, 0) else 'SOLID'\n"
                 "        if shading.type == 'SOLID': shading.color_type = 'TEXTURE'")  # fmt: skip
        self.settle()

    def scroll_down(self, area="VIEW_3D"):
        """To the end of an area's sidebar."""
        x, top, _, height = self.region(area, "UI")
        self.move(x + 4, top + height // 2)
        for _ in range(30):
            xdotool("click", 5)
        self.settle()

    def find_button(self, area, text, fraction=0.5, step=14):
        """Where in the sidebar of an area a button is whose Python command has this text (Ctrl C copies it).

        fraction  of the sidebar's width, from the left; or pixels from the left, or negative ones from the right
        """
        x, top, width, height = self.region(area, "UI")
        x += int(fraction * width if abs(fraction) < 1 else fraction % width)
        for y in 2 * [*range(top + step, top + height, step)]:  # twice, if a busy machine is late with an answer
            self.run("bpy.context.window_manager.clipboard = ''")
            self.move(x, y)
            xdotool("key", "ctrl+c", "sleep", "0.05")
            self.ask("True")
            if text in self.ask("bpy.context.window_manager.clipboard"):
                return x, y + step // 2
        raise AssertionError(f"no button {text!r} in the sidebar of {area}")


def xdotool(*arguments):
    """Run xdotool."""
    subprocess.run(["xdotool", *map(str, arguments)], check=True)
