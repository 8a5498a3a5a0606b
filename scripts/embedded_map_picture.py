# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/reliability.md, "Why maps are one to one": docs/images/embedded_map.svg. NumPy alone.

A coarse ring with a square hole: filled, by convex combination, its loop pulled round, and after a step too long.
"""

from pathlib import Path

import numpy as np

OUT = Path(__file__).resolve().parent.parent / "docs" / "images" / "embedded_map.svg"
INK, FACE, FAN, WRONG, CIRCLE = "#1b2a41", "#f4efe6", "#dbe7ea", "#e4572e", "#2a7f9e"
RIM, RINGS, HOLE = 12, 2, 4
SIDE, GAP = 190, 30


def mesh():
    """A bent strip round an uneven hole: points of the surface seen from above, faces, faces of the fan."""
    angle = 2 * np.pi * np.arange(RIM) / RIM
    outer = np.column_stack([np.cos(angle), 0.75 * np.sin(angle) + 0.22 * np.cos(2 * angle)])
    middle = 0.62 * outer + [0.1, 0.05]
    corner = np.radians([30, 120, 210, 300])
    hole = [0.1, 0.05] + np.array([[0.34], [0.15], [0.38], [0.2]]) * np.column_stack([np.cos(corner), np.sin(corner)])
    points = np.concatenate([outer, middle, hole, [hole.mean(axis=0)]])
    i = np.arange(RIM)
    j = (i + 1) % RIM
    faces = np.concatenate([np.column_stack([i, j, RIM + j]), np.column_stack([i, RIM + j, RIM + i])])
    first, after = 2 * RIM + i * HOLE // RIM, 2 * RIM + (i + 1) * HOLE // RIM % HOLE
    faces = np.concatenate([faces, np.column_stack([RIM + i, RIM + j, first])])
    turned = first != after
    faces = np.concatenate([faces, np.column_stack([RIM + j, after, first])[turned]])
    k = np.arange(HOLE)
    fan = np.column_stack([2 * RIM + k, 2 * RIM + (k + 1) % HOLE, np.full(HOLE, len(points) - 1)])
    return points, faces, fan


def convex_combination(count, faces, fixed, places):
    """Every vertex that is not fixed at the mean of its neighbours (Tutte 1963)."""
    edges = np.unique(np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1), axis=0)
    matrix = np.zeros((count, count))
    matrix[edges[:, 0], edges[:, 1]] = matrix[edges[:, 1], edges[:, 0]] = -1.0
    np.fill_diagonal(matrix, -matrix.sum(axis=1))
    right = np.zeros((count, 2))
    matrix[fixed], right[fixed] = np.eye(count)[fixed], places
    return np.linalg.solve(matrix, right)


def panel(points, faces, fan, column, title, circle=None, scale=80.0):
    """One of the four drawings."""
    q = points * [scale, -scale] + [GAP + column * (SIDE + GAP) + SIDE / 2, SIDE / 2 + 14]
    parts = []
    for group, color in ((faces, FACE), (fan, FAN)):
        for face in group:
            (ax, ay), (bx, by), (cx, cy) = points[face]
            over = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax) <= 0
            corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in q[face])
            parts.append(f'<polygon points="{corners}" fill="{WRONG if over else color}" stroke="{INK}"/>')
    if circle is not None:
        (x, y), radius = circle
        x, y = GAP + column * (SIDE + GAP) + SIDE / 2 + scale * x, SIDE / 2 + 14 - scale * y
        place = f'cx="{x:.1f}" cy="{y:.1f}" r="{scale * radius:.1f}"'
        parts.append(f'<circle {place} fill="none" stroke="{CIRCLE}" stroke-width="2.5"/>')
    middle = GAP + column * (SIDE + GAP) + SIDE / 2
    parts.append(f'<text x="{middle}" y="{SIDE + 42}" text-anchor="middle" stroke="none">{title}</text>')
    return parts


def upright(points, faces):
    a, b, c = points[faces].transpose(1, 0, 2)
    return (((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) > 0).all()


def main():
    surface, faces, fan = mesh()
    every = np.concatenate([faces, fan])
    angle = 2 * np.pi * np.arange(RIM) / RIM
    rim, hole = np.arange(RIM), np.arange(2 * RIM, 2 * RIM + HOLE)
    circle = np.column_stack([np.cos(angle), np.sin(angle)])
    start = convex_combination(len(surface), every, rim, circle)
    center = start[hole].mean(axis=0)
    arm = start[hole] - center
    radius = np.linalg.norm(arm, axis=1).mean()
    on_circle = center + radius * arm / np.linalg.norm(arm, axis=1, keepdims=True)
    fixed = np.concatenate([rim, hole])
    round_hole = convex_combination(len(surface), every, fixed, np.concatenate([circle, on_circle]))
    too_far = round_hole.copy()
    too_far[RIM + 1] += 2.6 * (round_hole[hole[1]] - round_hole[RIM + 1])
    assert [upright(points, every) for points in (surface, start, round_hole, too_far)] == [True, True, True, False]
    parts = panel(surface, faces, fan, 0, "the surface, its hole filled")
    parts += panel(start, faces, fan, 1, "start: convex combinations")
    parts += panel(round_hole, faces, fan, 2, "the hole pulled to a circle", (center, radius))
    parts += panel(too_far, faces, fan, 3, "a step too long: refused")
    width, height = 4 * (SIDE + GAP) + GAP, SIDE + 60
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}">'
    style = '<g stroke-linejoin="round" font-family="sans-serif" font-size="14" fill="#1b2a41">'
    paper = f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    OUT.write_text("\n".join([head, paper, style, *parts, "</g>", "</svg>", ""]), encoding="utf-8")


if __name__ == "__main__":
    main()
