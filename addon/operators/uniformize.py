# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that maps: it gathers, runs and writes. The computation is in `jobs` and below."""

import bpy

from ..blender.targets import target_objects
from ..jobs.map_job import Job
from ..state.option_properties import ACCURACY_NAMES, OPTION_NAMES, UniformizeProperties, options_of
from .run_operator import MapOperator


class UV_OT_koebe_uniformize(MapOperator, UniformizeProperties, bpy.types.Operator):
    """Unwrap surfaces to a disk with round holes. Angles are kept. Seams are cuts, and a mesh that cannot be mapped
    directly is cut in the UVs only. In Edit Mode the selected faces are mapped. The mesh is not changed"""

    bl_idname = "uv.koebe_uniformize"
    bl_label = "Koebe Unwrap to Disk"
    options_shown = tuple(sorted(OPTION_NAMES, key=lambda name: name in ACCURACY_NAMES))

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> Job:
        job = Job(target_objects(context), options_of(self), selected_only, refused=[])
        if job.options.placement == "keep":
            job.read_old_uv()
        return job
