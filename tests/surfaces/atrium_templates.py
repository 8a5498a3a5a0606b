# SPDX-License-Identifier: GPL-3.0-or-later
"""An atrium made by script, a body with five tubes, and templates for its circles, from mild to hard."""

import sys
import time
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "build" / "python"))

import koebe  # noqa: E402

# Direction, angular radius, length and name of each tube. The last one, the valve, is the outer rim.
TUBES = [
    ((0.75, 0.25, 0.62), 0.24, 0.9, "LSPV"), ((0.85, 0.2, -0.25), 0.22, 0.7, "LIPV"),
    ((-0.75, 0.25, 0.62), 0.26, 0.8, "RSPV"), ((-0.85, 0.2, -0.25), 0.2, 0.6, "RIPV"),
    ((0.1, -0.75, -0.75), 0.55, 0.15, "valve"),
]  # fmt: skip
# As seen from outside: a mirrored template would turn the surface inside out between the tubes.
TEMPLATE = {"LSPV": ((-0.45, 0.35), 0.17), "LIPV": ((-0.45, -0.25), 0.17),
            "RSPV": ((0.45, 0.35), 0.17), "RIPV": ((0.45, -0.25), 0.17)}  # fmt: skip


def ball(level):
    """An icosahedron with each face cut in four, level times, on the unit sphere."""
    g = (1 + 5**0.5) / 2
    corners = [(s * a, t * b, 0.0) for a, b in ((1.0, g),) for s in (1, -1) for t in (1, -1)]
    points = np.array([np.roll(c, k) for c in corners for k in range(3)])
    near = np.linalg.norm(points[:, None] - points[None], axis=2) < 2.1
    triples = ((a, b, c) for a in range(12) for b in range(a) for c in range(b))
    faces = [(a, b, c) for a, b, c in triples if near[a, b] and near[b, c] and near[a, c]]
    faces = [f if np.linalg.det(points[list(f)]) > 0 else f[::-1] for f in faces]
    points, faces = points / np.linalg.norm(points[0]), np.array(faces)
    for _ in range(level):
        ends = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        edges, number = np.unique(ends, axis=0, return_inverse=True)
        a, b, c = len(points) + number.reshape(3, -1)
        middle = points[edges].sum(axis=1)
        points = np.concatenate([points, middle / np.linalg.norm(middle, axis=1, keepdims=True)])
        x, y, z = faces.T
        faces = np.concatenate([np.stack(f, axis=1) for f in ((x, a, c), (a, y, b), (c, b, z), (a, b, c))])
    return points, faces


def atrium(level=4):
    """Vertices, triangles, and for each tube the vertices of its rim."""
    points, faces = ball(level)
    edge = np.linalg.norm(points[faces[0, 0]] - points[faces[0, 1]])
    rims = []
    for direction, radius, length, _ in TUBES:
        axis = np.array(direction) / np.linalg.norm(direction)
        angle = np.arccos(np.clip(points @ axis / np.linalg.norm(points, axis=1), -1, 1))
        near = (angle < radius) & (np.abs(np.linalg.norm(points, axis=1) - 1) < 1e-9)
        faces = faces[~near[faces].any(axis=1)]
        loop = min(koebe.boundary_loops(compact(points, faces)[1]), key=lambda v: angle[np.unique(faces)[v]].mean())
        loop = np.unique(faces)[loop]
        side = points[loop] - np.outer(points[loop] @ axis, axis)
        side /= np.linalg.norm(side, axis=1, keepdims=True)
        points[loop] = np.cos(radius + edge / 2) * axis + np.sin(radius + edge / 2) * side
        for ring in range(1, max(1, round(length / edge)) + 1):
            rim = points[loop] + edge * axis
            arm = rim - rim.mean(axis=0)
            rim -= 0.3 * edge / ring * arm / np.linalg.norm(arm, axis=1)[:, None]
            fresh = len(points) + np.arange(len(loop))
            points = np.concatenate([points, rim])
            after, ahead = np.roll(loop, -1), np.roll(fresh, -1)
            # The loop has the surface on its left.
            faces = np.concatenate([faces, np.stack([after, loop, fresh], 1), np.stack([after, fresh, ahead], 1)])
            loop = fresh
        rims.append(loop)
    number = np.full(len(points), -1)
    number[np.unique(faces)] = np.arange(len(np.unique(faces)))
    points, faces = compact(points, faces)
    points = points * np.array([1.25, 0.9, 1.0])
    return points, faces, [number[rim] for rim in rims]


def compact(points, faces):
    used, numbers = np.unique(faces, return_inverse=True)
    return points[used], numbers.reshape(-1, 3).astype(np.int32)


def surface(level=4):
    """The atrium, the numbers of its loops in the order of the tubes, and its conformal map with the valve outside."""
    vertices, faces, rims = atrium(level)
    loops = koebe.boundary_loops(faces)
    ranks = [next(k for k, loop in enumerate(loops) if rim[0] in loop) for rim in rims]
    conformal = koebe.uniformize(vertices, faces, outer=int(rims[-1][0]))
    own = [next(k for k, loop in enumerate(conformal.loops) if rim[0] in loop) for rim in rims[:-1]]
    return (vertices, faces), ranks[:-1], conformal.centers[own], conformal.radii[own]


def square(radius, reach=0.5):
    angles = np.radians([45, 135, 225, 315])
    return reach * np.column_stack([np.cos(angles), np.sin(angles)]), np.full(4, radius)


def row(gap):
    radius = (2 - 5 * gap) / 8
    places = -1 + gap + radius + (2 * radius + gap) * np.arange(4)
    return np.column_stack([places, np.zeros(4)])[[3, 2, 0, 1]], np.full(4, radius)


# Each makes centres and radii from the conformal ones, and tells which circle each vein goes to.
TEMPLATES = {
    "the picture's": lambda c, r: (*zip(*TEMPLATE.values(), strict=True), [0, 1, 2, 3]),
    "own circles, radii times 2": lambda c, r: (c, 2 * r, [0, 1, 2, 3]),
    "own circles, radii times 10": lambda c, r: (c, 10 * r, [0, 1, 2, 3]),
    "own circles, radii over 10": lambda c, r: (c, r / 10, [0, 1, 2, 3]),
    "a square of four, radius 0.3": lambda c, r: (*square(0.3), [0, 3, 1, 2]),
    "a square of four, gaps 0.02": lambda c, r: (*square(0.343, 0.5), [0, 3, 1, 2]),
    "four in a row, gaps 0.05": lambda c, r: (*row(0.05), [0, 1, 2, 3]),
    "one vein of radius 0.7, three of 0.05": lambda c, r: (
        [[0.2, 0], [-0.8, 0], [-0.65, 0.45], [-0.65, -0.45]], [0.7, 0.05, 0.05, 0.05], [0, 2, 1, 3]
    ),
    "all circles swapped": lambda c, r: (c, r, [3, 2, 1, 0]),
    "all circles one further, radii times 3": lambda c, r: (c, 3 * r, [1, 2, 3, 0]),
    "two circles meet": lambda c, r: ([[0, 0], [0.3, 0], [-0.5, 0], [0, 0.6]], [0.2] * 4, [0, 1, 2, 3]),
}  # fmt: skip
HEAD = ["template", "mean µ", "largest µ", "largest K", "path", "flipped", "seconds"]


def cells(name):
    """A row of the table in docs/fit.md."""
    mesh, ranks, centers, radii = surface()
    places, sizes, order = TEMPLATES[name](centers, radii)
    begin = time.perf_counter()
    try:
        fit = koebe.fit_circles(mesh, places, sizes, [ranks[k] for k in order])
    except (koebe.InputError, koebe.SolverError) as error:
        return [type(error).__name__, "", "", "", "", f"{time.perf_counter() - begin:.1f}"]
    mu = fit.fit["mu"]
    return [
        f"{mu['mean']:.2f}", f"{mu['max']:.2f}", f"{mu['dilatation']:.1f}", fit.fit["path"], str(fit.flipped),
        f"{time.perf_counter() - begin:.1f}",
    ]  # fmt: skip


if __name__ == "__main__":
    for one in TEMPLATES:
        print(one, "|", " | ".join(cells(one)), flush=True)
