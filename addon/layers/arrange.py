# SPDX-License-Identifier: GPL-3.0-or-later
"""Arranges islands in the UV plane: in a line, in sorted rows, in the rectangles of a trim sheet, on mirror images.

Islands are moved, scaled or turned by a quarter as they are; only the fit `STRETCH` changes their proportions.
"""

from collections.abc import Hashable, Sequence

import numpy as np

from ..surfaces.surface import Surface, next_corners

# Word: label, what it does.
MODES = {
    "LEFT": ("Align Left", "the left sides of the islands on one line"),
    "COLUMN": ("Align in a Column", "the middles of the islands on one vertical line"),
    "RIGHT": ("Align Right", "the right sides of the islands on one line"),
    "TOP": ("Align Top", "the upper sides of the islands on one line"),
    "ROW": ("Align in a Row", "the middles of the islands on one horizontal line"),
    "BOTTOM": ("Align Bottom", "the lower sides of the islands on one line"),
    "SIZE": ("Sort by Size", "islands in rows, the largest first"),
    "MATERIAL": ("Sort by Material", "islands in rows, each material in rows of its own"),
    "PART": ("Sort by Part", "islands in rows, each connected part of the mesh in rows of its own"),
    "TRIM": ("Into Trims", "each island in a rectangle of the trim sheet"),
    "MIRROR": ("Onto Mirror Image", "islands of a symmetric mesh on those of the other side"),
}
FITS = {
    "INSIDE": ("Inside", "as large as fits into the rectangle"),
    "HEIGHT": ("Height", "as high as the rectangle, and along it where it was, as on a strip that repeats"),
    "WIDTH": ("Width", "as wide as the rectangle, and along it where it was, as on a strip that repeats"),
    "STRETCH": ("Stretch", "exactly the rectangle, which changes the island's proportions"),
    "KEEP": ("Keep Size", "in the middle of the rectangle, in the size that it has"),
}
# Word of an alignment: axis, and the place on the box that comes onto the line, from its lower to its upper end.
ALIGNED = {"LEFT": (0, 0.0), "COLUMN": (0, 0.5), "RIGHT": (0, 1.0),
           "TOP": (1, 1.0), "ROW": (1, 0.5), "BOTTOM": (1, 0.0)}  # fmt: skip

ALONG = {"HEIGHT": 0, "WIDTH": 1}  # of a fit: the axis on which an island stays where it is

Points = list[np.ndarray]  # UVs (c, 2) of each island


def box(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The lower and the upper corner (2,) of points (n, 2)."""
    return points.min(axis=0), points.max(axis=0)


def aligned(mode: str, islands: Points, in_square: bool) -> Points:
    """The islands along a line: of the box of them all, or of the UV square."""
    axis, share = ALIGNED[mode]
    lower, upper = (np.zeros(2), np.ones(2)) if in_square else box(np.concatenate(islands))
    line = lower[axis] + share * (upper[axis] - lower[axis])
    result = []
    for points in islands:
        low, high = box(points)
        moved = points.copy()
        moved[:, axis] += line - (low[axis] + share * (high[axis] - low[axis]))
        result.append(moved)
    return result


def in_rows(islands: Points, groups: Sequence[Hashable], gap: float) -> Points:
    """The islands in rows from the top left corner of their box, as wide as the UV square, or as they need.

    groups  of each island: a group begins a row, in the order of its first island. In it the largest box comes first
    gap     between two islands
    """
    lower, upper = box(np.concatenate(islands))
    boxes = [box(points) for points in islands]
    sizes = [high - low for low, high in boxes]
    width = max(1.0, *(float(size[0]) for size in sizes), float(np.sqrt(sum(size.prod() for size in sizes))))
    order = {group: rank for rank, group in enumerate(dict.fromkeys(groups))}
    turns = sorted(range(len(islands)), key=lambda k: (order[groups[k]], -float(sizes[k].prod()), k))
    result = list(islands)
    x, y, row, last = 0.0, 0.0, 0.0, None
    for k in turns:
        new_group = last is not None and groups[k] != last
        if x > 0.0 and (new_group or x + sizes[k][0] > width):
            x, y, row = 0.0, y + row + gap, 0.0
        result[k] = islands[k] + (lower[0] + x - boxes[k][0][0], upper[1] - y - boxes[k][1][1])
        x, row, last = x + float(sizes[k][0]) + gap, max(row, float(sizes[k][1])), groups[k]
    return result


def in_rectangles(islands: Points, rectangles: np.ndarray, fit: str, may_turn: bool) -> Points:
    """Each island in the rectangle that is nearest to the middle of its box.

    rectangles  (r, 4) left, bottom, right, top
    fit         a word of `FITS`
    may_turn    by a quarter, if island and rectangle are long in different directions
    """
    result = []
    for points in islands:
        low, high = box(points)
        middle = (low + high) / 2.0
        lower, upper = _nearest(rectangles, middle)
        moved = points - middle
        if may_turn and (high - low)[0] != (high - low)[1] and (
            ((high - low)[0] > (high - low)[1]) != ((upper - lower)[0] >= (upper - lower)[1])
        ):  # fmt: skip
            moved = np.stack([-moved[:, 1], moved[:, 0]], axis=1)
        place = (lower + upper) / 2.0
        if fit in ALONG:
            place[ALONG[fit]] = np.clip(middle, lower, upper)[ALONG[fit]]
        result.append(place + moved * _scale(fit, np.ptp(moved, axis=0), upper - lower))
    return result


def _nearest(rectangles: np.ndarray, point: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The lower and the upper corner of the rectangle nearest to a point; of several that with the nearest middle."""
    lower, upper = rectangles[:, :2], rectangles[:, 2:]
    away = np.linalg.norm(point - np.clip(point, lower, upper), axis=1)
    from_middle = np.linalg.norm(point - (lower + upper) / 2.0, axis=1)
    k = np.lexsort((from_middle, away))[0]
    return lower[k], upper[k]


def _scale(fit: str, size: np.ndarray, room: np.ndarray) -> np.ndarray:
    """The factors (2,) that bring a box of a size to a rectangle. An axis without length keeps it."""
    factors = np.divide(room, size, out=np.full(2, np.inf), where=size > 0.0)
    one = {"INSIDE": factors.min(), "HEIGHT": factors[1], "WIDTH": factors[0], "KEEP": 1.0}.get(fit)
    found = factors if one is None else np.full(2, one)
    return np.where(np.isfinite(found), found, 1.0)


def mirrored_corners(surface: Surface, image: np.ndarray) -> np.ndarray:
    """The corner (C,) of the mirrored face at the mirror image of each corner's vertex; -1 if there is none.

    image  (V,) mirror image of each vertex; -1: none

    The mirror image of a face runs the other way round: that of the edge from v to w runs from w' to v'.
    """
    vertex, following = surface.corner_vertex.astype(np.int64), next_corners(surface)
    count = len(surface.positions)
    key = vertex * count + vertex[following]
    start, end = image[vertex[following]].astype(np.int64), image[vertex].astype(np.int64)
    wanted = np.where((start >= 0) & (end >= 0), start * count + end, -1)
    order = np.argsort(key, kind="stable")
    at = np.searchsorted(key[order], wanted)
    known = np.append(key[order], -2)
    once = (known[at] == wanted) & (known[np.minimum(at + 1, len(key))] != wanted)
    found = np.full(len(key), -1, dtype=np.int64)
    found[once] = following[order[at[once]]]
    return found


def left_side(surface: Surface, image: np.ndarray) -> np.ndarray:
    """Which faces (P,) lie on the side of the mirror plane with the lower coordinates."""
    positions = surface.positions
    across = np.where((image >= 0)[:, None], positions - positions[image], 0.0)
    axis = across[np.argmax(np.abs(across).sum(axis=1))]
    axis = axis * np.sign(axis[np.argmax(np.abs(axis))])
    side = (across @ axis)[surface.corner_vertex]
    return np.asarray(np.add.reduceat(side, surface.face_start) < 0.0)


def on_mirror_images(
    surface: Surface, islands: Sequence[np.ndarray], free: Sequence[bool], uv: np.ndarray, image: np.ndarray, tiles: int
) -> list[tuple[int, np.ndarray]]:
    """Islands that go onto their mirror images, and their UVs (c, 2) there, so many tiles to the right.

    islands  corners (c,) of each island. Those that are `free` may move; of two that may, the one on the left side

    An island that is its own mirror image stays, and so does one whose mirror image is cut otherwise.
    """
    partner, left = mirrored_corners(surface, image), left_side(surface, image)
    island_of = np.full(len(uv), -1)
    for k, corners in enumerate(islands):
        island_of[corners] = k
    face = np.repeat(np.arange(len(surface.face_size)), surface.face_size)
    result = []
    for k, corners in enumerate(islands):
        there = partner[corners]
        if not free[k] or (there < 0).any():
            continue
        others = np.unique(island_of[there])
        other = int(others[0])
        if len(others) > 1 or other in (-1, k) or len(islands[other]) != len(corners):
            continue
        if not free[other] or np.count_nonzero(left[face[corners]]) * 2 > len(corners):
            result.append((k, uv[there] + (float(tiles), 0.0)))
    return result
