"""Another expression of the face: points on its skin, moved. Units and axes as in face_surface."""

import face_surface
import numpy as np

JAW_JOINT = np.array([0.0, -0.05, -0.15])
JAW_TURN = np.radians(13.0)
MOUTH_LINE, MOUTH_CORNER = -0.675, 0.262
LIP_DEPTH = 0.30  # below the mouth's line by this the skin follows the jaw wholly
EYE, EYE_SIZE = np.array([0.29, 0.005]), 0.21  # in (x, z), on the side x > 0
BROW, BROW_SIZE = np.array([0.32, 0.24]), 0.24


def surprised(p):
    """Points (n, 3) of the skin with the eyes wide, the brows up and the jaw down."""
    return _jaw_down(_brows_up(_eyes_wide(p)))


def _bump(p, center, size):
    """1 at both copies of a place in (x, z), falling off around it; 0 at the back of the head."""
    away = np.column_stack([np.abs(p[:, 0]), p[:, 2]]) - center
    return np.exp(-(away**2).sum(axis=1) / size**2) * (p[:, 1] < 0.0)


def _eyes_wide(p):
    moved = p.copy()
    moved[:, 2] += 0.75 * _bump(p, EYE, EYE_SIZE) * (p[:, 2] - EYE[1])
    return face_surface.project(moved)


def _brows_up(p):
    moved = p.copy()
    moved[:, 2] += 0.07 * _bump(p, BROW, BROW_SIZE)
    return moved


def _jaw_down(p):
    """Below the mouth the skin turns with the jaw, the lip the less the nearer to the corners; beside the mouth it
    gives way, the wider the farther from them."""
    side = np.abs(p[:, 0]) / MOUTH_CORNER
    give = 0.02 + 0.4 * np.maximum(side - 0.9, 0.0)
    below = _smooth_step((MOUTH_LINE - p[:, 2]) / give + 0.5)
    lip = np.sqrt(np.clip(1.0 - side**2, 0.04, 1.0))
    angle = JAW_TURN * below * (lip + (1.0 - lip) * _smooth_step((MOUTH_LINE - p[:, 2]) / LIP_DEPTH))
    arm = p - JAW_JOINT
    cos, sin = np.cos(angle), np.sin(angle)
    y, z = cos * arm[:, 1] - sin * arm[:, 2], sin * arm[:, 1] + cos * arm[:, 2]
    return JAW_JOINT + np.column_stack([arm[:, 0], y, z])


def _smooth_step(t):
    t = np.clip(t, 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)
