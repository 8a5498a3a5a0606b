# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong with one object, in words for the artist. No bpy."""

class KnownError(Exception):
    """An error whose text is meant to be read: what is wrong, and what to do about it."""
