# SPDX-License-Identifier: GPL-3.0-or-later
"""Arranges the islands of a UV layer of an object."""

import dataclasses
from types import ModuleType

import numpy as np

from ..blender import mesh_reading
from ..blender.errors import TransferError
from ..blender.transaction import Transaction
from ..layers import arrange
from ..layers.mirror import NO_MIRROR
from ..maps.wording import counted
from ..surfaces.islands import cut_into_islands
from ..surfaces.surface import Island
from .island_layer import IslandLayer

DONE = {"TRIM": "put into trims", "MIRROR": "laid on their mirror images"}
NO_PARTNER = "no chosen island has another one as its mirror image"


@dataclasses.dataclass(frozen=True)
class Arrangement:
    """What is done with islands.

    mode        word of `arrange.MODES`
    in_square   aligned to the UV square, not to each other
    gap         between islands in rows, UV units
    rectangles  (r, 4) of the trim sheet: left, bottom, right, top
    fit, turn   into a rectangle: word of `arrange.FITS`, and whether quarter turns are allowed
    tiles       to the right of the mirror image
    """

    mode: str
    in_square: bool = False
    gap: float = 0.0
    rectangles: np.ndarray = dataclasses.field(default_factory=lambda: np.zeros((0, 4)))
    fit: str = "INSIDE"
    turn: bool = True
    tiles: int = 0


class ArrangedLayer(IslandLayer):
    """A UV layer that was read, to arrange its islands."""

    def arrange(self, run: Transaction, koebe: ModuleType, wanted: Arrangement) -> str:
        """Arrange the islands with a selected face and no pinned UV. Returns what was done.

        Raises TransferError if there is none, or if the layer cannot be written.
        """
        free, left = self.free_islands()
        finite = [island for island in free if np.isfinite(self.uv[island.corners]).all()]
        uv = self.uv.astype(np.float64)
        changed = []
        for island, points in self._places(koebe, finite, uv, wanted) if finite else ():
            if (np.abs(points) < np.finfo(np.float32).max).all():
                uv[island.corners] = points
                changed.append(island)
        if wanted.mode == "MIRROR":
            unmoved = len(finite) - len(changed)
            left += [counted(unmoved, "other island")] * (unmoved > 0)
        lost = len(free) - (len(finite) if wanted.mode == "MIRROR" else len(changed))
        left += [f"{counted(lost, 'island')} whose UVs are not finite"] * (lost > 0)
        return self.write(run, changed, uv, DONE.get(wanted.mode, "arranged"), left)

    def _places(
        self, koebe: ModuleType, islands: list[Island], uv: np.ndarray, wanted: Arrangement
    ) -> list[tuple[Island, np.ndarray]]:
        """The islands that move, and their UVs (c, 2) in the order of their corners. Raises TransferError."""
        if wanted.mode == "MIRROR":
            return self._on_mirror_images(koebe, islands, uv, wanted.tiles)
        points = [uv[island.corners] for island in islands]
        if wanted.mode == "TRIM":
            made = arrange.in_rectangles(points, wanted.rectangles, wanted.fit, wanted.turn)
        elif wanted.mode in arrange.ALIGNED:
            made = arrange.aligned(wanted.mode, points, wanted.in_square)
        else:
            made = arrange.in_rows(points, self._groups(islands, wanted.mode), wanted.gap)
        return list(zip(islands, made, strict=True))

    def _groups(self, islands: list[Island], mode: str) -> list[int]:
        """What each island belongs to: the most frequent material of its faces, or a part of the mesh."""
        if mode == "SIZE":
            return [0] * len(islands)
        if mode == "MATERIAL":
            material = mesh_reading.face_materials(self.obj)
            return [int(np.bincount(material[island.faces]).argmax()) for island in islands]
        part = np.zeros(len(self.chosen), dtype=np.int32)
        uncut = dataclasses.replace(self.surface, seam=np.zeros_like(self.surface.seam))
        for number, piece in enumerate(cut_into_islands(uncut)):
            part[piece.faces] = number
        return [int(part[island.faces[0]]) for island in islands]

    def _on_mirror_images(
        self, koebe: ModuleType, islands: list[Island], uv: np.ndarray, tiles: int
    ) -> list[tuple[Island, np.ndarray]]:
        surface = self.surface
        try:
            image = koebe.mirror_image(
                surface.positions, surface.corner_vertex[surface.triangle_corners], polygon=surface.triangle_face
            )
        except koebe.KoebeError as error:
            raise TransferError(f"{self.obj.name}: {error}") from error
        if image is None:
            raise TransferError(f"{self.obj.name}: {NO_MIRROR}")
        everything = self.islands()
        free = {int(island.corners[0]) for island in islands}
        may_move = [int(island.corners[0]) in free for island in everything]
        corners = [island.corners for island in everything]
        found = arrange.on_mirror_images(surface, corners, may_move, uv, image, tiles)
        if not found:
            raise TransferError(f"{self.obj.name}: {NO_PARTNER}")
        return [(everything[k], points) for k, points in found]
