# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/decisions.md: docs/images/decisions.svg, the way of a mesh and the decisions on it.

Standard library alone.
"""

from html import escape
from pathlib import Path

OUT = Path(__file__).resolve().parent.parent / "docs" / "images" / "decisions.svg"
INK, PAPER, STEP, NOTE, LINE = "#1b2a41", "#ffffff", "#dbe7ea", "#f4efe6", "#2a7f9e"
WIDTH, GAP, TOP, HEIGHT, ROW = 178, 24, 16, 52, 19
# (step, the decisions on it, as the page names them)
STEPS = (
    ("a file", ("a library reads numbers,", "our code reads files", "a process for each file")),
    ("canonical form", ("the map depends on", "the shape alone, not on", "the input's numbers")),
    ("factor", ("the boundary last", "CHOLMOD's analysis,", "our own numbers")),
    ("iteration", ("kernels of our own:", "the same bits on", "every processor")),
    ("last check", ("if a map fails it, a map", "that is one to one from", "the start takes its place")),
    ("UVs", ("bits and integers pack", "the parts; a file keeps", "its author's text")),
)
BESIDE = ("Blender: arrays without new memory, undo, a window that stays awake",
          "Tried and left: attempts that were given up, with figures")


def box(x, y, width, height, fill):
    place = f'x="{x}" y="{y}" width="{width}" height="{height}"'
    return f'<rect {place} rx="6" fill="{fill}" stroke="{INK}" stroke-width="1.2"/>'


def text(x, y, words, size, weight="normal"):
    return (f'<text x="{x}" y="{y}" text-anchor="middle" font-size="{size}" font-weight="{weight}" fill="{INK}">'
            f"{escape(words)}</text>")  # fmt: skip


def main():
    parts = []
    for k, (step, decisions) in enumerate(STEPS):
        x = GAP + k * (WIDTH + GAP)
        middle = x + WIDTH / 2
        parts += [box(x, TOP, WIDTH, HEIGHT, STEP), text(middle, TOP + 32, step, 17, "bold")]
        below = TOP + HEIGHT + 26
        parts.append(f'<path d="M{middle} {TOP + HEIGHT}V{below}" stroke="{INK}" stroke-dasharray="3 3"/>')
        parts.append(box(x, below, WIDTH, 24 + ROW * len(decisions), NOTE))
        parts += [text(middle, below + 25 + ROW * row, words, 13.5) for row, words in enumerate(decisions)]
        if k:
            y = TOP + HEIGHT / 2
            parts.append(f'<path d="M{x - GAP} {y}h{GAP - 7}" stroke="{LINE}" stroke-width="2.5"/>')
            parts.append(f'<path d="M{x} {y}l-9 -6v12z" fill="{LINE}"/>')
    full, y = len(STEPS) * (WIDTH + GAP) - GAP, TOP + HEIGHT + 26 + 24 + 3 * ROW + 18
    half = (full - GAP) / 2
    for k, words in enumerate(BESIDE):
        x = GAP + k * (half + GAP)
        parts += [box(x, y, half, 36, NOTE), text(x + half / 2, y + 23, words, 13.5)]
    width, height = full + 2 * GAP, y + 36 + TOP
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif">'
    OUT.write_text("\n".join([head, f'<rect width="100%" height="100%" fill="{PAPER}"/>', *parts, "</svg>", ""]),
                   encoding="utf-8")  # fmt: skip


if __name__ == "__main__":
    main()
