"""Makes docs/link.obj, a link of a chain: a small surface with one handle and no hole, for examples.

    python3 scripts/link.py [OUT.obj]
"""

import sys
from math import cos, pi, sin
from pathlib import Path

AROUND, ACROSS = 32, 16  # vertices round the link and round its rod
LONG, WIDE, ROD = 1.5, 1.2, 0.6  # half axes of the middle line, radius of the rod


def main():
    lines = ["# a link of a chain, made by scripts/link.py", "o link"]
    for k in range(AROUND):
        a = 2.0 * pi * k / AROUND
        # The normal of the ellipse, in its plane.
        x, y = WIDE * cos(a), LONG * sin(a)
        size = (x * x + y * y) ** 0.5
        for m in range(ACROSS):
            t = 2.0 * pi * m / ACROSS
            out = ROD * cos(t) / size
            lines.append(f"v {LONG * cos(a) + out * x:.5f} {WIDE * sin(a) + out * y:.5f} {ROD * sin(t):.5f}")
    for k in range(AROUND):
        for m in range(ACROSS):
            a, b = k * ACROSS, (k + 1) % AROUND * ACROSS
            n = (m + 1) % ACROSS
            lines.append(f"f {a + m + 1} {b + m + 1} {b + n + 1} {a + n + 1}")
    path = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parents[1] / "docs" / "link.obj"
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


if __name__ == "__main__":
    main()
