# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/benchmarks.md: speed.svg, the stages of the commands `koebe sphere` and `koebe uniformize` by
size, with the page's figures, which are printed; and speed_peer.svg, time and memory of `koebe uniformize` and of
boundary-first flattening, from docs/data/speed_peer.csv. That is measured anew where the peer's source is (see
bench/against_bff.py). NumPy and the command.

    scripts/speed_picture.py [FOLDER]        default: docs/images

A ball with waves is mapped whole, and with a cap and three holes cut out. The command runs on one thread, file to file,
several times, and the run with the least time counts.
"""

import csv
import json
import math
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import against_bff  # noqa: E402
from atrium_templates import ball, compact  # noqa: E402

LEVELS, RUNS, FACES = (4, 5, 6, 7), 3, 200_000  # at least so many runs, and so many faces in all runs
STAGES = {
    "read and write": "#d9d3c4", "order and topology": "#c9b6de", "metric": "#86a8d6",
    "factorizations": "#1b2a41", "iteration": "#7fb492", "check and layout": "#e08a78",
}  # fmt: skip
PEER_LEVELS, PEER_TABLE = (3, 4, 5, 6, 7), ROOT / "docs" / "data" / "speed_peer.csv"
PEER_HEAD = ("faces", "koebe s", "peer s", "koebe MB", "peer MB")
HOLES = (((0.0, 0.0, 1.0), 0.7), ((0.9, 0.0, -0.2), 0.3), ((-0.5, 0.8, -0.3), 0.25), ((-0.3, -0.8, -0.5), 0.2))
PEER_COLORS = {"koebe uniformize": "#1b2a41", "boundary-first flattening": "#e08a78"}
WIDTH, HEIGHT, LEFT, TOP, BAR, INK = 400, 210, 46, 34, 46, "#33415c"
FONT = 'font-family="Helvetica, Arial, sans-serif"'


def surface(level, holes):
    """Vertices and faces of a ball with waves, without the faces in the holes."""
    points, faces = ball(level)
    for direction, radius in holes:
        axis = np.array(direction) / np.linalg.norm(direction)
        faces = faces[~(points[faces] @ axis > np.cos(radius)).all(axis=1)]
    used, faces = compact(points, faces)
    waves = np.sin(used @ [[3.0, 1.0, -2.0], [-1.0, 4.0, 1.0], [2.0, -1.0, 3.0]])
    return used * np.exp(0.1 * waves.sum(axis=1))[:, None], faces


def stages_of(command, path, out, faces):
    """Seconds of the stages in the run with the least total, and the least processor seconds."""
    seconds, processor = [], []
    for _ in range(max(RUNS, FACES // faces)):
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        words = [ROOT / "build" / "koebe", command, path, out / "out.obj", "--json", out / "out.json", "--quiet"]
        subprocess.run([*words, "--threads", "1"], check=True)
        processor.append(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before)
        seconds.append(json.loads((out / "out.json").read_text())["seconds"])
    best = min(seconds, key=lambda run: run["total"])
    named = [best["read"] + best["write"], 0.0, best["metric"], best["factor"], best["iterate"], best["finish"]]
    named[1] = best["total"] - sum(named)  # topology, and the order of vertices and faces, which has no figure
    return dict(zip(STAGES, named, strict=True)), min(processor)


def write_obj(path, vertices, faces):
    lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices]
    lines += [f"f {a} {b} {c}" for a, b, c in faces + 1]
    path.write_text("\n".join(lines) + "\n")


def measured():
    """For both commands rows of (faces, seconds of the stages). Prints the table."""
    rows = {"sphere": [], "uniformize": []}
    print("| command | faces | processor seconds | µs a face |\n| --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for command, found in rows.items():
            for level in LEVELS:
                vertices, faces = surface(level, HOLES if command == "uniformize" else ())
                write_obj(folder / "in.obj", vertices, faces)
                stages, processor = stages_of(command, folder / "in.obj", folder, len(faces))
                found.append((len(faces), stages))
                each = 1e6 * processor / len(faces)
                print(f"| `{command}` | {len(faces):,} | {processor:.2f} | {each:.1f} |", flush=True)
    return rows


def picture(rows):
    """A panel for each command: a bar for each size, divided by the shares of the stages."""
    low, total = TOP + HEIGHT, WIDTH * len(rows)
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total} {low + 62}" width="{total}">',
        f'<rect width="{total}" height="{low + 62}" fill="#ffffff"/><g {FONT} font-size="11" fill="{INK}">',
    ]
    for panel, (command, found) in enumerate(rows.items()):
        left = panel * WIDTH + LEFT
        out.append(
            f'<text x="{left + WIDTH / 2 - LEFT}" y="20" text-anchor="middle" font-size="13" font-weight="bold">'
            f"koebe {command}</text>"
        )
        for share in (0, 25, 50, 75, 100):
            y = low - HEIGHT * share / 100
            out.append(f'<path d="M{left} {y}H{left + WIDTH - LEFT - 10}" stroke="#e3e6ea"/>')
            out.append(f'<text x="{left - 5}" y="{y + 4}" text-anchor="end">{share} %</text>')
        for number, (faces, stages) in enumerate(found):
            x, y, whole = left + 14 + number * (BAR + 20), float(low), sum(stages.values())
            for name, color in STAGES.items():
                height = HEIGHT * stages[name] / whole
                y -= height
                out.append(f'<rect x="{x}" y="{y:.1f}" width="{BAR}" height="{height:.1f}" fill="{color}"/>')
            out.append(f'<text x="{x + BAR / 2}" y="{low + 16}" text-anchor="middle">{faces:,}</text>')
        out.append(f'<text x="{left + WIDTH / 2 - LEFT}" y="{low + 32}" text-anchor="middle">faces</text>')
    x = LEFT
    for name, color in STAGES.items():
        out.append(f'<rect x="{x}" y="{low + 42}" width="12" height="12" fill="{color}"/>')
        out.append(f'<text x="{x + 17}" y="{low + 52}">{name}</text>')
        x += 40 + 6 * len(name)
    return "\n".join([*out, "</g></svg>\n"])


def measure_peer(peer):
    """Writes the table: the least costs of runs in turn, file to file. A run counts this script's memory at its start:
    a cell with hardly more stays empty."""
    own = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1000
    with tempfile.TemporaryDirectory() as name, PEER_TABLE.open("w", newline="", encoding="utf-8") as table:
        folder, writer = Path(name), csv.writer(table, lineterminator="\n")
        writer.writerow(PEER_HEAD)
        ours = [ROOT / "build" / "koebe", "uniformize", folder / "in.obj", folder / "out.obj", "--quiet"]
        for level in PEER_LEVELS:
            vertices, faces = surface(level, HOLES)
            write_obj(folder / "in.obj", vertices, faces)
            commands = ours + ["--threads", "1"], [peer, folder / "in.obj", folder / "out.obj"]
            runs = [[against_bff.cost(*words) for words in commands] for _ in range(RUNS)]
            times, sizes = ([min(run[c][k] for run in runs) for c in (0, 1)] for k in (0, 1))
            writer.writerow(
                [len(faces), *(f"{t:.3g}" for t in times), *(f"{m:.0f}" if m > 1.2 * own else "" for m in sizes)]
            )
            table.flush()


def peer_picture(rows):
    """Two panels, both axes logarithmic: processor seconds, and memory, by faces."""
    low = TOP + HEIGHT
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {2 * WIDTH} {low + 62}" width="{2 * WIDTH}">',
        f'<rect width="{2 * WIDTH}" height="{low + 62}" fill="#ffffff"/><g {FONT} font-size="11" fill="{INK}">',
    ]
    panels = (("processor seconds", 1, -3, 2), ("memory in MB", 3, 0, 5))
    for panel, (title, column, bottom, top) in enumerate(panels):
        left, right = panel * WIDTH + LEFT, (panel + 1) * WIDTH - 20

        def at(faces, value, left=left, right=right, bottom=bottom, top=top):
            across = (math.log10(faces) - 3) / 3.3
            return left + (right - left) * across, low - HEIGHT * (math.log10(value) - bottom) / (top - bottom)

        middle = (left + right) / 2
        out.append(f'<text x="{middle}" y="20" text-anchor="middle" font-size="13" font-weight="bold">{title}</text>')
        for power in range(bottom, top + 1):
            y = at(1e3, 10.0**power)[1]
            out.append(f'<path d="M{left} {y:.1f}H{right}" stroke="#e3e6ea"/>')
            out.append(f'<text x="{left - 5}" y="{y + 4:.1f}" text-anchor="end">{10.0**power:g}</text>')
        for faces in (1_000, 10_000, 100_000, 1_000_000):
            x = at(faces, 1.0)[0]
            out.append(f'<path d="M{x:.1f} {low}v4" stroke="{INK}"/>')
            out.append(f'<text x="{x:.1f}" y="{low + 17}" text-anchor="middle">{faces:,}</text>')
        out.append(f'<text x="{middle}" y="{low + 34}" text-anchor="middle">faces</text>')
        for color, c in zip(PEER_COLORS.values(), (column, column + 1), strict=True):
            points = [at(row[0], row[c]) for row in rows if row[c] > 0.0]
            line = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
            out.append(f'<path d="M{line}" fill="none" stroke="{color}" stroke-width="2"/>')
            out += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3" fill="{color}"/>' for x, y in points]
    for number, (name, color) in enumerate(PEER_COLORS.items()):
        x = LEFT + 150 * number
        out.append(f'<rect x="{x}" y="{low + 42}" width="12" height="12" fill="{color}"/>')
        out.append(f'<text x="{x + 17}" y="{low + 52}">{name}</text>')
    return "\n".join([*out, "</g></svg>\n"])


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "images"
    if peer := against_bff.built():
        measure_peer(peer)
    with PEER_TABLE.open(encoding="utf-8") as table:
        rows = [[float(cell or "nan") for cell in row] for row in list(csv.reader(table))[1:]]
    (folder / "speed_peer.svg").write_text(peer_picture(rows), encoding="utf-8")
    (folder / "speed.svg").write_text(picture(measured()), encoding="utf-8")


if __name__ == "__main__":
    main()
