# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes an operator's tooltip from a docstring."""


def tooltip(docstring: str | None) -> str:
    """The docstring in one line, as Blender shows line breaks. Blender cuts off text after 239 letters."""
    return " ".join((docstring or "").split())
