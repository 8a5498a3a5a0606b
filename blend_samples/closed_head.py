"""The closed head: the face of face_surface with closed eyes and mouth, ears, and a neck with a rounded foot."""

import face_surface
import numpy as np
from cage_mesher import Cage, limb_sections, oval, section
from face_surface import ellipsoid, limb, smooth_difference, smooth_union
from implicit_shapes import chain, folded, frame, project, turned_ellipsoid

EAR = (0.690, 0.10, -0.08)
SLIT = [(0.150, -0.815, -0.028), (0.225, -0.850, -0.062), (0.300, -0.845, -0.070), (0.380, -0.800, -0.055),
        (0.438, -0.740, -0.020)]  # fmt: skip


def bust(p):
    """The whole field."""
    q = folded(p)
    f = face_surface.head(p)
    f = smooth_union(f, limb(p, (0, 0.22, -0.55), (0, 0.26, -1.42), 0.42, 0.45), 0.35)
    f = smooth_union(f, ellipsoid(p, (0, 0.26, -1.62), (0.80, 0.52, 0.26)), 0.40)
    f = smooth_difference(f, p[:, 2] + 1.66, 0.10)
    f = smooth_difference(f, chain(q, SLIT, [0.012] * len(SLIT), 2), 0.03)
    return _ear(q, f)


def _ear(q, f):
    """An oval leaning back, hollowed, with a lobe."""
    axes = frame((0.06, 0.16, 1.0), (0.25, 1.0, -0.1))
    f = smooth_union(f, turned_ellipsoid(q, np.array(EAR), (0.145, 0.25, 0.115), axes), 0.06)
    f = smooth_difference(f, ellipsoid(q, (0.835, 0.075, -0.06), (0.085, 0.075, 0.145)), 0.07)
    return smooth_union(f, ellipsoid(q, (0.700, 0.060, -0.29), (0.055, 0.065, 0.075)), 0.07)


def cage():
    """A block of cells for the head, finer in front; ears and neck pulled out of it."""
    c = Cage()

    def place(cube):
        """Where rays from the middle of the head leave it, more of them in front."""
        ahead = cube / np.linalg.norm(cube, axis=1, keepdims=True)
        narrow = 1.0 - 0.12 * (1.0 - ahead[:, 1:2])
        ahead = ahead * (narrow * (1.0, 0.0, 1.0) + (0.0, 1.0, 0.0))
        ahead /= np.linalg.norm(ahead, axis=1, keepdims=True)
        return face_surface.cast(face_surface.CHART_CENTER + 1.5 * ahead, -ahead)

    head = c.box((10, 8, 10), place)
    neck = c.open(head["bottom"][1:6, 2:9])
    around = oval(20, 6, 4)
    sections = [(-1.05, 0.42, 0.40, 0.24), (-1.22, 0.44, 0.42, 0.25), (-1.36, 0.50, 0.44, 0.26),
                (-1.48, 0.68, 0.46, 0.26), (-1.58, 0.78, 0.50, 0.26), (-1.65, 0.70, 0.42, 0.26)]  # fmt: skip
    rings = c.tube(neck, [section(around, (0, y, z), (a, 0, 0), (0, -b, 0)) for z, a, b, y in sections])
    c.cap(rings[-1], 6, 4)
    for side, patch in ((1, head["right"]), (-1, head["left"])):
        ear = c.open(patch[3:7, 3:6])
        joints = [(0.64, 0.08, -0.10), (0.72, 0.10, -0.09), (0.79, 0.11, -0.08)]
        radii = [(0.13, 0.23), (0.13, 0.23), (0.08, 0.16)]
        c.cap(c.tube(ear, limb_sections(oval(10, 2, 3), joints, radii, (0.3, 1, 0), 3, side))[-1], 2, 3)
    return c


def closed_head():
    """Points (V, 3) and quads (F, 4)."""
    return cage().mesh(lambda p: project(bust, p))
