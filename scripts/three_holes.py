# SPDX-License-Identifier: GPL-3.0-or-later
"""The worked example: docs/three_holes.obj, a small surface with three holes; docs/three_holes.ipynb, run, with its
outputs; and docs/images/three_holes.svg, the surface and its map.

    PYTHONPATH=build/python scripts/three_holes.py [mesh]        mesh: make the surface anew too
"""

import contextlib
import io
import json
import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "bench"))

import even_mesh  # noqa: E402
import numpy as np  # noqa: E402
import strips  # noqa: E402
import table_surfaces  # noqa: E402

DOCS = ROOT / "docs"
MESH, NOTEBOOK, PICTURE = DOCS / "three_holes.obj", DOCS / "three_holes.ipynb", DOCS / "images" / "three_holes.svg"
VERTICES = 140
# Ellipses seen from above: centre, half axes, turn in degrees, vertices; by falling length.
OUTLINES = (
    (0j, 1.12, 1.0, 0, 26), (-0.5 + 0.1j, 0.25, 0.34, 15, 10), (0.3 - 0.42j, 0.36, 0.22, -12, 10),
    (0.4 + 0.45j, 0.32, 0.22, 10, 10),
)  # fmt: skip


def lifted(plane):
    x, y = plane[:, :2].T
    return np.column_stack([x, y, 0.4 * x * x - 0.2 * y * y + 0.2 * x * y])


def outline(center, a, b, turn, count):
    """Points of the plane that are equally far apart along the curve on the surface."""
    t = np.linspace(0.0, 2 * np.pi, 721)
    z = center + (a * np.cos(t) + 1j * b * np.sin(t)) * np.exp(1j * np.radians(turn))
    steps = np.linalg.norm(np.diff(lifted(np.column_stack([z.real, z.imag])), axis=0), axis=1)
    walked = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.arange(count) * walked[-1] / count
    return np.column_stack([np.interp(wanted, walked, z.real), np.interp(wanted, walked, z.imag)])


def make_mesh():
    """Points to four digits, triangles, and the loops, the surface on their left."""
    polygons = [outline(*row) for row in OUTLINES]
    points, triangles = table_surfaces.planar_mesh(polygons, VERTICES)
    points = lifted(points)
    triangles = even_mesh.flipped_to_delaunay(points, triangles)
    points, triangles = even_mesh.relaxed(points, triangles, lifted, 24)
    points = np.round(points, 4) + 0.0  # no minus zero, whose sign depends on the processor
    triangles = even_mesh.flipped_to_delaunay(points, triangles)
    first = np.cumsum([0] + [len(polygon) for polygon in polygons])
    loops = [np.arange(a, b) for a, b in zip(first, first[1:])]
    return points, triangles, [loops[0], *(np.roll(loop[::-1], 1) for loop in loops[1:])]


def obj_text(points, triangles, loops):
    lines = ["v {:.4f} {:.4f} {:.4f}".format(*point) for point in points]
    lines += ["f {} {} {}".format(*(triangle + 1)) for triangle in triangles]
    lines += ["l " + " ".join(map(str, loop + 1)) for loop in loops]
    return "\n".join(lines) + "\n"


def run(notebook):
    """What the code cells print, one after the other, in the folder of the notebook; and all their names."""
    names, printed, here = {}, [], os.getcwd()
    os.chdir(DOCS)
    try:
        for cell in notebook["cells"]:
            if cell["cell_type"] == "code":
                with contextlib.redirect_stdout(io.StringIO()) as out:
                    exec(compile("".join(cell["source"]), "docs/three_holes.ipynb", "exec"), names)
                printed.append(out.getvalue())
    finally:
        os.chdir(here)
    return printed, names


def keep(notebook, printed):
    cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    for number, (cell, text) in enumerate(zip(cells, printed), 1):
        cell["execution_count"] = number
        stream = {"name": "stdout", "output_type": "stream", "text": text.splitlines(keepends=True)}
        cell["outputs"] = [stream] if text else []


def picture(names, size=300.0):
    """The surface from above, and its map with the circles."""
    frames = []
    loops, faces, points = names["loops"], names["faces"], names["points"]
    for caption, places in (
        ("the surface, from above", points[:, :2] / np.abs(points[:, :2]).max()),
        ("its map", np.column_stack([names["uv"].real, names["uv"].imag])),
    ):
        frame, q = strips.Frame(caption, size), strips.into_frame(places, size)
        style = f'fill="{strips.PAPER}" stroke="{strips.INK}" stroke-width="4" stroke-linejoin="round"'
        frame.add(strips.path_element([q[[*face, face[0]]] for face in faces], style, 0.0))
        for rank, loop in enumerate(loops):
            style = f'fill="none" stroke="{strips.loop_color(rank)}" stroke-width="24" stroke-linejoin="round"'
            frame.add(strips.path_element([q[np.append(loop, loop[0])]], style, 0.0))
        frames.append(frame)
    turn = np.exp(1j * np.linspace(0.0, 2 * np.pi, 91))
    rings = [c + r * turn for c, r in names["circles"]]
    rings = [strips.into_frame(np.column_stack([ring.real, ring.imag]), size) for ring in rings]
    # All points: which of a circle may go is decided by rounding, which differs between processors.
    frames[1].add(strips.path_element(rings, f'fill="none" stroke="{strips.INK}" stroke-width="7"', 0.0))
    return strips.strip(frames, 2)


def main():
    if sys.argv[1:] == ["mesh"]:
        MESH.write_text(obj_text(*make_mesh()), encoding="ascii")
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    printed, names = run(notebook)
    keep(notebook, printed)
    NOTEBOOK.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    PICTURE.write_text(picture(names), encoding="utf-8")


if __name__ == "__main__":
    main()
