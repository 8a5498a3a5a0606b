# SPDX-License-Identifier: GPL-3.0-or-later
"""Where a function that is linear in each triangle lies between levels: the outlines of such regions as closed chains,
which hold for every position of the vertices, and as SVG paths.

A point of a chain is (a, b, t): (1 - t) of the way from vertex a to vertex b. So one set of chains serves all frames of
a figure, in which the same mesh is drawn at other places.
"""

import numpy as np


def boundary_edges(triangles):
    """Directed edges (E, 2) with a triangle on the left alone."""
    edges = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, index, count = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    return edges[np.sort(index[count == 1])]


def outlines(triangles, values, levels, kept):
    """Closed chains, each (n, 3), around where `kept` holds: kept[i] is about values from levels[i - 1] up to below
    levels[i]; there is one more of them than levels."""
    levels, kept = np.asarray(levels, float), np.asarray(kept, bool)
    band = np.searchsorted(levels, values, side="right")
    graph = {}

    def join(one, other):
        for key, to in ((one, other), (other, one)):
            graph.setdefault(key, []).append(to)

    def crossing(a, b, level):
        return (min(a, b), max(a, b), level)

    low, high = band[triangles].min(axis=1), band[triangles].max(axis=1)
    for face in triangles[low != high].tolist():
        bands = [int(band[v]) for v in face]
        for level in range(min(bands), max(bands)):
            if kept[level] == kept[level + 1]:
                continue
            cut = [(a, b) for a, b in zip(face, face[1:] + face[:1]) if (band[a] <= level) != (band[b] <= level)]
            join(crossing(*cut[0], level), crossing(*cut[1], level))
    for a, b in boundary_edges(triangles).tolist():
        at, to = int(band[a]), int(band[b])
        step = 1 if to > at else -1
        before, run = (a, a, -1), at
        for level in range(at, to) if step > 0 else range(at - 1, to - 1, -1):
            key = crossing(a, b, level)
            if kept[run] and kept[level] != kept[level + 1]:
                join(before, key)
            # Where kept does not change there is no node: the piece goes on.
            if kept[level] != kept[level + 1]:
                before = key
            run += step
        if kept[run]:
            join(before, (b, b, -1))
    return [_placed(chain, values, levels) for chain in _closed_chains(graph)]


def _closed_chains(graph):
    """Walks through a graph whose nodes all have an even degree, two almost always."""
    graph = {key: list(others) for key, others in graph.items()}
    chains = []
    for start in list(graph):
        while graph[start]:
            chain, at = [start], start
            while graph[at]:
                after = graph[at].pop()
                graph[after].remove(at)
                chain.append(after)
                at = after
                if at == start:
                    break
            chains.append(chain)
    return chains


def _placed(chain, values, levels):
    points = []
    for a, b, level in chain:
        t = 0.0 if level < 0 else (levels[level] - values[a]) / (values[b] - values[a])
        points.append((a, b, t))
    return np.array(points)


def stripes(triangles, values, step, phase=0.0):
    """Outlines of every other stripe of width `step`."""
    first = np.floor((np.min(values) - phase) / step)
    levels = phase + step * (first + 1 + np.arange(int((np.max(values) - phase) // step - first)))
    return outlines(triangles, values, levels, (np.arange(len(levels) + 1) + int(first)) % 2 == 0)


def below(triangles, values, level):
    """Outlines of where the values are less."""
    return outlines(triangles, values, [level], [True, False])


def checker(triangles, uv, step, phase=0.0):
    """Chains whose interiors, by the even-odd rule, are every other square: stripes of both coordinates."""
    return stripes(triangles, uv[:, 0], step, phase) + stripes(triangles, uv[:, 1], step, phase)


# ---------------------------------------------------------------- paths


def place(chain, points):
    """The chain where the vertices are at `points` (V, 2)."""
    a, b, t = chain[:, 0].astype(int), chain[:, 1].astype(int), chain[:, 2:]
    return (1 - t) * points[a] + t * points[b]


def simplified(line, tolerance):
    """Fewer points, none farther than `tolerance` from the line [Douglas, Peucker 1973]. A closed one stays closed."""
    kept = np.zeros(len(line), bool)
    kept[[0, -1]] = True
    closed = len(line) > 2 and np.allclose(line[0], line[-1])
    if closed:
        kept[np.argmax(((line - line[0]) ** 2).sum(axis=1))] = True
    ends = np.flatnonzero(kept).tolist()
    pending = list(zip(ends, ends[1:]))
    while pending:
        i, j = pending.pop()
        if j - i < 2:
            continue
        chord, part = line[j] - line[i], line[i + 1 : j] - line[i]
        length = np.hypot(*chord)
        away = np.hypot(*part.T) if length == 0 else np.abs(part[:, 0] * chord[1] - part[:, 1] * chord[0]) / length
        k = int(np.argmax(away))
        if away[k] > tolerance:
            kept[i + 1 + k] = True
            pending += [(i, i + 1 + k), (i + 1 + k, j)]
    return line[kept]


def path(lines, tolerance=0.2, closed=True):
    """The d of an SVG path in tenths of a unit, for a group that is scaled by 0.1; lines (n, 2)."""
    words = []
    for line in lines:
        q = np.rint(10 * simplified(np.asarray(line, float), tolerance)).astype(int)
        if closed and len(q) > 1 and (q[0] == q[-1]).all():
            q = q[:-1]
        if len(q) < 2:
            continue
        moves = " ".join(f"{x} {y}" for x, y in np.diff(q, axis=0))
        words.append(f"M{q[0][0]} {q[0][1]}l{moves}" + ("z" if closed else ""))
    return "".join(words).replace(" -", "-")
