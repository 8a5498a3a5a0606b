# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether UVs are the layout of a sphere, read off the UVs themselves, and checkers that run over their cuts."""

import numpy as np

from .surface import Surface
from .tile_pattern import REPEAT, CutSides, Pattern, cut_sides


def sphere_pattern(surface: Surface, uv: np.ndarray, size: float) -> Pattern | None:
    """The checker nearest to one of so many squares across the UV square that runs over the cuts of a sphere's layout;
    None where UVs (C, 2) have a cut that is none of such a layout.

    Longitudes and latitudes: u has the period 1, and the squares are half as many along v, where the sphere is half as
    long. The octahedron folded out: half turns round the middles of the square's sides leave the checker as it is.
    """
    sides = cut_sides(surface, uv)
    if not len(sides.piece):
        return None
    squares = float(REPEAT * max(1, round(size / REPEAT)))
    if _are_longitudes(sides, surface, uv):
        return Pattern(size, (squares, 0.0, 0.0, squares / 2.0))
    return Pattern(squares) if _are_folded_out(sides) else None


def _are_longitudes(sides: CutSides, surface: Surface, uv: np.ndarray) -> bool:
    """Whether both ends of each cut lie apart by whole turns, poles aside, and it is no cylinder: its cuts end at a
    pole, which is a vertex or in a torn face, or both poles are in holes and so out of reach."""
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
    """Whether both ends of each cut are images of each other under the layout's half turns and their products."""
    here, there = sides.ends[:, :, 0], sides.ends[:, :, 1]
    half_turn = _are_whole(here + there, 1)
    return bool(half_turn.any() and (half_turn | _are_whole(here - there, 0)).all())


def _are_whole(shift: np.ndarray, parity: int) -> np.ndarray:
    """Whether shifts (..., 2) are whole, their sum even or odd."""
    whole = np.rint(shift)
    return (whole == shift).all(axis=-1) & (whole.sum(axis=-1) % 2 == parity)
