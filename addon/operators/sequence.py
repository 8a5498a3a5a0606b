# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that maps the shapes of a mesh: frames of its animation, or its shape keys."""

from collections.abc import Generator

import bpy

from ..blender import edit_mode
from ..blender.targets import target_objects
from ..blender.transaction import Transaction
from ..jobs.sequence_job import SequenceJob
from ..maps.options import SequenceChoice
from ..state.option_properties import (
    RANGE_NAMES,
    SequenceProperties,
    sequence_options_of,
)
from .run_operator import MapOperator


class UV_OT_koebe_sequence(MapOperator, SequenceProperties, bpy.types.Operator):
    """Unwrap the active object in each frame of its animation, or in each of its shape keys. All maps lie over the
    first map, so a texture stays in its place. Modifiers may move vertices, but must not make other faces"""

    bl_idname = "uv.koebe_sequence"
    bl_label = "Koebe Sequence"
    options_shown = ("source", *RANGE_NAMES, "target", "play", "checker", "checker_size")  # others are in the panel
    redo_waits = False  # it changes the frame while it reads

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        if not super().poll(context):
            return False
        if context.active_object not in target_objects(context):
            cls.poll_message_set("Select the active object: its frames or shape keys are mapped")
            return False
        return True

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> SequenceJob:
        for name in RANGE_NAMES:
            if not self.properties.is_property_set(name):
                setattr(self, name, getattr(context.scene, name))
        frames = range(self.frame_start, self.frame_end + 1, self.frame_step)
        choice = SequenceChoice(self.source, frames, self.target, self.play)
        return SequenceJob(target_objects(context)[:1], sequence_options_of(self), choice, selected_only)

    def _reading(self, context: bpy.types.Context, job: SequenceJob) -> Generator[float, None, None]:
        return job.read_shapes(context)

    def _write(self, run: Transaction, context: bpy.types.Context, job: SequenceJob) -> None:
        """Write in Object Mode, as attributes require."""
        back = edit_mode.leave(run, context) if job.choice.target == "ATTRIBUTE" else None
        super()._write(run, context, job)
        if back is not None:
            back()
