"""What a call shows in a terminal or a notebook, what it logs, and the old names of its arguments."""

import contextlib
import functools
import logging
import sys
import time
import warnings
from collections.abc import Callable, Iterator, Mapping
from contextvars import ContextVar
from typing import Any, TypeVar

LOG = logging.getLogger("koebe")
LOG.addHandler(logging.NullHandler())
Function = TypeVar("Function", bound=Callable[..., Any])
_IN_A_CALL = ContextVar("koebe_in_a_call", default=False)
_SILENT = 1.0  # seconds: a shorter call shows nothing
_PAUSE = 0.1  # seconds between two pictures
_WIDTH = 24  # characters of a bar


class _Bar:
    """A line on stderr that says how far a call is. It appears after a second, and vanishes at the end."""

    def __init__(self, name: str) -> None:
        self.name, self.begin, self.drawn, self.width = name, time.monotonic(), 0.0, 0

    def __call__(self, fraction: float, stage: str) -> None:
        now = time.monotonic()
        if now - self.begin < _SILENT or now - self.drawn < _PAUSE:
            return
        done = int(_WIDTH * fraction)
        bar = "#" * done + "." * (_WIDTH - done)
        line = f"{self.name} [{bar}] {fraction:4.0%} {stage}, {now - self.begin:.0f} s"
        self._write(line.ljust(self.width))
        self.drawn, self.width = now, len(line)

    def end(self) -> None:
        if self.width:
            self._write(" " * self.width + "\r")

    def _write(self, line: str) -> None:
        with contextlib.suppress(OSError, ValueError):  # a closed stream
            sys.stderr.write("\r" + line)
            sys.stderr.flush()


def _is_watched() -> bool:
    """Whether a person looks on: in a terminal or a notebook."""
    shell = sys.modules.get("IPython")
    kernel = shell is not None and "ipykernel" in sys.modules and shell.get_ipython() is not None
    return kernel or bool(sys.stderr is not None and not sys.stderr.closed and sys.stderr.isatty())


@contextlib.contextmanager
def call(name: str, given: dict[str, Any], has_progress: bool) -> Iterator[list[Any]]:
    """Shows the progress of the outermost call, unless the caller has a function or False for it, and logs its result.

    given    the caller's keywords: `progress` is set in them
    The result is to be put into the list.
    """
    outermost, bar = not _IN_A_CALL.get(), None
    results: list[Any] = []
    if has_progress:
        if given.get("progress") is None and outermost and _is_watched():
            given["progress"] = bar = _Bar(name)
        elif given.get("progress") is False:
            given["progress"] = None
    state, begin = _IN_A_CALL.set(True), time.monotonic()
    try:
        yield results
    finally:
        _IN_A_CALL.reset(state)
        if bar is not None:
            bar.end()
    if has_progress and outermost and LOG.isEnabledFor(logging.WARNING):
        LOG.info("%s: %s, %.2f s", name, results[0], time.monotonic() - begin)
        for warning in getattr(results[0], "warnings", ()):
            LOG.warning("%s: %s", name, warning)


def watched(**renamed: str) -> Callable[[Function], Function]:
    """Makes a function with `progress` as `call` says. renamed: the names that arguments had before, new name = old."""

    def changed(function: Function) -> Function:
        @functools.wraps(function)
        def watching(*arguments: Any, **given: Any) -> Any:
            take_old_names(function.__name__, given, renamed)
            with call(function.__name__, given, has_progress) as results:
                results.append(function(*arguments, **given))
            return results[0]

        has_progress = "progress" in function.__code__.co_varnames
        return watching  # type: ignore[return-value]

    return changed


def take_old_names(function: str, given: dict[str, Any], renamed: Mapping[str, str]) -> None:
    """Gives arguments that are named as in the last version their new names, with a warning."""
    for new, old in renamed.items():
        if old in given:
            text = f"{function}: {old} is now {new}; the old name goes with the next version"
            warnings.warn(text, DeprecationWarning, stacklevel=3)
            given[new] = given.pop(old)
