# SPDX-License-Identifier: GPL-3.0-or-later
"""Packs the islands of a UV layer of each object, as they are: read, compute, write."""

import dataclasses
from types import ModuleType
from typing import Any

import numpy as np

from ..blender import map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import Transaction
from ..maps.outcomes import Progress, share_of
from ..maps.wording import counted
from ..surfaces.surface import Surface


@dataclasses.dataclass
class PackTask:
    """An object's islands, and what became of them.

    corners  (t, 3) of the triangles that are packed, polygon (t,) their faces
    uv       (C, 2) of the layer
    locked   (t,) triangles whose islands keep their place
    placed   (t, 3, 2) their new UVs
    result   of all objects that share a UV square, named in `together`
    """

    layer: str
    target: Target
    surface: Surface
    corners: np.ndarray
    polygon: np.ndarray
    uv: np.ndarray
    locked: np.ndarray
    together: list[str] = dataclasses.field(default_factory=list)
    placed: np.ndarray | None = None
    result: Any = None
    error: Exception | None = None

    @property
    def line(self) -> str:
        """What became of it, in a sentence."""
        first, name = self.together[0], self.target.name
        if name != first:
            return f"{name}: in one atlas with {first}, whose line has the figures"
        report = self.result.to_dict()
        overlaps = report["overlaps"]
        more = f", {overlaps} overlap or touch themselves as before" if overlaps else ""
        kept = sum(island["locked"] for island in report["islands"])
        more += f", {kept} kept their place" if kept else ""
        more += f", the others {100 * report['scale']:.0f} % as large" if kept and report["scale"] < 0.995 else ""
        more += f", in one atlas of {len(self.together)} objects" if len(self.together) > 1 else ""
        return (
            f"{name}: {counted(len(report['islands']), 'island')}{more}, "
            f"{100 * report['coverage']:.0f} % of the UV square, margin {report['margin']:.3g} px"
        )


class PackJob:
    """Packs several objects, each into a UV square of its own, or all into one.

    layer    that is packed. Without a name the active one
    keep     word of the option `keep_places`
    atlas    all into one
    options  of `koebe.pack`; the `seconds` are those of each square
    """

    def __init__(
        self, koebe: ModuleType, layer: str, selected_only: bool, keep: str, atlas: bool, options: dict[str, Any]
    ) -> None:
        self.koebe, self.options, self._atlas = koebe, options, atlas
        self._layer, self._selected_only, self._keep = layer, selected_only, keep
        self.cancel_token, self.enough = koebe.CancelToken(), koebe.CancelToken()
        self.tasks: list[PackTask] = []

    def read(self, obj: MeshObject) -> None:
        """Add an object. Raises TransferError."""
        check_mesh(obj)
        surface = mesh_reading.read_surface(obj, self._selected_only)
        layer = mesh_reading.layer_named(obj, self._layer)
        selected = surface.selected[surface.triangle_face]
        if not selected.any():
            nothing = "no face is selected" if self._selected_only else "it has no faces"
            raise TransferError(f"{obj.name}: {nothing}")
        chosen = np.ones_like(selected) if self._keep in {"OTHERS", "BOTH"} else selected
        corners = surface.triangle_corners[chosen]
        locked = ~selected[chosen]
        if self._keep in {"PINNED", "BOTH"}:
            locked |= mesh_reading.pinned_corners(obj, layer)[corners].any(axis=1)
        uv = mesh_reading.read_layer(obj, layer).astype(np.float64)
        polygon = surface.triangle_face[chosen]
        self.tasks.append(PackTask(layer, Target.of(obj), surface, corners, polygon, uv, locked))

    def compute(self, progress: Progress | None = None) -> None:
        """Fill the tasks' results or errors. Raises `koebe.Cancelled` once the token was raised."""
        squares = [self.tasks] if self._atlas else [[task] for task in self.tasks]
        for k, tasks in enumerate(squares):
            try:
                self._pack(tasks, share_of(progress, k, 1, len(squares)))
            except self.koebe.Cancelled:
                raise
            except self.koebe.KoebeError as error:
                for task in tasks:
                    task.error = error

    def _pack(self, tasks: list[PackTask], progress: Progress | None) -> None:
        """Pack the islands of these objects into one square."""
        surfaces = [task.surface for task in tasks]
        vertex, face = (np.cumsum([0, *map(len, of)]) for of in (
            [surface.positions for surface in surfaces], [surface.face_start for surface in surfaces]))  # fmt: skip
        made = self.koebe.pack(
            np.concatenate([surface.positions for surface in surfaces]),
            np.concatenate([task.surface.corner_vertex[task.corners] + begin
                            for task, begin in zip(tasks, vertex, strict=False)]),
            uv=np.concatenate([task.uv[task.corners] for task in tasks]),
            polygon=np.concatenate([task.polygon + begin for task, begin in zip(tasks, face, strict=False)]),
            locked=np.concatenate([task.locked for task in tasks]),
            cancel=self.cancel_token, enough=self.enough, progress=progress, **self.options,
        )  # fmt: skip
        ends = np.cumsum([len(task.corners) for task in tasks])[:-1]
        for task, placed in zip(tasks, np.split(made.uv, ends), strict=True):
            task.result, task.placed, task.together = made, placed, [one.target.name for one in tasks]

    def finish_early(self) -> bool:
        """End the search: the best packing so far is taken. False if that was asked for already."""
        asked, _ = self.enough.cancelled, self.enough.cancel()
        return not asked

    def write(self, run: Transaction, task: PackTask) -> None:
        """Write an object's packed islands. Raises TransferError, also if it could not be packed."""
        if task.error is not None or task.placed is None:
            raise TransferError(f"{task.target.name}: {task.error}")
        task.uv[task.corners] = task.placed
        written = np.unique(task.corners)
        plan = map_writing.plan(task.target, task.layer, task.surface, written, task.uv[written])
        map_writing.write(run, plan, select=False)
