# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation on its own thread, with progress and end to be polled."""

import contextlib
import os
import sys
import threading
from collections.abc import Callable

NICENESS = 3  # of the computation: the window goes first, and other busy programs do not stop the computation


class Worker:
    """Runs `compute(progress)` on a thread. Poll `running`; when it is false call `result`.

    At exit Python waits for the thread, as stopping it inside native code could crash the program.
    """

    def __init__(self, compute: Callable[[Callable[[float, str], None]], None]) -> None:
        self.fraction = 0.0
        self.stage = ""
        self._compute = compute
        self._error: BaseException | None = None
        self._thread = threading.Thread(target=self._run, name="koebe")
        self._thread.start()

    @property
    def running(self) -> bool:
        """Whether the computation is still running."""
        return self._thread.is_alive()

    def result(self) -> None:
        """Wait for the end; raise the computation's error."""
        self._thread.join()
        if self._error is not None:
            raise self._error

    def _run(self) -> None:
        _stand_back()
        try:
            self._compute(self._progress)
        except BaseException as error:  # for the thread that polls
            self._error = error

    def _progress(self, fraction: float, stage: str) -> None:
        self.fraction, self.stage = fraction, stage


def _stand_back() -> None:
    """Lower the priority of this thread, and of the threads that it starts, if the system has priorities per thread."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError):
            thread = threading.get_native_id()
            os.setpriority(os.PRIO_PROCESS, thread, os.getpriority(os.PRIO_PROCESS, thread) + NICENESS)
