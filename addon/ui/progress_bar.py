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


register, unregister = drawing.drawn(*BAR_EDITORS, name="progress", draw=draw, region="HEADER")
