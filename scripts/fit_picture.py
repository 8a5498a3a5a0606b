# SPDX-License-Identifier: GPL-3.0-or-later
"""docs/images/fit.png: an atrium made here, its conformal circle domain, and its map to a template.

PYTHONPATH=build/python build/venv-labs/bin/python scripts/fit_picture.py
"""

from pathlib import Path

import koebe
import matplotlib
import numpy as np
from koebe._plot import _in_pieces
from PIL import Image

matplotlib.use("agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.collections import PolyCollection  # noqa: E402

ROOT = Path(__file__).resolve().parents[1]
# Direction, angular radius, length and name of each tube. The last one, the valve, is the outer rim.
TUBES = [
    ((0.75, 0.25, 0.62), 0.24, 0.9, "LSPV"), ((0.85, 0.2, -0.25), 0.22, 0.7, "LIPV"),
    ((-0.75, 0.25, 0.62), 0.26, 0.8, "RSPV"), ((-0.85, 0.2, -0.25), 0.2, 0.6, "RIPV"),
    ((0.1, -0.75, -0.75), 0.55, 0.15, "valve"),
]  # fmt: skip
# As seen from outside: a mirrored template would turn the surface inside out between the tubes.
TEMPLATE = {"LSPV": ((-0.45, 0.35), 0.17), "LIPV": ((-0.45, -0.25), 0.17),
            "RSPV": ((0.45, 0.35), 0.17), "RIPV": ((0.45, -0.25), 0.17)}  # fmt: skip
SQUARE = 0.12  # of the checker, in the disk
INK = np.array([[0.93, 0.95, 0.98], [0.25, 0.45, 0.65]])


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


def squares(uv):
    dark = np.floor((uv + 3) / SQUARE).astype(int).sum(axis=1) % 2
    return INK[dark]


def draw_surface(axes, vertices, faces, uv):
    pieces = _in_pieces(np.concatenate([vertices, uv], axis=1)[faces], 4)
    corners = pieces[:, :, :3]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    order = np.argsort(corners[:, :, 1].mean(axis=1))  # seen from +y, the back of the atrium
    shade = (0.55 + 0.45 * np.abs(normal @ np.array([-0.3, 0.8, 0.52])))[:, None]
    color = np.clip(squares(pieces[:, :, 3:].mean(axis=1)) * shade, 0, 1)[order]
    flat = corners[order][:, :, [0, 2]] * np.array([-1, 1])
    axes.add_collection(PolyCollection(flat, facecolors=color, edgecolors=color, linewidths=0.2))
    axes.set(xlim=(-2.4, 2.4), ylim=(-2.0, 2.2), aspect="equal")


def draw_domain(axes, faces, uv, names, centers):
    pieces = _in_pieces(uv[faces], 4)
    color = squares(pieces.mean(axis=1))
    axes.add_collection(PolyCollection(pieces, facecolors=color, edgecolors=color, linewidths=0.2))
    for name, (x, y) in zip(names, centers, strict=True):
        axes.text(x, y, name, ha="center", va="center", fontsize=7)
    axes.set(xlim=(-1.05, 1.05), ylim=(-1.05, 1.05), aspect="equal")


def main():
    vertices, faces, rims = atrium()
    loops = koebe.boundary_loops(faces)
    names = list(TEMPLATE)
    ranks = [next(k for k, loop in enumerate(loops) if rims[i][0] in loop) for i in range(len(names))]
    centers, radii = zip(*TEMPLATE.values(), strict=True)
    fit = koebe.fit_circles((vertices, faces), centers, radii, ranks, names=names)
    conformal = koebe.uniformize(vertices, faces, outer=int(fit.loops[0][0]))
    own = [next(k for k, loop in enumerate(conformal.loops) if rims[i][0] in loop) for i in range(len(names))]
    print(fit, fit.fit, [f"{conformal.radii[k]:.3g}" for k in own])
    figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6), layout="constrained")
    draw_surface(axes[0], vertices, faces, fit.uv)
    draw_domain(axes[1], faces, conformal.uv, names, conformal.centers[own])
    draw_domain(axes[2], faces, fit.uv, names, fit.centers[1:])
    for axis, title in zip(axes, ("the surface", "its conformal circles", "the template"), strict=True):
        axis.set_title(title, fontsize=9, pad=8)
        axis.set_axis_off()
    path = ROOT / "docs/images/fit.png"
    figure.savefig(path, dpi=100)
    Image.open(path).convert("RGB").quantize(48).save(path, optimize=True)


if __name__ == "__main__":
    main()
