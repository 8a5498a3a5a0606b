# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators have in common that map objects: what they work on, their options, what they say."""

from typing import Any

import bpy

from ..blender.errors import TransferError
from ..blender.targets import target_objects
from ..jobs.map_job import Job
from ..maps.options import OptionError
from ..maps.wording import few, lines
from ..solver.errors import NativeError
from .modal_run import ModalRun

NEEDS = {  # options that matter with others alone
    "margin": lambda options: options.placement != "keep",
    "importance": lambda options: options.balance == "area",
    "evenness": lambda options: options.seams == "add",
    "checker_size": lambda options: options.checker,
    "checker_even": lambda options: options.checker,
    "play": lambda options: options.source == "FRAMES" and options.target == "ATTRIBUTE",
    "frame_start": lambda options: options.source == "FRAMES",
    "frame_end": lambda options: options.source == "FRAMES",
    "frame_step": lambda options: options.source == "FRAMES",
}


def is_used(options: Any, name: str) -> bool:
    """Whether an option matters, as others are chosen."""
    return name not in NEEDS or NEEDS[name](options)


def draw_option(layout: bpy.types.UILayout, options: Any, name: str, context: bpy.types.Context) -> None:
    """A row for an option, grey where it does not matter."""
    row = layout.row()
    row.active = is_used(options, name)
    obj = context.active_object
    if name == "importance" and obj is not None and obj.type == "MESH":
        row.prop_search(options, name, obj, "vertex_groups")
    else:
        row.prop(options, name)


def can_map(cls: type[bpy.types.Operator], context: bpy.types.Context) -> bool:
    """Whether there is a mesh to work on, in a mode in which that can be done; else it says what to do."""
    if context.mode not in {"OBJECT", "EDIT_MESH"}:
        cls.poll_message_set("Works in Object Mode and in Edit Mode")
        return False
    if not target_objects(context):
        cls.poll_message_set("Select a mesh object")
        return False
    return True


class MapOperator(ModalRun):
    """Mixed into operators that map the selected objects.

    options_shown  the names of the properties in the redo panel
    """

    options_shown: tuple[str, ...]

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return can_map(cls, context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        assert layout is not None
        layout.use_property_split = True
        layout.use_property_decorate = False
        for name in self.options_shown:
            draw_option(layout, self, name, context)

    def _new_job(self, context: bpy.types.Context, selected_only: bool) -> Job:
        raise NotImplementedError

    def _job(self, context: bpy.types.Context) -> Job | None:
        context.evaluated_depsgraph_get()  # brings the objects' world matrices up to date
        try:
            return self._new_job(context, selected_only=context.mode == "EDIT_MESH")
        except (NativeError, OptionError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None

    def _tell(self, job: Job, failures: list[str], results: list[tuple[str, bool, list[str], list[str]]]) -> set[str]:
        """Say what became of the objects.

        failures  why islands or objects have no new UVs, beside the objects that the job has refused
        results   of each object that has: its line, whether it is good, what was done beside, what to watch out for
        """
        failures = [*failures, *(text for _, text in job.refused)]
        if not job.mapped_any:
            self.report({"ERROR"}, lines("Koebe UV: nothing was mapped.", failures))
            return {"CANCELLED"}
        for line, is_good, notes, warnings in results:
            self.report({"INFO"} if is_good else {"WARNING"}, line)
            for note in notes:
                self.report({"INFO"}, note)
            for warning in dict.fromkeys(warnings):
                self.report({"WARNING"}, warning)
        if failures:
            self.report({"WARNING"}, "Koebe UV: not mapped. " + few(failures))
        return {"FINISHED"}
