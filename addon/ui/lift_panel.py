# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of the panel that brings patterns onto surfaces."""

import bpy

from ..operators.lift import OBJECT_OT_koebe_lift
from ..operators.node_groups import NODE_OT_koebe_add_groups, NODE_OT_koebe_remove_groups
from ..state.lift_properties import LIFT_NAMES, copy_lift_options, draw_lift_options, lift_settings_of
from .panel_parts import ClosedPanel


class LiftPanel(ClosedPanel):
    """Patterns on the surface, as holes or a relief, and node groups that bend things onto it."""

    bl_label = "Pattern on Surface"
    help_at = "13-patterns-on-the-surface"

    def draw(self, context: bpy.types.Context) -> None:
        column, settings = self.aligned_layout().column(), lift_settings_of(context)
        button = column.operator(OBJECT_OT_koebe_lift.bl_idname, text="Make Patterned Copy", icon="MOD_LATTICE")
        copy_lift_options(settings, button)
        draw_lift_options(column, settings, LIFT_NAMES)
        row = column.row(align=True)
        row.operator(NODE_OT_koebe_add_groups.bl_idname, text="Add Node Groups", icon="NODETREE")
        row.operator(NODE_OT_koebe_remove_groups.bl_idname, text="", icon="X")
