# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation on a thread of its own, with its progress and its end to be polled."""

import contextlib
import os
import sys
import threading

NICENESS = 10  # steps by which the computation's threads stand back behind those that draw the window


class Worker:
    """Runs `compute(progress)` on a thread. Poll `running`; when it is false call `result`.

    Python waits for the thread when it ends: to be cut off in native code could bring the program down.
    """

    def __init__(self, compute):
        self.fraction = 0.0
        self.stage = ""
        self._compute = compute
        self._error = None
        self._thread = threading.Thread(target=self._run, name="koebe")
        self._thread.start()

    @property
    def running(self):
        """Whether the computation has not ended yet."""
        return self._thread.is_alive()

    def result(self):
        """Wait for the end; raise what the computation raised."""
        self._thread.join()
        if self._error is not None:
            raise self._error

    def _run(self):
        _stand_back()
        try:
            self._compute(self._progress)
        except BaseException as error:  # handed to the thread that polls
            self._error = error

    def _progress(self, fraction, stage):
        self.fraction, self.stage = fraction, stage


def _stand_back():
    """Lower the priority of this thread, and of those it will start, where the system has one for each thread."""
    if sys.platform == "linux":
        with contextlib.suppress(OSError):
            thread = threading.get_native_id()
            os.setpriority(os.PRIO_PROCESS, thread, os.getpriority(os.PRIO_PROCESS, thread) + NICENESS)
