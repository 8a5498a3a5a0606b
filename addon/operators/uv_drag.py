# SPDX-License-Identifier: GPL-3.0-or-later
"""What operators share that the mouse drags in the UV Editor."""

import bpy

from .modal_run import OperatorBase


class UvDrag(OperatorBase):
    """Mixin of operators that go on while a button is down in a region of the UV Editor."""

    _region: bpy.types.Region

    def _press(self, context: bpy.types.Context, event: bpy.types.Event) -> bool:
        """Note the region in which the mouse was pressed. False if the operator was called in another way."""
        space, region = context.space_data, context.region
        by_hand = event.type == "LEFTMOUSE" and space is not None and space.type == "IMAGE_EDITOR"
        if bpy.app.background or not by_hand or region is None or region.type != "WINDOW":
            return False
        self._region = region
        return True

    def _place(self, x: float, y: float) -> tuple[float, float]:
        """The place of the UVs at a pixel of the region."""
        u, v = self._region.view2d.region_to_view(x, y)
        return u, v
