# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of reading and writing a mesh."""

from ..surfaces.errors import KnownError


class TransferError(KnownError):
    """A mesh that cannot be read or written."""
