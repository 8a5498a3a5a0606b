# SPDX-License-Identifier: GPL-3.0-or-later
"""A docstring as the tooltip of an operator."""


def tooltip(docstring: str | None) -> str:
    """The docstring in one line: Blender shows line breaks as they are. It cuts off what is longer than 239 letters."""
    return " ".join((docstring or "").split())
