"""The thread that computes: progress, result and error come over."""

import os
import sys
import threading

import pytest

pytestmark = pytest.mark.alike


def test_result_waits_and_progress_is_seen(addon):
    may_end = threading.Event()
    seen = []

    def compute(progress):
        progress(0.25, "factor")
        may_end.wait(10)
        seen.append(threading.current_thread())

    worker = addon("solver.worker").Worker(compute)
    while worker.stage != "factor":
        assert worker.running
    assert worker.fraction == 0.25
    may_end.set()
    worker.result()
    assert not worker.running
    assert seen != [threading.current_thread()]


def test_an_error_is_raised_where_the_result_is_asked_for(addon):
    def compute(progress):
        raise ValueError("from the thread")

    worker = addon("solver.worker").Worker(compute)
    with pytest.raises(ValueError, match="from the thread"):
        worker.result()


@pytest.mark.skipif(sys.platform != "linux", reason="threads have no priority of their own")
def test_the_thread_stands_back_and_nobody_else(addon):
    here = os.getpriority(os.PRIO_PROCESS, 0)
    seen = []
    addon("solver.worker").Worker(lambda progress: seen.append(os.getpriority(os.PRIO_PROCESS, 0))).result()
    assert seen == [min(here + addon("solver.worker").NICENESS, 19)]
    assert os.getpriority(os.PRIO_PROCESS, 0) == here
