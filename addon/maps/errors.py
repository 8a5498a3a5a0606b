# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors whose text an artist reads, and what an error of the native package carries."""

from collections.abc import Sequence


class KnownError(Exception):
    """An error whose text is meant to be read: what is wrong, and what to do about it."""


NOWHERE = "one of its vertices has a coordinate that is NaN or infinite: delete it"


class MapError(KnownError):
    """An island that cannot be mapped, beside the native package's own errors."""


def kind_of(error: Exception | None) -> str | None:
    """The kind of a `koebe.TopologyError`; None of any other error."""
    return getattr(error, "kind", None)


def elements_of(error: Exception | None) -> Sequence[int]:
    """The elements that a `koebe.KoebeError` is about; none of any other error."""
    return getattr(error, "elements", ())
