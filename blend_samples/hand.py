"""The hand: palm, four fingers, thumb, with knuckles and nails; open at the wrist.

A left hand, fingers up along z, its back to +y, 1.9 high.
"""

import numpy as np
from cage_mesher import Cage, limb_sections, oval, section
from face_surface import ellipsoid, limb, smooth_difference, smooth_union
from implicit_shapes import chain, project

WRIST = -0.62
FINGERS = [  # from the thumb's side: root, two joints, tip
    [(-0.270, 0.010, 0.30), (-0.325, 0.000, 0.56), (-0.352, -0.030, 0.78), (-0.362, -0.070, 0.93)],
    [(-0.085, 0.020, 0.36), (-0.095, 0.015, 0.66), (-0.100, -0.015, 0.90), (-0.102, -0.060, 1.06)],
    [(0.095, 0.015, 0.33), (0.130, 0.010, 0.61), (0.146, -0.020, 0.84), (0.152, -0.062, 1.00)],
    [(0.265, 0.000, 0.22), (0.335, -0.005, 0.43), (0.372, -0.028, 0.61), (0.385, -0.062, 0.74)],
]
FINGER_RADII = [[0.094, 0.086, 0.076, 0.064], [0.097, 0.089, 0.079, 0.066], [0.093, 0.085, 0.075, 0.063],
                [0.081, 0.072, 0.064, 0.055]]  # fmt: skip
THUMB = [(-0.22, -0.06, -0.30), (-0.43, -0.12, -0.06), (-0.555, -0.15, 0.14), (-0.625, -0.17, 0.31)]
THUMB_RADII = [0.15, 0.108, 0.095, 0.072]


def flesh(p):
    """The hand's field; it goes on below the wrist."""
    f = ellipsoid(p, (0.0, 0.0, 0.06), (0.36, 0.145, 0.42))
    f = smooth_union(f, ellipsoid(p, (0.19, -0.04, -0.13), (0.155, 0.135, 0.30)), 0.15)
    arm = limb(p * (1.0, 0.215 / 0.155, 1.0), (0.0, 0.0, -0.22), (0.0, 0.0, -1.5), 0.215, 0.215)
    f = smooth_union(f, 0.8 * arm, 0.25)
    f = smooth_union(f, chain(p, THUMB, THUMB_RADII), 0.22)
    f = smooth_difference(f, ellipsoid(p, (0.02, -0.235, 0.06), (0.13, 0.12, 0.17)), 0.12)
    for joints, radii in zip(FINGERS, FINGER_RADII):
        f = smooth_union(f, _finger(p, np.array(joints), radii), 0.055)
    return _nail(p, f, THUMB, (-0.35, 0.75, 0.0), 0.072)


def _finger(p, joints, radii):
    """A finger, thicker at its joints, with a knuckle on the back and a nail."""
    f = chain(p, joints, radii)
    for joint, radius in zip(joints[:3], radii):
        f = smooth_union(f, ellipsoid(p, joint + (0.0, 0.25 * radius, 0.0), np.full(3, 0.80 * radius)), 0.06)
    return _nail(p, f, joints, (0.0, 1.0, 0.0), radii[-1])


def _nail(p, f, joints, back, radius):
    """With a flat bed for the nail, and the nail in it."""
    tip, before = np.array(joints[-1]), np.array(joints[-2])
    ahead = (tip - before) / np.linalg.norm(tip - before)
    back = np.array(back) - np.dot(back, ahead) * ahead
    back /= np.linalg.norm(back)
    side = np.cross(back, ahead)
    q = (p - tip + 0.25 * radius * ahead - 0.64 * radius * back) @ np.stack([side, back, ahead]).T
    return smooth_union(f, ellipsoid(q, np.zeros(3), radius * np.array([0.68, 0.44, 0.90])), 0.02)


def cage():
    """A block for the palm, five fingers and the wrist pulled out of it."""
    c = Cage()
    palm = c.box((8, 2, 6), lambda cube: cube * (0.30, 0.10, 0.28))
    for k, (joints, radii) in enumerate(zip(FINGERS, FINGER_RADII)):
        ring = c.open(palm["top"][:, 2 * k : 2 * k + 3])
        widths = [(0.9 * r, 0.9 * r) for r in radii]
        c.cap(c.tube(ring, limb_sections(oval(8, 2, 2), joints, widths, (1, 0, 0), 11))[-1], 2, 2)
    widths = [(0.9 * r, 0.9 * r) for r in THUMB_RADII]
    thumb = c.open(palm["left"][1:4, 0:3])
    c.cap(c.tube(thumb, limb_sections(oval(8, 2, 2), THUMB, widths, (0.3, -1, 0), 10))[-1], 2, 2)
    wrist = c.open(palm["bottom"])
    around = oval(20, 8, 2)
    heights = np.linspace(-0.34, WRIST, 6)
    c.tube(wrist, [section(around, (0, 0, z), (0.215, 0, 0), (0, -0.155, 0)) for z in heights])
    return c


def _on_flesh(p):
    """On the surface; what is at the wrist's rim stays at its height."""
    rim = p[:, 2] < WRIST + 0.02
    moved = project(flesh, p)
    moved[rim, 2] = p[rim, 2]
    return moved


def hand():
    """Points (V, 3) and quads (F, 4)."""
    return cage().mesh(_on_flesh)
