# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of docs/benchmarks.md, "Where the time goes": docs/images/speed.svg, the stages of the commands
`koebe sphere` and `koebe uniformize` by size, and the table beside it, which is printed. NumPy and the command.

    scripts/speed_picture.py [FOLDER]        default: docs/images

A ball with waves is mapped whole, and with a cap and three holes cut out. The command runs on one thread, file to file,
several times, and the run with the least time counts.
"""

import json
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

from atrium_templates import ball, compact  # noqa: E402

LEVELS, RUNS, FACES = (4, 5, 6, 7), 3, 200_000  # at least so many runs, and so many faces in all runs
STAGES = {
    "read and write": "#d9d3c4", "order and topology": "#c9b6de", "metric": "#86a8d6",
    "factorizations": "#1b2a41", "iteration": "#7fb492", "check and layout": "#e08a78",
}  # fmt: skip
HOLES = (((0.0, 0.0, 1.0), 0.7), ((0.9, 0.0, -0.2), 0.3), ((-0.5, 0.8, -0.3), 0.25), ((-0.3, -0.8, -0.5), 0.2))
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


def measured():
    """For both commands rows of (faces, seconds of the stages). Prints the table."""
    rows = {"sphere": [], "uniformize": []}
    print("| command | faces | processor seconds | µs a face |\n| --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for command, found in rows.items():
            for level in LEVELS:
                vertices, faces = surface(level, HOLES if command == "uniformize" else ())
                lines = [f"v {x:.9g} {y:.9g} {z:.9g}" for x, y, z in vertices]
                lines += [f"f {a} {b} {c}" for a, b, c in faces + 1]
                (folder / "in.obj").write_text("\n".join(lines) + "\n")
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


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "docs" / "images"
    (folder / "speed.svg").write_text(picture(measured()), encoding="utf-8")


if __name__ == "__main__":
    main()
