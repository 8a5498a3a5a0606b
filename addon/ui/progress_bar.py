# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a bar of the progress along the headers of the 3D Views and UV Editors, while an operator computes."""

import bpy

from ..operators.modal_run import BAR_EDITORS, ModalRun
from . import drawing

HEIGHT = 5  # pixels at a resolution scale of 1
GROUND, DONE = (0.0, 0.0, 0.0, 0.6), (0.28, 0.56, 0.9, 1.0)


def draw() -> None:
    """Draw the bar. The status line has its words."""
    if ModalRun.bar is None:
        return
    width, height = bpy.context.region.width, HEIGHT * bpy.context.preferences.system.ui_scale
    drawing.box(0, 0, width, height, GROUND)
    drawing.box(0, 0, width * min(max(ModalRun.bar[0], 0.0), 1.0), height, DONE)


def register() -> None:
    """Draw in every 3D View and UV Editor."""
    for space in BAR_EDITORS:
        drawing.add(space, "progress", draw, region="HEADER")


def unregister() -> None:
    """The reverse of `register`."""
    for space in BAR_EDITORS:
        drawing.remove(space, "progress")
