# SPDX-License-Identifier: GPL-3.0-or-later
"""Small multiples with a logarithmic axis, as one SVG."""

import math
from html import escape

WIDTH, HEIGHT = 330, 300  # of one panel
LEFT, RIGHT, TOP, BOTTOM = 46, 10, 30, 36
FONT = 'font-family="Helvetica, Arial, sans-serif"'


def log_plot(panels, x_label, y_label, lowest=1e-14, highest=1.0):
    """panels: [(title, [(name, color, dashes, [(x, y), ...]), ...]), ...] in a row, y on a logarithmic axis that all
    share; points at or below `lowest` are left out. The names of the first panel make the legend."""
    most = max(x for _, lines in panels for *_, points in lines for x, _ in points)
    step = next(s for s in (1, 2, 5, 10, 20, 50) if most / s <= 8)
    right = step * math.ceil(most / step)
    low, high = math.log10(lowest), math.log10(highest)
    total = WIDTH * len(panels)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {HEIGHT + 30}" width="{total}">',
        f'<rect width="{total}" height="{HEIGHT + 30}" fill="#ffffff"/>',
    ]
    for number, (title, lines) in enumerate(panels):
        x0, x1 = number * WIDTH + LEFT, (number + 1) * WIDTH - RIGHT
        y0, y1 = HEIGHT - BOTTOM, TOP

        def place(x, y, x0=x0, x1=x1, y0=y0, y1=y1):
            return x0 + (x1 - x0) * x / right, y0 + (y1 - y0) * (math.log10(y) - low) / (high - low)

        out.append(f'<g {FONT} font-size="11" fill="#33415c">')
        for power in range(math.ceil(low), math.floor(high) + 1, 2):
            _, y = place(0, 10.0**power)
            out.append(f'<path d="M{x0} {y:.1f}H{x1}" stroke="#e3e6ea"/>')
            out.append(
                f'<text x="{x0 - 5}" y="{y + 4:.1f}" text-anchor="end">10<tspan dy="-4" font-size="8">'
                f"{str(power).replace('-', chr(0x2212))}</tspan></text>"
            )
        for x in range(0, right + 1, step):
            at, _ = place(x, 1.0)
            out.append(f'<path d="M{at:.1f} {y0}v4" stroke="#33415c"/>')
            out.append(f'<text x="{at:.1f}" y="{y0 + 16}" text-anchor="middle">{x}</text>')
        out.append(f'<path d="M{x0} {y1}V{y0}H{x1}" fill="none" stroke="#33415c"/>')
        out.append(f'<text x="{(x0 + x1) / 2}" y="{y0 + 31}" text-anchor="middle">{escape(x_label)}</text>')
        out.append(
            f'<text x="{(x0 + x1) / 2}" y="18" text-anchor="middle" font-size="13" font-weight="bold">'
            f"{escape(title)}</text>"
        )
        if number == 0:
            out.append(
                f'<text transform="translate(11 {(y0 + y1) / 2}) rotate(-90)" text-anchor="middle">'
                f"{escape(y_label)}</text>"
            )
        out.append("</g>")
        for _, color, dashes, points in lines:
            seen = [place(x, y) for x, y in points if y > lowest]
            if not seen:
                continue
            path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in seen)
            stroke = f'stroke="{color}" stroke-width="1.6" stroke-dasharray="{dashes}"'
            out.append(f'<path d="{path}" fill="none" {stroke}/>')
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2.3" fill="{color}"/>' for x, y in seen]
    at = LEFT
    for name, color, dashes, _ in panels[0][1]:
        out.append(
            f'<path d="M{at} {HEIGHT + 14}h26" stroke="{color}" stroke-width="1.8" stroke-dasharray="{dashes}"/>'
            f'<text x="{at + 32}" y="{HEIGHT + 18}" {FONT} font-size="12" fill="#33415c">{escape(name)}</text>'
        )
        at += 60 + 7 * len(name)
    return "\n".join([*out, "</svg>\n"])
