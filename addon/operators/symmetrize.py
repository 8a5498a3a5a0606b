# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that makes the maps of mirror-symmetric surfaces exactly symmetric."""

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.noted_properties import note_group
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import Transaction, transaction
from ..jobs.moebius_job import MoebiusJob
from ..layers.circle_domain import DomainError
from ..layers.mirror import Symmetry, symmetric
from ..state import moved_circles
from ..state.run_report import report_of
from .answers import finished, refused
from .modal_run import redraw
from .moebius import numbered
from .polls import OnTargets, native_or_error

Done = tuple[MoebiusJob, Symmetry]


class UV_OT_koebe_symmetrize(OnTargets, bpy.types.Operator):
    """Make the UVs of a mirror-symmetric surface exactly symmetric, about a vertical line. The plane of symmetry is
    found, and circles stay circles. Other surfaces stay as they are"""

    bl_idname = "uv.koebe_symmetrize"
    bl_label = "Koebe Symmetrize"
    needs = "Select a mapped mesh object, in Object Mode or in Edit Mode"

    layer: StringProperty(name="UV Layer", description="UV layer to write. Without a name, the active layer")

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        koebe = native_or_error(self)
        if koebe is None:
            return {"CANCELLED"}
        problems: list[str] = []
        done: list[Done] = []
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                for obj in with_own_meshes(target_objects(context)):
                    with attempt(run, obj.name, problems):
                        done += self._object(run, context, MoebiusJob(koebe, obj, self.layer), problems)
            redraw(context)
            return self._say(done, problems)

    def _object(self, run: Transaction, context: bpy.types.Context, job: MoebiusJob, problems: list[str]) -> list[Done]:
        """Write the islands of an object that can be made symmetric; why the others cannot goes to the problems."""
        found, refused = [], []
        for domain in job.domains:
            try:
                found.append((job, symmetric(job.koebe, numbered(context, job, domain))))
            except DomainError as error:
                refused.append(str(error))
        if not found:
            raise TransferError(f"{job.name}: {'; '.join(dict.fromkeys(refused))}")
        problems += [f"{job.name}: {text}" for text in refused]
        note_group(run, report_of(context))
        for _, made in found:
            job.write(run, made.image)
            entry = moved_circles.entry_of(context, job.name, job.layer, made.image.domain)
            if entry is not None:
                moved_circles.record(entry, made.image, job.figures(made.image), moved_circles.SYMMETRIC)
        return found

    def _say(self, done: list[Done], problems: list[str]) -> set[str]:
        if not done:
            return refused(self, "nothing was made symmetric.", problems)
        for job, made in done:
            text = moved_circles.describe(made.image, moved_circles.SYMMETRIC)
            self.report({"WARNING"} if ":" in text else {"INFO"},
                        f"{job.name}: {text}, {made.pairs} pairs of vertices, moved by {made.moved:.1e} at most")
        return finished(self, "some objects or islands were not changed", problems)
