# SPDX-License-Identifier: GPL-3.0-or-later
"""Möbius maps of the circle domains in one object's UV layer: reads, shows during a drag, writes."""

from types import ModuleType

import numpy as np

from ..blender import compat, map_writing, mesh_reading
from ..blender.errors import TransferError
from ..blender.mesh_object import MeshObject
from ..blender.targets import Target, check_mesh
from ..blender.transaction import Transaction
from ..layers.circle_domain import CircleDomain, CircleImage, read_domains
from ..layers.distortion import texel_figures
from ..maps.wording import few
from ..surfaces.moebius import Moebius
from ..surfaces.surface import next_corners

MOST_EDGES = 60_000  # limit of edges drawn during a drag


class MoebiusJob:
    """The circle domains of an object's UV layer.

    domains  in the order of their first faces
    """

    def __init__(self, koebe: ModuleType, obj: MeshObject, layer: str = "") -> None:
        """Read the object's UV layer, without a name the active one. Raises TransferError if it has no circle domain.

        In Edit Mode the whole mesh is read, with any selection.
        """
        check_mesh(obj)
        self.surface = mesh_reading.read_surface(obj, selected_only=False)
        self.target, self.layer = Target.of(obj), layer or _active_layer(obj)
        if self.layer not in obj.data.uv_layers:
            raise TransferError(f"{obj.name}: it has no UV layer {self.layer!r}: map it first")
        self.koebe, self._old = koebe, mesh_reading.read_layer(obj, self.layer)
        self.domains, errors = read_domains(koebe, self.surface, self._old)
        if not self.domains:
            reasons = dict.fromkeys(map(str, errors))
            raise TransferError(f"{obj.name}: " + (few(list(reasons)) or "it has no faces"))
        self._values = self._old.copy()

    @property
    def name(self) -> str:
        """Name of the object."""
        return self.target.name

    def domain_at(self, u: float, v: float, reach: float) -> int | None:
        """Number of the domain whose disk holds that place of the UVs, or nearly: within `reach` times its radius."""
        away = [abs(domain.in_disk(u, v)) for domain in self.domains]
        nearest = int(np.argmin(away))
        return nearest if away[nearest] <= reach else None

    def image_of(self, domain: CircleDomain, moved: Moebius) -> np.ndarray:
        """UVs (n,) of a domain's vertices after a map, as complex numbers in 32 bits, for `show`."""
        z = domain.moved_points(moved)
        z *= domain.scale
        z += domain.offset
        return z.astype(np.complex64)

    def edges(self, domain: CircleDomain) -> np.ndarray:
        """Vertices (e, 2) of a domain's edges, each once. Of more than MOST_EDGES, that many, spread evenly."""
        island, vertex = domain.island, np.zeros(len(self.surface.corner_vertex), dtype=np.int32)
        vertex[island.corners] = island.corner_vertex
        first = np.unique(self.surface.corner_edge[island.corners], return_index=True)[1]
        corners = island.corners[first[:: -(-len(first) // MOST_EDGES)]]
        return np.stack([vertex[corners], vertex[next_corners(self.surface)[corners]]], axis=1)

    def show(self, domain: CircleDomain, points: np.ndarray) -> None:
        """Write a domain's image into the layer, in Object Mode, fast enough for every frame of a drag."""
        island = domain.island
        values = self._values.view(np.complex64)[:, 0]
        if len(island.corners) == len(values):  # then all corners are there, in order
            np.take(points, island.corner_vertex, out=values, mode="clip")
        else:
            values[island.corners] = points.take(island.corner_vertex)
        self._set(self._values)

    def put_back(self) -> None:
        """Write the UVs that were read, in Object Mode."""
        self._set(self._old)
        self._values[:] = self._old

    def _set(self, values: np.ndarray) -> None:
        obj = self.target.obj
        if obj is None or obj.mode == "EDIT" or self.layer not in obj.data.uv_layers:
            return
        layer = obj.data.uv_layers[self.layer]
        if len(layer.data) == len(values):
            compat.set_corner_uv(layer, values)
            obj.data.update_tag()

    def write(self, run: Transaction, image: CircleImage) -> None:
        """Write an image permanently, in any mode. Raises TransferError if the mesh has changed since it was read."""
        island = image.domain.island
        plan = map_writing.plan(
            self.target, self.layer, self.surface, island.corners, image.uv[island.corner_vertex]
        )
        map_writing.write(run, plan, select=False)  # an island that was there, which keeps its selection

    def figures(self, image: CircleImage) -> dict[str, float]:
        """The figures of an image by which an artist judges it, named as in the report."""
        island = image.domain.island
        report = self.koebe.distortion(island.vertices, island.triangles, image.uv.astype(np.float64))
        return {"angle_error": float(report["angle_error_deg"]["mean"]), **texel_figures(island, image.uv)}


def _active_layer(obj: MeshObject) -> str:
    active = obj.data.uv_layers.active
    if active is None:
        raise TransferError(f"{obj.name}: it has no UVs: map it first")
    return active.name
