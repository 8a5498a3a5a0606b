"""Tori and tubes of quadrilaterals, and what a tile of theirs promises, told without the add-on."""

import math

import numpy as np
import scenes

GRID = 2.0**24  # steps of 32-bit UVs between 1/2 and 1


def torus_arrays(n=16, m=12, holes=(), twist=0.4):
    """A torus of revolution with lines that no cut follows, without the faces (i, j) of `holes`."""
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    u, v = 2 * np.pi * i / n, 2 * np.pi * j / m
    u, v = u + 0.5 * twist * np.sin(2 * v + u), v + 0.5 * twist * np.sin(2 * u)
    points = np.stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)], axis=2).reshape(-1, 3)
    at = lambda i, j: i % n * m + j % m  # noqa: E731
    faces = [
        (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
        for i in range(n) for j in range(m) if (i, j) not in holes
    ]  # fmt: skip
    return _used(points, faces)


def tube_arrays(n=16, m=12, holes=()):
    """A bent tube of quadrilaterals, upright, without the faces (i, j) of `holes`."""
    i, j = np.meshgrid(np.arange(n), np.arange(m + 1), indexing="ij")
    turn = 2 * np.pi * i / n
    points = np.stack([np.cos(turn) + 0.3 * np.sin(0.3 * j), np.sin(turn), 0.4 * j + 0.1 * np.cos(turn)], axis=2)
    at = lambda i, j: i % n * (m + 1) + j  # noqa: E731
    faces = [
        (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
        for i in range(n) for j in range(m) if (i, j) not in holes
    ]  # fmt: skip
    return _used(points.reshape(-1, 3), faces)


def block(i, j, size=2):
    """Faces of a hole of that many by as many."""
    return tuple((i + a, j + b) for a in range(size) for b in range(size))


def with_finger(points, faces, face, length=10):
    """In the place of a quadrilateral a square finger, as many of its sides long."""
    base = list(faces[face])
    a, b, _, d = points[base]
    up = np.cross(b - a, d - a)
    up *= np.linalg.norm(b - a) / np.linalg.norm(up)
    rings = [base, *(np.arange(4) + len(points) + 4 * k for k in range(length))]
    sides = [
        [low[i], low[(i + 1) % 4], high[(i + 1) % 4], high[i]]
        for low, high in zip(rings, rings[1:]) for i in range(4)
    ]  # fmt: skip
    points = np.concatenate([points, *(points[base] + (k + 1) * up for k in range(length))])
    return points, [*faces[:face], *faces[face + 1 :], *np.array([*sides, rings[-1]]).tolist()]


def _used(points, faces):
    used, index = np.unique(np.array(faces), return_inverse=True)
    return points[used], index.reshape(-1, 4).tolist()


def add_torus(name="Torus", **options):
    obj = scenes.add_object(name, *torus_arrays(**options))
    scenes.select(obj)
    return obj


def add_tube(name="Tube", finger=None, **options):
    arrays = tube_arrays(**options)
    obj = scenes.add_object(name, *(arrays if finger is None else with_finger(*arrays, finger)))
    scenes.select(obj)
    return obj


def grid_points(obj, layer="Koebe"):
    """UVs of the corners in whole steps."""
    points = scenes.corner_uv(obj.data, layer).astype(np.float64) * GRID
    assert (points == np.rint(points)).all(), "a UV is between two steps"
    return points.astype(np.int64)


def shifts(obj, points):
    """How far the sides of each edge with two faces lie apart; both its ends have to say the same."""
    corner_edge, found = {}, []
    for face in obj.data.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, [*loops[1:], loops[0]]):
            places = {obj.data.loops[i].vertex_index: points[i] for i in (here, there)}
            corner_edge.setdefault(obj.data.loops[here].edge_index, []).append(places)
    for sides in corner_edge.values():
        if len(sides) == 2:
            apart = [tuple((sides[0][v] - sides[1][v]).tolist()) for v in sides[0]]
            assert apart[0] == apart[1], "the ends of an edge are not moved alike"
            found.append(apart[0])
    return set(found)


def lattice_area(found):
    """Area of the cell of the lattice that shifts generate, and the greatest common divisor of their lengths along u:
    by the minors."""
    minors = [a[0] * b[1] - a[1] * b[0] for a in found for b in found]
    return math.gcd(*minors), math.gcd(*(x for x, _ in found))


def polygon_areas(obj, points):
    """Twice the UV area of each face."""
    loops = [list(face.loop_indices) for face in obj.data.polygons]
    return np.array([
        sum(int(points[i][0] * points[j][1] - points[j][0] * points[i][1]) for i, j in zip(of, [*of[1:], of[0]]))
        for of in loops
    ])  # fmt: skip


def assert_torus(obj, layer="Koebe"):
    """The sides of all cuts differ by a lattice, all faces are upright, and together they cover its cell once (less the
    holes)."""
    points = grid_points(obj, layer)
    found = shifts(obj, points)
    cell, _ = lattice_area(found)
    areas = polygon_areas(obj, points)
    assert (areas > 0).all() and cell > 0
    if not scenes.boundary_loops(obj.data):
        assert areas.sum() == 2 * cell
    else:
        assert 0.2 * cell < areas.sum() < 2 * cell
    return found


def assert_ring(obj, layer="Koebe"):
    """The sides of all cuts differ by multiples of one period along u, all faces are upright, the rims straight."""
    points = grid_points(obj, layer)
    found = shifts(obj, points)
    assert all(v == 0 for _, v in found)
    _, period = lattice_area(found)
    areas = polygon_areas(obj, points)
    assert (areas > 0).all() and period > 0
    low, high = points[:, 1].min(), points[:, 1].max()
    assert areas.sum() <= 2 * period * (high - low)
    if len(scenes.boundary_loops(obj.data)) == 2:
        assert areas.sum() == 2 * period * (high - low)
    return period
