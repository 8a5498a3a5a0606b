# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/patterns.md: docs/images/patterns.svg, a hat and its pattern. NumPy and koebe.

PYTHONPATH=build/python python3 scripts/patterns_picture.py
"""

import re
from pathlib import Path

import koebe
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "docs" / "images" / "patterns.svg"
WIDTH, HEIGHT = 300, 400  # of a half of the picture, in its units
READABLE = 9  # mm, of text in the picture, where it is larger than on paper
COLOURS = ("#e9b44c", "#6fa8dc", "#93c47d", "#d98cb3", "#b4a7d6", "#f6b26b")


def hat(around=60):
    """A crown and a brim: vertices in mm, triangles."""
    t = np.linspace(0.06, 1, 22)
    crown = [(95 * np.sin(t * np.pi / 2) ** 0.7, 120 * np.cos(t * np.pi / 2) ** 0.7) for t in t]
    brim = [(95 + 14 * k, -5 * k - 0.8 * k * k) for k in range(1, 7)]
    radius, height = np.array(crown + brim).T
    angle = 2 * np.pi * np.arange(around) / around
    x, y = np.outer(1.1 * np.cos(angle), radius), np.outer(0.9 * np.sin(angle), radius)
    points = np.stack([x, y, np.tile(height, (around, 1))], -1)
    n = len(radius)
    i, k = (one.ravel() for one in np.meshgrid(np.arange(around), np.arange(n - 1), indexing="ij"))
    a, b = i * n + k, (i + 1) % around * n + k
    faces = np.concatenate([np.stack([a, b + 1, b], 1), np.stack([a, a + 1, b + 1], 1)])
    top = np.stack([np.arange(around) * n, np.roll(np.arange(around) * n, -1), np.full(around, around * n)], 1)
    vertices = np.concatenate([points.reshape(-1, 3), [[0, 0, height[0] + 1]]])
    return vertices, np.concatenate([faces, top])


def drawn(vertices, triangles, part):
    """The hat from the front and above, farthest faces first."""
    tilt = np.radians(28)
    x, up = vertices[:, 0], np.cos(tilt) * vertices[:, 2] + np.sin(tilt) * vertices[:, 1]
    away = -np.cos(tilt) * vertices[:, 1] + np.sin(tilt) * vertices[:, 2]
    at = np.stack([WIDTH / 2 + 0.72 * x, HEIGHT / 2 + 30 - 0.72 * up], 1).round(1)
    lines = []
    for f in np.argsort(away[triangles].mean(axis=1)):
        path = "M{} {}L{} {}L{} {}z".format(*at[triangles[f]].ravel())
        fill = COLOURS[part[f] % len(COLOURS)]
        lines.append(f'<path d="{path}" fill="{fill}" stroke="#5c5c5c" stroke-width=".25" stroke-linejoin="round"/>')
    return lines


def pattern(page):
    """What is on the page, scaled to half of the picture."""
    size = [float(number) for number in re.search(r'viewBox="0 0 ([\d.]+) ([\d.]+)"', page).groups()]
    body = page[page.index("</style>") + len("</style>") : page.rindex("</svg>")]
    body = re.sub(r"-?\d+\.\d+", lambda found: f"{float(found[0]):.1f}", body)
    for name, style in (
        ("cut", 'fill="none" stroke="#000" stroke-width=".8"'),
        ("seam", 'fill="none" stroke="#777" stroke-width=".6" stroke-dasharray="3 2"'),
        ("mark", 'fill="none" stroke="#c00" stroke-width=".8"'),
    ):
        body = body.replace(f'class="{name}"', style)
    body = body.replace("<text ", '<text text-anchor="middle" ')
    body = re.sub(r'font-size="([\d.]+)"', lambda found: f'font-size="{max(float(found[1]), READABLE)}"', body)
    scale = min((WIDTH - 10) / size[0], (HEIGHT - 40) / size[1])
    shift = WIDTH + (WIDTH - scale * size[0]) / 2, 30 + (HEIGHT - 40 - scale * size[1]) / 2
    return [f'<g transform="translate({shift[0]:.2f} {shift[1]:.2f}) scale({scale:.4f})">{body}</g>']


def main():
    vertices, triangles = hat()
    result = koebe.flatten(vertices, triangles, page="none", allowance=10, darts=0.05)
    told = result.stretch_percent
    words = (f"a hat: {len(result.pieces)} pieces, {result.darts} darts",
             f"{told['mean']:.1f} % stretch in the mean, 10 mm allowance")  # fmt: skip
    svg = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {HEIGHT}" font-family="sans-serif">',
           f'<rect width="{2 * WIDTH}" height="{HEIGHT}" fill="#fff"/>']  # fmt: skip
    svg += drawn(vertices, triangles, result.part) + pattern(result.svg[0])
    for k, text in enumerate(words):
        svg.append(f'<text x="{WIDTH * (k + 0.5)}" y="18" text-anchor="middle" font-size="13">{text}</text>')
    OUT.write_text("\n".join([*svg, "</svg>"]) + "\n", encoding="utf-8")
    print(result)


if __name__ == "__main__":
    main()
