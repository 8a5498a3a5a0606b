# SPDX-License-Identifier: GPL-3.0-or-later
"""Flat pieces as SVG for cutting and engraving, in millimetres, with one group per piece."""

from collections.abc import Sequence

import numpy as np

from .flat_layout import FlatLayout

BORDER = 5.0  # mm around the drawing and between objects
STROKE = 0.1  # mm
CUT, HOLE, ENGRAVE = "#ff0000", "#0000ff", "#000000"  # colours that tell cutters what to do
DIGITS = 4  # after the point: down to a tenth of a micrometre


def flat_svg(named: Sequence[tuple[str, FlatLayout]], millimetres: float, edges: bool = False) -> str:
    """The document with the layouts of some objects side by side, and their names.

    millimetres  of the drawing per unit of length of the surface
    edges        also draw the edges between faces, for engraving

    Holes come before the outline of their piece, as they must be cut first.
    """
    from xml.sax.saxutils import escape, quoteattr  # brings urllib and http, which the start has no time for

    width, height, groups = BORDER, 0.0, []
    tallest = max(float(layout.points[:, 1].max()) for _, layout in named) * millimetres
    for name, layout in named:
        at = millimetres * layout.points * [1.0, -1.0] + [width, BORDER + tallest]
        groups += _object([quoteattr(f"{name} {k}") for k in range(1, len(layout.pieces) + 1)], layout, at, edges)
        width += float(layout.points[:, 0].max()) * millimetres + BORDER
        height = BORDER + tallest + BORDER
    wide, high = _number(width), _number(height)
    return "\n".join([
        '<?xml version="1.0" encoding="UTF-8"?>',
        '<svg xmlns="http://www.w3.org/2000/svg" version="1.1" '
        f'width="{wide}mm" height="{high}mm" viewBox="0 0 {wide} {high}">',
        *(f"<desc>{escape(f'{name}: {layout.describe()}')}</desc>" for name, layout in named),
        f'<g fill="none" stroke-width="{STROKE}" stroke-linejoin="round">', *groups, "</g>", "</svg>", "",
    ])  # fmt: skip


def _object(ids: Sequence[str], layout: FlatLayout, at: np.ndarray, edges: bool) -> list[str]:
    lines = []
    for own, piece in zip(ids, layout.pieces, strict=True):
        lines.append(f"<g id={own}>")
        lines += [_path("hole", HOLE, at[hole]) for hole in piece.holes]
        lines += [_path("outline", CUT, at[piece.outline]), "</g>"]
    if edges and len(layout.edges):
        steps = "".join(f"M{_points(at[pair])}" for pair in layout.edges)
        lines.insert(0, f'<path class="engrave" stroke="{ENGRAVE}" d="{steps}"/>')
    return lines


def _path(kind: str, color: str, loop: np.ndarray) -> str:
    return f'<path class="{kind}" stroke="{color}" d="M{_points(loop)}Z"/>'


def _points(points: np.ndarray) -> str:
    return "L".join(f"{_number(x)} {_number(y)}" for x, y in points.tolist())


def _number(value: float) -> str:
    return f"{value:.{DIGITS}f}".rstrip("0").rstrip(".")
