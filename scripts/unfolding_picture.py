# SPDX-License-Identifier: GPL-3.0-or-later
"""A picture of docs/parts.md: docs/images/unfolding.svg, solids of flat and rolled faces and their parts. NumPy, koebe.

PYTHONPATH=build/python python3 scripts/unfolding_picture.py
"""

from pathlib import Path

import koebe
import numpy as np

OUT = Path(__file__).resolve().parent.parent / "docs" / "images" / "unfolding.svg"
SIDE = 240  # of a picture, in its units
LIGHT = np.array([0.35, -0.55, 0.76])
COLOURS = ("#e9b44c", "#6fa8dc", "#93c47d", "#d98cb3", "#b4a7d6")


def triangles_of(polygons):
    """Polygons that are star-shaped round their first corner, as triangles, and the polygon of each."""
    fans = [[(p[0], p[k], p[k + 1]) for k in range(1, len(p) - 1)] for p in polygons]
    return np.array([face for fan in fans for face in fan]), np.repeat(np.arange(len(fans)), [len(fan) for fan in fans])


def extruded(outline, height):
    """A prism over an outline that runs counter-clockwise."""
    n = len(outline)
    points = np.concatenate([np.column_stack([outline, np.full(n, z)]) for z in (0.0, height)])
    sides = [(i, (i + 1) % n, n + (i + 1) % n, n + i) for i in range(n)]
    return points, [*sides, tuple(range(n))[::-1], tuple(range(n, 2 * n))]


def cube():
    return extruded(np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float), 1.0)


def stairs(steps=3):
    """Steps seen from the side. The outline begins where all of it can be seen from: at the back below."""
    corners = [(steps, 0.0), (steps, float(steps))]
    for k in range(steps - 1, -1, -1):
        corners += [(k, k + 1.0), (k, float(k))]
    points, polygons = extruded(np.array(corners, float), 2.5)
    front = [polygons[-2][-1:] + polygons[-2][:-1], polygons[-1]]  # both from the back below
    return points[:, [0, 2, 1]] * [1, -1, 1], polygons[:-2] + front


def pencil(around=48, height=2.4, tip=1.2):
    angle = 2 * np.pi * np.arange(around) / around
    points, polygons = extruded(np.column_stack([np.cos(angle), np.sin(angle)]), height)
    rim = polygons.pop()
    sharpened = [(2 * around, a, b) for a, b in zip(rim, np.roll(rim, -1), strict=True)]
    return np.concatenate([points, [[0, 0, height + tip]]]), polygons + sharpened


def path(points, fill):
    places = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path d="M{places}z" fill="{fill}" stroke="{fill}" stroke-width=".4" stroke-linejoin="round"/>'


def shaded(colour, light):
    return "#" + "".join(f"{round(int(colour[i : i + 2], 16) * light):02x}" for i in (1, 3, 5))


def normals(points, triangles):
    a, b, c = points[triangles].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    return normal / np.linalg.norm(normal, axis=1)[:, None]


def creases(points, triangles):
    """(face, corner) from which an edge starts that is bent by more than 30 degrees, once from each side."""
    sides, normal = {}, normals(points, triangles)
    for f, face in enumerate(triangles):
        for k in range(3):
            sides.setdefault(frozenset((face[k], face[(k + 1) % 3])), []).append((f, k))
    return [side for a, b in sides.values() if normal[a[0]] @ normal[b[0]] < np.cos(np.pi / 6) for side in (a, b)]


def view(points):
    """Places on the page and depths, from the front and above."""
    turn, tilt = np.radians(28), np.radians(26)
    x = np.cos(turn) * points[:, 0] - np.sin(turn) * points[:, 1]
    y = np.sin(turn) * points[:, 0] + np.cos(turn) * points[:, 1]
    up, away = np.cos(tilt) * points[:, 2] + np.sin(tilt) * y, np.cos(tilt) * y - np.sin(tilt) * points[:, 2]
    return np.stack([x, -up], 1), away


def fitted(points, left, top, size):
    """Places scaled into a square of the page."""
    low, high = points.min(axis=0), points.max(axis=0)
    scale = size / (high - low).max()
    return (points - (low + high) / 2) * scale + [left + SIDE / 2, top + SIDE / 2]


def solid(points, triangles, part, left):
    page, away = view(points)
    flat = fitted(page, left, 20, SIDE - 70)[triangles]
    along, across = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    seen = np.flatnonzero(along[:, 0] * across[:, 1] < along[:, 1] * across[:, 0])
    light = 0.72 + 0.28 * np.maximum(normals(points, triangles) @ LIGHT, 0)
    order = seen[np.argsort(-away[triangles[seen]].mean(axis=1))]
    return [path(flat[f], shaded(COLOURS[part[f]], light[f])) for f in order]


def layout(result, edges, left):
    places = fitted(result.uv.reshape(-1, 2) * [1, -1], left, SIDE + 10, SIDE - 40).reshape(-1, 3, 2)
    lines = [path(corners, COLOURS[part]) for corners, part in zip(places, result.part, strict=True)]
    for f, k in edges:
        (ax, ay), (bx, by) = places[f, k], places[f, (k + 1) % 3]
        lines.append(f'<path d="M{ax:.1f} {ay:.1f}L{bx:.1f} {by:.1f}" stroke="#fff" stroke-width="1"/>')
    return lines


def main():
    width, height = 3 * SIDE, 2 * SIDE + 30
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">',
           f'<rect width="{width}" height="{height}" fill="#fff"/>']  # fmt: skip
    for column, shape in enumerate((cube, stairs, pencil)):
        points, polygons = shape()
        triangles, polygon = triangles_of(polygons)
        result = koebe.parts(points, triangles, polygon=polygon)
        print(shape.__name__, len(result.parts), result.cut_length, result.density_ratio_5_95)
        left = column * SIDE
        svg += solid(points, triangles, result.part, left)
        svg += layout(result, creases(points, triangles), left)
        words = f"{shape.__name__}: {len(result.parts)} part{'s' if len(result.parts) > 1 else ''}"
        svg.append(f'<text x="{left + SIDE / 2}" y="18" text-anchor="middle" font-size="14">{words}</text>')
    OUT.write_text("\n".join([*svg, "</svg>"]) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
