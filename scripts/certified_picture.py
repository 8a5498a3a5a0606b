# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/reliability.md, "Capacities and moduli are proved": docs/images/certified.svg.

A square in a square; how wide the enclosure of its capacity is, and how far its middle is from the exact value, against
the number of triangles.

    PYTHONPATH=build/python python3 scripts/certified_picture.py
"""

import math
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests" / "python"))
OUT = ROOT / "docs" / "images" / "certified.svg"
WIDTHS = [10.0 ** (-k / 2.0) for k in range(1, 15)]
INK, GRID, LINES = "#33415c", "#e3e6ea", {"width: upper − lower": "#c8553d", "middle − exact": "#2a7f9e"}
FONT = 'font-family="Helvetica, Arial, sans-serif"'
LEFT, TOP, WIDE, HIGH = 370, 34, 400, 280  # of the plot
FACES, GAPS = (1, 6), (-11, 1)  # powers of ten on its axes


def measured():
    """(triangles, width, distance of the middle from the exact value) of each refinement."""
    import koebe
    from test_certified import ring, square_in_square

    exact, found = square_in_square(), {}
    for width in WIDTHS:
        bounds = koebe.certified_moduli(*ring(), width=width)
        low, high = bounds.capacities[0]
        assert low <= exact <= high
        found[bounds.faces] = (high - low, abs((low + high) / 2.0 - exact))
    return [(faces, *gaps) for faces, gaps in sorted(found.items())]


def text(x, y, words, anchor="middle", size=12):
    place_of = f'x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"'
    return f'<text {place_of} {FONT} font-size="{size}" fill="{INK}">{words}</text>'


def power(k):
    return f'10<tspan dy="-4" font-size="8">{str(k).replace("-", "−")}</tspan>'


def place(faces, gap):
    x = (math.log10(faces) - FACES[0]) / (FACES[1] - FACES[0])
    y = (math.log10(gap) - GAPS[0]) / (GAPS[1] - GAPS[0])
    return LEFT + WIDE * x, TOP + HIGH * (1.0 - y)


def path(points, style):
    return f'<path d="M{"L".join(f"{x:.1f} {y:.1f}" for x, y in points)}" fill="none" {style}/>'


def square(x, y, side, fill):
    return f'<rect x="{x}" y="{y}" width="{side}" height="{side}" fill="{fill}" stroke="{INK}" stroke-width="3"/>'


def condenser():
    """The surface: potential 1 inside, 0 outside."""
    return [
        square(30, 52, 240, "#f4efe6"),
        square(90, 112, 120, "#ffffff"),
        text(150, 176, "potential 1"),
        text(150, 46, "potential 0"),
        text(150, 320, "the surface: capacity 10.23409256…"),
    ]


def plot(rows):
    out = []
    for k in range(FACES[0], FACES[1] + 1):
        x, _ = place(10.0**k, 1.0)
        out += [f'<path d="M{x:.1f} {TOP}v{HIGH}" stroke="{GRID}"/>', text(x, TOP + HIGH + 17, power(k))]
    for k in range(GAPS[0], GAPS[1] + 1):
        _, y = place(10.0, 10.0**k)
        out += [f'<path d="M{LEFT} {y:.1f}h{WIDE}" stroke="{GRID}"/>', text(LEFT - 6, y + 4, power(k), "end")]
    out.append(text(LEFT + WIDE / 2, TOP + HIGH + 36, "triangles N"))
    law = [place(n, 6e3 * n**-2.0) for n in (10**2.6, 1e5)]
    out.append(path(law, f'stroke="{INK}" stroke-width="1.2" stroke-dasharray="5 4"'))
    out.append(text(law[1][0] + 6, law[1][1] + 4, "N<tspan dy='-4' font-size='8'>−2</tspan>", "start"))
    for rank, (name, color) in enumerate(LINES.items()):
        points = [place(row[0], row[1 + rank]) for row in rows if row[1 + rank] > 10.0 ** GAPS[0]]
        out.append(path(points, f'stroke="{color}" stroke-width="1.8"'))
        out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.8" fill="{color}"/>' for x, y in points]
        y = TOP - 14
        out.append(f'<path d="M{LEFT + 20 + 170 * rank} {y}h26" stroke="{color}" stroke-width="2"/>')
        out.append(text(LEFT + 52 + 170 * rank, y + 4, name, "start"))
    return out


def main():
    rows = measured()
    print(*rows, sep="\n")
    head = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 800 360" width="800">'
    paper = '<rect width="800" height="360" fill="#ffffff"/>'
    OUT.write_text("\n".join([head, paper, *condenser(), *plot(rows), "</svg>\n"]), encoding="utf-8")


if __name__ == "__main__":
    main()
