# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong with one object, in words for the artist. No bpy."""

FEW = 6  # reasons in one message, which has to fit on the screen


def few(reasons, between=". "):
    """The first of the reasons as one text, and how many more there are."""
    more = [f"And {len(reasons) - FEW} more"] if len(reasons) > FEW else []
    return between.join([*reasons[:FEW], *more])


def lines(start, reasons):
    """An error for Blender's popup, which has a line for each reason where there are several."""
    return f"{start}\n{few(reasons, chr(10))}" if len(reasons) > 1 else " ".join([start, *reasons])


class KnownError(Exception):
    """An error whose text is meant to be read: what is wrong, and what to do about it."""
