# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that joins islands along selected edges."""

import bpy
from bpy.props import StringProperty

from ..jobs import native_package
from ..jobs.sew_job import SewJob
from ..state.option_properties import option, shown_number
from .layer_run import LayerRun
from .polls import OnTargets


class UV_OT_koebe_sew(OnTargets, LayerRun, bpy.types.Operator):
    """Join the UV islands on both sides of the selected edges, or close a cut inside an island. The new island is
    mapped anew, one to one, and lies where the larger island lay. Pins stay"""

    bl_idname = "uv.koebe_sew"
    bl_label = "Koebe Sew"
    done = "sewn"
    needs, modes = "In Edit Mode select the edges to sew", ("EDIT_MESH",)

    layer: StringProperty(name="UV Layer", description="UV layer to sew. Without a name, the active layer")
    keep_angles: option("keep_angles")
    even: option("even")

    def _job(self, context: bpy.types.Context) -> SewJob:
        in_uv = getattr(context.area, "type", "") == "IMAGE_EDITOR"
        by_uv = in_uv and not context.tool_settings.use_uv_select_sync
        even = None if self.keep_angles else shown_number(self.even)
        job = SewJob(native_package.load(), self.layer, even, by_uv)
        return self._read(context, job, "select the edges to sew: cuts of the UVs")
