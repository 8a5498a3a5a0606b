"""The face as an implicit surface: f(p) < 0 inside the head, f = 0 on the skin.

A head is blended from ellipsoids and round cones by the cubic smooth minimum (Quilez), which is twice
differentiable, so that the skin has no crease. Units: the head is about 2.3 high, the eye line is z = 0,
x points to the model's left, the face looks along -y as Blender's own models do.
Every function takes points of shape (n, 3) and returns (n,).
"""

import numpy as np

CHART_CENTER = np.array([0.0, 0.1, 0.0])


def smooth_union(a, b, width):
    """min(a, b), rounded where |a - b| < width; pushes the surface out by at most width / 6."""
    overlap = np.maximum(width - np.abs(a - b), 0.0) / width
    return np.minimum(a, b) - overlap**3 * width / 6.0


def smooth_difference(a, b, width):
    """The part of a outside b, its edge rounded over width."""
    return -smooth_union(-a, b, width)


def ellipsoid(p, center, radii):
    """First-order distance to an axis-parallel ellipsoid, exact on its surface."""
    q = (p - center) / radii
    level = np.linalg.norm(q, axis=1)
    slope = np.linalg.norm(q / radii, axis=1)
    return level * (level - 1.0) / np.maximum(slope, 1e-12)


def limb(p, start, end, radius_start, radius_end):
    """A stick from start to end whose radius runs linearly between the two given ones."""
    start, end = np.asarray(start, float), np.asarray(end, float)
    axis = end - start
    t = np.clip((p - start) @ axis / (axis @ axis), 0.0, 1.0)
    radius = radius_start + t * (radius_end - radius_start)
    return np.linalg.norm(p - start - t[:, None] * axis, axis=1) - radius


def both_sides(shape, p, *args, width=0.03):
    """The union of a shape given on the side x > 0 and of its mirror image."""
    return smooth_union(shape(p, *args), shape(p * (-1.0, 1.0, 1.0), *args), width)


def mirrored_chain(p, joints, radii, width):
    """Limbs through joints given on the side x > 0, and their mirror images."""
    f = np.full(len(p), np.inf)
    for start, end, radius_start, radius_end in zip(joints, joints[1:], radii, radii[1:]):
        part = both_sides(limb, p, start, end, radius_start, radius_end)
        f = part if np.isinf(f[0]) else smooth_union(f, part, width)
    return f


def head(p):
    """Signed value of the whole face, negative inside."""
    f = ellipsoid(p, (0, 0.05, 0.25), (0.70, 0.98, 0.92))
    f = smooth_union(f, ellipsoid(p, (0, -0.22, -0.34), (0.58, 0.68, 0.78)), 0.3)
    f = _bones(p, f)
    f = _eyes(p, f)
    f = _mouth(p, f)
    return _nose(p, f)


def _bones(p, f):
    """Jaw, chin, cheekbones and brow ridge."""
    f = smooth_union(f, both_sides(limb, p, (0.42, -0.22, -0.66), (0.13, -0.74, -0.94), 0.15, 0.13), 0.3)
    f = smooth_union(f, ellipsoid(p, (0, -0.80, -0.97), (0.18, 0.15, 0.14)), 0.25)
    f = smooth_union(f, both_sides(ellipsoid, p, (0.36, -0.50, -0.22), (0.24, 0.29, 0.18)), 0.4)
    brow = mirrored_chain(
        p,
        [(0.10, -0.86, 0.14), (0.26, -0.82, 0.21), (0.43, -0.70, 0.20), (0.54, -0.50, 0.10)],
        [0.06, 0.07, 0.065, 0.05],
        0.08,
    )
    return smooth_union(f, brow, 0.2)


def _eyes(p, f):
    """Sockets, and the lids as balls set into them."""
    f = smooth_difference(f, both_sides(ellipsoid, p, (0.27, -1.0, -0.01), (0.19, 0.20, 0.12)), 0.2)
    return smooth_union(f, both_sides(ellipsoid, p, (0.29, -0.665, 0.0), (0.19, 0.17, 0.155)), 0.035)


def _nose(p, f):
    """Bridge, flanks, tip, wings."""
    f = smooth_union(f, limb(p, (0, -0.85, 0.02), (0, -0.95, -0.32), 0.08, 0.13), 0.15)
    f = smooth_union(f, limb(p, (0, -0.90, 0.10), (0, -1.08, -0.33), 0.055, 0.085), 0.12)
    f = smooth_union(f, ellipsoid(p, (0, -1.115, -0.36), (0.09, 0.085, 0.075)), 0.08)
    return smooth_union(f, both_sides(ellipsoid, p, (0.11, -1.01, -0.385), (0.062, 0.095, 0.07)), 0.06)


def _mouth(p, f):
    """Muzzle, philtrum, lips and the furrow above the chin."""
    f = smooth_union(f, ellipsoid(p, (0, -0.70, -0.66), (0.34, 0.25, 0.30)), 0.25)
    f = smooth_difference(f, limb(p, (-0.12, -1.02, -0.865), (0.12, -1.02, -0.865), 0.06, 0.06), 0.15)
    f = smooth_difference(f, limb(p, (0, -1.03, -0.47), (0, -1.03, -0.57), 0.03, 0.03), 0.08)
    upper = mirrored_chain(
        p, [(0.035, -0.965, -0.605), (0.13, -0.945, -0.615), (0.27, -0.855, -0.670)], [0.055, 0.05, 0.018], 0.04
    )
    lower = mirrored_chain(
        p, [(0.03, -0.945, -0.74), (0.13, -0.925, -0.730), (0.27, -0.855, -0.675)], [0.07, 0.06, 0.018], 0.04
    )
    return smooth_union(f, smooth_union(upper, lower, 0.02), 0.045)


def gradient(p, step=1e-4):
    """Central differences of head, shape (n, 3)."""
    shifts = step * np.eye(3)
    return np.stack([(head(p + s) - head(p - s)) / (2 * step) for s in shifts], axis=1)


def project(p, rounds=4):
    """Points near the skin, moved onto it along the gradient (Newton)."""
    for _ in range(rounds):
        g = gradient(p)
        p = p - (head(p) / np.sum(g * g, axis=1))[:, None] * g
    return p


def cast(origins, directions, rounds=40):
    """Where rays that start outside first meet the skin (sphere tracing until within 1e-4, then Newton)."""
    p = np.array(origins, float)
    active = np.arange(len(p))
    for _ in range(rounds):
        height = head(p[active])
        p[active] += 0.8 * height[:, None] * directions[active]
        active = active[np.abs(height) > 1e-4]
        if not len(active):
            break
    return project(p, 2)


def chart(p):
    """Azimuthal equidistant chart of the directions seen from CHART_CENTER, with -y in the middle."""
    d = p - CHART_CENTER
    sideways = np.hypot(d[:, 0], d[:, 2])
    angle = np.arctan2(sideways, -d[:, 1])
    return d[:, [0, 2]] * (angle / np.maximum(sideways, 1e-12))[:, None]


def lift(q):
    """Where the rays from CHART_CENTER leave the head, for points (n, 2) of the chart."""
    angle = np.hypot(q[:, 0], q[:, 1])
    scale = np.sinc(angle / np.pi)
    outward = np.stack([q[:, 0] * scale, -np.cos(angle), q[:, 1] * scale], axis=1)
    return cast(CHART_CENTER + 1.5 * outward, -outward)
