"""Surfaces whose maps to the sphere are known: spheroids, and round holes of the sphere under Moebius maps."""

import numpy as np
from domain_surfaces import on_sphere


def icosphere(frequency):
    """Vertices (10 n^2 + 2, 3) on the unit sphere and faces (20 n^2, 3): an icosahedron's, each edge in n."""
    t = (1 + 5**0.5) / 2
    corners = np.array([(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t),
                        (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)])  # fmt: skip
    sides = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6),
             (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10),
             (8, 6, 7), (9, 8, 1)]  # fmt: skip
    points, faces = [], []
    for side in sides:
        a, b, c = corners[list(side)]
        number = {}
        for i in range(frequency + 1):
            for j in range(frequency + 1 - i):
                number[i, j] = len(points)
                points.append((a * (frequency - i - j) + b * i + c * j) / frequency)
        for i in range(frequency):
            for j in range(frequency - i):
                faces.append((number[i, j], number[i + 1, j], number[i, j + 1]))
                if i + j < frequency - 1:
                    faces.append((number[i + 1, j], number[i + 1, j + 1], number[i, j + 1]))
    points = np.array(points)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    _, first, same = np.unique(np.round(points, 9), axis=0, return_index=True, return_inverse=True)
    return points[first], same.reshape(-1)[np.array(faces)].astype(np.int32)


def spheroid_map(points, height):
    """The conformal map of x^2 + y^2 + (z / height)^2 = 1 to the unit sphere: the isometric latitude."""
    sine = points[:, 2] / height  # of the parametric latitude
    cosine = np.hypot(points[:, 0], points[:, 1])
    normal = np.clip(sine / np.hypot(sine, height * cosine), -1, 1)  # sine of the normal's latitude
    e = np.sqrt(abs(height**2 - 1))
    with np.errstate(divide="ignore"):
        isometric = np.arctanh(normal) + (e * np.arctan(e * normal) if height > 1 else -e * np.arctanh(e * normal))
    longitude = np.arctan2(points[:, 1], points[:, 0])
    return np.column_stack([np.cos(longitude) / np.cosh(isometric), np.sin(longitude) / np.cosh(isometric),
                            np.tanh(isometric)])  # fmt: skip


def in_plane(points):
    """Stereographic projection, the inverse of on_sphere_upright."""
    return (points[:, 0] + 1j * points[:, 1]) / (1 + points[:, 2])


def on_sphere_upright(w):
    """Inverse stereographic projection that keeps orientation: 0 goes to (0, 0, 1)."""
    return on_sphere(w) * [1, 1, -1]


def best_turned(points, other, weights):
    """points turned to lie as near to others as they can."""
    u, _, v = np.linalg.svd((other * weights[:, None]).T @ points)
    return points @ (u @ np.diag([1, 1, np.sign(np.linalg.det(u @ v))]) @ v).T


def areas_around(vertices, triangles):
    """(V) a third of the faces around each vertex."""
    a, b, c = vertices[triangles].transpose(1, 0, 2)
    share = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 6
    return np.bincount(triangles.ravel(), np.repeat(share, 3), minlength=len(vertices))


def from_spheroid_map(points, height):
    """The inverse of spheroid_map: from the unit sphere to x^2 + y^2 + (z / height)^2 = 1."""
    isometric = np.arctanh(np.clip(points[:, 2], -1 + 1e-16, 1 - 1e-16))
    low, high = np.full(len(points), -1.0), np.full(len(points), 1.0)
    e = np.sqrt(abs(height**2 - 1))
    for _ in range(80):  # the normal's latitude by halving
        sine = (low + high) / 2
        own = np.arctanh(sine) + (e * np.arctan(e * sine) if height > 1 else -e * np.arctanh(e * sine))
        low, high = np.where(own < isometric, sine, low), np.where(own < isometric, high, sine)
    cosine = np.sqrt(1 - sine**2)
    radius = cosine / np.hypot(cosine, height * sine)  # cosine of the parametric latitude
    across = points[:, :2] / np.maximum(np.linalg.norm(points[:, :2], axis=1, keepdims=True), 1e-300)
    return np.column_stack([radius[:, None] * across, height * np.sign(sine) * np.sqrt(1 - radius**2)])


def moved_sphere(points, move):
    """Points of the unit sphere under the Moebius map w -> (w - move) / (1 + conj(move) w / 2)."""
    w = in_plane(points)
    return on_sphere_upright((w - move) / (1 + np.conj(move) * w / 2))


def cap_through(points, inside):
    """The cap (4,) whose circle points lie on: center and radius as an angle; the points inside are not in it."""
    middle = points.mean(axis=0)
    _, _, v = np.linalg.svd(points - middle)
    normal = v[2] / np.linalg.norm(v[2])
    height = normal @ middle
    if (inside @ normal > height).mean() > 0.5:
        normal, height = -normal, -height
    return np.array([*normal, np.arccos(np.clip(height, -1, 1))])


def inversive(first, second):
    """Of two caps: what no Moebius map changes."""
    a, b = first[3], second[3]
    return (np.cos(a) * np.cos(b) - first[:3] @ second[:3]) / (np.sin(a) * np.sin(b))


def led_back(uv, layout):
    """The points of the sphere that UVs (n, 2) show, wherever the pattern continues."""
    uv = np.asarray(uv, float)
    if layout == "equirectangular":
        longitude, latitude = 2 * np.pi * uv[:, 0] - np.pi, np.pi * uv[:, 1] - np.pi / 2
        return np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)],
                        axis=-1)  # fmt: skip
    at = 2 * uv - 1
    for _ in range(6):  # half turns round the middles of the square's sides, until it is inside
        for axis in (0, 1):
            for side in (1, -1):
                over = side * at[:, axis] > 1
                middle = np.zeros(2)
                middle[axis] = side
                at[over] = 2 * middle - at[over]
    z = 1 - np.abs(at).sum(axis=1)
    x = np.where(z < 0, np.copysign(1 - np.abs(at[:, 1]), at[:, 0]), at[:, 0])
    y = np.where(z < 0, np.copysign(1 - np.abs(at[:, 0]), at[:, 1]), at[:, 1])
    back = np.stack([x, y, z], axis=-1)
    return back / np.linalg.norm(back, axis=-1, keepdims=True)
