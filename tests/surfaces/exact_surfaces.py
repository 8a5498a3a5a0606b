# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of revolution with a hole at each end, whose conformal map is known. NumPy alone.

A ring of radius r and width ds is mapped to one of width ds / r on the logarithmic scale: so the map is the annulus
with log(1 / inner radius) = the integral of ds / r from the one rim to the other.
"""

import numpy as np


def revolved(radius, height, around):
    """Vertices (V, 3) and triangles (F, 3) of rings of some radius and height, each turned by half a step."""
    rows = len(radius)
    turn = 2 * np.pi / around * (np.arange(around) + 0.5 * (np.arange(rows)[:, None] % 2))
    vertices = np.stack(
        [radius[:, None] * np.cos(turn), radius[:, None] * np.sin(turn), np.broadcast_to(height[:, None], turn.shape)],
        axis=-1,
    ).reshape(-1, 3)
    i = np.arange(around)
    after, faces = (i + 1) % around, []
    for row in range(rows - 1):
        low, high = row * around, (row + 1) * around
        if row % 2 == 0:
            faces += [np.column_stack([low + i, low + after, high + i])]
            faces += [np.column_stack([high + i, low + after, high + after])]
        else:
            faces += [np.column_stack([low + i, high + after, high + i])]
            faces += [np.column_stack([low + i, low + after, high + after])]
    return vertices, np.concatenate(faces).astype(np.int32)


def ring(inner, around, rows=None):
    """A flat ring from radius 1 to `inner`: its map is itself. As many rows as make faces equilateral, or `rows`."""
    if rows is None:
        rows = max(1, round(-np.log(inner) * around / (2 * np.pi * np.sin(np.pi / 3))))
    radius = inner ** (np.arange(rows + 1) / rows)
    return (*revolved(radius, np.zeros(rows + 1), around), inner)


def limb(depth, around, base=0.2):
    """A flat ring down to the radius `base`, and a tube on it that is `depth` of its radii long, open at its end.
    Also the radius of the circle of its end: base * exp(-depth)."""
    step = 2 * np.pi / around * np.sin(np.pi / 3)
    flat, tube = (max(1, round(length / step)) for length in (-np.log(base), depth))
    radius = np.concatenate([base ** (np.arange(flat) / flat), np.full(tube + 1, base)])
    height = np.concatenate([np.zeros(flat), np.linspace(0.0, depth * base, tube + 1)])
    return (*revolved(radius, height, around), base * np.exp(-depth))
