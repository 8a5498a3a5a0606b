"""A curved panel with 15 holes, a vase and a bowl, as points and faces."""

import numpy as np
from surface_mesher import Surface, closed_spline, mesh_surface

GOLDEN_ANGLE = np.pi * (3 - np.sqrt(5))
# Profiles, as control points (radius, height).
VASE = [(0.50, 0.0), (0.54, 0.06), (0.86, 0.35), (0.92, 0.80), (0.62, 1.15), (0.50, 1.35), (0.56, 1.52), (0.74, 1.64)]
BOWL = [(0.0, 0.0), (0.30, 0.0), (0.75, 0.10), (1.05, 0.42), (1.16, 0.78), (1.30, 0.92)]


def perforated_panel():
    """A saddle over a rounded rectangle, with 15 round holes in a sunflower spiral that grow outwards."""
    k = np.arange(15)
    turn = 0.255 * np.sqrt(k + 0.4)
    centers = np.stack([1.38 * turn * np.cos(k * GOLDEN_ANGLE), 0.95 * turn * np.sin(k * GOLDEN_ANGLE)], axis=1)
    radii = 0.07 + 0.0085 * k
    circles = [c + r * _unit_circle(96) for c, r in zip(centers, radii)]
    corner = [(1.55, 0.0), (1.55, 0.75), (1.5, 1.05), (1.15, 1.12)]
    side = corner + [(0.0, 1.12)] + [(-x, y) for x, y in reversed(corner)]
    outline = closed_spline(side + [(x, -y) for x, y in reversed(side[1:-1])])

    def spacing(p):
        away = np.linalg.norm(p[:, None, :2] - centers, axis=2) - radii
        return np.minimum((2 * np.pi * radii / 36 + 0.12 * np.maximum(away, 0)).min(axis=1), 0.05)

    surface = Surface(chart=lambda p: p[:, :2], lift=_saddle, project=lambda p: _saddle(p[:, :2]), spacing=spacing)
    return mesh_surface(surface, _saddle(outline), [_saddle(circle) for circle in circles])


def _saddle(q):
    """The panel's points over plane points."""
    return np.column_stack([q, 0.30 - 0.16 * q[:, 0] ** 2 + 0.24 * q[:, 1] ** 2])


def _unit_circle(count):
    angle = np.arange(count) * 2 * np.pi / count
    return np.stack([np.cos(angle), np.sin(angle)], axis=1)


def vase(around=112, along=88):
    """Quads of a vase that is open at mouth and foot."""
    radius, height = _curve(VASE, along)
    circle = _unit_circle(around)
    points = np.concatenate([np.column_stack([r * circle, np.full(around, z)]) for r, z in zip(radius, height)])
    ring = np.arange(around)
    after = np.roll(ring, -1)
    rows = [np.stack([ring, after, after + around, ring + around], axis=1) + around * row for row in range(along - 1)]
    return points, np.concatenate(rows)


def bowl(core=24, rings=36):
    """Quads of a bowl: a square of core x core of them in the middle of the floor, rings of 4 core around it."""
    axis = np.linspace(-1.0, 1.0, core + 1)
    x, y = np.meshgrid(axis, axis)
    # The square's sides bulge towards the circle, so that the quads at its corners stay open.
    middle = 0.30 * np.stack([x * (1 - 0.16 * y**2), y * (1 - 0.16 * x**2)], axis=-1).reshape(-1, 2)
    ids = np.arange((core + 1) ** 2).reshape(core + 1, core + 1)
    faces = [np.stack([ids[:-1, :-1], ids[:-1, 1:], ids[1:, 1:], ids[1:, :-1]], axis=-1).reshape(-1, 4)]
    rim = np.concatenate([ids[0, :-1], ids[:-1, -1], ids[-1, :0:-1], ids[:0:-1, 0]])
    angle = (np.arange(4 * core) / core - 1.5) * np.pi / 2
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    plane, inner = [middle], rim
    for ring in range(1, rings + 1):
        t = ring / rings
        plane.append((1 - t) * middle[rim] + t * circle)
        outer = len(ids.flat) + 4 * core * (ring - 1) + np.arange(4 * core)
        faces.append(np.stack([inner, outer, np.roll(outer, -1), np.roll(inner, -1)], axis=1))
        inner = outer
    plane = np.concatenate(plane)
    distance = np.linalg.norm(plane, axis=1)
    radius, height = _curve(BOWL, 400)
    at = np.linspace(0.0, 1.0, len(radius))
    scale = np.interp(distance, at, radius) / np.maximum(distance, 1e-12)
    points = np.column_stack([plane * scale[:, None], np.interp(distance, at, height)])
    # Outside is below.
    return points, np.concatenate(faces)[:, ::-1]


def _curve(control, count):
    """Radius and height at even steps along the clamped quadratic B-spline of these control points."""
    control = np.array(control)
    joints = np.concatenate([control[:1], (control[1:-2] + control[2:-1]) / 2, control[-1:]])
    t = np.linspace(0, 1, 200)[:, None]
    pieces = [(1 - t) ** 2 * a + 2 * t * (1 - t) * b + t**2 * c for a, b, c in zip(joints, control[1:-1], joints[1:])]
    line = np.concatenate(pieces)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    at = np.linspace(0.0, length[-1], count)
    return np.interp(at, length, line[:, 0]), np.interp(at, length, line[:, 1])
