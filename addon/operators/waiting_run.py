# SPDX-License-Identifier: GPL-3.0-or-later
"""A run from the redo panel that goes on beside the window."""

import dataclasses
from typing import Any, ClassVar

import bpy

from ..blender.transaction import Transaction
from ..jobs.map_job import Job
from ..solver.worker import Worker


@dataclasses.dataclass
class Waiting:
    """A run from the redo panel that goes on.

    label    of its operator, as of its undo step
    preview  has written the last map, which is seen meanwhile
    settled  the redo panel has ended: changes after that are the user's
    last     the run that goes on now
    done     the last map: the label of its operator, and its job
    """

    label: str
    job: Job
    worker: Worker
    preview: Transaction
    settled: bool = False

    last: ClassVar["Waiting | None"] = None
    done: ClassVar[tuple[str, Job] | None] = None


def go_on(window: bpy.types.Window, run: Waiting) -> None:
    """Look after a run once the redo panel has ended. It takes the place of the last one."""
    forget_waiting()
    Waiting.last = run

    def begin() -> None:
        if Waiting.last is run:
            with bpy.context.temp_override(window=window):
                operators: Any = bpy.ops.uv
                operators.koebe_redo("INVOKE_DEFAULT")

    bpy.app.timers.register(begin, first_interval=0.0)


def forget_waiting() -> None:
    """End the run that goes on."""
    if Waiting.last is not None:
        Waiting.last.job.cancel_token.cancel()
        Waiting.last = None
