# SPDX-License-Identifier: GPL-3.0-or-later
"""One run on Blender objects: read, map, write. The operator and the batch script share it.

`Job.compute` touches no Blender data and may run on any thread; everything else runs on the main thread.
"""

import dataclasses
from contextlib import AbstractContextManager
from typing import Any

import bpy
import numpy as np

from ..blender import checker, map_writing, mesh_reading, rendered_layer, sequence_player, shapes, uv_layers
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh, reason, with_own_meshes
from ..blender.transaction import Transaction, transaction
from ..layers.tile_pattern import Pattern
from ..maps.mapping import map_surfaces
from ..maps.options import Options
from ..maps.outcomes import LATER, Outcome, Place, Progress, Task, failure_row
from ..maps.wording import counted, few
from ..surfaces.surface import Surface
from ..surfaces.welding import joined
from . import native_package


class Job:
    """Maps the surfaces of some mesh objects. Objects that share a mesh count once.

    targets   the objects that were read; tasks and outcomes are in their order
    refused   name and reason of each object that was left out
    """

    def __init__(
        self,
        objects: list[MeshObject],
        options: Options,
        selected_only: bool = False,
        refused: list[tuple[str, str]] | None = None,
    ) -> None:
        """Read the objects. Raises NativeError, or TransferError if none can be mapped.

        An object that could not be written later is left out. Without a list `refused` for these, it raises.
        """
        self.koebe = native_package.load()
        self.options, self.selected_only = options, selected_only
        self._first: np.ndarray | None = None  # of the surface that was read last, see `joined`
        self._dropped = np.zeros(0, dtype=bool)  # (P,) faces of that surface without a place once vertices are joined
        self._loose: dict[str, int] = {}  # by object: vertices at the place of another one
        self.refused = [] if refused is None else refused
        self.targets: list[Target] = []
        self.tasks: list[Task] = []
        for obj in with_own_meshes(objects):
            try:
                self._add(obj)
            except Exception as error:
                if refused is None:
                    raise
                refused.append((obj.name, reason(obj.name, error)))
        if not self.targets:
            reasons = [text for _, text in self.refused]
            raise TransferError(
                few(reasons) if reasons
                else "no faces are selected" if selected_only else "there is no mesh with faces"
            )  # fmt: skip
        if options.outer == "active" and all(task.outer == "auto" for task in self.tasks):
            raise TransferError(
                "Outer Boundary is Active Vertex, but no vertex is active: in Edit Mode, select a vertex of it"
            )
        for wanted, found, what, where in (
            (options.center, [task.center for task in self.tasks], "Centre", "inside the surface"),
            (options.point, [task.point for task in self.tasks], "Rim Point", "of a boundary"),
        ):
            if wanted == "active" and all(place is None for place in found):
                raise TransferError(
                    f"{what} is Active Vertex, but no vertex is active: in Edit Mode, select a vertex {where}"
                )
        if self._importance:
            self._even_importance()
        self.cancel_token = self.koebe.CancelToken()
        self.outcomes: list[Any] = LATER  # of a subclass of `Outcome`

    @property
    def _importance(self) -> str:
        """The vertex group, or empty."""
        return str(self.options.importance)

    @property
    def _cut_at(self) -> str:
        """What counts as a seam beside the seams: a word of the option."""
        return "nothing"

    def _add(self, obj: MeshObject) -> None:
        check_mesh(obj)
        surface = self._surface(obj)
        if not surface.selected.any():
            return
        self._check_room(obj)
        self._check_pins(obj, surface)
        task = self._task(obj, surface)
        self.targets.append(Target.of(obj))
        self.tasks.append(task)

    def _surface(self, obj: MeshObject) -> Surface:
        surface, self._first = mesh_reading.read_surface(obj, self.selected_only, self._cut_at), None
        if self.options.deformed:
            surface = shapes.deformed_surface(bpy.context, obj, surface)
        self._dropped = np.zeros_like(surface.selected)
        if not np.isfinite(surface.positions).all():  # the solver refuses them, and names them
            return surface
        if self.options.weld > 0.0:
            chosen = surface.selected
            surface, self._first = joined(self.koebe, surface, self.options.weld)
            self._dropped = chosen & ~surface.selected
        elif loose := int(np.count_nonzero(np.diff(np.sort(self.koebe.weld(surface.positions))) == 0)):
            self._loose[obj.name] = loose
        return surface

    def _named(self, vertex: Any) -> Any:
        """The vertex that stands for this one in the surface that was read last. Other places stay."""
        whole = isinstance(vertex, int) and self._first is not None and 0 <= vertex < len(self._first)
        return int(self._first[vertex]) if whole else vertex  # type: ignore[index]

    def _task(self, obj: MeshObject, surface: Surface) -> Task:
        outer = self.options.outer
        if outer == "active":
            vertex = mesh_reading.active_vertex(obj)
            outer = "auto" if vertex is None else vertex
        outer = self._named(outer)
        mirrored = obj.matrix_world.determinant() < 0.0
        center, point = (self._named(self._place(obj, one)) for one in (self.options.center, self.options.point))
        importance = mesh_reading.vertex_weights(obj, self._importance) if self._importance else None
        return Task(obj.name, surface, outer, mirrored, center=center, point=point, importance=importance,
                    rest=self._rest(obj, surface), pins=self._pins(obj, surface))  # fmt: skip

    def _rest(self, obj: MeshObject, surface: Surface) -> np.ndarray | None:
        """The UVs of the layer, if faces that are not selected have some there; NaN where nothing is to stay."""
        if (surface.selected | self._dropped).all() or self.options.layer not in obj.data.uv_layers:
            return None
        uv = mesh_reading.read_layer(obj, self.options.layer)
        uv[np.repeat(self._dropped, surface.face_size)] = np.nan
        return uv

    def _check_room(self, obj: MeshObject) -> None:
        """Raise TransferError unless the results can be written to the object."""
        uv_layers.check_layer(obj, self.options.layer)

    def _check_pins(self, obj: MeshObject, surface: Surface) -> None:
        """Raise TransferError if pinned UVs would move whatever they are."""
        if (self.options.placement == "together" or self.options.symmetry != "off") and (
            self._pinned(obj, surface).any()
        ):
            raise TransferError(
                f"{obj.name}: pinned UVs cannot be kept with Placement: Together or with Symmetry: choose others"
            )

    def _pins(self, obj: MeshObject, surface: Surface) -> np.ndarray | None:
        """The pinned UVs (C, 2), NaN elsewhere, or None."""
        pinned = self._pinned(obj, surface)
        if not pinned.any():
            return None
        return np.where(pinned[:, None], mesh_reading.read_layer(obj, self.options.layer), np.nan)

    def _pinned(self, obj: MeshObject, surface: Surface) -> np.ndarray:
        """Which corners (C,) of selected faces are pinned in the layer."""
        return mesh_reading.pinned_corners(obj, self.options.layer) & np.repeat(surface.selected, surface.face_size)

    def _even_importance(self) -> None:
        """Subtract the least importance over all objects; without the group it is 0. Raises TransferError."""
        known = [task.importance for task in self.tasks if task.importance is not None]
        if not known:
            raise TransferError(f"More Texels is the vertex group {self._importance!r}, but no object has this group")
        least = min(float(one.min()) for one in known) if len(known) == len(self.tasks) else 0.0
        self.tasks = [
            dataclasses.replace(task, importance=None if task.importance is None else task.importance - least)
            for task in self.tasks
        ]

    @staticmethod
    def _place(obj: MeshObject, wanted: str | int) -> Place:
        if wanted == "cursor":
            return mesh_reading.cursor_place(obj)
        if wanted == "active":
            return mesh_reading.active_vertex(obj)
        return wanted if isinstance(wanted, int) else None

    def compute(self, progress: Progress | None = None) -> None:
        """Fill `outcomes`, one per object. Raises `koebe.Cancelled` once the token was raised."""
        self.outcomes = map_surfaces(self.koebe, self.tasks, self.options, progress, self.cancel_token)

    def sketched(self) -> np.ndarray:
        """As of parts. Other maps have no cuts to show before they are done."""
        return np.zeros((0, 2, 3), dtype=np.float32)

    def line(self, outcome: Outcome) -> str:
        """One line on a surface with at least one mapped island."""
        return outcome.line()

    def entries(self, outcome: Outcome) -> list[dict[str, Any]]:
        """Its entries of the JSON report."""
        return outcome.entries()

    def rows(self) -> list[dict[str, Any]]:
        """The rows of the report in Blender."""
        left_out = [failure_row(name, text) for name, text in self.refused]
        together = self.options.placement == "together"
        rows = [row for outcome in self.outcomes for row in outcome.rows(self.options.layer)]
        return [{**row, "together": together} for row in rows] + left_out

    def read_old_uv(self) -> None:
        """Note the present places of the islands, for the placement "keep". Call it before anything changes."""
        self.tasks = [self._with_old_uv(*pair) for pair in zip(self.targets, self.tasks, strict=True)]

    def _with_old_uv(self, target: Target, task: Task) -> Task:
        obj = target.obj
        assert obj is not None  # it was just read
        return dataclasses.replace(task, old_uv=mesh_reading.read_uv(obj, self.options.layer))

    @property
    def mapped_any(self) -> bool:
        """Whether anything can be written, or was written."""
        return any(outcome.mapped for outcome in self.outcomes)

    def write(self, run: Transaction | None = None) -> None:
        """Write the UV layer of every object with a mapped island, and put the checker on if requested.

        An object that cannot be written stays as it was, and its outcome gets the reason. Without a transaction `run`
        it raises, and all objects stay as they were.
        """
        if run is None:
            with transaction() as run:
                self.write(run)
                lost = [outcome.not_written for outcome in self.outcomes if outcome.not_written]
                if lost:
                    raise TransferError(". ".join(lost))
            return
        plans, start = [], run.mark()
        for target, outcome in zip(self.targets, self.outcomes, strict=True):
            if outcome.mapped:
                with self._attempt(run, outcome):
                    plans.append((outcome, self._plan(target, outcome)))
        materials = self._checkers(run, [plan for _, plan in plans])
        for (outcome, plan), material in zip(plans, materials, strict=True):
            with self._attempt(run, outcome):
                self._write_one(run, outcome, plan, material)
        if not self.mapped_any:
            run.put_back(start)  # the new material

    @staticmethod
    def _attempt(run: Transaction, outcome: Any) -> AbstractContextManager[None]:
        def failed(error: Exception) -> None:
            outcome.not_written = reason(outcome.name, error)

        return run.attempt(failed)

    def _plan(self, target: Target, outcome: Any) -> map_writing.Plan:
        return map_writing.plan(target, self.options.layer, outcome.task.surface, *outcome.corner_uv())

    def _checkers(self, run: Transaction, plans: list[map_writing.Plan]) -> list[bpy.types.Material | None]:
        """The checker for each object, or None."""
        if not self.options.checker:
            return [None] * len(plans)
        sizes = [self.options.checker_size] * len(plans)
        if self.options.checker_even and len(plans) > 1:
            sizes = checker.even_sizes(sizes[0], [plan.density for plan in plans])
        patterns = [self._pattern(*pair) for pair in zip(plans, sizes, strict=True)]
        return [*checker.materials(run, [plan.obj for plan in plans], self.options.layer, patterns)]

    def _pattern(self, plan: map_writing.Plan, size: float) -> Pattern:
        return Pattern(size)

    def _write_one(
        self, run: Transaction, outcome: Any, plan: map_writing.Plan, material: bpy.types.Material | None
    ) -> None:
        map_writing.write(run, plan)
        hidden = sequence_player.shown_instead(plan.obj, plan.layer)
        if hidden is not None:
            outcome.remarks.append(hidden)
        if loose := self._loose.get(outcome.name, 0):
            outcome.remarks.append(
                f"{counted(loose, 'vertex', 'vertices')} at the place of another one: Merge Distance, under Seams and "
                "Cuts, joins them in the UVs"
            )
        self._put_checker(run, outcome, plan.obj, material)
        outcome.hints += rendered_layer.sentences(plan.obj, plan.layer)

    @staticmethod
    def _put_checker(run: Transaction, outcome: Any, obj: MeshObject, material: bpy.types.Material | None) -> None:
        if material is None:
            return
        try:
            checker.check(obj)
        except TransferError as error:  # the map is there nevertheless
            outcome.remarks.append(f"it did not get the checker. {error}")
        else:
            checker.put_on(run, obj, material)
