# SPDX-License-Identifier: GPL-3.0-or-later
"""Buttons that open the pages of documentation that are in the add-on's folder, in the browser."""

from pathlib import Path
from typing import Any

import bpy

FOLDER = Path(__file__).resolve().parents[1]


def draw_help(layout: bpy.types.UILayout, place: str, page: str = "guide", text: str = "") -> None:
    """A button that opens a page at a heading. A checkout has no pages, and no button."""
    path = FOLDER / f"{page}.html"
    if not path.exists():
        return
    icon: Any = "HELP"
    button: Any = layout.operator("wm.url_open", text=text, icon=icon, emboss=bool(text))
    button.url = f"{path.as_uri()}#{place}" if place else path.as_uri()
