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

from ..maps.option_table import table
from .flag_names import in_flags

LAST_SECONDS = 5.0  # for a process whose starter has ended
DONE, BROKEN, USAGE, UNMAPPABLE, NOT_CONVERGED, INTERRUPTED = (code for _, code, _ in table("exit_codes"))


class Stop(Exception):
    """Ends the run: its exit code, the reason for stderr, and an error's name and entries for the report."""

    def __init__(self, code: int, reason: object, name: str = "", objects: Iterable[dict[str, Any]] = ()) -> None:
        super().__init__(code, reason)
        self.code, self.reason, self.objects = code, in_flags(reason), list(objects)
        self.name = name or ("UsageError" if code == USAGE else "Error")


def refusal(reasons: dict[str, str]) -> Stop:
    """A Stop because objects cannot be mapped: reasons by name."""
    entries = [{"object": name, "error": {"name": "TransferError", "reason": text}} for name, text in reasons.items()]
    lines = "; ".join(f"{name}: {reason}" for name, reason in reasons.items())
    return Stop(UNMAPPABLE, lines, "TransferError", entries)


class Signals:
    """Notes Ctrl-C, SIGTERM and SIGHUP when they come, and obeys them where nothing is left half done.

    Blender 3.4 takes Ctrl-C itself, and the other signals would end it at any moment.
    """

    def __init__(self) -> None:
        self.came = False
        for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK"):
            number = getattr(signal, name, None)
            # Signals that the caller ignores, as nohup does, stay ignored.
            if number is not None and signal.getsignal(number) is not signal.SIG_IGN:
                signal.signal(number, self._note)

    def watch_input(self) -> None:
        """From now on the end of standard input counts as a signal: the process that started this one has ended."""
        threading.Thread(target=self._wait_for_input, name="koebe input", daemon=True).start()

    def _wait_for_input(self) -> None:
        with contextlib.suppress(OSError):
            while os.read(0, 1):
                pass
        self.came = True
        time.sleep(LAST_SECONDS)  # no process waits for the end of this one's reading or writing
        os._exit(INTERRUPTED)

    def _note(self, number: int, frame: FrameType | None) -> None:
        self.came = True

    def obey(self) -> None:
        """End the run if a signal came."""
        if self.came:
            raise Stop(INTERRUPTED, "interrupted: nothing was written")


def say(text: str, stream: TextIO) -> None:
    """Print one line with any text. A closed or full stream does not end the run."""
    line = " ".join(text.splitlines())
    with contextlib.suppress(OSError, ValueError):
        encoding = stream.encoding or "utf-8"
        print(line.encode(encoding, "backslashreplace").decode(encoding), file=stream, flush=True)


def drop_what_cannot_be_printed() -> None:
    """Discard the rest in a closed or full stream: Python tries to write it at exit, and 3.13 then exits with 120."""
    for stream in (sys.stdout, sys.stderr):
        try:
            stream.flush()
        except (OSError, ValueError):
            with contextlib.suppress(OSError, ValueError):
                os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def tell(text: object) -> None:
    """Print a reason on stderr."""
    say(f"koebe: {in_flags(text)}", sys.stderr)
