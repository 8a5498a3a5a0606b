# SPDX-License-Identifier: GPL-3.0-or-later
"""How a batch run ends: exit codes, its reason in one line, and signals."""

import contextlib
import os
import signal
import sys
import threading
import time
from collections.abc import Iterable
from types import FrameType
from typing import Any, TextIO

from .flags import in_flags

LAST_SECONDS = 5.0  # for a process whose starter is gone
DONE, BROKEN, USAGE, UNMAPPABLE, NOT_CONVERGED, INTERRUPTED = 0, 1, 2, 3, 4, 130


class Stop(Exception):
    """The end of the run: its exit code, the reason told on stderr, and for the report an error's name and entries."""

    def __init__(self, code: int, reason: object, name: str = "", objects: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(code, reason)
        self.code, self.reason, self.objects = code, in_flags(reason), list(objects)
        self.name = name or ("UsageError" if code == USAGE else "Error")


def refusal(reasons: dict[str, str]) -> Stop:
    """The end because objects cannot be mapped: reasons by name."""
    entries = [{"object": name, "error": {"name": "TransferError", "reason": text}} for name, text in reasons.items()]
    lines = "; ".join(f"{name}: {reason}" for name, reason in reasons.items())
    return Stop(UNMAPPABLE, lines, "TransferError", entries)


class Signals:
    """Ctrl-C, SIGTERM and SIGHUP are noted when they come, and obeyed where nothing can be left half done.

    Blender 3.4 keeps Ctrl-C to itself, and would let the others end it at any moment.
    """

    def __init__(self) -> None:
        self.came = False
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK"):
            number = getattr(signal, name, None)
            # What the caller has ignored, as nohup does, stays ignored.
            if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, self._note)

    def watch_input(self) -> None:
        """From now on the end of standard input counts as a signal: that of the process which started this one."""
        threading.Thread(target=self._wait_for_input, name="koebe input", daemon=True).start()

    def _wait_for_input(self) -> None:
        with contextlib.suppress(OSError):
            while os.read(0, 1):
                pass
        self.came = True
        time.sleep(LAST_SECONDS)  # nobody is there to wait for the end of what is read or written
        os._exit(INTERRUPTED)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.came = True

    def obey(self) -> None:
        """End the run if a signal came."""
        if self.came:
            raise Stop(INTERRUPTED, "interrupted: nothing was written")


def say(text: str, stream: TextIO) -> None:
    """Print one line, whatever the text holds; a stream that is closed or full does not end the run."""
    line = " ".join(text.splitlines())
    with contextlib.suppress(OSError, ValueError):
        encoding = stream.encoding or "utf-8"
        print(line.encode(encoding, "backslashreplace").decode(encoding), file=stream, flush=True)


def drop_what_cannot_be_printed() -> None:
    """Give up what a closed or full stream still holds: Python tries it again at its end, and 3.13 ends by 120 then."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            with contextlib.suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def tell(text: object) -> None:
    """Say why on stderr."""
    say(f"koebe: {in_flags(text)}", sys.stderr)
