# SPDX-License-Identifier: GPL-3.0-or-later
"""A run on Blender objects that maps their shapes one after another: read, compute, write."""

import dataclasses
from collections.abc import Generator
from typing import Any

import bpy
import numpy as np

from ..blender import checker, edit_mode, map_writing, sequence_player, shapes, uv_layers, vector_attribute
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target
from ..blender.transaction import Transaction
from ..maps.options import OptionError, SequenceChoice
from ..maps.outcomes import Progress, Task
from ..maps.sequence import SequenceOutcome, are_alike, map_sequence, point_values
from .choice_job import ChoiceJob

STAYS_IN_EDIT_MODE = (
    "the run needs Object Mode, and Blender could not return to Edit Mode with objects that are hidden or not "
    "selected: leave Edit Mode first"
)


class SequenceJob(ChoiceJob):
    """Has sequences as outcomes. First reads the objects, then `read_shapes`, then `compute`."""

    choice: SequenceChoice

    def _begin(self) -> None:
        scene: Any = bpy.context.scene
        self.frames = self.choice.frames or range(scene.frame_start, scene.frame_end + 1, scene.frame_step)
        self.names: dict[str, list[str]] = {}  # by object: names of the layers or attributes with each shape's UVs
        self.shapes: dict[str, list[shapes.MeshShape]] = {}

    def _check_room(self, obj: MeshObject) -> None:
        wanted = [*self.frames] if self.choice.source == "FRAMES" else shapes.key_names(obj)
        try:
            names = [self.choice.name(self.options.layer, shape) for shape in wanted]
        except OptionError as error:
            raise TransferError(f"{obj.name}: {error}") from None
        if self.choice.source == "FRAMES":
            shapes.check_frames(bpy.context, obj)
        if self._needs_object_mode() and obj.mode == "EDIT" and not edit_mode.can_leave(bpy.context):
            raise TransferError(f"{obj.name}: {STAYS_IN_EDIT_MODE}")
        if self.choice.target == "LAYERS":
            uv_layers.check_layers(obj, names)
        for name in names if self.choice.target == "ATTRIBUTE" else ():
            vector_attribute.check(obj, name)
        self.names[obj.name] = names
        if self.choice.source == "SHAPE_KEYS":
            self.shapes[obj.name] = shapes.key_shapes(obj, shapes.key_names(obj))

    def _needs_object_mode(self) -> bool:
        return self.choice.source == "FRAMES" or self.choice.target == "ATTRIBUTE"

    def read_shapes(self, context: bpy.types.Context) -> Generator[float, None, None]:
        """Read the shapes of all objects step by step; yields the share that is read. Raises TransferError."""
        if self.choice.source != "FRAMES":
            return
        steps = len(self.frames) * len(self.targets)
        for number, (target, task) in enumerate(zip(self.targets, self.tasks, strict=True)):
            read = self.shapes[target.name] = []
            for shape in shapes.frame_shapes(context, target.find(), task.surface, self.frames):
                read.append(shape)
                yield (number * len(self.frames) + len(read)) / steps

    def compute(self, progress: Progress | None = None) -> None:
        """As in `ChoiceJob`."""
        self._alike = {task.name: self._keep_one(task) for task in self.tasks}
        super().compute(progress)

    def _size(self, task: Task) -> int:
        return len(self.shapes[task.name]) * super()._size(task)

    def _map(self, task: Task, progress: Progress | None) -> SequenceOutcome:
        found = self.shapes[task.name]
        begun = _begun(task, found[0])
        outcome = map_sequence(self.koebe, begun, found, self.options, progress, self.cancel_token)
        outcome.alike, outcome.written = self._alike[task.name], self.names[task.name]
        outcome.in_layers = self.choice.target == "LAYERS"
        return outcome

    def _keep_one(self, task: Task) -> int:
        """Keep only the first shape of an object if all are alike. Returns their number, or 0."""
        found, surface = self.shapes[task.name], task.surface
        used = surface.triangle_corners[surface.selected[surface.triangle_face]]
        if len(found) < 2 or not are_alike(found, surface.corner_vertex[used]):
            return 0
        self.shapes[task.name], self.names[task.name] = found[:1], self.names[task.name][:1]
        return len(found)

    def _plan(self, target: Target, outcome: SequenceOutcome) -> Any:
        names, maps = self.names[outcome.task.name], outcome.maps
        uvs = [made.corner_uv() for made in maps]
        if self.choice.target == "LAYERS":
            uv_layers.check_layers(target.find(), names)
            return [
                map_writing.plan(target, name, made.task.surface, *uv)
                for name, made, uv in zip(names, maps, uvs, strict=True)
            ]
        surface, obj = outcome.task.surface, target.find()
        points = [point_values(surface, *uv) for uv in uvs]
        cut = any(values is None for values in points)  # then all values are of the corners
        return self._shown(target, outcome, uvs[0]), obj, [
            vector_attribute.Vectors(name, "CORNER", *uv) if cut or values is None
            else vector_attribute.Vectors(name, "POINT", *values)
            for name, uv, values in zip(names, uvs, points, strict=True)
        ]  # fmt: skip

    def _shown(
        self, target: Target, outcome: SequenceOutcome, uv: tuple[np.ndarray, np.ndarray]
    ) -> map_writing.Plan | None:
        """The plan for the first frame in the UV layer that plays all frames, or None if it has no place."""
        if not (self.choice.play and self.choice.source == "FRAMES"):
            return None
        try:
            return map_writing.plan(target, self.options.layer, outcome.maps[0].task.surface, *uv)
        except TransferError as error:  # the attributes are there nevertheless
            outcome.remarks.append(f"no modifier plays the frames. {error}")
            return None

    def _checkers(self, run: Transaction, plans: list[Any]) -> list[bpy.types.Material | None]:
        """The checker of the layer in which each object shows its first map, or None."""
        found: list[bpy.types.Material | None] = []
        for shown, *_ in plans:
            if shown is None or not self.options.checker:
                found.append(None)
            else:
                pattern = self._pattern(shown, self.options.checker_size)
                found += checker.materials(run, [shown.obj], shown.layer, [pattern])
        return found

    def _write_one(self, run: Transaction, outcome: Any, plan: Any, material: Any) -> None:
        outcome.how_shown = self._how_shown(outcome, plan)
        if self.choice.target == "LAYERS":
            map_writing.write_several(run, plan)
            self._put_checker(run, outcome, plan[0].obj, material)
            return
        shown, obj, vectors = plan
        if obj.mode == "EDIT":
            raise TransferError(f"{obj.name}: {STAYS_IN_EDIT_MODE}")
        for one in vectors:
            vector_attribute.write(run, obj, one)
        if shown is None:
            return
        if outcome.alike:
            outcome.in_uv = True
            super()._write_one(run, outcome, shown, material)
            return
        map_writing.write(run, shown)
        sequence_player.put_on(run, obj, self.options.layer, self.choice.name(self.options.layer, ""), self.frames)
        self._put_checker(run, outcome, obj, material)

    def _how_shown(self, outcome: SequenceOutcome, plan: Any) -> str:
        """A sentence: where the maps are to be seen."""
        each = "frame" if self.choice.source == "FRAMES" else "shape key"
        if outcome.alike:
            return ""  # a warning says what was written
        if self.choice.target == "LAYERS":
            said = f"each {each} has its own UV layer. Choose a layer in Object Data ▸ UV Maps"
            return said if each == "shape key" else f"{said}. With Target: Attributes the map follows the timeline"
        if plan[0] is not None:
            return "play the timeline: the checker and the UV Editor show the map of each frame"
        return f"each {each} has its own attribute. An Attribute node in a material shows it: {outcome.written[-1]}"


def _begun(task: Task, first: shapes.MeshShape) -> Task:
    """The task with the triangles of the first shape."""
    surface = dataclasses.replace(task.surface, positions=first.positions)
    if first.triangle_corners is not None:
        surface = dataclasses.replace(surface, triangle_corners=first.triangle_corners)
    return dataclasses.replace(task, surface=surface)
