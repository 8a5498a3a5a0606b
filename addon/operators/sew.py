# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that joins islands along selected edges."""

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import transaction
from ..jobs import native_package
from ..jobs.sew_job import SewJob
from ..maps.wording import lines
from ..state.option_properties import option, shown_number
from ..state.run_report import forget
from .answers import finished, refused
from .modal_run import ModalRun, redraw
from .polls import has_targets
from .tooltip import tooltip

NOTHING = "nothing was sewn."
NO_EDGE = "select the edges to sew: cuts of the UVs"


class UV_OT_koebe_sew(ModalRun, bpy.types.Operator):
    """Join the UV islands on both sides of the selected edges, or close a cut inside an island. The new island is
    mapped anew, one to one, and lies where the larger island lay. Pins stay"""

    bl_idname = "uv.koebe_sew"
    bl_label = "Koebe Sew"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}

    layer: StringProperty(name="UV Layer", description="UV layer to sew. Without a name, the active layer")
    keep_angles: option("keep_angles")
    even: option("even")

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return has_targets(cls, context, "In Edit Mode select the edges to sew", ("EDIT_MESH",))

    def _job(self, context: bpy.types.Context) -> SewJob:
        in_uv = getattr(context.area, "type", "") == "IMAGE_EDITOR"
        by_uv = in_uv and not context.tool_settings.use_uv_select_sync
        even = None if self.keep_angles else shown_number(self.even)
        job = SewJob(native_package.load(), self.layer, even, by_uv)
        self._problems: list[str] = []
        for obj in with_own_meshes(target_objects(context)):
            try:
                job.read(obj)
            except TransferError as error:
                self._problems.append(str(error))
        if not job.tasks:
            raise TransferError(lines(NOTHING, self._problems or [NO_EDGE]))
        return job

    def _finish(self, context: bpy.types.Context, job: SewJob) -> set[str]:
        problems, done = self._problems, []
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                for task in job.tasks:
                    with attempt(run, task.target.name, problems):
                        job.write(run, task)
                        forget(run, context, task.target.name, task.layer)
                        done.append(task.line)
            redraw(context)
            edit_mode.undo_all(context)
            if not done:
                return refused(self, NOTHING, problems)
            for line in done:
                self.report({"INFO"}, line)
            return finished(self, "not sewn", problems)


register, unregister = bpy.utils.register_classes_factory((UV_OT_koebe_sew,))
