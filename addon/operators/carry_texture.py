# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that carries a texture from one shape to others."""

import bpy
from bpy.props import BoolProperty

from ..blender.noted_properties import note_group
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs.shape_jobs import CarryJob
from ..maps.carried_uv import Carried
from ..state import run_report
from ..state.option_properties import option
from ..state.run_report import report_of
from ..state.shape_report import shapes_of
from .answers import finished, refused
from .modal_run import ModalRun, redraw
from .polls import in_object_mode


class UV_OT_koebe_carry_texture(ModalRun, bpy.types.Operator):
    """Give the other selected objects UVs that fit the texture of the active object. Their holes are laid over its
    holes, as well as a conformal map can. The active object must be mapped, and is not changed"""

    bl_idname = "uv.koebe_carry_texture"
    bl_label = "Koebe Carry Texture"
    bl_options = {"REGISTER", "UNDO"}

    layer: option("layer")
    fit_holes: BoolProperty(
        name="Fit Holes",
        default=False,
        description="Bend the map so that every hole lies exactly on the active object's. Where the shapes differ the "
        "map is not conformal any more. Off: angles are kept, and the holes fit as well as they can",
    )
    material: BoolProperty(
        name="Material",
        default=True,
        description="Objects without a material get the material of the active object",
    )

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return in_object_mode(cls, context, 2)

    def _job(self, context: bpy.types.Context) -> CarryJob:
        return CarryJob(target_objects(context), self.layer, self.fit_holes)

    def _finish(self, context: bpy.types.Context, job: CarryJob) -> set[str]:
        with transaction() as run:
            job.write(run, self.material)
            done = [one for one in job.carried if one is not None]
            if not done:
                return refused(self, "nothing was carried.", job.failures)
            shapes = shapes_of(context)
            note_group(run, shapes)
            note_group(run, report_of(context))
            shapes.carried.clear()
            for one in done:
                run_report.record_moved(context, job.koebe, one.name, job.layer, one.shape.island, one)
                entry = shapes.carried.add()
                entry.name, entry.measured, entry.distance, entry.message = one.name, True, one.residual, one.message
            redraw(context)
            for one in done:
                self.report({"WARNING" if one.message or len(one.flipped) else "INFO"}, _line(one))
            return finished(self, "not carried", job.failures)


def _line(one: Carried) -> str:
    """The result for one object, and how well the texture fits."""
    fit = "fitted holes, " if one.fitted else ""
    text = (
        f"{one.name}: holes apart by {100 * one.residual:.2g} % of the texture ({fit}worst {100 * one.largest:.2g} %), "
        f"angle error {one.angle_error:.2f}°, {len(one.flipped)} flips"
    )
    return f"{text}; {one.message}" if one.message else text
