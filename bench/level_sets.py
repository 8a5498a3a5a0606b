# SPDX-License-Identifier: GPL-3.0-or-later
"""The paper's Figs. 6 and 7: level sets of a harmonic function and of its conjugate, on a surface and on its image."""

import math
import subprocess
from pathlib import Path

import convergence
import numpy as np

KOEBE = Path(__file__).resolve().parent.parent / "build" / "koebe"
PAPER = "#f4efe6"
WARM, COLD, EDGE = "#c8553d", "#1d5f78", "#1b2a41"


def svg(width, height, parts):
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}">'
    return "\n".join([head, f'<rect width="{width}" height="{height}" fill="#ffffff"/>', *parts, "</svg>\n"])


MOST_LEVELS = 15  # then level lines run into each other


# ---------------------------------------------------------------- level sets


def read_obj(path):
    """Vertices (V, 3), UVs (V, 2) as points of the unit disk and triangles (F, 3)."""
    rows = {"v": [], "vt": [], "f": []}
    for line in path.read_text().splitlines():
        kind, *words = line.split()
        if kind in rows:
            rows[kind].append([float(word.split("/")[0]) for word in words])
    return np.array(rows["v"]), 2.0 * np.array(rows["vt"]) - 1.0, np.array(rows["f"], int) - 1


def level_lines(values, points, triangles, step, period=None):
    """Polylines (n, 2) along which the values, linear in each triangle, are multiples of `step`; modulo `period`."""
    after = {}
    for face in triangles.tolist():
        f = values[face] / step
        if period is not None:
            f = f[0] + (f - f[0] + period / step / 2) % (period / step) - period / step / 2
        for level in range(math.ceil(f.min()), math.floor(f.max()) + 1):
            ends = []
            for a, b in ((0, 1), (1, 2), (2, 0)):
                if (f[a] < level) != (f[b] < level):
                    turn = level % round(period / step) if period else level
                    key = (min(face[a], face[b]), max(face[a], face[b]), turn)
                    t = (level - f[a]) / (f[b] - f[a])
                    ends.append((key, (1 - t) * points[face[a]] + t * points[face[b]]))
            if len(ends) == 2:
                for (key, place), (other, _) in (ends, ends[::-1]):
                    after.setdefault(key, (place, []))[1].append(other)
    return chains(after)


def chains(graph):
    """Walks over a graph of degree at most two, {key: (place, [keys])}: open ones from their ends, then closed ones."""
    lines, left = [], dict(graph)
    for key in sorted(graph, key=lambda key: len(graph[key][1])):
        if key not in left:
            continue
        line, at = [], key
        while at is not None:
            place, neighbours = left.pop(at)
            line.append(place)
            at = next((k for k in neighbours if k in left), None)
        if len(graph[key][1]) == 2:
            line.append(line[0])
        lines.append(np.array(line))
    return lines


def path_of(lines):
    """Whole tenths of a pixel, relative."""
    words = []
    for line in lines:
        q = np.rint(10 * line).astype(int)
        words.append("M{} {}l".format(*q[0]) + " ".join("{} {}".format(*d) for d in np.diff(q, axis=0)))
    return "".join(words)


def level_sets(out, holes):
    """A surface with one hole and the annulus, or without and the disk: f and its conjugate, the real and imaginary
    part of a logarithm."""
    mesh, mapped = out / "level_sets.obj", out / "level_sets_mapped.obj"
    subprocess.run([convergence.RATES, "surface", str(holes), "12000", mesh], check=True)
    subprocess.run([KOEBE, "uniformize", mesh, mapped, "--quiet"], check=True)
    points, disk, triangles = read_obj(mapped)
    z = disk @ [1.0, 1j]
    f, conjugate = -np.log(np.abs(z)), np.angle(z)
    step = 2.0 * math.pi / 36.0
    drawn = triangles[f[triangles].max(axis=1) < (MOST_LEVELS + 3) * step]  # the logarithm has a pole in the disk
    tilt = math.radians(38.0)
    seen = np.column_stack([points[:, 0], math.cos(tilt) * points[:, 1] + math.sin(tilt) * points[:, 2]])
    low, high = seen.min(axis=0), seen.max(axis=0)
    seen = (seen - (low + high) / 2) * np.array([1.0, -1.0]) * 340.0 / (high - low).max() + [180.0, 180.0]
    flat = disk * [165.0, -165.0] + [545.0, 180.0]
    parts = ['<g transform="scale(0.1)" fill="none" stroke-linejoin="round" stroke-width="13">']
    for place in (seen, flat):
        border = path_of(chains(boundary_graph(triangles, place)))
        parts.append(f'<path fill="{PAPER}" fill-rule="evenodd" d="{border}"/>')
        for values, period, color in ((f, None, WARM), (conjugate, 2 * math.pi, COLD)):
            lines = level_lines(values, place, drawn, step, period)
            parts.append(f'<path stroke="{color}" d="{path_of(lines)}"/>')
        if f.max() > MOST_LEVELS * step:
            last = path_of(level_lines(f, place, drawn, MOST_LEVELS * step))
            parts.append(f'<path fill="{PAPER}" stroke="{WARM}" d="{last}"/>')
        parts.append(f'<path stroke="{EDGE}" stroke-width="24" d="{border}"/>')
    return svg(720, 360, [*parts, "</g>"])


def boundary_graph(triangles, points):
    """The boundary edges as a graph for `chains`."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, index, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    graph = {}
    for a, b in edges[index[count == 1]].tolist():
        for one, other in ((a, b), (b, a)):
            graph.setdefault(one, (points[one], []))[1].append(other)
    return graph


def pictures(out):
    """Fig. 6 on the annulus and Fig. 7 on the disk, by name."""
    return {"level_sets": level_sets(out, 1), "level_sets_disk": level_sets(out, 0)}
