# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that change the UV layer of each selected object, one object after the other."""

from collections.abc import Callable, Iterable
from typing import Any, ClassVar

import bpy
from bpy.props import StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import Transaction, transaction
from ..maps.wording import lines
from ..state.run_report import forget
from .answers import finished, refused
from .modal_run import ModalRun, OperatorBase, redraw

EACH_LAYER = StringProperty(name="UV Layer", description="UV layer. Without a name, the active layer")


class LayerEdit(OperatorBase):
    """Mixin of operators that change the islands of a layer at once. An object that cannot be changed is named.

    nothing, not_done  what is said if no object was changed, or some were not
    moves_uv           whether reports on the layer are out of date then
    """

    bl_options = {"REGISTER", "UNDO"}
    nothing: ClassVar[str]
    not_done: ClassVar[str]
    moves_uv: ClassVar[bool] = True
    layer: Any

    def _edit(
        self,
        context: bpy.types.Context,
        objects: Iterable[MeshObject],
        change: Callable[[Transaction, MeshObject], str],
    ) -> set[str]:
        """Let `change` write each object: it returns what was done."""
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        problems: list[str] = []
        done: list[str] = []
        with transaction() as run:
            with edit_mode.left_if_faster(run, context):
                for obj in with_own_meshes(objects):
                    with attempt(run, obj.name, problems):
                        done.append(change(run, obj))
                        if self.moves_uv:
                            forget(run, context, obj.name, self.layer or obj.data.uv_layers.active.name)
            if not done:
                return refused(self, self.nothing, problems)
            redraw(context)
            edit_mode.undo_all(context)
            for line in done:
                self.report({"INFO"}, line)
            return finished(self, self.not_done, problems)


class LayerRun(ModalRun):
    """The job has a task for each object. An object that cannot be read or written is named, and the others go on."""

    done: ClassVar[str]  # what the operator did to the islands: packed, sewn

    def _read(self, context: bpy.types.Context, job: Any, empty: str = "") -> Any:
        """Give the job the selected objects. @raises TransferError if no object has a task, with `empty` as reason"""
        self._problems: list[str] = []
        for obj in with_own_meshes(target_objects(context)):
            try:
                job.read(obj)
            except TransferError as error:
                self._problems.append(str(error))
        if not job.tasks:
            raise TransferError(lines(self._nothing(), self._problems or [empty] * bool(empty)))
        return job

    def _finish(self, context: bpy.types.Context, job: Any) -> set[str]:
        done, problems = [], self._problems
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
                return refused(self, self._nothing(), problems)
            for line in done:
                self.report({"INFO"}, line)
            return finished(self, f"not {self.done}", problems)

    def _nothing(self) -> str:
        return f"nothing was {self.done}."
