# SPDX-License-Identifier: GPL-3.0-or-later
"""Random models of any topology, coarse and unkind: what parts and cuts are tried on. NumPy alone.

    make(kind, seed) -> vertices (V, 3), triangles (F, 3)

They may be closed, have handles or holes, or be two components of very different size.
"""

import numpy as np


def ring(points, around):
    """Rings of vertices joined to a tube: points (m, n, 3) -> vertices, faces; `around`: the last joins the first."""
    m, n = points.shape[:2]
    i, k = np.meshgrid(np.arange(m if around else m - 1), np.arange(n), indexing="ij")
    a, b = i * n + k, (i + 1) % m * n + k
    c, d = (i + 1) % m * n + (k + 1) % n, i * n + (k + 1) % n
    return points.reshape(-1, 3), np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


def stick(rng):
    """A bent tube of three to eight sides, as characters' limbs are, mostly closed at its ends."""
    n, m = int(rng.integers(3, 9)), int(rng.integers(4, 80))
    t = np.linspace(0, 1, m)
    length = rng.choice([2, 5, 10, 20, 40, 80]) * (0.5 + rng.random())
    bends = [np.sin(t * 10 * rng.random()) * 2 * rng.random() for _ in range(2)]
    path = np.column_stack([t * length, *bends])
    radius = np.exp(rng.normal(size=m) * rng.choice([0, 0.1, 0.3])) * np.linspace(0.5, rng.choice([0.5, 0.25, 0.05]), m)
    angle = 2 * np.pi * np.arange(n) / n
    circle = np.column_stack([0 * angle, np.cos(angle), np.sin(angle)])
    vertices, faces = ring(path[:, None] + radius[:, None, None] * circle, around=False)
    turn = np.roll(np.arange(n), -1)
    for end, rim, side in ((0, np.arange(n), -1), (m - 1, (m - 1) * n + np.arange(n), 1)):
        if rng.random() < 0.3:
            continue
        tip = path[end] + [side * radius[end] * rng.random(), 0, 0]
        pair = (rim, rim[turn]) if side < 0 else (rim[turn], rim)
        faces = np.concatenate([faces, np.column_stack([np.full(n, len(vertices)), *pair])])
        vertices = np.concatenate([vertices, [tip]])
    return vertices, faces


def boxes(cells, rng):
    """The surface of some unit cubes of a grid."""
    number, faces = {}, []
    for cell in sorted(cells):
        for axis in range(3):
            for side in (0, 1):
                beside = np.array(cell)
                beside[axis] += 2 * side - 1
                if tuple(beside) in cells:
                    continue
                corner = np.array(cell)
                corner[axis] += side
                u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in (1, 2))
                corners = (corner, corner + u, corner + u + v, corner + v)
                quad = [number.setdefault(tuple(p), len(number)) for p in corners]
                quad = np.roll(quad if side else quad[::-1], int(rng.integers(2)))
                faces += [quad[[0, 1, 2]], quad[[0, 2, 3]]]
    vertices = np.array(list(number), float)
    return vertices + rng.choice([0, 0.02, 0.1]) * rng.normal(size=vertices.shape), np.array(faces)


def limbs(rng):
    """Straight limbs of one cube's width that start from each other."""
    cells = {(0, 0, 0)}
    for _ in range(int(rng.integers(2, 6))):
        cell, step = np.array(sorted(cells)[rng.integers(len(cells))]), np.zeros(3, int)
        step[rng.integers(3)] = rng.choice([-1, 1])
        cells |= {tuple(cell + k * step) for k in range(int(rng.integers(3, 25)))}
    return boxes(cells, rng)


def plate(rng):
    """A plate of genus 1 to 6, sometimes thin, sometimes with holes."""
    genus, height, depth = int(rng.integers(1, 7)), int(rng.integers(5, 9)), int(rng.integers(1, 3))
    cells = {(x, y, z) for x in range(3 * genus + 2) for y in range(height) for z in range(depth)
             if x % 3 != 2 or x > 3 * genus or not 2 <= y < height - 2}
    vertices, faces = boxes(cells, rng)
    return vertices * [1, 1, rng.choice([1, 0.2, 0.02])], holed(faces, rng)


def knot(rng):
    """A torus knot of three to eight sides."""
    p, q = [(2, 3), (3, 2), (2, 5), (3, 4), (1, 0), (5, 2)][rng.integers(6)]
    m, n = int(rng.integers(30, 220)), int(rng.integers(3, 9))
    t, angle = 2 * np.pi * np.arange(m) / m, 2 * np.pi * np.arange(n) / n
    path = np.column_stack([(2 + np.cos(q * t)) * np.cos(p * t), (2 + np.cos(q * t)) * np.sin(p * t), -np.sin(q * t)])
    tangent = np.roll(path, -1, axis=0) - np.roll(path, 1, axis=0)
    across = np.cross(tangent, [0.3, 0.5, 0.8])
    other = np.cross(tangent, across)
    across, other = (v / np.linalg.norm(v, axis=1)[:, None] for v in (across, other))
    radius = rng.choice([0.03, 0.1, 0.25]) * np.exp(rng.normal(size=m) * rng.choice([0, 0.2]))
    circle = np.cos(angle)[None, :, None] * across[:, None] + np.sin(angle)[None, :, None] * other[:, None]
    vertices, faces = ring(path[:, None] + radius[:, None, None] * circle, around=True)
    return vertices, holed(faces, rng)


def ball(level):
    """The octahedron, each face cut in four `level` times, on the unit sphere."""
    vertices = [v for axis in np.eye(3) for v in (axis, -axis)]
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    for _ in range(level):
        middle, finer = {}, []
        for face in faces:
            ends = [tuple(sorted((face[k], face[(k + 1) % 3]))) for k in range(3)]
            for end in ends:
                if end not in middle:
                    middle[end] = len(vertices)
                    vertices.append(vertices[end[0]] + vertices[end[1]])
            x, y, z = (middle[end] for end in ends)
            a, b, c = face
            finer += [(a, x, z), (x, b, y), (z, y, c), (x, y, z)]
        vertices, faces = [v / np.linalg.norm(v) for v in vertices], finer
    return np.array(vertices), np.array(faces)


def bumps(rng):
    """A ball with bumps, some of them long fingers."""
    vertices, faces = ball(int(rng.integers(2, 5)))
    radius = np.ones(len(vertices))
    for _ in range(int(rng.integers(1, 9))):
        at = rng.normal(size=3)
        away = 1 - vertices @ at / np.linalg.norm(at)
        radius += rng.choice([0.5, 2, 6, 20]) * np.exp(-rng.choice([10, 40, 150]) * away)
    return vertices * radius[:, None], faces


def needles(rng):
    """A ball of which some vertices are pulled out by up to five magnitudes, sometimes flat, sometimes with holes."""
    vertices, faces = ball(int(rng.integers(1, 4)))
    some = rng.choice(len(vertices), int(rng.integers(1, 6)), replace=False)
    vertices[some] *= 10.0 ** rng.uniform(0, 5, len(some))[:, None]
    if rng.random() < 0.5:
        vertices *= 10.0 ** rng.uniform(-4, 0, 3)
    return vertices, holed(faces, rng)


def two(rng):
    """Two components, one of them up to eight magnitudes smaller."""
    (vertices, faces), (others, more) = (ONE[rng.integers(len(ONE))](rng) for _ in range(2))
    scale = 10.0 ** rng.uniform(-8, 2)
    return np.concatenate([vertices, others * scale + [100, 0, 0]]), np.concatenate([faces, more + len(vertices)])


def holed(faces, rng):
    """In three of ten cases without up to five faces."""
    if rng.random() > 0.3:
        return faces
    return np.delete(faces, rng.choice(len(faces), int(rng.integers(1, 6)), replace=False), axis=0)


ONE = [stick, limbs, plate, knot, bumps, needles]
KINDS = {kind.__name__: kind for kind in [*ONE, two]}


def make(kind, seed):
    vertices, faces = KINDS[kind](np.random.default_rng([seed, list(KINDS).index(kind)]))
    return vertices, faces.astype(np.int32)
