# SPDX-License-Identifier: GPL-3.0-or-later
"""All or nothing: whoever writes into Blender's data first leaves here how to put back what was there.

An operator computes first, then checks that it can write, then writes inside `transaction()`. If that is left by an
exception, whichever it is, everything is put back, the last thing first. Within it every object is an `attempt` of
its own: one that fails is put back alone, and the others go on.
"""

import contextlib
import functools
import traceback
from collections.abc import Callable, Iterator
from typing import Any


class Transaction:
    """How to put back what was written so far."""

    def __init__(self) -> None:
        self._restores: list[Callable[[], None]] = []

    def before_write(self, restore: Callable[..., None], *arguments: Any) -> None:
        """Call this before anything is written that `restore(*arguments)` puts back.

        It is called however far the writing came, and maybe twice: so it sets what was, whatever is there now.
        """
        self._restores.append(functools.partial(restore, *arguments))

    @contextlib.contextmanager
    def part(self) -> Iterator[None]:
        """What is written inside is put back if an exception leaves it."""
        start = self.mark()
        try:
            yield
        except BaseException:
            self.put_back(start)
            raise

    @contextlib.contextmanager
    def attempt(self, failed: Callable[[Exception], None]) -> Iterator[None]:
        """A part that may fail for itself: the exception is given to `failed`, and what comes after goes on."""
        try:
            with self.part():
                yield
        except Exception as error:
            failed(error)

    def mark(self) -> int:
        """What was written until now, for `put_back`."""
        return len(self._restores)

    def put_back(self, start: int = 0) -> None:
        """Put back what was written since the mark `start`: after an exception, or where nothing came of it."""
        while len(self._restores) > start:
            try:
                self._restores[-1]()
            except KeyboardInterrupt:
                continue  # once more: what was there matters more than that key
            except ReferenceError:
                pass  # what it belonged to is gone
            except Exception:
                traceback.print_exc()  # beside the exception that is on its way; the rest is put back all the same
            self._restores.pop()


@contextlib.contextmanager
def transaction() -> Iterator[Transaction]:
    """The transaction of a run: as a whole it is one part."""
    run = Transaction()
    with run.part():
        yield run
