# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures of docs/method.md: docs/images/flux_is_angle.svg, disk_kernel.svg and barycentre.svg. NumPy alone.

scripts/method_pictures.py [FOLDER]        default: docs/images
"""

import sys
from pathlib import Path

import numpy as np

IMAGES = Path(__file__).resolve().parent.parent / "docs" / "images"
INK, FACE, FLUX, MARK, FAINT = "#1b2a41", "#f4efe6", "#2a7f9e", "#e4572e", "#b9c2cc"
SIZE, GAP, TEXT = 220, 24, 30
FONT = 'font-family="Georgia, \'DejaVu Serif\', serif" font-size="13"'


def place(z, column):
    """A point of the unit disk in a panel."""
    scale = SIZE / 2 - 6
    return f"{GAP + column * (SIZE + GAP) + SIZE / 2 + scale * z.real:.1f},{SIZE / 2 + 10 - scale * z.imag:.1f}"


def line(points, column, style):
    return f'<polyline points="{" ".join(place(z, column) for z in points)}" fill="none" {style}/>'


def dot(z, column, color, radius=3.5):
    x, y = place(z, column).split(",")
    return f'<circle cx="{x}" cy="{y}" r="{radius}" fill="{color}"/>'


def disk(column):
    x, y = place(0j, column).split(",")
    return f'<circle cx="{x}" cy="{y}" r="{SIZE / 2 - 6}" fill="{FACE}" stroke="{INK}" stroke-width="1.5"/>'


def words(text, x, y, anchor="middle"):
    return f'<text x="{x:.1f}" y="{y:.1f}" {FONT} fill="{INK}" text-anchor="{anchor}">{text}</text>'


def caption(text, column):
    return words(text, GAP + column * (SIZE + GAP) + SIZE / 2, SIZE + TEXT)


def picture(parts, width, height=SIZE + TEXT + 12):
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="#ffffff"/>', *parts, "</svg>\n"])


def moved(z, a):
    """By the automorphism of the disk that takes a to 0."""
    return (z - a) / (1 - np.conj(a) * z)


def flux_is_angle(source=0.45 + 0.25j, lines=12):
    """Lines of flux from a source, and the same after the map that takes the source to 0."""
    parts = [disk(0), disk(1)]
    for angle in 2 * np.pi * np.arange(lines) / lines:
        ray = np.linspace(0.0, 1.0, 40) * np.exp(1j * angle)
        for column, points in ((0, moved(ray, -source)), (1, ray)):
            parts += [line(points, column, f'stroke="{FLUX}" stroke-width="1.4"'), dot(points[-1], column, INK, 3)]
    parts += [dot(source, 0, MARK), dot(0j, 1, MARK)]
    parts += [caption("equal flux between the lines", 0), caption("equal angles", 1)]
    return picture(parts, 2 * SIZE + 3 * GAP)


def disk_kernel(vertices=9, arc=4):
    """The kernel over the circle unrolled, its mean over the arcs, and below a hat function with its difference."""
    width, left, top, height = 470, 40, 14, 130
    nodes = np.linspace(-np.pi, np.pi, vertices + 1) + 0.12 * np.sin(3 * np.arange(vertices + 1))
    nodes[-1] = nodes[0] + 2 * np.pi
    low, high = nodes[0], nodes[-1]

    def at(t, y, base, scale):
        return f"{left + (width - 2 * left) * (t - low) / (high - low):.1f},{base - scale * y:.1f}"

    t = np.linspace(low, high, 2001)
    middle = (nodes[arc] + nodes[arc + 1]) / 2
    kernel = -np.log(np.maximum(np.abs(2 * np.sin((t - middle) / 2)), 1e-3)) / np.pi
    base, scale = top + 88, 62
    drawn = kernel < 1.2
    sides = (drawn & (t < middle), drawn & (t > middle))
    curve = [[at(x, y, base, scale) for x, y in zip(t[side], kernel[side])] for side in sides]
    own = np.linspace(nodes[arc], nodes[arc + 1], 202)[1:-1]
    parts = [f'<path d="M{left} {base}H{width - left}" stroke="{FAINT}"/>']
    for a, b in zip(nodes, nodes[1:]):
        samples = a + (b - a) * (np.arange(200) + 0.5) / 200
        mean = np.mean(-np.log(np.abs(2 * np.sin((samples[:, None] - own) / 2)))) / np.pi
        (x0, y0), (x1, _) = (at(v, mean, base, scale).split(",") for v in (a, b))
        parts.append(f'<path d="M{x0} {y0}H{x1}" stroke="{MARK}" stroke-width="3"/>')
    parts += [
        f'<polyline points="{" ".join(points)}" fill="none" stroke="{FLUX}" stroke-width="1.6"/>' for points in curve
    ]
    under, hat = top + height + 66, 40
    for k, node in enumerate(nodes):
        x, _ = at(node, 0, under, hat).split(",")
        parts.append(f'<path d="M{x} {top}V{under}" stroke="{FAINT}" stroke-dasharray="2 3"/>')
        parts.append(f'<circle cx="{x}" cy="{under}" r="3" fill="{INK}"/>')
        if k == arc:
            points = [at(nodes[k - 1], 0, under, hat), at(node, 1, under, hat), at(nodes[k + 1], 0, under, hat)]
            parts.append(f'<polyline points="{" ".join(points)}" fill="none" stroke="{INK}" stroke-width="1.8"/>')
    parts.append(f'<path d="M{left} {under}H{width - left}" stroke="{INK}"/>')
    parts.append(words("kernel, and its means over arcs", width / 2, top + height + 12))
    parts.append(words("a hat function between the vertices’ angles", width / 2, under + 24))
    return picture(parts, width, under + 36)


def barycentre():
    """Crowded points with their barycentre, and the same moved."""
    z = np.exp(1j * np.array([0.15, 0.4, 0.62, 0.85, 1.1, 1.4, 1.75, 2.6, 3.9, 5.2]))
    w = z
    for _ in range(100):
        w = moved(w, w.mean())
    a = point_taken_to_zero(z, w)
    parts = [disk(0), disk(1)]
    for column, points, center in ((0, z, a), (1, w, 0j)):
        parts += [line([center, point], column, f'stroke="{FAINT}"') for point in points]
        parts += [dot(point, column, INK) for point in points]
        parts.append(dot(center, column, MARK, 4.5))
    parts += [caption("the conformal barycentre a", 0), caption("a moved to 0: the mean is 0", 1)]
    return picture(parts, 2 * SIZE + 3 * GAP)


def point_taken_to_zero(z, w):
    """The a with w = turn (z - a) / (1 - conj(a) z), from many points by least squares."""
    # w - turn z + turn a - conj(a) z w = 0, linear in turn, turn a =: b, and conj(a)
    system = np.column_stack([-z, np.ones_like(z), -z * w])
    turn, b, _ = np.linalg.lstsq(system, -w, rcond=None)[0]
    return b / turn


PICTURES = {"flux_is_angle": flux_is_angle, "disk_kernel": disk_kernel, "barycentre": barycentre}


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES
    for name, draw in PICTURES.items():
        (folder / f"{name}.svg").write_text(draw(), encoding="utf-8")


if __name__ == "__main__":
    main()
