# SPDX-License-Identifier: GPL-3.0-or-later
"""All or nothing: before any writing into Blender's data, its undoing is noted here.

An operator computes first, then checks that it can write, then writes inside `transaction()`. If an exception leaves
that, everything is undone, in reverse order. Inside it every object is an `attempt` of its own: a failed one is undone
alone, and the others go on.
"""

import contextlib
import functools
import traceback
from collections.abc import Callable, Iterator
from typing import Any


class Transaction:
    """Undoes everything written so far."""

    def __init__(self) -> None:
        self._restores: list[Callable[[], None]] = []

    def before_write(self, restore: Callable[..., None], *arguments: Any) -> None:
        """Call this before writing data that `restore(*arguments)` restores.

        It is called after any amount of writing, perhaps twice. So it must set the former data, whatever is there now.
        """
        self._restores.append(functools.partial(restore, *arguments))

    @contextlib.contextmanager
    def part(self) -> Iterator[None]:
        """Undoes the writing inside if an exception leaves it."""
        start = self.mark()
        try:
            yield
        except BaseException:
            self.put_back(start)
            raise

    @contextlib.contextmanager
    def attempt(self, failed: Callable[[Exception], None]) -> Iterator[None]:
        """A part that may fail alone: its exception goes to `failed`, and the run goes on."""
        try:
            with self.part():
                yield
        except Exception as error:
            failed(error)

    def mark(self) -> int:
        """A mark after everything written so far, for `put_back`."""
        return len(self._restores)

    def put_back(self, start: int = 0) -> None:
        """Undo all writing since the mark `start`: after an exception, or if the writing was useless."""
        while len(self._restores) > start:
            try:
                self._restores[-1]()
            except KeyboardInterrupt:
                continue  # again: the former data matters more than that key
            except ReferenceError:
                pass  # its owner is gone
            except Exception:
                traceback.print_exc()  # beside the pending exception; the rest is undone nevertheless
            self._restores.pop()


@contextlib.contextmanager
def transaction() -> Iterator[Transaction]:
    """The transaction of a run. As a whole it is one part."""
    run = Transaction()
    with run.part():
        yield run
