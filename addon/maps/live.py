# SPDX-License-Identifier: GPL-3.0-or-later
"""Which islands a change of seams, pins or vertices concerns, and how they follow from where they are."""

import dataclasses
import functools
from types import ModuleType
from typing import Any

import numpy as np

from .even_drag import STILL
from .islands import cut_into_islands
from .outcomes import Task
from .packing import fit_placement
from .pins import has_pins, pin_island
from .surface import Island, Surface, next_corners
from .triangles import signed_areas
from .uv_islands import uv_cuts, vertex_uv

MOST_STEPS = 60  # Newton steps until a warm map has settled. Ten are many
LEAST_EVEN = 0.1  # E around pins if the angles are kept
LARGE, PATCH = 20_000, 8_000  # faces: islands with more than so many follow with about so many round moved vertices
ROUNDS = 6  # of adding faces until their rim does not meet itself


@dataclasses.dataclass(frozen=True)
class LiveState:
    """A mesh while it is edited.

    surface  the whole mesh
    uv       (C, 2) of the layer
    pins     (C, 2) its pinned UVs, NaN at other corners
    """

    surface: Surface
    uv: np.ndarray
    pins: np.ndarray

    def is_same_mesh(self, other: "LiveState") -> bool:
        """Whether both have the same faces."""
        return np.array_equal(self.surface.corner_vertex, other.surface.corner_vertex) and np.array_equal(
            self.surface.face_start, other.surface.face_start
        )

    def concerned(self, before: "LiveState") -> np.ndarray:
        """The faces (P,) bool of all islands at which a seam, a pin or a vertex has changed.

        before  of the same mesh
        """
        surface = self.surface
        changed = (surface.seam != before.surface.seam)[surface.corner_edge]
        changed |= ~((self.pins == before.pins) | (np.isnan(self.pins) & np.isnan(before.pins))).all(axis=1)
        changed |= (surface.positions != before.surface.positions).any(axis=1)[surface.corner_vertex]
        if not changed.any():
            return np.zeros(len(surface.face_size), dtype=bool)
        if np.array_equal(surface.seam, before.surface.seam):
            self.__dict__["island_of_face"] = before.island_of_face  # it is kept while seams stay
        touched = np.zeros(len(surface.face_size), dtype=bool)
        touched[self.island_of_face[np.add.reduceat(changed, surface.face_start) > 0]] = True
        return np.asarray(touched[self.island_of_face])

    def near(self, before: "LiveState", faces: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
        """Of large islands (P,) bool the faces (P,) bool near moved vertices, and pins (C, 2) on their rim: they fill
        the same region as before, so the islands stay one to one. None if all faces must follow."""
        surface = self.surface
        seams_stay = np.array_equal(surface.seam, before.surface.seam)
        if np.count_nonzero(faces) <= LARGE or not seams_stay or not np.array_equal(
            self.pins, before.pins, equal_nan=True
        ):
            return None
        # The faces nearest to the box of the moved vertices in the UVs.
        moved = (surface.positions != before.surface.positions).any(axis=1)[surface.corner_vertex]
        place = before.uv[moved]
        outside = np.maximum(place.min(axis=0) - before.uv, before.uv - place.max(axis=0)).max(axis=1)
        away = np.where(faces, np.maximum.reduceat(outside, surface.face_start), np.inf)
        chosen = away < np.partition(away, PATCH)[PATCH]
        if np.count_nonzero(away <= 0.0) > PATCH // 2 or not chosen.any():
            return None
        cuts = surface.seam | uv_cuts(surface, before.uv)
        for _ in range(ROUNDS):
            rim, pinched = self._rim(before.uv, chosen, cuts)
            if not pinched.any():
                return chosen, np.where(rim[:, None], before.uv, self.pins)
            chosen |= faces & np.logical_or.reduceat(pinched[surface.corner_vertex], surface.face_start)
        return None

    def _rim(self, uv: np.ndarray, chosen: np.ndarray, cuts: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """The corners (C,) bool of chosen faces (P,) on their rim, and the vertices (V,) bool where it meets itself."""
        surface = self.surface
        mine, vertex = np.repeat(chosen, surface.face_size), surface.corner_vertex
        edges = (np.bincount(surface.corner_edge[mine], minlength=len(cuts)) != 2) | cuts
        sides = np.flatnonzero(mine & edges[surface.corner_edge])
        ends = np.concatenate([sides, next_corners(surface)[sides]])
        on_rim, meets = (np.zeros(len(surface.positions), dtype=bool) for _ in range(2))
        on_rim[vertex[ends]] = True
        places, times = np.unique(np.column_stack([vertex[ends], uv[ends]]), axis=0, return_counts=True)
        meets[places[times > 2, 0].astype(np.int64)] = True
        return mine & on_rim[vertex], meets

    @functools.cached_property
    def island_of_face(self) -> np.ndarray:
        """The number (P,) of each face's island, between seams."""
        number = np.zeros(len(self.surface.face_size), dtype=np.int32)
        for k, island in enumerate(cut_into_islands(self.surface)):
            number[island.faces] = k
        return number


def follow(
    koebe: ModuleType, task: Task, start: np.ndarray, even: float, cancel: Any = None
) -> tuple[np.ndarray, np.ndarray] | None:
    """The selected islands, relaxed from UVs that they have, in milliseconds: corners (m,) and UVs (m, 2) in 32 bits.

    start  (C, 2) where the islands lie. Seams of the task's surface are new cuts of them
    even   E of the islands, and how they bend about their pins

    None if the islands do not follow from there, as they are turned over, or would lie over themselves. Raises
    MapError for pins that are in the way, and koebe.Cancelled.
    """
    surface = task.surface
    uv = start.astype(np.float64)
    pieces = cut_into_islands(dataclasses.replace(surface, seam=surface.seam | uv_cuts(surface, start)))
    for piece in pieces:
        places = vertex_uv(piece, uv)
        try:
            made = _relaxed(koebe, piece, places, task.pins, even, cancel)
        except koebe.Cancelled:
            raise
        except koebe.KoebeError:
            return None
        if made is None:
            return None
        uv[piece.corners] = made[piece.corner_vertex]
    corners = np.sort(np.concatenate([piece.corners for piece in pieces]))
    stored = uv.astype(np.float32)
    return None if _is_spoiled(koebe, surface, stored) else (corners, stored[corners])


def joined(surface: Surface, cleared: np.ndarray, uv: np.ndarray) -> np.ndarray | None:
    """UVs (C, 2) of the selected islands that have grown together: the smaller ones go to the largest, by a similarity
    that fits the cleared edges, and there the two sides meet half way.

    surface  with its seams as they are now
    cleared  (E,) bool, edges that were seams
    uv       (C, 2) as the islands lie

    None if an island has no place beside the others.
    """
    start = uv.astype(np.float64)
    cuts = (surface.seam | uv_cuts(surface, uv)) & ~cleared
    piece = np.zeros(len(uv), dtype=np.int32)
    for k, old in enumerate(cut_into_islands(dataclasses.replace(surface, seam=cuts | cleared))):
        piece[old.corners] = k
    for island in cut_into_islands(dataclasses.replace(surface, seam=cuts)):
        at, vertex = island.corners, island.corner_vertex
        there = np.bincount(piece[at]).argmax()
        done = piece[at] == there
        while not done.all():
            place = np.full((len(island.vertices), 2), np.nan)
            place[vertex[done]] = start[at[done]]
            meets = ~done & np.isfinite(place[vertex]).all(axis=1)
            if not meets.any():
                return None
            there = np.bincount(piece[at[meets]]).argmax()
            chosen = piece[at] == there
            ends = start[at[meets & chosen]]
            fit = fit_placement(ends, place[vertex[meets & chosen]]) if np.ptp(ends, axis=0).any() else None
            if fit is None:
                return None
            start[at[chosen]] = fit.apply(start[at[chosen]])
            done |= chosen
        count = np.bincount(vertex)
        middle = np.stack([np.bincount(vertex, weights=start[at, axis]) / count for axis in (0, 1)], axis=1)
        start[at] = middle[vertex]
    return start


def _relaxed(
    koebe: ModuleType, piece: Island, places: np.ndarray, pins: np.ndarray | None, even: float, cancel: Any
) -> np.ndarray | None:
    """The places (n, 2) of a piece's vertices after it has settled; None if it does not."""
    free = np.ones(len(places), dtype=bool)
    if pins is not None:
        free[piece.corner_vertex[np.isfinite(pins[piece.corners]).all(axis=1)]] = False
    copies = np.column_stack([piece.source_vertex, places])[free]
    if len(np.unique(copies, axis=0)) < len(copies):
        return None  # a new cut whose sides lie on each other: they would be in each other's way
    dial = koebe.EvenDial(piece.vertices, piece.triangles, uv=places, round=False)
    if pins is not None and has_pins(piece, pins):
        return pin_island(koebe, dial, piece, pins, even or LEAST_EVEN, cancel)
    before = places
    for _ in range(MOST_STEPS):
        made = dial.move(even, steps=1, cancel=cancel)
        if not dial.moved or np.abs(made - before).max() < STILL * np.ptp(places, axis=0).max():
            placement = fit_placement(made, places)
            return None if placement is None else placement.apply(made)
        before = made
    return None


def _is_spoiled(koebe: ModuleType, surface: Surface, uv: np.ndarray) -> bool:
    """Whether a selected triangle has no area in the UVs (C, 2) as they are stored, or an island lies over itself."""
    chosen = surface.selected[surface.triangle_face]
    at = surface.triangle_corners[chosen]
    if not (signed_areas(uv, at) > 0.0).all():
        return True
    found = koebe.pack(
        surface.positions, surface.corner_vertex[at], uv=uv[at].astype(np.float64),
        polygon=surface.triangle_face[chosen], locked=np.ones(len(at), dtype=bool),
    )  # fmt: skip
    return bool(found.overlaps)
