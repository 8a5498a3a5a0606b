# SPDX-License-Identifier: GPL-3.0-or-later
"""The error whose text an artist reads."""

class KnownError(Exception):
    """An error whose text is meant to be read: what is wrong, and what to do about it."""
