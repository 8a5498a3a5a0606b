"""Implicit surfaces beside those of face_surface: fields f(p), negative inside, of points (n, 3)."""

import functools

import numpy as np
from cage_mesher import smooth_rows
from face_surface import ellipsoid, limb


def chain(p, joints, radii, finer=4):
    """A round limb along a smooth curve from the first joint to the last, its radius running with it."""
    rows = smooth_rows(np.column_stack([joints, radii]), finer * (len(joints) - 1))
    sticks = (limb(p, a[:3], b[:3], a[3], b[3]) for a, b in zip(rows, rows[1:]))
    return functools.reduce(np.minimum, sticks)


def turned_ellipsoid(p, center, radii, axes):
    """An ellipsoid whose half axes point along the rows of axes (3, 3), orthonormal."""
    return ellipsoid((p - center) @ np.asarray(axes).T, np.zeros(3), radii)


def frame(ahead, right):
    """Orthonormal rows: to the right, ahead, and up = right x ahead."""
    ahead = np.asarray(ahead, float) / np.linalg.norm(ahead)
    up = np.cross(right, ahead)
    up /= np.linalg.norm(up)
    return np.stack([np.cross(ahead, up), ahead, up])


def folded(p):
    """Points with x replaced by |x|: a field of them is symmetric."""
    return p * (np.sign(p[:, :1]) * (1.0, 0.0, 0.0) + (0.0, 1.0, 1.0))


def project(field, p, rounds=1, step=1e-4, reach=0.05):
    """Points near a field's surface, moved onto it along the gradient (Newton), each time by at most reach."""
    shifts = step * np.eye(3)
    for _ in range(rounds):
        slope = np.stack([(field(p + s) - field(p - s)) / (2 * step) for s in shifts], axis=1)
        move = (field(p) / np.maximum(np.sum(slope * slope, axis=1), 1e-3))[:, None] * slope
        length = np.linalg.norm(move, axis=1)[:, None]
        p = p - move * np.minimum(1.0, reach / np.maximum(length, 1e-12))
    return p
