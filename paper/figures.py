#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The figures of paper.md: a drawing of the documentation, and two plots of its measured figures (docs/figures.json).

    paper/figures.py        needs rsvg-convert; writes condensed_step.png and measurements.png beside itself
"""

import json
import math
import subprocess
from pathlib import Path

HERE = Path(__file__).resolve().parent
DOCS = HERE.parent / "docs"
WIDTH, HEIGHT, LEFT, TOP, BOTTOM, RIGHT = 420, 300, 62, 14, 46, 14  # of one panel
INK, GRID = "#1b2a41", "#e3e6ea"
COLORS = ("#3b6ea5", "#c0504d", "#6a994e")
PIXELS = 1700  # of a picture's width


def number(cell: str) -> float:
    return float(cell.split()[0].replace(",", ""))


def power_of_ten(power: int) -> str:
    return f'10<tspan dy="-5" font-size="9">{str(power).replace("-", chr(0x2212))}</tspan>'


class Panel:
    """Two logarithmic axes, `x` and `y` each the lowest and highest power of ten."""

    def __init__(self, column: int, x: tuple[int, int], y: tuple[int, int], labels: tuple[str, str]) -> None:
        self.x, self.y, self.left = x, y, column * WIDTH + LEFT
        self.right, self.bottom = (column + 1) * WIDTH - RIGHT, HEIGHT - BOTTOM
        self.out = [f'<g font-family="DejaVu Sans, sans-serif" font-size="12" fill="{INK}">']
        for power in range(x[0], x[1] + 1):
            at, _ = self.place(10.0**power, 10.0 ** y[0])
            self.out.append(f'<path d="M{at:.1f} {TOP}V{self.bottom}" stroke="{GRID}"/><text x="{at:.1f}" '
                            f'y="{self.bottom + 18}" text-anchor="middle">{power_of_ten(power)}</text>')
        for power in range(y[0], y[1] + 1):
            _, at = self.place(10.0 ** x[0], 10.0**power)
            self.out.append(f'<path d="M{self.left} {at:.1f}H{self.right}" stroke="{GRID}"/><text x="{self.left - 6}" '
                            f'y="{at + 4:.1f}" text-anchor="end">{power_of_ten(power)}</text>')
        middle = (TOP + self.bottom) / 2
        self.out.append(f'<text x="{(self.left + self.right) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{labels[0]}'
                        f'</text><text transform="translate({self.left - 44} {middle}) rotate(-90)" '
                        f'text-anchor="middle">{labels[1]}</text>')

    def place(self, x: float, y: float) -> tuple[float, float]:
        across = (math.log10(x) - self.x[0]) / (self.x[1] - self.x[0])
        up = (math.log10(y) - self.y[0]) / (self.y[1] - self.y[0])
        return self.left + across * (self.right - self.left), self.bottom - up * (self.bottom - TOP)

    def line(self, points: list[tuple[float, float]], color: str, dashes: str = "none") -> None:
        path = "L".join(f"{x:.1f} {y:.1f}" for x, y in (self.place(*point) for point in points))
        self.out.append(f'<path d="M{path}" fill="none" stroke="{color}" stroke-width="1.8" '
                        f'stroke-dasharray="{dashes}"/>')

    def dots(self, points: list[tuple[float, float]], color: str) -> None:
        self.out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3.4" fill="{color}" fill-opacity="0.75"/>'
                     for x, y in (self.place(*point) for point in points)]

    def text(self, x: float, y: float, words: str, color: str = INK) -> None:
        at, up = self.place(x, y)
        self.out.append(f'<text x="{at:.1f}" y="{up:.1f}" fill="{color}">{words}</text>')

    def svg(self) -> str:
        return "\n".join([*self.out, "</g>"])


def accuracy(figures: dict) -> str:
    """Errors of five known circles, by the number of faces; the dashed line is of second order in the edge length."""
    panel = Panel(0, (2, 5), (-6, -2), ("faces", "largest relative error of the circles"))
    faces = [number(cell) for cell in figures["exact"]["head"][1:]]
    for place, (lift, color) in enumerate(zip(("polynomial", "sphere", "Enneper"), COLORS)):
        points = list(zip(faces, map(number, figures["exact"]["rows"][f"{lift}, condensed"])))
        panel.line(points, color)
        panel.dots(points, color)
        panel.text(130, 10 ** (-4.9 - 0.32 * place), lift, color)
    panel.line([(1e3, 4e-3), (4e4, 1e-4)], "#8a8f98", "5 4")
    panel.text(6e3, 1.2e-3, "second order", "#6b7078")
    return panel.svg()


def beside_the_peer(figures: dict) -> str:
    """Time of the whole command over the time of boundary first flattening, by the number of faces."""
    panel = Panel(1, (2, 6), (-2, 2), ("faces", "time / time of BFF"))
    points = [(number(row[0]), number(row[1])) for name, row in figures["bff"]["rows"].items() if "median" not in name]
    panel.line([(1e2, 1.0), (1e6, 1.0)], INK, "5 4")
    panel.dots(points, COLORS[0])
    return panel.svg()


def main() -> None:
    figures = json.loads((DOCS / "figures.json").read_text(encoding="utf-8"))
    drawing = (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {HEIGHT}" width="{2 * WIDTH}">'
               f'<rect width="100%" height="100%" fill="#ffffff"/>{accuracy(figures)}{beside_the_peer(figures)}</svg>')
    step = (DOCS / "images" / "condensed_step.svg").read_text(encoding="utf-8")
    for name, svg in {"measurements": drawing, "condensed_step": step}.items():
        size = ["--width", str(PIXELS), "--keep-aspect-ratio"]
        subprocess.run(["rsvg-convert", *size, "--output", HERE / f"{name}.png"], input=svg.encode(), check=True)


if __name__ == "__main__":
    main()
