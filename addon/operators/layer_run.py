# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs that change the UV layer of each selected object, one object after the other."""

from typing import Any, ClassVar

import bpy

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.targets import attempt, target_objects, with_own_meshes
from ..blender.transaction import transaction
from ..maps.wording import lines
from ..state.run_report import forget
from .answers import finished, refused
from .modal_run import ModalRun, redraw


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
