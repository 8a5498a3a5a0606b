# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors whose text an artist reads, and the data in the native package's errors."""

import contextlib
import traceback
from collections.abc import Iterable, Iterator, Sequence
from types import ModuleType
from typing import Any


class KnownError(Exception):
    """An error whose text is for the artist: what is wrong, and what to do about it."""


NOWHERE = "a vertex has a coordinate that is not a finite number: delete this vertex"


class MapError(KnownError):
    """An island that cannot be mapped, beyond the native package's own errors."""


def kind_of(error: Exception | None) -> str | None:
    """The kind of a `koebe.TopologyError`; None of any other error."""
    return getattr(error, "kind", None)


def elements_of(error: Exception | None) -> Sequence[int]:
    """The elements of a `koebe.KoebeError`; empty for any other error."""
    return getattr(error, "elements", ())


@contextlib.contextmanager
def failing_alone(koebe: ModuleType, islands: Iterable[Any]) -> Iterator[None]:
    """Makes any exception inside the error of these islands; the run goes on."""
    try:
        yield
    except koebe.Cancelled:
        raise
    except Exception as error:
        for one in islands:
            one.error = foreseen(koebe, error)


def foreseen(koebe: ModuleType, error: Exception) -> Exception:
    """The error, if its text is for the artist; else an error that says so, with its origin on the console."""
    if isinstance(error, (koebe.KoebeError, MapError)):
        return error
    traceback.print_exception(type(error), error, error.__traceback__)
    unforeseen = MapError(f"an unexpected error: {type(error).__name__}: {error}")
    unforeseen.__cause__ = error
    return unforeseen
