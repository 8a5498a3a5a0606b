# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/method.md, "The condensed engine": docs/images/condensed_step.svg. NumPy alone.

A disk with three holes, then two of them filled and one open, with lines of equal flux from the outer loop to the open
one; and its image by the automorphism that makes the open one concentric, where these lines are straight.
"""

from pathlib import Path

import numpy as np

OUT = Path(__file__).resolve().parent.parent / "docs" / "images" / "condensed_step.svg"
INK, FACE, FILLED, OPEN, FLUX = "#1b2a41", "#f4efe6", "#dbe7ea", "#ffffff", "#e4572e"
SIZE, GAP, LINES, POINTS = 250, 40, 24, 60
POLE, RADIUS = 0.35 - 0.1j, 0.22  # of the open hole, in the disk
DISKS = ((-0.45 + 0.3j, 0.17), (-0.25 - 0.5j, 0.14))  # filled: the flux passes through them
CORNERS = 16  # vertices of a loop in the picture


def concentric():
    """The automorphism z -> (z - a) / (1 - conj(a) z) that makes the open hole concentric, and its new radius."""
    direction = POLE / abs(POLE)
    near, far = abs(POLE) - RADIUS, abs(POLE) + RADIUS
    # Images of both ends are opposite: (far - t) / (1 - t far) = -(near - t) / (1 - t near).
    b = 2 + 2 * near * far
    t = (b - np.sqrt(b * b - 4 * (near + far) ** 2)) / (2 * (near + far))
    return t * direction, (far - t) / (1 - t * far)


def flux_lines():
    """Lines of equal flux: arcs of circles, straight once the hole is concentric."""
    a, inner = concentric()
    radius = np.linspace(1.0, inner, POINTS)
    for angle in 2 * np.pi * np.arange(LINES) / LINES:
        w = radius * np.exp(1j * angle)
        yield (w + a) / (1 + np.conj(a) * w)


def at(z, left):
    return f"{left + SIZE / 2 * (1 + z.real):.1f},{10 + SIZE / 2 * (1 - z.imag):.1f}"


def circle(center, radius, left, fill, width=1.5):
    x, y = at(center, left).split(",")
    return (
        f'<circle cx="{x}" cy="{y}" r="{SIZE / 2 * radius:.1f}" fill="{fill}" stroke="{INK}" stroke-width="{width}"/>'
    )


def dots(points, left, color):
    return [
        '<circle cx="{}" cy="{}" r="3" fill="{}"/>'.format(*at(z, left).split(","), color) for z in points
    ]


def caption(text, left):
    return (
        f'<text x="{left + SIZE / 2:.0f}" y="{SIZE + 38}" text-anchor="middle" font-family="sans-serif" '
        f'font-size="14" fill="{INK}">{text}</text>'
    )


def loop(center, radius):
    return center + radius * np.exp(2j * np.pi * np.arange(CORNERS) / CORNERS)


def main():
    parts = []
    first, second, third = (10 + k * (SIZE + GAP) for k in range(3))
    holes = [*DISKS, (POLE, RADIUS)]
    # All open: the boundary is all there is.
    parts.append(circle(0, 1, first, FACE))
    parts += [circle(*hole, first, OPEN) for hole in holes]
    for hole in [(0, 1), *holes]:
        parts += dots(loop(*hole), first, INK)
    parts.append(caption("Σ: the surface, known at its boundary", first))
    # Two are filled, flux runs between the pair.
    parts.append(circle(0, 1, second, FACE))
    parts += [circle(*disk, second, FILLED) for disk in DISKS]
    for line in flux_lines():
        path = " ".join(at(z, second) for z in line)
        parts.append(f'<polyline points="{path}" fill="none" stroke="{FLUX}" stroke-width="1.2"/>')
    parts.append(circle(POLE, RADIUS, second, OPEN))
    parts.append(caption("two holes filled, the pair open", second))
    # Where the flux arrives is the angle.
    a, inner = concentric()
    parts.append(circle(0, 1, third, FACE))
    parts.append(circle(0, inner, third, OPEN))
    for angle in 2 * np.pi * np.arange(LINES) / LINES:
        ends = [at(r * np.exp(1j * angle), third) for r in (1.0, inner)]
        parts.append(f'<polyline points="{" ".join(ends)}" fill="none" stroke="{FLUX}" stroke-width="1.2"/>')
    for center, radius in ((0, 1), (POLE, RADIUS)):
        points = loop(center, radius)
        parts += dots((points - a) / (1 - np.conj(a) * points), third, INK)
    parts.append(caption("equal flux is equal angle", third))
    width, height = 3 * SIZE + 2 * GAP + 20, SIZE + 54
    OUT.write_text(
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" '
        f'viewBox="0 0 {width} {height}">\n<rect width="100%" height="100%" fill="white"/>\n'
        + "\n".join(parts)
        + "\n</svg>\n",
        encoding="utf-8",
    )


if __name__ == "__main__":
    main()
