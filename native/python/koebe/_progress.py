"""The progress and the cancel of a call that consists of several native calls."""

from collections.abc import Callable
from typing import Any, Literal, TypeAlias, TypedDict

from ._native import _koebe
from ._options import callback, token
from .errors import Cancelled

Progress = Callable[[float, str], Any]
Shown: TypeAlias = Progress | Literal[False] | None  # None: in a terminal or a notebook; False: never


class SurfaceOptions(TypedDict, total=False):
    """Which part of the surface is meant."""

    mask: Any


class Watched(TypedDict, total=False):
    """Options of each call that takes a while."""

    progress: Shown
    cancel: "_koebe.CancelToken | None"


class RunOptions(SurfaceOptions, Watched, total=False):
    """Options of each such call with one surface."""


class Run:
    """The progress and the cancel of one call, or of a part of it.

    progress, cancel    as for `uniformize`
    """

    def __init__(self, progress: Any, cancel: Any) -> None:
        self.progress: Progress | None = callback(progress, "progress")
        self.cancel: _koebe.CancelToken = token(cancel, "cancel")

    def part(self, begin: float, end: float) -> "Run":
        """A part of the call, from one fraction of its progress to another."""
        report = self.progress
        if report is None:
            return self
        return Run(lambda fraction, stage: report((1.0 - fraction) * begin + fraction * end, stage), self.cancel)

    def at(self, fraction: float, stage: str) -> None:
        """Tells the progress. Raises Cancelled if the caller asked to stop."""
        if self.progress is not None:
            self.progress(fraction, stage)
        self.check()

    def check(self) -> None:
        """Raises Cancelled if the caller asked to stop."""
        if self.cancel.cancelled:
            raise Cancelled("cancelled by the caller")
