# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that moves the circles of a map by hand, or by its properties: Möbius maps, nothing is solved."""

import math
from collections.abc import Callable
from typing import ClassVar

import bpy
import numpy as np
from bpy.props import FloatProperty, FloatVectorProperty, IntProperty, StringProperty

from ..blender import edit_mode
from ..blender.errors import TransferError
from ..blender.noted_properties import note_group
from ..blender.targets import reason, target_objects
from ..blender.transaction import Transaction, transaction
from ..jobs import native_package
from ..jobs.moebius_job import MoebiusJob
from ..layers.circle_domain import CircleDomain, CircleImage, DomainError
from ..layers.circle_drag import HOLE, REACH, TURN, Grip
from ..maps.wording import few, lines
from ..solver.errors import NativeError
from ..state import moved_circles
from ..state.run_report import report_of
from ..surfaces.moebius import Moebius
from .answers import refused
from .modal_run import redraw
from .polls import OnTargets
from .uv_drag import UvDrag

NEAR, CLICK, SNAP = 6.0, 4.0, 7.0  # pixels: to hold a hole, longest click, to snap to the middle
HINTS = {
    TURN: "Turn: {0:.1f}°      Ctrl: Steps of 5°",
    HOLE: "Hole {1}: near the middle it snaps to the middle",
    "point": "Drag the disk under the pointer",
}


class UV_OT_koebe_moebius(OnTargets, UvDrag, bpy.types.Operator):
    """Move the circles of a map. Drag the disk or a hole, click a hole to make it the rim, or drag outside the disk to
    turn it. Angles are kept and circles stay circles"""

    shown: ClassVar[np.ndarray | None] = None  # edges (e, 2) of the dragged domain, complex, in the UVs
    held: ClassVar[tuple[str, np.ndarray] | None] = None  # the dragged object's name and its corners (c,)

    bl_idname = "uv.koebe_moebius"
    bl_label = "Koebe Move Circles"
    needs = "Select a mapped mesh object, in Object Mode or in Edit Mode"
    shown_errors = TransferError, DomainError, ReferenceError

    object_name: StringProperty(
        name="Object",
        description="Name of a selected object. Without a name, the first selected object whose UVs are circles",
    )
    layer: StringProperty(name="UV Layer", description="UV layer with the circles. Without a name, the active layer")
    island: IntProperty(
        name="Island",
        min=0,
        description="Number of the island. Only islands whose UVs are circles count. The first island is 0",
    )
    rim: IntProperty(
        name="Rim",
        min=0,
        description="Number of the loop that becomes the rim, as in the report. 0: the rim stays. The disk is then "
        "balanced and upright",
    )
    hole: IntProperty(
        name="Hole in the Middle",
        min=0,
        description="Number of the hole that moves to the middle of the disk, as in the report. 0: no hole",
    )
    center: FloatVectorProperty(
        name="Centre",
        size=2,
        precision=4,
        step=1,
        soft_min=-1.0,
        soft_max=1.0,
        description="Point that moves to the middle of the disk. The rim is the circle of radius 1 around (0, 0)",
    )
    rotation: FloatProperty(
        name="Turn",
        subtype="ANGLE",
        unit="ROTATION",
        description="Angle by which the disk turns at the end, counter-clockwise",
    )

    def draw(self, context: bpy.types.Context) -> None:
        layout = self.layout
        layout.use_property_split, layout.use_property_decorate = True, False
        for name in ("rim", "hole", "center", "rotation", "island", "layer"):
            row = layout.row()
            row.active = name != "center" or not self.hole
            row.prop(self, name)

    # ---------------------------------------------------------------- by properties

    def execute(self, context: bpy.types.Context) -> set[str]:
        context.evaluated_depsgraph_get()  # updates the objects' world matrices
        try:
            job = self._chosen_job(context)
            if not self.island < len(job.domains):
                raise TransferError(f"{job.name}: it has no island {self.island} whose UVs are circles")
            with transaction() as run:
                with edit_mode.left_if_faster(run, context):
                    image = self._write(run, context, job)
                redraw(context)
            return self._say(job, image)
        except (NativeError, TransferError, DomainError) as error:
            return refused(self, str(error))

    def _chosen_job(self, context: bpy.types.Context) -> MoebiusJob:
        """The object by its name, or the first object whose UVs are circles."""
        jobs, problems = _jobs(context, self.object_name, self.layer, lambda job: True)
        if not jobs:
            raise TransferError(lines("", problems).strip() or f"no object {self.object_name!r} is selected")
        return jobs[0]

    def _write(self, run: Transaction, context: bpy.types.Context, job: MoebiusJob) -> CircleImage:
        """Write the image given by the properties, and update the report."""
        domain = numbered(context, job, job.domains[self.island])
        image = domain.image(domain.moved(self.rim, complex(*self.center), self.rotation, self.hole))
        job.write(run, image)
        note_group(run, report_of(context))
        entry = moved_circles.entry_of(context, job.name, job.layer, domain)
        if entry is not None:
            moved_circles.record(entry, image, job.figures(image))
        return image

    def _say(self, job: MoebiusJob, image: CircleImage) -> set[str]:
        trouble = len(image.flipped) or image.too_small
        self.report({"WARNING" if trouble else "INFO"}, f"{job.name}: {moved_circles.describe(image)}")
        return {"FINISHED"}

    # ---------------------------------------------------------------- by hand

    def invoke(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if not self._press(context, event):
            return self.execute(context)
        context.evaluated_depsgraph_get()
        place = self._place(event.mouse_region_x, event.mouse_region_y)
        try:
            jobs, problems = _jobs(context, "", self.layer, lambda job: job.domain_at(*place, REACH) is not None)
        except NativeError as error:
            problems, jobs = [str(error)], []
        if not jobs:
            if problems:
                self.report({"ERROR"}, "Koebe UV: " + few(problems))
            return {"CANCELLED"}
        self._begin(context, event, jobs[0], place)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _begin(
        self, context: bpy.types.Context, event: bpy.types.Event, job: MoebiusJob, place: tuple[float, float]
    ) -> None:
        self.object_name, self.island = job.name, job.domain_at(*place, REACH) or 0
        self.rim, self.hole, self.center, self.rotation = 0, 0, (0.0, 0.0), 0.0
        self._job, self._run = job, Transaction()
        domain = numbered(context, job, job.domains[self.island])
        self._pixel = self._place(event.mouse_region_x + 1, event.mouse_region_y)[0] - place[0]
        self._grip = Grip.at(domain, *place, NEAR * self._pixel)
        self._pressed, self._dragging, self._live = (event.mouse_x, event.mouse_y), False, False
        self._back: Callable[[], None] | None = None

    def _follow(self, context: bpy.types.Context, event: bpy.types.Event) -> set[str]:
        if event.type == "MOUSEMOVE":
            self._drag(context, event)
        elif event.type == "LEFTMOUSE" and event.value == "RELEASE":
            return self._end(context)
        return {"RUNNING_MODAL"}

    def _reason(self, error: Exception) -> str:
        return reason(self._job.name, error)

    def cancel(self, context: bpy.types.Context) -> None:
        """Restore everything: after Esc, after an error, or when Blender ends the operator."""
        self._run.put_back()
        self._tidy(context)

    def _tidy(self, context: bpy.types.Context) -> None:
        UV_OT_koebe_moebius.shown = UV_OT_koebe_moebius.held = None
        context.workspace.status_text_set(None)
        redraw(context)

    def _drag(self, context: bpy.types.Context, event: bpy.types.Event) -> None:
        """Show the map of a drag to the pointer."""
        if not self._dragging:
            if math.dist(self._pressed, (event.mouse_x, event.mouse_y)) <= CLICK:
                return
            self._start(context)
        x, y = event.mouse_x - self._region.x, event.mouse_y - self._region.y
        moved = self._grip.moved(*self._place(x, y), SNAP * self._pixel, event.ctrl)
        center, angle = self._grip.properties(moved)
        self.center, self.rotation = (center.real, center.imag), angle
        self._show(context, self._grip.domain.moved(0, complex(*self.center), self.rotation))

    def _start(self, context: bpy.types.Context) -> None:
        """The pointer has moved. From now on UVs are written in Object Mode, where that is fast."""
        self._dragging, domain = True, self._grip.domain
        note_group(self._run, report_of(context))
        self._entry = moved_circles.entry_of(context, self._job.name, self._job.layer, domain)
        if self._entry is not None:
            moved_circles.begin(self._entry, domain)
        self._edges = self._job.edges(domain)
        UV_OT_koebe_moebius.held = self._job.name, domain.island.corners
        self._back = edit_mode.leave(self._run, context)
        self._live = context.mode == "OBJECT"  # otherwise only the circles move until the end
        if self._live:
            self._run.before_write(self._job.put_back)

    def _show(self, context: bpy.types.Context, moved: Moebius) -> None:
        points = self._job.image_of(self._grip.domain, moved)
        UV_OT_koebe_moebius.shown = points[self._edges]
        if self._live:
            self._job.show(self._grip.domain, points)
        if self._entry is not None:
            moved_circles.show(self._entry, self._grip.domain, moved)
        hint = HINTS[self._grip.kind].format(math.degrees(self.rotation), self._grip.hole)
        context.workspace.status_text_set(f"Koebe UV: {hint}      Esc: Cancel")
        redraw(context)

    def _end(self, context: bpy.types.Context) -> set[str]:
        """The button was released: write permanently. A click on a hole makes it the rim; other clicks do nothing."""
        if not self._dragging:
            if not self._grip.hole:
                self._tidy(context)
                return {"CANCELLED"}
            self.rim = self._grip.hole
            self._start(context)
        if self._live:
            self._job.put_back()
        image = self._write(self._run, context, self._job)
        if self._back is not None:
            self._back()
        self._tidy(context)
        return self._say(self._job, image)


def _jobs(
    context: bpy.types.Context, name: str, layer: str, wanted: Callable[[MoebiusJob], bool]
) -> tuple[list[MoebiusJob], list[str]]:
    """The first suitable object, as a list, and the problems of the objects before it."""
    koebe, problems = native_package.load(), []
    for obj in target_objects(context):
        if name and obj.name != name:
            continue
        try:
            job = MoebiusJob(koebe, obj, layer)
        except TransferError as error:
            problems.append(str(error))
            continue
        if wanted(job):
            return [job], problems
    return [], problems


def numbered(context: bpy.types.Context, job: MoebiusJob, domain: CircleDomain) -> CircleDomain:
    """The domain with its holes numbered as in the report, if it is there."""
    entry = moved_circles.entry_of(context, job.name, job.layer, domain)
    return domain if entry is None else domain.numbered(moved_circles.loop_keys(entry))
