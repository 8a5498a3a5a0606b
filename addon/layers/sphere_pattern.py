# SPDX-License-Identifier: GPL-3.0-or-later
"""Detects UVs that are a sphere's layout, from the UVs themselves, and finds checkers that fit their cuts."""

import numpy as np

from ..surfaces.surface import Surface
from .tile_pattern import REPEAT, CutSides, Pattern, cut_sides


def sphere_pattern(surface: Surface, uv: np.ndarray, size: float) -> Pattern | None:
    """The checker nearest to one with so many squares across the UV square that continues over the cuts of a sphere's
    layout; None if UVs (C, 2) have a cut that no such layout has.

    Longitudes and latitudes: u has the period 1, and there are half as many squares along v, where the sphere is half
    as long. Octahedron folded out: half turns round the middles of the square's sides do not change the checker.
    """
    sides = cut_sides(surface, uv)
    if not len(sides.piece):
        return None
    squares = float(REPEAT * max(1, round(size / REPEAT)))
    if _are_longitudes(sides, surface, uv):
        return Pattern(size, (squares, 0.0, 0.0, squares / 2.0))
    return Pattern(squares) if _are_folded_out(sides) else None


def _are_longitudes(sides: CutSides, surface: Surface, uv: np.ndarray) -> bool:
    """Whether both ends of each cut lie apart by whole turns, except at poles, and the UVs are not a cylinder: the cuts
    end at a pole, which is a vertex or in a torn face, or both poles are in holes."""
    here, there = sides.ends[:, :, 0], sides.ends[:, :, 1]  # (n, 2, 2): cut, end, u and v
    apart = here - there
    at_pole = (here[..., 1] == 0.0) | (here[..., 1] == 1.0)
    if (apart[..., 1] != 0.0).any() or (np.rint(apart[..., 0]) != apart[..., 0])[~at_pole].any():
        return False
    if not (apart[..., 0] != 0.0).any() or (np.abs(apart[..., 0])[~at_pole] > 1.0).any():
        return False
    ends_differ = (apart[:, 0] != apart[:, 1]).any()
    face = np.repeat(np.arange(len(surface.face_size)), surface.face_size)
    v = uv[np.isin(sides.of_face, sides.piece)[face], 1]
    return bool(v.min() >= 0.0 and v.max() <= 1.0 and (ends_differ or v.min() > 0.0))


def _are_folded_out(sides: CutSides) -> bool:
    """Whether the layout's half turns and their products take the ends of each cut to each other."""
    here, there = sides.ends[:, :, 0], sides.ends[:, :, 1]
    half_turn = _are_whole(here + there, 1)
    return bool(half_turn.any() and (half_turn | _are_whole(here - there, 0)).all())


def _are_whole(shift: np.ndarray, parity: int) -> np.ndarray:
    """Whether shifts (..., 2) are whole, and their sum is even or odd."""
    whole = np.rint(shift)
    return (whole == shift).all(axis=-1) & (whole.sum(axis=-1) % 2 == parity)
