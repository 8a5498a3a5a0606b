# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws where a model will be cut into parts over the 3D Views, while an operator computes."""

import bpy
from mathutils import Matrix

from ..blender import compat
from ..operators.run_operator import MapOperator
from . import drawing

IN_FRONT, BEHIND = 1.0, 0.25  # opacity before and behind the surface
WIDTH = 2.5  # pixels at a resolution scale of 1
NEARER = 2e-4  # of the depth: or the surface would hide half of each line


def draw() -> None:
    """Draw the cuts in the colour of seams, faint where the surface hides them."""
    import gpu

    if MapOperator.sketch is None:
        return
    points = MapOperator.sketch[1].reshape(-1, 3)
    seams = compat.seam_color()
    width = WIDTH * bpy.context.preferences.system.ui_scale
    drawing.segments(points, None, (*seams, BEHIND), width)
    nearer = Matrix.Identity(4)
    nearer[2][3] = -NEARER
    gpu.matrix.push_projection()
    gpu.matrix.load_projection_matrix(nearer @ gpu.matrix.get_projection_matrix())
    gpu.state.depth_test_set("LESS_EQUAL")
    drawing.segments(points, None, (*seams, IN_FRONT), width)
    gpu.state.depth_test_set("NONE")
    gpu.matrix.pop_projection()


register, unregister = drawing.drawn("VIEW_3D", name="sketch", draw=draw, when="POST_VIEW")
