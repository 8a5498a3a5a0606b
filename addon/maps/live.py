# SPDX-License-Identifier: GPL-3.0-or-later
"""Which islands a change of seams, pins or vertices concerns, and how they follow from where they are."""

import dataclasses
import functools
from itertools import permutations
from types import ModuleType
from typing import Any

import numpy as np

from ..layers.even_drag import STILL
from ..layers.packing import fit_placement
from ..surfaces.islands import cut_into_islands
from ..surfaces.surface import Island, Surface, next_corners
from ..surfaces.triangles import signed_areas
from ..surfaces.uv_islands import uv_cuts, vertex_uv
from .outcomes import Task
from .pins import has_pins, pin_island, pins_of

MOST_STEPS = 60  # Newton steps until a warm map has settled. Ten are many
LEAST_EVEN = 0.1  # E around pins if the angles are kept
LARGE, PATCH = 20_000, 5_000  # faces: islands with more than so many follow with about so many round a change
APART = 0.2  # of the way to its neighbours' middle: so far a new cut's sides are parted at first
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
        changed = self._changed(before)
        if not changed.any():
            return np.zeros(len(surface.face_size), dtype=bool)
        if np.array_equal(surface.seam, before.surface.seam):
            self.__dict__["island_of_face"] = before.island_of_face  # it is kept while seams stay
        touched = np.zeros(len(surface.face_size), dtype=bool)
        touched[self.island_of_face[np.add.reduceat(changed, surface.face_start) > 0]] = True
        return np.asarray(touched[self.island_of_face])

    def _changed(self, before: "LiveState") -> np.ndarray:
        """The corners (C,) bool of changed vertices and pins, and at the start of changed seams."""
        surface = self.surface
        changed = (surface.seam != before.surface.seam)[surface.corner_edge] | self._repinned(before)
        changed |= (surface.positions != before.surface.positions).any(axis=1)[surface.corner_vertex]
        return np.asarray(changed)

    def _repinned(self, before: "LiveState") -> np.ndarray:
        """The corners (C,) bool that were unpinned, or whose pins have moved."""
        changed, at = ~np.isnan(before.pins[:, 0]) & np.isnan(self.pins[:, 0]), self._pinned
        changed[at] = (self.pins[at] != before.uv[at]).any(axis=1)
        return changed

    @functools.cached_property
    def _pinned(self) -> np.ndarray:
        """The pinned corners."""
        return np.flatnonzero(~np.isnan(self.pins[:, 0]))

    def _is_carried(self, before: "LiveState") -> bool:
        """Whether a moved pin moves a whole island: it has two pins at most."""
        surface, at = self.surface, self._pinned
        island = np.repeat(self.island_of_face, surface.face_size)[at] if len(at) else at
        pinned = np.unique(np.column_stack([island, surface.corner_vertex[at]]), axis=0)[:, 0]
        return bool((np.bincount(pinned, minlength=1)[island[self._repinned(before)[at]]] <= 2).any())

    def near(self, before: "LiveState", faces: np.ndarray) -> "Near | None":
        """What is near a change of large islands (P,) bool; None if all their faces must follow."""
        surface = self.surface
        opened = surface.seam & ~before.surface.seam
        is_joined = (before.surface.seam & ~surface.seam).any()
        if np.count_nonzero(faces) <= LARGE or is_joined or self._is_carried(before):
            return None
        # The faces nearest to the box of what has changed in the UVs.
        changed = self._changed(before)
        place = np.concatenate([before.uv[changed], self.pins[self._pinned[changed[self._pinned]]]])
        sides = np.maximum(place.min(axis=0) - before.uv, before.uv - place.max(axis=0))
        outside = np.maximum(sides[:, 0], sides[:, 1])
        away = np.where(faces, np.maximum.reduceat(outside, surface.face_start), np.inf)
        most = min(PATCH, len(away) - 1)
        chosen = away < np.partition(away, most)[most]
        if np.count_nonzero(away <= 0.0) > PATCH // 2 or not chosen.any():
            return None
        at_change, cut = (np.zeros(len(surface.positions), dtype=bool) for _ in range(2))
        at_change[surface.corner_vertex[changed]] = True
        chosen |= faces & np.logical_or.reduceat(at_change[surface.corner_vertex], surface.face_start)
        along = np.flatnonzero(opened[surface.corner_edge])
        cut[surface.corner_vertex[np.concatenate([along, next_corners(surface)[along]])]] = True
        if cut[surface.corner_vertex[self._pinned]].any():
            return None  # the sides of the cut cannot part there
        for _ in range(ROUNDS):
            part, corners = surface.part(chosen)
            uv = before.uv[corners]
            ends = (surface.seam & ~opened) | uv_cuts(part, uv)
            rim, pinched = _rim(part, uv, ends)
            if not pinched.any():
                repinned = self._repinned(before)[corners]
                is_free = bool((rim & repinned).any())
                if is_free:  # a pin takes the border of its island along
                    ends |= np.bincount(surface.corner_edge, minlength=len(ends)) != 2
                    rim, _ = _rim(part, uv, np.zeros_like(ends), ends)
                    if (rim & repinned).any():
                        return None
                is_free |= bool(opened.any())
                return Near(part, corners, uv, np.where(rim[:, None], uv, self.pins[corners]), is_free)
            chosen |= faces & np.logical_or.reduceat(pinched[surface.corner_vertex], surface.face_start)
        return None

    @functools.cached_property
    def island_of_face(self) -> np.ndarray:
        """The number (P,) of each face's island, between seams."""
        number = np.zeros(len(self.surface.face_size), dtype=np.int32)
        for k, island in enumerate(cut_into_islands(self.surface)):
            number[island.faces] = k
        return number


@dataclasses.dataclass(frozen=True)
class Near:
    """Faces near a change. They fill the same region as before, so that the islands stay one to one, or are judged.

    surface  these faces alone
    corners  (m,) their corners in the whole surface
    uv       (m, 2) as they lay
    pins     (m, 2) of their rim, too; NaN at other corners
    is_free  their rim may move with a pin on it, or at the end of a cut: then `lies_over` judges
    """

    surface: Surface
    corners: np.ndarray
    uv: np.ndarray
    pins: np.ndarray
    is_free: bool

    def lies_over(self, koebe: ModuleType, whole: Surface, uv: np.ndarray) -> bool:
        """Whether they lie over other faces of the selected islands. @param uv (C, 2) of all corners now"""
        mine = uv[self.corners]
        low, high = np.minimum.reduceat(uv, whole.face_start), np.maximum.reduceat(uv, whole.face_start)
        beside = (low <= mine.max(axis=0)).all(axis=1) & (high >= mine.min(axis=0)).all(axis=1) & whole.selected
        part, corners = whole.part(beside)
        return _is_spoiled(koebe, part, uv[corners], True)


def _rim(
    part: Surface, uv: np.ndarray, cuts: np.ndarray, free: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """The corners (C,) bool on the rim of a part of a surface, and the vertices (V,) bool where it meets itself.

    cuts  (E,) bool, edges of the rim beside those with one face
    free  (E,) bool, edges that are none of it
    """
    vertex = part.corner_vertex
    edges = (np.bincount(part.corner_edge, minlength=len(cuts)) != 2) | cuts
    if free is not None:
        edges &= ~free
    sides = np.flatnonzero(edges[part.corner_edge])
    ends = np.concatenate([sides, next_corners(part)[sides]])
    on_rim, meets = (np.zeros(len(part.positions), dtype=bool) for _ in range(2))
    on_rim[vertex[ends]] = True
    places, times = np.unique(np.column_stack([vertex[ends], uv[ends]]), axis=0, return_counts=True)
    meets[places[times > 2, 0].astype(np.int64)] = True
    return on_rim[vertex], meets


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
    is_bent = len(pieces) > 1
    for piece in pieces:
        places = vertex_uv(piece, uv)
        try:
            made = _carried(piece, places, task.pins)
            if made is None:
                is_bent, made = True, _relaxed(koebe, piece, places, task.pins, even, cancel)
        except koebe.Cancelled:
            raise
        except koebe.KoebeError:
            return None
        if made is None:
            return None
        uv[piece.corners] = made[piece.corner_vertex]
    corners = np.sort(np.concatenate([piece.corners for piece in pieces]))
    stored = uv.astype(np.float32)
    return None if _is_spoiled(koebe, surface, stored, is_bent) else (corners, stored[corners])


def parted(near: Near) -> tuple[np.ndarray, np.ndarray]:
    """The UVs (m, 2) with the sides of new cuts a little apart, each towards its own faces, and the pins (m, 2) with
    them: where a cut meets the rim, its two ends go along the rim."""
    surface, start, pins = near.surface, near.uv.astype(np.float64), near.pins.copy()
    for piece in cut_into_islands(dataclasses.replace(surface, seam=surface.seam | uv_cuts(surface, near.uv))):
        places, count = vertex_uv(piece, start), len(piece.vertices)
        copies = np.column_stack([piece.source_vertex, places])
        _, which, times = np.unique(copies, axis=0, return_inverse=True, return_counts=True)
        lying, held = times[which.ravel()] > 1, np.zeros(count, dtype=bool)
        held[piece.corner_vertex[np.isfinite(pins[piece.corners]).all(axis=1)]] = True
        one, other = np.concatenate([piece.triangles[:, ends] for ends in permutations(range(3), 2)]).T
        used = lying[one] & (~held[one] | (held[other] & ~lying[other]))
        one, other = one[used], other[used]
        sums = np.stack([np.bincount(one, part, count) for part in (places[other] - places[one]).T], axis=1)
        way = sums / np.maximum(np.bincount(one, minlength=count), 1)[:, None]
        share = APART
        while not (signed_areas(places + share * way, piece.triangles) > 0.0).all():
            share *= 0.5
            if share < APART / 100:
                return start, pins  # some faces are turned over already
        start[piece.corners] = (places + share * way)[piece.corner_vertex]
        at = piece.corners[(lying & held)[piece.corner_vertex]]
        pins[at] = start[at]
    return start, pins


def joined(surface: Surface, cleared: np.ndarray, uv: np.ndarray) -> np.ndarray | None:
    """UVs (C, 2) of the selected islands that have grown together: the smaller ones go to the largest, by a similarity
    that fits the cleared edges, and there the two sides meet half way.

    surface  with its seams as they are now
    cleared  (E,) bool, edges that were seams
    uv       (C, 2) as the islands lie

    None if an island has no place beside the others.
    """
    # The pieces before, and the islands that they form now.
    start = uv.astype(np.float64)
    cuts = (surface.seam | uv_cuts(surface, uv)) & ~cleared
    piece = np.zeros(len(uv), dtype=np.int32)
    for k, old in enumerate(cut_into_islands(dataclasses.replace(surface, seam=cuts | cleared))):
        piece[old.corners] = k
    for island in cut_into_islands(dataclasses.replace(surface, seam=cuts)):
        at, vertex = island.corners, island.corner_vertex
        there = np.bincount(piece[at]).argmax()
        # From the largest piece outwards: next is the piece that meets most corners of those that lie already.
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


def _carried(piece: Island, places: np.ndarray, pins: np.ndarray | None) -> np.ndarray | None:
    """The places (n, 2) of a piece's vertices that one pin moves, or two pins turn and scale; else None."""
    if pins is None:
        return None
    found = pins_of(piece, pins)
    at, target = list(found), np.array(list(found.values())).reshape(-1, 2)
    if len(at) == 1:
        made = places + (target - places[at])
    else:
        placement = fit_placement(places[at], target) if len(at) == 2 and np.ptp(places[at], axis=0).any() else None
        if placement is None:
            return None
        made = placement.apply(places)
    made[at] = target
    return made


def _is_spoiled(koebe: ModuleType, surface: Surface, uv: np.ndarray, is_bent: bool) -> bool:
    """Whether a selected triangle has no area in the UVs (C, 2) as they are stored, or an island that is bent lies over
    itself."""
    chosen = surface.selected[surface.triangle_face]
    at = surface.triangle_corners[chosen]
    if not (signed_areas(uv, at) > 0.0).all():
        return True
    if not is_bent:
        return False
    found = koebe.pack(
        surface.positions, surface.corner_vertex[at], uv=uv[at].astype(np.float64),
        polygon=surface.triangle_face[chosen], locked=np.ones(len(at), dtype=bool),
    )  # fmt: skip
    return bool(found.overlaps)
