# SPDX-License-Identifier: GPL-3.0-or-later
"""Computations side by side on the cores: the native package does not need Python while it computes."""

import collections
import concurrent.futures
import dataclasses
import os
from collections.abc import Callable, Sequence
from typing import Generic, TypeVar

from .outcomes import Progress

MOST_IN_HAND = 1_000_000  # triangles of all running computations, to limit memory; a larger one runs alone
POLL_SECONDS = 0.05  # interval of progress reports

T = TypeVar("T")


@dataclasses.dataclass(frozen=True)
class Unit(Generic[T]):
    """A computation: `compute(progress)` may run on any thread; `size` is its work in triangles."""

    size: int
    compute: Callable[[Progress | None], T]


def core_count() -> int:
    """The number of threads of this process that can run at once."""
    try:
        return len(os.sched_getaffinity(0))
    except AttributeError:  # Windows and macOS do not have it
        return os.cpu_count() or 1


def side_by_side(
    units: Sequence[Unit[T]],
    threads: int,
    progress: Progress | None,
    stop: Callable[[], None],
    counts: Callable[[T], bool],
) -> list[T]:
    """The results of the units in their order, whichever ends first.

    At most `threads` run at once, 0: one for each core. `progress` is called on this thread with the finished share of
    all work. With one unit or one thread everything runs on this thread. Work of a unit whose result does not `counts`
    must be done again by the caller. If a unit or `progress` raises, calls `stop` so that the others end soon, waits
    for them, and raises the error.
    """
    threads = min(threads or core_count(), len(units))
    shared = _Shared([unit.size for unit in units], progress)
    if threads < 2:
        alone = []
        for index, unit in enumerate(units):
            alone.append(unit.compute(shared.of(index, tell=True)))
            shared.fractions[index] = float(counts(alone[-1]))
        return alone
    results: dict[int, T] = {}
    # Start with the largest, so that all cores are busy to the end.
    waiting = collections.deque(sorted(range(len(units)), key=lambda index: -units[index].size))
    running: dict[concurrent.futures.Future[T], int] = {}
    with concurrent.futures.ThreadPoolExecutor(threads, thread_name_prefix="koebe") as pool:
        try:
            while waiting or running:
                while waiting and len(running) < threads and _has_room(units, running.values(), waiting[0]):
                    index = waiting.popleft()
                    running[pool.submit(units[index].compute, shared.of(index, tell=False))] = index
                done = concurrent.futures.wait(
                    running, POLL_SECONDS, return_when=concurrent.futures.FIRST_COMPLETED
                ).done
                for future in done:
                    index = running.pop(future)
                    results[index] = future.result()
                    shared.fractions[index] = float(counts(results[index]))
                shared.tell()
        except BaseException:
            stop()
            raise
    return [results[index] for index in range(len(units))]


def _has_room(units: Sequence[Unit[T]], running: "collections.abc.ValuesView[int]", index: int) -> bool:
    in_hand = sum(units[one].size for one in running)
    return not in_hand or in_hand + units[index].size <= MOST_IN_HAND


class _Shared:
    """The progress of all units. Each unit notes its own, and one thread reports the sum, which never falls."""

    def __init__(self, sizes: list[int], progress: Progress | None) -> None:
        self.fractions = [0.0] * len(sizes)
        self._sizes, self._total, self._progress = sizes, max(sum(sizes), 1), progress
        self._stage, self._reported = "", (0.0, "")

    def of(self, index: int, tell: bool) -> Progress | None:
        """The progress of one unit; `tell` if its thread reports the sum."""
        if self._progress is None:
            return None

        def note(fraction: float, stage: str) -> None:
            self.fractions[index], self._stage = fraction, stage
            if tell:
                self.tell()

        return note

    def tell(self) -> None:
        if self._progress is None:
            return
        done = sum(size * fraction for size, fraction in zip(self._sizes, self.fractions, strict=True)) / self._total
        news = max(done, self._reported[0]), self._stage
        if news != self._reported and news[1]:
            self._reported = news
            self._progress(*news)
