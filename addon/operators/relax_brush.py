# SPDX-License-Identifier: GPL-3.0-or-later
"""The brush of the UV Editor that relaxes the UVs under it, one to one."""

import contextlib
from typing import Any, ClassVar

import bpy
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ..blender.errors import TransferError
from ..blender.targets import target_objects
from ..blender.transaction import transaction
from ..jobs import native_package
from ..jobs.relax_job import RelaxJob
from ..layers.relax_brush import Dab
from ..solver.errors import NativeError
from ..solver.worker import Worker
from ..state.run_report import forget
from .answers import refused
from .modal_run import redraw
from .polls import OnTargets
from .uv_drag import UvDrag

POLL_SECONDS = 0.01
NO_ISLAND = "no island is there whose faces are not turned over: begin on one that is shown"


class UV_OT_koebe_relax(OnTargets, UvDrag, bpy.types.Operator):
    """Brush over UVs to relax them: texels become more even, and the map stays one to one. Borders of islands and
    pinned UVs stay. Esc puts all back"""

    bl_idname = "uv.koebe_relax"
    bl_label = "Koebe Relax"
    bl_options = {"REGISTER", "UNDO", "BLOCKING"}
    needs, modes = "Works on the UVs of a mesh object in Edit Mode", ("EDIT_MESH",)
    shown_errors = (TransferError,)
    shown: ClassVar[tuple[int, int] | None] = None  # pixel of the region under a brush that works

    center: FloatVectorProperty(
        name="Centre", size=2, default=(0.5, 0.5), soft_min=0.0, soft_max=1.0, description="Middle of the brush, in UVs"
    )
    radius: FloatProperty(name="Radius", default=0.1, min=0.0, soft_max=1.0, description="Radius of the brush, in UVs")
    even: FloatProperty(
        name="Even",
        default=0.5,
        min=0.0,
        max=1.0,
        description="How even texels become under the brush. 0: angles are kept",
    )
    layer: StringProperty(name="UV Layer", description="UV layer. Without a name, the active layer")

    def execute(self, context: bpy.types.Context) -> set[str]:
        """One dab."""
        try:
            job, island = self._job_at(context, tuple(self.center))
            dab = job.brush.dab(island, tuple(self.center), (self.radius or 1e-9, self.radius or 1e-9), self.even)
            if not len(dab.corners):
                return refused(self, dab.problem)
            return self._end(context, job, dab)
        except (NativeError, TransferError) as error:
            return refused(self, str(error))

    def _job_at(self, context: bpy.types.Context, place: tuple[float, float]) -> tuple[RelaxJob, int]:
        """The object and the island at a place. Raises NativeError, or TransferError if none is there."""
        koebe = native_package.load()
        context.evaluated_depsgraph_get()
        problems = []
        for obj in target_objects(context):
            try:
                job = RelaxJob(koebe, obj, self.layer, not context.tool_settings.use_uv_select_sync)
            except TransferError as error:
                problems.append(str(error))
                continue
            island = job.brush.island_at(place)
            if island is not None:
                return job, island
        raise TransferError(problems[0] if problems else NO_ISLAND)

    def _end(self, context: bpy.types.Context, job: RelaxJob, last: Dab | None = None) -> set[str]:
        """Write all dabs at once. @param last that was not shown yet"""
        with transaction() as run:
            run.before_write(job.put_back)
            if last is not None:
                job.show(last)
            job.write(run)
            forget(run, context, job.target.name, job.layer)
        redraw(context)
        return {"FINISHED"}

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self._press(context, event):
            return self.execute(context)
        self._at = event.mouse_region_x, event.mouse_region_y
        self.center, pixels = self._place(*self._at), context.scene.koebe_relax_radius
        self.radius = pixels * self._pixel()[0]
        try:
            self._job, self._island = self._job_at(context, tuple(self.center))
        except (NativeError, TransferError) as error:
            return refused(self, str(error))
        self._worker = None
        self._made: Dab
        self._wanted: tuple[int, int] | None = self._at
        self._is_released = False
        self._timer = context.window_manager.event_timer_add(POLL_SECONDS, window=context.window)
        context.window_manager.modal_handler_add(self)
        self._show(context)
        return {"RUNNING_MODAL"}

    def _pixel(self) -> tuple[float, float]:
        """The width and the height of a pixel in UVs."""
        (u, v), (right, top) = self._place(0, 0), self._place(100, 100)
        return (right - u) / 100, (top - v) / 100

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "MOUSEMOVE":
            self._at = event.mouse_x - self._region.x, event.mouse_y - self._region.y
            self._wanted = None if self._is_released else self._at
            self._show(context)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            self._is_released = True
        elif event.type == "TIMER":
            return self._go_on(context)
        return {"RUNNING_MODAL"}

    def _go_on(self, context: bpy.types.Context) -> set[str]:
        """Show the dab that has ended, and begin the next one; at the end write all."""
        if self._worker is not None:
            if self._worker.running:
                return {"RUNNING_MODAL"}
            self._worker.result()
            self._worker = None
            self._job.show(self._made)
            redraw(context, ("VIEW_3D", "IMAGE_EDITOR"))
        if self._wanted is not None:
            place, pixel = self._place(*self._wanted), self._pixel()
            radius = context.scene.koebe_relax_radius
            self._wanted = None
            self._worker = Worker(lambda progress: self._brush(place, (radius * pixel[0], radius * pixel[1])))
        elif self._is_released:
            self._tidy(context)
            if self._job.has_changed:
                return self._end(context, self._job)
            return refused(self, self._made.problem)
        return {"RUNNING_MODAL"}

    def _brush(self, place: tuple[float, float], radius: tuple[float, float]) -> None:
        self._made = self._job.brush.dab(self._island, place, radius, self.even)

    def cancel(self, context: bpy.types.Context) -> None:
        """Put the UVs back: after Esc, after an error, or when Blender ends the operator."""
        self._end_worker()
        with contextlib.suppress(TransferError):
            self._job.put_back()
        self._tidy(context)

    def _tidy(self, context: bpy.types.Context) -> None:
        UV_OT_koebe_relax.shown = None
        context.window_manager.event_timer_remove(self._timer)
        context.workspace.status_text_set(None)
        redraw(context)

    def _show(self, context: bpy.types.Context) -> None:
        UV_OT_koebe_relax.shown = self._at
        context.workspace.status_text_set("Koebe UV: Relax      Release: Keep      Esc: Cancel")
        redraw(context, ("IMAGE_EDITOR",))


def register() -> None:
    """Register the operator, and the brush's radius."""
    scene: Any = bpy.types.Scene
    scene.koebe_relax_radius = IntProperty(
        name="Radius", default=60, min=1, soft_max=500, subtype="PIXEL", description="Radius of the brush Koebe Relax"
    )
    bpy.utils.register_class(UV_OT_koebe_relax)


def unregister() -> None:
    """The reverse of `register`."""
    bpy.utils.unregister_class(UV_OT_koebe_relax)
    scene: Any = bpy.types.Scene
    del scene.koebe_relax_radius
