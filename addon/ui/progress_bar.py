# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a bar of the progress at the bottom of the 3D Views and UV Editors, while an operator computes."""

import bpy

from ..operators.modal_run import ModalRun
from . import drawing

SPACES = ("VIEW_3D", "IMAGE_EDITOR")
WIDTH, HEIGHT, BOTTOM = 280, 8, 36  # pixels at a resolution scale of 1
GROUND, DONE = (0.0, 0.0, 0.0, 0.6), (0.28, 0.56, 0.9, 1.0)


def draw() -> None:
    """Draw the bar, and its words over it."""
    if ModalRun.bar is None:
        return
    share, words = ModalRun.bar
    scale = bpy.context.preferences.system.ui_scale
    middle, bottom = bpy.context.region.width / 2, BOTTOM * scale
    width, height = min(WIDTH * scale, 1.8 * middle), HEIGHT * scale
    left = middle - width / 2
    drawing.box(left - 2, bottom - 2, width + 4, height + 4, GROUND)
    drawing.box(left, bottom, width * min(max(share, 0.0), 1.0), height, DONE)
    drawing.text(words, middle, bottom + height + 8 * scale)


register, unregister = drawing.drawn(*SPACES, name="progress", draw=draw)
