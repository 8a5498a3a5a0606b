#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Six surfaces with exactly the holes, vertices, faces and boundary vertices of the paper's Table 1.

    bench/table_surfaces.py [FOLDER]        default: out/reproduce/surfaces

Masks of the face in blend_samples/face_surface.py: eyes, mouth, brows and piercings, as many as the table has holes.
The paper's own scans are not public. The boundary vertices are spread over the loops first, so they come out exactly; a
planar mesh of a few vertices too many is made between them in the face's chart (bench/planar_mesher.cpp), lifted,
brought to the exact number, and made even (bench/even_mesh.py). Faces then follow from Euler's formula. A few minutes
for all six.
"""

import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")  # more threads only wait for each other in such small products

import numpy as np  # noqa: E402

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "bench"), str(ROOT / "blend_samples")]

import even_mesh  # noqa: E402
import face_surface  # noqa: E402
from printed import TABLE_1  # noqa: E402

MESHER = ROOT / "build" / "bench" / "planar_mesher"
FOLDER = ROOT / "out" / "reproduce" / "surfaces"
ROUNDS = 24
FINE = 1000  # samples of a curve
FEWEST = 12  # vertices of a loop
# How much longer than a hole's edges those of a loop ten times its length may be: the counts go as length ** SHARE.
SHARE = 0.8


@dataclass(frozen=True)
class Curve:
    """A closed curve in the face's chart, radians as seen from within the head: an ellipse with half axes `axes` whose
    upper and lower halves meet in corners (sharp > 0), bent by `bend` along its length, turned by `turn` degrees."""

    center: tuple[float, float]
    axes: tuple[float, float]
    sharp: float = 0.0
    bend: float = 0.0
    turn: float = 0.0

    def points(self, count=FINE):
        t = np.arange(count) * 2 * np.pi / count
        x = np.cos(t)
        y = np.sin(t) * np.abs(np.sin(t)) ** self.sharp
        q = np.column_stack([self.axes[0] * x, self.axes[1] * y + self.bend * (1 - x**2)])
        c, s = np.cos(np.radians(self.turn)), np.sin(np.radians(self.turn))
        return np.array(self.center) + q @ np.array([[c, s], [-s, c]])


def both(x, y, axes, sharp=0.0, bend=0.0, turn=0.0):
    """A curve and its mirror image."""
    return [Curve((x, y), axes, sharp, bend, turn), Curve((-x, y), axes, sharp, bend, -turn)]


OUTLINE = Curve((0.0, -0.14), (1.12, 1.06))
EYES = both(0.31, 0.0, (0.17, 0.075), 0.25, 0.0, 4.0)
MOUTH = [Curve((0.0, -0.60), (0.25, 0.075), 0.3, 0.02)]
BROWS = both(0.34, 0.23, (0.17, 0.028), 0.0, 0.035, -8.0)
CHEEKS = both(0.52, -0.38, (0.07, 0.07))
FOREHEAD = [Curve((0.0, 0.50), (0.09, 0.09)), *both(0.33, 0.50, (0.06, 0.06))]
TEMPLES = both(0.70, 0.05, (0.05, 0.09), 0.0, 0.0, -12.0)
JAW = both(0.50, -0.72, (0.06, 0.06))
CHIN = [Curve((0.0, -0.80), (0.09, 0.035))]
HOLES = {
    3: MOUTH + EYES,
    5: MOUTH + EYES + BROWS,
    9: MOUTH + EYES + BROWS + CHEEKS + TEMPLES,
    15: MOUTH + EYES + BROWS + CHEEKS + TEMPLES + FOREHEAD + JAW + CHIN,
}


def shares(lengths, total):
    """Whole numbers that sum to `total`, in proportion to length ** SHARE, none below FEWEST: largest remainders."""
    weight = np.asarray(lengths) ** SHARE
    exact = FEWEST + (total - FEWEST * len(weight)) * weight / weight.sum()
    counts = np.floor(exact).astype(int)
    for k in np.argsort(counts - exact, kind="stable")[: total - counts.sum()]:
        counts[k] += 1
    return counts


def evenly(curve, count):
    """So many points of the chart on the curve, equally far apart along it on the face."""
    dense = curve.points()
    lifted = face_surface.lift(dense)
    steps = np.linalg.norm(np.roll(lifted, -1, axis=0) - lifted, axis=1)
    at = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.arange(count) * at[-1] / count
    closed = np.vstack([dense, dense[:1]])
    return np.column_stack([np.interp(wanted, at, closed[:, k]) for k in range(2)])


def length_on_face(curve):
    lifted = face_surface.lift(curve.points())
    return np.linalg.norm(np.roll(lifted, -1, axis=0) - lifted, axis=1).sum()


def planar_mesh(polygons, vertices):
    """Points (V, 2), the polygons' first, and triangles (F, 3); V at least `vertices`."""
    text = json.dumps([polygon.tolist() for polygon in polygons])
    done = subprocess.run([MESHER, str(vertices)], input=text, capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"planar_mesher: {done.stderr.strip()}")
    mesh = json.loads(done.stdout)
    return np.array(mesh["points"]), np.array(mesh["triangles"])


def make(holes, vertices, boundary, rounds=ROUNDS):
    """A mask with so many holes, vertices and boundary vertices: points (V, 3) and triangles (F, 3), counter-clockwise
    from ahead."""
    return between([OUTLINE, *HOLES[holes]], vertices, boundary, rounds)


def between(curves, vertices, boundary, rounds=ROUNDS):
    """The same between any curves, the first around the others."""
    counts = shares([length_on_face(curve) for curve in curves], boundary)
    plane, triangles = planar_mesh([evenly(curve, count) for curve, count in zip(curves, counts)], vertices)
    points = face_surface.lift(plane)
    triangles = even_mesh.flipped_to_delaunay(points, triangles)
    points, triangles = even_mesh.fewer(points, triangles, len(points) - vertices)
    return even_mesh.relaxed(points, triangles, lambda p: face_surface.project(p, 1), rounds)


def write_obj(path, points, triangles):
    lines = ["v {:.6f} {:.6f} {:.6f}".format(*p) for p in points]
    lines += ["f {} {} {}".format(*(t + 1)) for t in triangles]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def read_obj(path):
    """Points (V, 3) and triangles (F, 3) of a file that write_obj wrote."""
    words = [line.split() for line in path.read_text(encoding="ascii").splitlines()]
    points = np.array([line[1:] for line in words if line[0] == "v"], float)
    return points, np.array([line[1:] for line in words if line[0] == "f"], np.int32) - 1


def file_of(row, folder=FOLDER):
    """The surface for a row of Table 1, made unless it is there and newer than what makes it."""
    path = folder / f"{row.figure.lower().replace('. ', '_')}.obj"
    makers = [Path(__file__), ROOT / "bench" / "even_mesh.py", ROOT / "blend_samples" / "face_surface.py"]
    if not path.exists() or path.stat().st_mtime < max(maker.stat().st_mtime for maker in makers):
        folder.mkdir(parents=True, exist_ok=True)
        write_obj(path, *make(row.holes, row.vertices, row.boundary))
    return path


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else FOLDER
    for row in TABLE_1:
        print(file_of(row, folder), flush=True)


if __name__ == "__main__":
    main()
