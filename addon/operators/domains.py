# SPDX-License-Identifier: GPL-3.0-or-later
"""The operators that map to domains that are no disk: tiles of a flat torus or a cylinder, layouts of a sphere,
surfaces with handles cut open."""

import bpy

from ..blender import edit_mode
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.domain_job import DomainJob, SchottkyJob, SphereJob
from ..jobs.tile_job import TileJob
from ..maps import wording
from ..maps.options import SchottkyChoice, SphereChoice
from ..state import run_report
from ..state.option_properties import (
    ACCURACY_NAMES,
    RingProperties,
    SchottkyProperties,
    SphereProperties,
    TorusProperties,
    choice_of,
    option_names,
    written_options_of,
)
from .modal_run import redraw
from .run_operator import MapOperator
from .select_from_report import select_offenders
from .tooltip import tooltip


def shown(domain: str) -> tuple[str, ...]:
    """The options of a domain, those last that most runs leave alone."""
    return tuple(sorted(option_names(domain), key=lambda name: name in ACCURACY_NAMES))


class DomainOperator(MapOperator):
    """Mixed into these operators. `domain` is one of maps/domains.py."""

    domain: str

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> DomainJob:
        choice, options = choice_of(self.domain, self), written_options_of(self)
        objects = target_objects(context)
        if isinstance(choice, SphereChoice):
            return SphereJob(objects, options, choice, selected_only, refused=[])
        if isinstance(choice, SchottkyChoice):
            return SchottkyJob(objects, options, choice, selected_only, refused=[])
        return TileJob(objects, options, choice, selected_only, refused=[])

    def _finish(self, context: bpy.types.Context, job: DomainJob) -> set[str]:
        """Write what was computed, each object wholly or not at all, and say what became of it."""
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                job.write(run)
            run_report.record_domains(run, context, job.outcomes, job.options.layer, job.refused)
            selected = select_offenders(run, context, job)
            redraw(context)
            edit_mode.undo_all(context)
            answer = self._say(job)
            if selected and answer == {"CANCELLED"}:  # after which Blender makes no undo step
                bpy.ops.ed.undo_push(message="Select What Is Wrong")
            return answer

    def _say(self, job: DomainJob) -> set[str]:
        failures = [wording.failure_line(outcome) for outcome in job.outcomes if outcome.failed or outcome.not_written]
        results: list[tuple[str, bool, list[str], list[str]]] = []
        for outcome in job.outcomes:
            if outcome.mapped:
                found = [warning["text"] for one in outcome.mapped for warning in outcome.warnings(one)]
                warnings = [f"{outcome.name}: {text}" for text in [*found, *outcome.remarks]]
                notes = [f"{outcome.name}: {text}" for one in outcome.mapped for text in outcome.notes(one)]
                results.append((outcome.line(), outcome.converged, notes, warnings))
        return self._tell(job, failures, results)


class UV_OT_koebe_torus(DomainOperator, TorusProperties, bpy.types.Operator):
    """Unwrap a surface with one handle to a tile of a flat torus: angles are kept, holes are round, and a pattern with
    its periods has no seam. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_torus"
    bl_label = "Koebe Unwrap to Torus Tile"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    domain = "torus"
    options_shown = shown("torus")


class UV_OT_koebe_ring(DomainOperator, RingProperties, bpy.types.Operator):
    """Unwrap a surface with two rims to a cylinder, unrolled: angles are kept, the rims are straight, and a pattern
    with its period has no seam. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_ring"
    bl_label = "Koebe Unwrap to Cylinder"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    domain = "ring"
    options_shown = shown("ring")


class UV_OT_koebe_sphere(DomainOperator, SphereProperties, bpy.types.Operator):
    """Unwrap a surface without handles, closed or with holes, to the sphere and this to UVs: angles are kept on the
    sphere, holes are round caps. The cut is in the UVs alone"""

    bl_idname = "uv.koebe_sphere"
    bl_label = "Koebe Unwrap to Sphere"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    domain = "sphere"
    options_shown = shown("sphere")


class UV_OT_koebe_schottky(DomainOperator, SchottkyProperties, bpy.types.Operator):
    """Unwrap a surface with any number of handles, closed or with holes, into the disk: angles are kept, holes are
    round, and both sides of each cut through a handle differ by a Möbius map. The cuts are in the UVs alone"""

    bl_idname = "uv.koebe_schottky"
    bl_label = "Koebe Unwrap Handles"
    bl_description = tooltip(__doc__)
    bl_options = {"REGISTER", "UNDO"}
    domain = "schottky"
    options_shown = shown("schottky")


OPERATORS = {
    "torus": UV_OT_koebe_torus, "ring": UV_OT_koebe_ring, "sphere": UV_OT_koebe_sphere,
    "schottky": UV_OT_koebe_schottky,
}  # fmt: skip
register, unregister = bpy.utils.register_classes_factory(tuple(OPERATORS.values()))
