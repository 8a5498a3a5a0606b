"""While a map of 150,000 faces is computed the window answers, and Esc ends it."""

import os
import subprocess
import sys
import threading
import time

import pytest
from window import PICTURES, ROOT, xdotool

STALL = 0.1  # seconds, beside the time that Blender takes to draw its window once while all cores are busy
ESCAPE = 0.2
FOLDER = PICTURES / "samples"  # of each Blender its own: an older one cannot read it
# The operator's own account: what came in, what it answered, when.
WATCH = """
import sys, time
name = next(n for n in sys.modules if n.endswith('koebe_uv.operators.unwrap'))
operator = sys.modules[name].UV_OT_koebe_unwrap
if not hasattr(heart, 'answers'):
    inner = operator.modal
    def modal(self, context, event):
        answer = inner(self, context, event)
        heart.answers.append((event.type, sorted(answer)[0], time.time()))
        return answer
    operator.modal = modal
heart.answers = []
"""


@pytest.fixture
def dense(open_sample):
    """The sample with 150,520 faces, made if it is missing."""
    if not (FOLDER / "face_dense.blend").is_file():
        make = [ROOT / "blend_samples" / "make_samples.py", "--", "--output", FOLDER, "--only", "face_dense"]
        subprocess.run(["blender", "-b", "--factory-startup", "-P", *map(str, make)], check=True)
    return open_sample("face_dense", FOLDER)


DRAW = """
import time
result = 0.0
with bpy.context.temp_override(window=bpy.context.window_manager.windows[0]):
    for _ in range(5):
        start = time.perf_counter()
        bpy.ops.wm.redraw_timer(type='DRAW_WIN_SWAP', iterations=1)
        result = max(result, time.perf_counter() - start)
"""


def drawing_beside_a_computation(window):
    """The longest of five drawings of the window, in seconds, while other processes keep all cores busy."""
    busy = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(os.cpu_count())]
    try:
        return window.run(DRAW)
    finally:
        for process in busy:
            process.kill()
            process.wait()


class Idler:
    """A thread of this process that only sleeps: the longest it overslept is what the machine withholds from all."""

    def __init__(self):
        self.longest = 0.0
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._sleep)
        self._thread.start()

    def _sleep(self):
        last = time.perf_counter()
        while not self._ended.wait(0.005):
            now = time.perf_counter()
            self.longest, last = max(self.longest, now - last), now

    def end(self):
        """Stop; return the longest time between two awakenings."""
        self._ended.set()
        self._thread.join()
        return self.longest


def start(window):
    """Click the button and wait for the thread, and no longer: the map may be done soon."""
    window.move(*window.button)
    xdotool("click", 1)
    window.wait("heart.computing or len(bpy.context.window_manager.koebe_uv.islands) > 0")


def test_escape_and_no_stall(window, dense):
    window.run(WATCH)
    window.button = window.find_button("VIEW_3D", "koebe_unwrap")
    window.run(DRAW)  # a file just opened takes a third of a second for each of its first pictures
    waits = []
    window.run("heart.updates = []\nbpy.app.handlers.depsgraph_update_post.append(lambda *_: heart.updates.append(1))")
    window.run("bpy.context.scene.koebe_uv.polish = True")  # without it the map is done before Esc is pressed
    for delay in (0.0, 0.2, 0.4):
        start(window)
        time.sleep(delay)
        pressed = time.time()
        xdotool("key", "Escape")
        window.wait("any(answer in {'CANCELLED', 'FINISHED'} for _, answer, _ in heart.answers)")
        assert window.ask("heart.answers[-1][1]") == "CANCELLED", "the map was done before Esc was pressed"
        waits.append(window.ask("heart.answers[-1][2]") - pressed)
        assert window.ask("len(bpy.context.view_layer.objects.active.data.uv_layers)") == 0
        assert window.ask("len(bpy.context.window_manager.koebe_uv.islands)") == 0
        window.wait("not heart.computing")
        window.run("heart.answers.clear()")
        assert window.ask("heart.updates") == [], "Blender draws everything anew, and Esc waits"
    window.run("bpy.app.handlers.depsgraph_update_post.pop()")
    window.picture("20_cancelled")
    window.run("bpy.context.scene.koebe_uv.polish = False")

    drawing = drawing_beside_a_computation(window)
    time.sleep(1.0)
    window.run("heart.silences.clear()")
    idler = Idler()
    start(window)
    window.wait("not heart.computing")
    overslept = idler.end()
    silences = window.ask("heart.silences")
    window.wait("len(bpy.context.window_manager.koebe_uv.islands) > 0")
    window.picture("22_done")
    window.run("bpy.context.window_manager.koebe_uv.islands.clear()")
    start(window)
    window.picture("21_running")  # not of the run that was measured: a picture holds up the screen
    window.wait("not heart.computing")
    print(f"Esc after {', '.join(f'{wait:.3f}' for wait in waits)} s; {len(silences)} beats in {sum(silences):.1f} s, "
          f"longest silences {', '.join(f'{s:.3f}' for s in sorted(silences)[:-4:-1])} s, drawing the window "
          f"{drawing:.3f} s; a process that only sleeps overslept {overslept:.3f} s", file=sys.stderr)  # fmt: skip
    assert max(waits) <= ESCAPE + 2 * drawing  # Esc is looked at between two pictures, and the click's own comes first
    assert max(silences) <= STALL + drawing
