# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that cuts a surface of any kind into even parts, in the UVs alone."""

import bpy

from ..blender.targets import target_objects
from ..jobs.parts_job import PartsJob
from ..state.option_properties import PART_OPTION_NAMES, PartsProperties, choice_of, written_options_of
from .run_operator import MapOperator


class UV_OT_koebe_parts(MapOperator, PartsProperties, bpy.types.Operator):
    """Cut any surface into parts with even texels, in the UVs only: limbs, closed models, handles. The mesh is not
    changed, unless you ask for seams. In Edit Mode the selected faces are mapped"""

    bl_idname = "uv.koebe_parts"
    bl_label = "Koebe Unwrap to Parts"
    options_shown = PART_OPTION_NAMES

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> PartsJob:
        keep = getattr(self, "placement", "") == "keep"  # of the operator of all shapes
        choice, options = choice_of("parts", self), written_options_of(self, **({"placement": "keep"} if keep else {}))
        job = PartsJob(target_objects(context), options, choice, selected_only, refused=[])
        if keep:
            job.read_old_uv()
        return job
