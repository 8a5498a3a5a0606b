"""The character: a small creature with ears, arms, hands of three fingers and a thumb, legs, feet and a tail, closed.

It stands on z = 0, is 2 high and looks along -y, x pointing to its left. Symmetric in x.
"""

import numpy as np
from cage_mesher import Cage, limb_sections, oval, section
from face_surface import ellipsoid, smooth_difference, smooth_union
from implicit_shapes import chain, folded, frame, project, turned_ellipsoid

HEAD = (0.0, 0.0, 1.42)
EYE = (0.170, -0.305, 1.48)
ARM = [(0.10, 0.01, 0.97), (0.26, 0.01, 0.93), (0.44, 0.03, 0.80), (0.60, -0.01, 0.66)]
ARM_RADII = [0.085, 0.085, 0.070, 0.058]
PALM = (0.675, -0.03, 0.595)
FINGERS = [  # root, middle, tip
    [(0.710, -0.095, 0.565), (0.765, -0.130, 0.510), (0.800, -0.145, 0.450)],
    [(0.725, -0.025, 0.555), (0.785, -0.030, 0.495), (0.822, -0.030, 0.430)],
    [(0.710, 0.045, 0.560), (0.765, 0.068, 0.505), (0.800, 0.075, 0.450)],
]
THUMB = [(0.650, -0.090, 0.610), (0.662, -0.165, 0.585), (0.688, -0.210, 0.545)]
FINGER_RADII = [0.042, 0.040, 0.038]
LEG = [(0.125, 0.01, 0.52), (0.145, -0.01, 0.36), (0.150, 0.02, 0.20), (0.152, 0.02, 0.11)]
LEG_RADII = [0.135, 0.115, 0.090, 0.085]
LEG_CAGE = [(0.135, 0.0, 0.44), (0.145, -0.01, 0.36), (0.150, 0.02, 0.22), (0.155, 0.03, 0.12), (0.158, 0.03, 0.02)]
TOE_CAGE = [(0.158, -0.06, 0.07), (0.160, -0.14, 0.075), (0.160, -0.21, 0.075)]
TAIL = [(0.0, 0.16, 0.56), (0.0, 0.36, 0.46), (0.0, 0.56, 0.52), (0.0, 0.66, 0.72), (0.0, 0.61, 0.92)]
TAIL_RADII = [0.085, 0.068, 0.066, 0.080, 0.050]
EAR = [(0.20, 0.03, 1.72), (0.29, 0.05, 1.88), (0.33, 0.06, 2.06)]
SMILE = [(0.0, -0.484, 1.225), (0.06, -0.470, 1.226), (0.115, -0.457, 1.245), (0.155, -0.435, 1.285)]


def body(p):
    """The whole creature's field."""
    q = folded(p)
    f = ellipsoid(p, (0, 0, 0.62), (0.265, 0.225, 0.27))
    f = smooth_union(f, ellipsoid(p, (0, 0.0, 0.90), (0.19, 0.155, 0.20)), 0.25)
    f = smooth_union(f, chain(q, ARM, ARM_RADII), 0.10)
    legs = [chain(p * (side, 1, 1), LEG, LEG_RADII) for side in (1, -1)]
    f = smooth_union(f, smooth_union(*legs, 0.06), 0.14)
    f = smooth_union(f, chain(p, TAIL, TAIL_RADII), 0.12)
    f = smooth_union(f, _foot(q), 0.14)
    f = smooth_union(f, _head(p, q), 0.09)
    return smooth_union(f, _hand(q), 0.05)


def _head(p, q):
    f = ellipsoid(p, HEAD, (0.43, 0.375, 0.37))
    f = smooth_union(f, ellipsoid(q, (0.21, -0.16, 1.29), (0.20, 0.19, 0.17)), 0.2)
    f = smooth_union(f, ellipsoid(p, (0, -0.345, 1.305), (0.175, 0.175, 0.125)), 0.12)
    ear = turned_ellipsoid(q, EAR[1], (0.115, 0.24, 0.055), frame(np.subtract(EAR[2], EAR[0]), (1.0, 0.1, -0.3)))
    f = smooth_union(f, ear, 0.10)
    f = smooth_difference(f, ellipsoid(q, (0.29, -0.035, 1.87), (0.065, 0.06, 0.165)), 0.05)
    f = smooth_difference(f, chain(q, SMILE, [0.020, 0.020, 0.018, 0.014]), 0.03)
    f = smooth_union(f, ellipsoid(p, (0, -0.515, 1.365), (0.062, 0.045, 0.042)), 0.02)
    return smooth_union(f, ellipsoid(q, EYE, (0.098, 0.088, 0.118)), 0.025)


def _hand(q):
    palm = turned_ellipsoid(q, PALM, (0.080, 0.105, 0.052), frame((0.10, -0.02, -0.10), (0.0, 1.0, 0.0)))
    for joints in FINGERS:
        palm = smooth_union(palm, chain(q, joints, FINGER_RADII, 2), 0.04)
    return smooth_union(palm, chain(q, THUMB, [0.042, 0.040, 0.037], 2), 0.04)


def _foot(q):
    f = ellipsoid(q, (0.160, -0.065, 0.085), (0.108, 0.19, 0.105))
    f = smooth_union(f, ellipsoid(q, (0.160, 0.03, 0.08), (0.095, 0.11, 0.09)), 0.05)
    return smooth_difference(f, q[:, 2], 0.05)


def cage():
    """Box modelling: a head of cubes, and all else pulled out of it."""
    c = Cage()

    def head_place(cube):
        q = cube / np.linalg.norm(cube, axis=1, keepdims=True) * np.abs(cube).max(axis=1, keepdims=True)
        return np.array(HEAD) + q * (0.43, 0.385, 0.37)

    head = c.box((8, 8, 8), head_place)
    ring = c.open(head["bottom"][2:7, 2:7])
    heights = [1.06, 0.99, 0.92, 0.85, 0.77, 0.69, 0.61, 0.53, 0.45]
    widths = [(0.13, 0.11), (0.17, 0.14), (0.19, 0.15), (0.20, 0.16), (0.23, 0.19), (0.26, 0.21), (0.27, 0.22),
              (0.25, 0.21), (0.20, 0.16)]  # fmt: skip
    around = oval(16, 6, 2, -1)
    rings = c.tube(ring, [section(around, (0, 0, z), (a, 0, 0), (0, -b, 0)) for z, (a, b) in zip(heights, widths)])
    bottom = c.cap(rings[-1], 6, 2, -1)
    small, ear_radii = oval(8, 2, 2), [(0.10, 0.05), (0.115, 0.05), (0.07, 0.03)]
    for side, columns in ((1, [7, 6, 5]), (-1, [15, 14, 13])):
        arm = c.open(rings[[4, 3, 2]][:, columns])
        radii = np.repeat(np.array(ARM_RADII)[:, None], 2, axis=1)
        arm = c.tube(arm, limb_sections(small, ARM[1:], radii[1:], (0, 1, 0), 8, side))[-1]
        _fingers(c, arm, side)
        leg = c.open(bottom[:, 4:7] if side > 0 else bottom[:, 0:3])
        radii = [(r, r) for r in (0.12, 0.115, 0.09, 0.09, 0.08)]
        leg = c.tube(leg, limb_sections(small, LEG_CAGE, radii, (1, 0, 0), 8, side))
        c.cap(leg[-1], 2, 2)
        toe = c.open(leg[[-1, -2, -3]][:, [6, 5, 4]])
        radii = [(0.10, 0.07), (0.10, 0.07), (0.07, 0.05)]
        c.cap(c.tube(toe, limb_sections(small, TOE_CAGE, radii, (1, 0, 0), 3, side))[-1], 2, 2)
        ear = c.open(head["top"][3:6, 6:9] if side > 0 else head["top"][3:6, 0:3])
        ear = c.tube(ear, limb_sections(small, EAR, ear_radii, (1, 0.1, -0.3), 5, side))[-1]
        c.cap(ear, 2, 2)
    tail = c.open(rings[[8, 7, 6]][:, [3, 2, 1]])
    radii = [(r, r) for r in TAIL_RADII]
    c.cap(c.tube(tail, limb_sections(small, TAIL, radii, (-1, 0, 0), 10))[-1], 2, 2)
    return c


def _fingers(c, wrist, side):
    """Palm, three fingers from its end, thumb from its front side."""
    shift = 0 if side > 0 else -1
    joints, radii = [(0.60, -0.01, 0.66), PALM, (0.715, -0.03, 0.56)], [(0.058, 0.05), (0.095, 0.045), (0.105, 0.04)]
    palm = c.tube(wrist, limb_sections(oval(8, 3, 1, shift), joints, radii, (0, 1, 0), 3, side))
    end = c.cap(palm[-1], 3, 1, shift)
    if side < 0:
        end = end[:, ::-1]
    for finger, joints in enumerate(FINGERS):
        root = end[:, finger : finger + 2]
        root = c.open(root if side > 0 else root[:, ::-1])
        c.cap(c.tube(root, limb_sections(oval(4, 1, 1), joints, [(0.033, 0.033)] * 3, (0, 1, 0), 5, side))[-1], 1, 1)
    front = palm[1:3][:, [7, 0]] if side > 0 else palm[1:3][:, [2, 3]]
    # seen from the front: the arm's outer end to the right on the creature's left side
    root = c.open(front.T[::-1] if side > 0 else front.T[:, ::-1])
    c.cap(c.tube(root, limb_sections(oval(4, 1, 1), THUMB, [(0.034, 0.034)] * 3, (1, 0, -1), 4, side))[-1], 1, 1)


def character():
    """Points (V, 3) and quads (F, 4)."""
    return cage().mesh(lambda p: project(body, p))
