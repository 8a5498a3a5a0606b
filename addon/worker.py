# SPDX-License-Identifier: GPL-3.0-or-later
"""A computation on a thread of its own, with its progress and its end to be polled. No bpy."""

import threading


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
        try:
            self._compute(self._progress)
        except BaseException as error:  # handed to the thread that polls
            self._error = error

    def _progress(self, fraction, stage):
        self.fraction, self.stage = fraction, stage
