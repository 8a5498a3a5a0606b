# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that packs the islands of any UV layer, and does nothing else."""

import bpy
from bpy.props import StringProperty

from ..jobs import native_package
from ..jobs.pack_job import PackJob
from ..state.option_properties import option, shown_number
from .layer_run import LayerRun
from .polls import OnTargets


class UV_OT_koebe_pack(OnTargets, LayerRun, bpy.types.Operator):
    """Pack the islands of the active UV layer into the UV square, as large as they have room. No island is cut, bent or
    turned over. In Edit Mode the islands of the selected faces are packed. Esc takes the best packing so far"""

    bl_idname = "uv.koebe_pack"
    bl_label = "Koebe Pack Only"
    done = "packed"

    layer: StringProperty(name="UV Layer", description="UV layer to pack. Without a name, the active layer")
    margin: option("margin")
    pixels: option("pixels")
    average_scale: option("average_scale")
    tiles: option("tiles")
    seconds: option("seconds")
    keep_places: option("keep_places")
    atlas: option("atlas")

    def _job(self, context: bpy.types.Context) -> PackJob:
        options = {"margin": shown_number(self.margin), "pixels": self.pixels, "average_scale": self.average_scale,
                   "tiles": max(1, self.tiles), "seconds": self.seconds or None}  # fmt: skip
        editing = context.mode == "EDIT_MESH"
        job = PackJob(native_package.load(), self.layer, editing, self.keep_places, self.atlas, options)
        return self._read(context, job)

    def _finish(self, context: bpy.types.Context, job: PackJob) -> set[str]:
        answer = super()._finish(context, job)
        if answer == {"FINISHED"} and len(job.tasks) > 1 and not self.atlas:
            self.report({"INFO"}, "Each object has a UV square of its own: One Atlas packs all into one")
        return answer
