# SPDX-License-Identifier: GPL-3.0-or-later
"""Joins islands of a UV layer along selected edges: read, compute, write."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import Transaction
from ..maps.beside import new_overlaps
from ..maps.live import LEAST_EVEN
from ..maps.outcomes import Progress, Task, share_of
from ..maps.pins import join_pins
from ..maps.wording import counted
from ..surfaces.errors import MapError
from ..surfaces.surface import Surface, next_corners

SEWN_OVER = ". Islands lie over each other: Pack Only makes room"


@dataclasses.dataclass
class SewTask:
    """An object's layer, and what became of it.

    edges   (n, 2) vertices of the selected edges
    uv      (C, 2) of the layer
    pins    (C,) bool
    """

    layer: str
    target: Target
    surface: Surface
    edges: np.ndarray
    uv: np.ndarray
    pins: np.ndarray
    result: Any = None
    written: np.ndarray | None = None
    error: Exception | None = None
    lies_over: bool = False

    @property
    def line(self) -> str:
        """What was done."""
        made, new = self.result, int(self.result.island.max()) + 1
        said = f"{self.target.name}: {counted(made.sewn, 'edge')} sewn, {counted(made.joined, 'island')} became {new}"
        return said + SEWN_OVER * self.lies_over


class SewJob:
    """Sews several objects one after the other.

    layer   the UV layer. Without a name the active one
    even    E of the new islands; None: as even as the angles allow
    by_uv   the edges selected in the UV Editor, not those of the mesh
    """

    def __init__(self, koebe: ModuleType, layer: str, even: float | None, by_uv: bool) -> None:
        self.koebe = koebe
        self._layer, self._even, self._by_uv = layer, even, by_uv
        self.cancel_token = koebe.CancelToken()
        self.tasks: list[SewTask] = []

    def read(self, obj: MeshObject) -> None:
        """Add an object in Edit Mode, if edges are selected. Raises TransferError."""
        check_mesh(obj)
        layer = mesh_reading.layer_named(obj, self._layer)
        surface = mesh_reading.read_surface(obj, selected_only=False)
        corners = np.flatnonzero(mesh_reading.selected_edge_corners(obj, layer, self._by_uv, surface.corner_edge))
        if not len(corners):
            return
        ends = np.stack([corners, next_corners(surface)[corners]], axis=1)
        edges = np.unique(np.sort(surface.corner_vertex[ends], axis=1), axis=0)
        self.tasks.append(
            SewTask(layer, Target.of(obj), surface, edges, mesh_reading.read_layer(obj, layer).astype(np.float64),
                    mesh_reading.pinned_corners(obj, layer))
        )  # fmt: skip

    def compute(self, progress: Progress | None = None) -> None:
        """Fill the tasks' results or errors. Raises `koebe.Cancelled` once the token was raised."""
        for k, task in enumerate(self.tasks):
            try:
                self._sew(task, share_of(progress, k, 1, len(self.tasks)))
            except self.koebe.Cancelled:
                raise
            except (self.koebe.KoebeError, MapError) as error:
                task.error = error

    def _sew(self, task: SewTask, progress: Progress | None) -> None:
        corners = task.surface.triangle_corners
        made = self.koebe.sew(
            task.surface.positions, task.surface.corner_vertex[corners], uv=task.uv[corners], edges=task.edges,
            polygon=task.surface.triangle_face, even=self._even, cancel=self.cancel_token, progress=progress,
        )  # fmt: skip
        new = made.island >= 0
        uv, written = task.uv.copy(), np.unique(corners[new])
        uv[corners[new]] = made.uv[new]
        if task.pins[written].any():
            pins = np.where(task.pins[:, None], task.uv, np.nan)
            pinned = Task(task.target.name, task.surface, pins=pins)
            even = LEAST_EVEN if self._even is None else self._even
            uv[written] = join_pins(self.koebe, pinned, written, uv[written], even, self.cancel_token).uv
        task.uv, task.written, task.result = uv, written, made
        task.lies_over = new_overlaps(self.koebe, task.surface, uv, written)

    def write(self, run: Transaction, task: SewTask) -> None:
        """Write an object's layer. Raises TransferError, also if it could not be sewn."""
        if task.error is not None or task.written is None:
            raise TransferError(f"{task.target.name}: {task.error}")
        plan = map_writing.plan(task.target, task.layer, task.surface, task.written, task.uv[task.written])
        map_writing.write(run, plan, select=False)
