# SPDX-License-Identifier: GPL-3.0-or-later
"""The common part of the operators on shapes."""

import bpy

from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import target_objects
from ..jobs.shape_jobs import CarryJob, MeasureJob
from ..maps.shapes import ShapeError
from ..solver.errors import NativeError
from .modal_run import ModalRun


class ShapeOperator(ModalRun):
    """The common part of the operators on shapes."""

    bl_options = {"REGISTER", "UNDO"}

    def _new_job(self, objects: list[MeshObject]) -> CarryJob | MeasureJob:
        raise NotImplementedError

    def _job(self, context: bpy.types.Context) -> CarryJob | MeasureJob | None:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        try:
            return self._new_job(target_objects(context))
        except (NativeError, TransferError) as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return None

    def execute(self, context: bpy.types.Context) -> set[str]:
        try:
            return super().execute(context)
        except ShapeError as error:
            return self._refuse(error)

    def _end(self, context: bpy.types.Context) -> set[str]:
        try:
            return super()._end(context)
        except ShapeError as error:
            return self._refuse(error)


def in_object_mode(cls: type[bpy.types.Operator], context: bpy.types.Context, least: int) -> bool:
    """Whether so many objects are selected, the active one among them. If not, tells the user what to do."""
    if context.mode != "OBJECT":
        cls.poll_message_set("Works in Object Mode, on whole objects")
        return False
    if len(target_objects(context)) < least or context.active_object not in context.selected_objects:
        cls.poll_message_set(
            "Select mesh objects. One of them must be the active object" if least == 1
            else "Select the other surfaces first, and last the surface that has the texture"
        )  # fmt: skip
        return False
    return context.active_object.type == "MESH"
