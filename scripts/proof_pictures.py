# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/proof.md: docs/images/proof_levels.svg, the copies of a circle domain that the map has reached
after some steps, by the words of the page's Lemma 1; proof_collars.svg, the collars of Lemma 2; and proof_errors.svg,
the errors of four orders of the steps against the number of factorizations. Only that needs build/bench/koebe_rates.

    scripts/proof_pictures.py [FOLDER]        default: docs/images
"""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import convergence  # noqa: E402
from log_plot import log_plot  # noqa: E402

INK, PAPER, UNKNOWN = "#1b2a41", "#f7f2e8", "#ffffff"
LEVELS = ("#e08a78", "#7fb492", "#86a8d6", "#c9b6de", "#d9d3c4")  # by level: red, green, blue, and deeper ones
CIRCLES = ((-0.5 + 0.5j, 0.45), (0.5 + 0.5j, 0.4), (0.47 - 0.5j, 0.46), (-0.5 - 0.5j, 0.42))
DEPTH = 5  # of the words that are drawn
SIZE, HALF, GAP, CAPTION = 200, 1.02, 14, 24
LEAST = 0.35  # units of the picture: smaller circles are not drawn

Words = dict[int, set[tuple[int, ...]]]  # by loop: the copies beyond it that the map has reached


def alternating(first: int, opened: tuple[int, ...], depth: int) -> list[tuple[int, ...]]:
    """Words that begin with `first` and alternate between the opened loops."""
    other = next((k for k in opened if k != first), None)
    longest = depth if other is not None else 1
    return [tuple(first if i % 2 == 0 else other for i in range(length)) for length in range(1, longest + 1)]


def opened(words: Words, loops: tuple[int, ...], depth: int) -> Words:
    """The words of the loops that a step opens, after it."""
    filled = {(), *(word for k, own in words.items() if k not in loops for word in own)}
    return {k: {u + w for u in alternating(k, loops, depth) for w in filled if len(u) + len(w) <= depth} for k in loops}


def after_step(words: Words, loops: tuple[int, ...], depth: int = DEPTH) -> Words:
    return words | opened(words, loops, depth)


def after_sweep_at_once(words: Words, depth: int = DEPTH) -> Words:
    """Each inner loop against loop 0, from the same state; then loop 0."""
    new = dict(words)
    for k in range(1, len(words)):
        new[k] = opened(words, (0, k), depth)[k]
    return new | {0: opened(new, (0, 1), depth)[0]}


def level(words: Words, depth: int = DEPTH) -> int:
    """The largest m for which all words of up to m letters are reached."""
    n = len(words)
    reached = {word for own in words.values() for word in own}
    m = 0
    while m < depth and sum(len(word) == m + 1 for word in reached) == n * (n - 1) ** m:
        m += 1
    return m


def start(n: int) -> Words:
    return {k: set() for k in range(n)}


# ---------------------------------------------------------------- the picture of the levels


def reflected(circle, mirror):
    (center, radius), (middle, size) = circle, mirror
    away = center - middle
    scale = size**2 / (abs(away) ** 2 - radius**2)
    return middle + scale * away, abs(scale) * radius


def circle_of(word):
    """What a copy fills, with the copies in its holes."""
    circle = CIRCLES[word[-1]]
    for k in reversed(word[:-1]):
        circle = reflected(circle, CIRCLES[k])
    return circle


def drawn(circle, at, fill, width):
    (center, radius), scale = circle, SIZE / (2 * HALF)
    if radius * scale < LEAST:
        return ""
    x, y = at[0] + SIZE / 2 + scale * center.real, at[1] + SIZE / 2 - scale * center.imag
    place = f'cx="{x:.1f}" cy="{y:.1f}" r="{radius * scale:.1f}"'
    return f'<circle {place} fill="{fill}" stroke="{INK}" stroke-width="{width}"/>'


def frame(at, words, last, caption):
    parts = [f'<rect x="{at[0]}" y="{at[1]}" width="{SIZE}" height="{SIZE}" fill="{PAPER}"/>']
    parts += [drawn(circle, at, UNKNOWN, 1) for circle in CIRCLES]
    for word in sorted((word for own in words.values() for word in own), key=lambda word: (len(word), word)):
        parts.append(drawn(circle_of(word), at, LEVELS[len(word) - 1], 0.6))
        parts += [drawn(circle_of(word + (k,)), at, UNKNOWN, 0.4) for k in range(len(CIRCLES)) if k != word[-1]]
    parts += [drawn(CIRCLES[k], at, "none", 3 if k in last else 1) for k in range(len(CIRCLES))]
    parts.append(
        f'<text x="{at[0] + SIZE / 2}" y="{at[1] + SIZE + 16}" font-family="Georgia, \'DejaVu Serif\', serif" '
        f'font-size="13" fill="{INK}" text-anchor="middle">{caption}</text>'
    )
    return parts


def levels_picture():
    """Two states of four orders."""
    columns = []
    for name, steps in (("CK", [(0,), (1,)]), ("first", [(0, 1), (0, 2)]), ("GK", [(0, 1), (2, 3)])):
        words, column = start(len(CIRCLES)), []
        for number, loops in enumerate(steps, 1):
            words = after_step(words, loops)
            column.append((words, loops, f"{name}, {number} step{'s' * (number > 1)}"))
        columns.append(column)
    words, column = start(len(CIRCLES)), []
    for number in (1, 2):
        words = after_sweep_at_once(words)
        column.append((words, range(len(CIRCLES)), f"at once, {number} sweep{'s' * (number > 1)}"))
    columns.append(column)
    width, height = len(columns) * (SIZE + GAP) + GAP, 2 * (SIZE + CAPTION + GAP)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}">',
        '<rect width="100%" height="100%" fill="#ffffff"/>',
    ]
    for x, column in enumerate(columns):
        for y, (words, last, caption) in enumerate(column):
            parts += frame((GAP + x * (SIZE + GAP), GAP / 2 + y * (SIZE + CAPTION + GAP)), words, last, caption)
    return "\n".join([*filter(None, parts), "</svg>\n"])


# ---------------------------------------------------------------- the picture of the collars

OUTER, INNER = "#e08a78", "#86a8d6"


def collar_edge(word, size):
    """The circle of the last letter, larger by a factor, after the mirrors of the letters before."""
    circle = (CIRCLES[word[-1]][0], CIRCLES[word[-1]][1] * size)
    for k in reversed(word[:-1]):
        circle = reflected(circle, CIRCLES[k])
    return circle


def collars_picture():
    """Outer and inner collars of words of one letter and two, as wide as P1 allows."""
    n = len(CIRCLES)
    width = min(abs(c - d) / (r + s) for k, (c, r) in enumerate(CIRCLES) for d, s in CIRCLES[:k])
    size = 2 * (SIZE + GAP)
    frame_scale = (size - 2 * GAP) / SIZE
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{size}" height="{size}" viewBox="0 0 {size} {size}">',
        f'<rect width="100%" height="100%" fill="{PAPER}"/>',
        f'<g transform="translate({GAP} {GAP}) scale({frame_scale:.3f})">',
    ]
    for word in [*((k,) for k in range(n)), *((j, k) for j in range(n) for k in range(n) if j != k)]:
        for edge, fill in ((width, OUTER), (1.0, INNER), (1.0 / width, PAPER)):
            parts.append(drawn(collar_edge(word, edge), (0, 0), fill, 0.8 if edge == 1.0 else 0.2))
    return "\n".join([*filter(None, parts), "</g></svg>\n"])


# ---------------------------------------------------------------- the picture of the errors

ORDERS = {
    "ck": ("CK", "#c8553d"), "against-outer": ("first", "#7a4f9c"), "gk": ("GK", "#2a7f9e"),
    "at-once": ("at once", "#1b2a41"),
}  # fmt: skip
FACES, FLOOR, MOST = 8000, 1e-12, 64


def errors(domain, order):
    """(factorizations, error): a step in turn costs one, and so does a sweep at once."""
    command = [convergence.RATES, "steps", domain, str(FACES), "condensed", order]
    report = json.loads(subprocess.run(command, capture_output=True, text=True, check=True).stdout)
    steps = report["steps"]
    if order == "at-once":
        steps = steps[report["steps_per_sweep"] - 1 :: report["steps_per_sweep"]]
    found = [(number, step["error"]) for number, step in enumerate(steps, 1) if number <= MOST]
    return found[: next((k for k, (_, error) in enumerate(found) if error <= FLOOR), len(found))]


def errors_picture():
    panels = [
        (title, [(name, color, "", errors(domain, order)) for order, (name, color) in ORDERS.items()])
        for domain, title in convergence.DOMAINS.items()
    ]
    return log_plot(panels, "factorizations", "relative error of the circles", lowest=FLOOR)


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "images"
    (folder / "proof_levels.svg").write_text(levels_picture(), encoding="utf-8")
    (folder / "proof_collars.svg").write_text(collars_picture(), encoding="utf-8")
    (folder / "proof_errors.svg").write_text(errors_picture(), encoding="utf-8")


if __name__ == "__main__":
    main()
