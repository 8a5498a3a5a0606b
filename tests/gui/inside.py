# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs inside Blender's window: installs the zip, answers questions over a socket, and feels for stalls.

Arguments after "--": ZIP SOCKET. A question is a line of JSON, {"code": ...}; the answer {"result": ...} or
{"error": ...}. The code runs on the main thread and leaves its answer in `result`.
"""

import json
import socket
import sys
import threading
import time
import traceback
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent.parent.parent / "scripts"))

from install_and_test import install  # noqa: E402

BEAT = 0.005  # seconds between two looks


class Heart:
    """Beats on the main thread whenever the interface is free; remembers the silences while a map was computed."""

    def __init__(self, path):
        self.silences = []
        self.computing = False
        self.last = time.perf_counter()
        self.server = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.server.bind(path)
        self.server.listen()
        self.server.setblocking(False)

    def beat(self):
        """Note the silence since the last beat, and answer who asks."""
        now = time.perf_counter()
        computing = any(thread.name == "koebe" for thread in threading.enumerate())
        if computing and self.computing:
            self.silences.append(now - self.last)
        self.last, self.computing = now, computing
        try:
            line, _ = self.server.accept()
        except BlockingIOError:
            return BEAT
        with line:
            line.setblocking(True)
            self.answer(line)
        self.last = time.perf_counter()
        return BEAT

    def answer(self, line):
        """Run one question's code."""
        names = {"bpy": bpy, "heart": self}
        try:
            with line.makefile() as lines:
                exec(json.loads(lines.readline())["code"], names)  # noqa: S102
            reply = {"result": names.get("result")}
        except Exception:
            reply = {"error": traceback.format_exc()}
        line.sendall(json.dumps(reply).encode() + b"\n")


def main():
    package, path = sys.argv[sys.argv.index("--") + 1 :]
    install(package)
    preferences = bpy.context.preferences
    preferences.view.show_splash = False
    preferences.view.smooth_view = 0
    preferences.view.show_developer_ui = True
    heart = Heart(path)
    bpy.app.timers.register(heart.beat, persistent=True)


main()
