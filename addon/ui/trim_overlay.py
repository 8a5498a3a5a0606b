# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws the rectangles of the trim sheet in the UV Editor, with their names."""

import bpy
import numpy as np

from ..state.trims import active_trim, rectangles, trims_of
from . import drawing

TRIM, ACTIVE = (0.35, 0.75, 1.0, 0.9), (1.0, 0.75, 0.2, 1.0)
INSET = 6  # pixels from a rectangle's corner to its name, at a resolution scale of 1


def draw() -> None:
    """Draw all rectangles, and the one that is chosen in the list over them."""
    context = bpy.context
    trims = trims_of(context)
    if context.space_data.mode != "UV" or not trims.shown or not len(trims.items):
        return
    chosen = active_trim(trims)
    places = rectangles(trims)
    order = sorted(range(len(places)), key=lambda k: trims.items[k] == chosen)
    to_region = context.region.view2d.view_to_region
    start, end = (np.array(to_region(x, x, clip=False)) for x in (0.0, 1.0))
    inset = INSET * context.preferences.system.ui_scale
    for k in order:
        left, bottom, right, top = places[k]
        corners = np.array([(left, bottom), (right, bottom), (right, top), (left, top), (left, bottom)])
        points = start + (end - start) * corners
        color = ACTIVE if trims.items[k] == chosen else TRIM
        drawing.lines([points], color, 1.5)
        drawing.text(trims.items[k].name, points[0][0] + inset, points[0][1] + inset, color, centered=False)


register, unregister = drawing.drawn("IMAGE_EDITOR", name="trims", draw=draw)
