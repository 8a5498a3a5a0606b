"""The add-on's computations side by side: order, errors, cancel, progress, memory; what is several surfaces at once.

Without Blender.
"""

import threading
import time

import numpy as np
import pytest


@pytest.fixture(scope="module")
def side(addon):
    return addon("maps.side_by_side")


class Work:
    """Units that note when they run."""

    def __init__(self, side, sizes, seconds=0.02, fails=()):
        self.lock, self.running, self.most, self.started, self.threads = threading.Lock(), 0, 0, [], set()
        self.stopped = threading.Event()
        self.in_hand, self.most_in_hand = 0, 0
        self.seconds, self.fails = seconds, fails
        self.units = [side.Unit(size, lambda progress, i=i, size=size: self.run(i, size, progress))
                      for i, size in enumerate(sizes)]  # fmt: skip

    def run(self, index, size, progress):
        with self.lock:
            self.running += 1
            self.in_hand += size
            self.most, self.most_in_hand = max(self.most, self.running), max(self.most_in_hand, self.in_hand)
            self.started.append(index)
            self.threads.add(threading.current_thread())
        try:
            if index in self.fails:
                raise ZeroDivisionError(index)
            for step in range(5):
                if self.stopped.wait(self.seconds / 5):
                    raise InterruptedError
                if progress:
                    progress((step + 1) / 5, f"stage {step}")
            return index * index
        finally:
            with self.lock:
                self.running -= 1
                self.in_hand -= size


def run(side, work, threads, progress=None, counts=lambda result: True):
    return side.side_by_side(work.units, threads, progress, work.stopped.set, counts)


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
def test_results_are_in_order_and_so_many_run_at_once(side, threads):
    work = Work(side, [5, 1, 4, 2, 3, 6])
    assert run(side, work, threads) == [0, 1, 4, 9, 16, 25]
    assert work.most == min(threads, 6)
    assert (work.threads == {threading.current_thread()}) == (threads == 1)


def test_without_a_number_all_cores_are_taken(side):
    work = Work(side, [1] * 2 * side.core_count())
    run(side, work, 0)
    assert work.most == side.core_count()


def test_the_largest_come_first(side):
    work = Work(side, [5, 1, 4, 2, 3, 6])
    run(side, work, 2)
    assert set(work.started[:2]) == {5, 0} and work.started[-1] == 1


def test_nothing_and_one_run_on_this_thread(side):
    assert run(side, Work(side, []), 4) == []
    work = Work(side, [7])
    assert run(side, work, 4) == [0] and work.threads == {threading.current_thread()}


def test_large_ones_do_not_share_the_memory(side, monkeypatch):
    monkeypatch.setattr(side, "MOST_IN_HAND", 10)
    work = Work(side, [25, 9, 8, 1, 1, 1])
    run(side, work, 3)
    assert work.most_in_hand == 25
    work = Work(side, [6, 6, 4, 4])
    run(side, work, 3)
    assert work.most_in_hand == 10


@pytest.mark.parametrize("threads", [1, 3])
def test_progress_comes_on_this_thread_and_never_falls(side, threads):
    told, threads_of_told = [], set()

    def progress(fraction, stage):
        told.append(fraction)
        threads_of_told.add(threading.current_thread())

    work = Work(side, [10, 20, 30, 40], seconds=0.3)
    run(side, work, threads, progress)
    assert threads_of_told == {threading.current_thread()}
    assert told == sorted(told) and len(told) > 4 and 0.0 < told[0] < told[-1] <= 1.0
    assert told[-1] == pytest.approx(1.0) or threads == 1


def test_work_that_is_to_be_done_again_is_not_counted(side):
    told = []
    work = Work(side, [10, 30], seconds=0.2)
    run(side, work, 2, lambda fraction, stage: told.append(fraction), counts=lambda result: result == 0)
    assert told == sorted(told) and told[-1] <= 1.0


@pytest.mark.parametrize("threads", [1, 2])
def test_an_error_stops_the_others_and_is_raised_when_they_have_ended(side, threads):
    work = Work(side, [1] * 10, seconds=40, fails={0})
    begin = time.monotonic()
    with pytest.raises(ZeroDivisionError):
        run(side, work, threads)
    assert time.monotonic() - begin < 20 and work.running == 0
    assert len(work.started) <= threads


def test_an_exception_of_the_progress_ends_everything(side):
    work = Work(side, [1] * 10, seconds=5)

    def progress(fraction, stage):
        raise KeyboardInterrupt

    begin = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        run(side, work, 2, progress)
    assert time.monotonic() - begin < 15 and work.running == 0 and len(work.started) <= 4


def test_surfaces_that_are_numbered_one_after_the_other_are_seen_to_be_several(addon):
    falls_apart = addon("surfaces.islands")._falls_apart
    chance = np.random.default_rng(1)
    found = set()
    for _ in range(500):
        count = chance.integers(3, 12)
        triangles = [chance.choice(count, 3, replace=False) for _ in range(chance.integers(1, 6))]
        used, triangles = np.unique(triangles, return_inverse=True)
        triangles = triangles.reshape(-1, 3).astype(np.int32)
        expected = any(
            not ((triangles.min(axis=1) <= k) & (triangles.max(axis=1) > k)).any() for k in range(len(used) - 1)
        )
        assert falls_apart(triangles, len(used)) == expected
        found.add(expected)
    assert found == {True, False}
