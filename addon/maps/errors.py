# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors whose text an artist reads, and the data in the native package's errors."""

from collections.abc import Sequence


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
