"""Reads patterns as they are written, and what is true of every pattern. NumPy alone."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass

import numpy as np
from uv_measures import signed_areas

SVG = "{http://www.w3.org/2000/svg}"


@dataclass
class Line:
    kind: str
    piece: int
    closed: bool
    points: np.ndarray


def svg_page(text):
    """Size in mm, lines and labels ((piece, text) pairs) of a page. The y axis points down."""
    root = ElementTree.fromstring(text)
    size = [float(re.fullmatch(r"([\d.]+)mm", root.get(name))[1]) for name in ("width", "height")]
    assert [float(word) for word in root.get("viewBox").split()] == [0, 0, *size]  # a unit is a millimetre
    lines = []
    for path in root.iter(SVG + "path"):
        if path.get("data-piece"):
            steps = path.get("d")
            points = [[float(word) for word in step.split()] for step in steps.strip("MZ").split("L")]
            lines.append(Line(path.get("class"), int(path.get("data-piece")), steps.endswith("Z"), np.array(points)))
    texts = [text for text in root.iter(SVG + "text") if text.get("data-piece")]
    return size, lines, [(int(text.get("data-piece")), text.text) for text in texts]


def dxf_entities(text):
    """Polylines as (layer, closed, points) and texts as (layer, text), and the unit's number."""
    words = text.split("\n")
    assert words[-1] == "" and len(words) % 2 == 1
    pairs = [(int(words[k]), words[k + 1]) for k in range(0, len(words) - 1, 2)]
    assert pairs[-1] == (0, "EOF")
    unit = next(pairs[k + 1][1] for k, pair in enumerate(pairs) if pair == (9, "$INSUNITS"))
    polylines, texts, kind, groups = [], [], "", {}
    for code, value in [*pairs[pairs.index((2, "ENTITIES")) + 1 :], (0, "")]:
        if code:
            groups[code] = value
            continue
        if kind == "POLYLINE":
            polylines.append((groups[8], groups[70] == "1", []))
        elif kind == "VERTEX":
            polylines[-1][2].append([float(groups[10]), float(groups[20])])
        elif kind == "TEXT":
            texts.append((groups[8], groups[1]))
        kind, groups = value, {}
    return [(layer, closed, np.array(points)) for layer, closed, points in polylines], texts, unit


def lengths(points):
    """Of the edges of a closed line."""
    return np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)


def enclosed(points):
    x, y = (points - points[0]).T
    return 0.5 * float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())


def crossings(first, second):
    """How many edges of two closed lines cross, end points apart."""
    a, b = first[:, None], np.roll(first, -1, axis=0)[:, None]
    c, d = second[None], np.roll(second, -1, axis=0)[None]

    def side(p, q, r):
        along, to = q - p, r - p
        return np.sign(along[..., 0] * to[..., 1] - along[..., 1] * to[..., 0])

    return int(((side(a, b, c) * side(a, b, d) < 0) & (side(c, d, a) * side(c, d, b) < 0)).sum())


def inside(point, rings):
    """Whether the even-odd rule has the point inside."""
    count = 0
    for ring in rings:
        a, b = ring, np.roll(ring, -1, axis=0)
        over = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
        x = a[over, 0] + (point[1] - a[over, 1]) * (b[over, 0] - a[over, 0]) / (b[over, 1] - a[over, 1])
        count += int((x > point[0]).sum())
    return count % 2 == 1


def require_sound(result, allowance=0.0):
    """What holds for every pattern: pieces are one to one, apart, whole, and true to the report."""
    mapped = result.part >= 0
    assert (signed_areas(result.uv[mapped]) > 0).all()
    polylines, texts, unit = dxf_entities(result.dxf)
    assert unit == "4"
    cuts = [points for layer, closed, points in polylines if layer == "CUT"]
    seams = [points for layer, closed, points in polylines if layer == ("SEAM" if allowance else "CUT")]
    assert all(closed for layer, closed, _ in polylines if layer in ("CUT", "SEAM"))
    boxes = [(points.min(axis=0), points.max(axis=0)) for points in cuts]
    for i, first in enumerate(cuts):
        assert crossings(first, first) == 0
        for j in range(i):
            if (boxes[i][0] <= boxes[j][1]).all() and (boxes[j][0] <= boxes[i][1]).all():
                assert crossings(first, cuts[j]) == 0
    area = signed_areas(result.uv[mapped]).sum()
    assert abs(sum(map(enclosed, seams)) - area) <= 1e-9 * area
    total = sum(piece["outline_mm"] for piece in result.pieces)
    assert abs(sum(lengths(points).sum() for points in seams) - total) <= 1e-9 * total
    numbers = [text for _, text in texts if not text.startswith("P")]
    for number, seam in enumerate(result.seams, 1):
        assert len(seam["pieces"]) == len(seam["lengths_mm"]) == numbers.count(str(number)) >= 2
    assert len(result.svg) == result.pages == sum(sheet["columns"] * sheet["rows"] for sheet in result.sheets)
    page = iter(result.svg)
    for sheet in result.sheets:
        shown = [svg_page(next(page)) for _ in range(sheet["columns"] * sheet["rows"])]
        for size, lines, _ in shown:
            assert not result.page_mm[0] or size == result.page_mm
            if len(shown) == 1:  # all of it is on the page
                for line in lines:
                    assert (line.points >= 0).all() and (line.points <= size).all()
