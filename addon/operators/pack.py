# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that packs the islands of any UV layer, and does nothing else."""

from typing import Any

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import transaction
from ..jobs import native_package
from ..jobs.pack_job import PackJob
from ..maps.wording import lines
from ..state.option_properties import option, shown_number
from ..state.run_report import forget
from .answers import finished, refused
from .modal_run import ModalRun, redraw
from .polls import has_targets
from .tooltip import tooltip

NOTHING = "nothing was packed."


class UV_OT_koebe_pack(ModalRun, bpy.types.Operator):
    """Pack the islands of the active UV layer into the UV square, as large as they have room. No island is cut, bent or
    turned over. In Edit Mode the islands of the selected faces are packed. Esc takes the best packing so far"""

    bl_idname = "uv.koebe_pack"
    bl_label = "Koebe Pack Only"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}

    layer: StringProperty(name="UV Layer", description="UV layer to pack. Without a name, the active layer")
    margin: option("margin")
    pixels: option("pixels")
    average_scale: option("average_scale")
    tiles: option("tiles")
    seconds: option("seconds")
    keep_places: option("keep_places")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_targets(cls, context, "Select a mesh object with UVs, in Object Mode or in Edit Mode")

    def _job(self, context: bpy.types.Context) -> PackJob:
        options = {"margin": shown_number(self.margin), "pixels": self.pixels, "average_scale": self.average_scale,
                   "seconds": self.seconds or None}  # fmt: skip
        if self.keep_places == "NONE":  # the free space is that of one tile
            options["tiles"] = max(1, self.tiles)
        job = PackJob(native_package.load(), self.layer, context.mode == "EDIT_MESH", self.keep_places, options)
        self._problems: list[str] = []
        for obj in with_own_meshes(target_objects(context)):
            try:
                job.read(obj)
            except TransferError as error:
                self._problems.append(str(error))
        if not job.tasks:
            raise TransferError(lines(NOTHING, self._problems))
        return job

    def _finish(self, context: bpy.types.Context, job: PackJob) -> set[str]:
        problems, done = self._problems, []
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                for task in job.tasks:
                    with attempt(run, task.target.name, problems):
                        job.write(run, task)
                        forget(run, context, task.target.name, task.layer)
                        done.append(_line(task.target.name, task.result.to_dict()))
            redraw(context)
            edit_mode.undo_all(context)
            return self._say(done, problems)

    def _say(self, done: list[str], problems: list[str]) -> set[str]:
        if not done:
            return refused(self, NOTHING, problems)
        for line in done:
            self.report({"INFO"}, line)
        return finished(self, "not packed", problems)


def _line(name: str, report: dict[str, Any]) -> str:
    """The result for one object."""
    overlaps = report["overlaps"]
    more = f", {overlaps} overlap or touch themselves as before" if overlaps else ""
    kept = sum(island["locked"] for island in report["islands"])
    more += f", {kept} kept their place" if kept else ""
    more += f", the others {100 * report['scale']:.0f} % as large" if kept and report["scale"] < 0.995 else ""
    return (
        f"{name}: {len(report['islands'])} islands{more}, {100 * report['coverage']:.0f} % of the UV square, "
        f"margin {report['margin']:.3g} px"
    )


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_pack,))
