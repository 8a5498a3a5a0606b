"""Surfaces whose maps to a torus or an annulus are known: flat cells with round holes, and their conformal lifts."""

import numpy as np


def merged(points, triangles, digits=9):
    """Points that coincide made one."""
    _, first, number = np.unique(np.round(points, digits), axis=0, return_index=True, return_inverse=True)
    return points[first], number.reshape(-1)[triangles], first


def cell(corner, size, steps, hole=None, circle=None):
    """A square, (n, 2) points and (m, 3) faces; with a hole (center, radius) rays run from its circle to the sides.

    circle: another rim of the hole, a function of the directions (n, 2) from the center.
    """
    side = np.arange(steps) / steps
    if hole is None:
        x, y = np.meshgrid(np.arange(steps + 1) / steps, np.arange(steps + 1) / steps, indexing="ij")
        points = corner + size * np.column_stack([x.ravel(), y.ravel()])
        width = steps + 1
        ring = steps
    else:
        zero, one = np.zeros(steps), np.ones(steps)
        outline = np.concatenate(
            [np.column_stack(p) for p in ((side, zero), (one, side), (1 - side, one), (zero, 1 - side))]
        )
        outline = corner + size * outline
        arm = outline - hole[0]
        arm /= np.linalg.norm(arm, axis=1, keepdims=True)
        rim = circle(arm) if circle else hole[0] + hole[1] * arm
        layers = max(2, steps // 2)
        share = (np.arange(layers + 1) / layers)[:, None, None]
        points = ((1 - share) * rim + share * outline).reshape(-1, 2)
        width, ring = len(outline), len(outline)
    faces = []
    for i in range(len(points) // width - 1):
        for j in range(ring):
            a, b = i * width + j, i * width + (j + 1) % width
            c, d = a + width, b + width
            faces += [(a, c, d), (a, d, b)] if (i + j) % 2 else [(a, c, b), (b, c, d)]
    return points, np.array(faces)


def torus_radii(ratio):
    """R and r of the torus of revolution whose periods are 2 pi and 2 pi * ratio, ratio = r / sqrt(R^2 - r^2)."""
    return 1.0, ratio / np.hypot(1.0, ratio)


def torus_point(flat, ratio):
    """Conformal from the plane, 2 pi and 2 pi * ratio being the periods, to the torus of revolution."""
    big, small = torus_radii(ratio)
    eta = flat[:, 1] / (2.0 * ratio)
    phi = 2.0 * np.arctan2(np.sqrt(big + small) * np.sin(eta), np.sqrt(big - small) * np.cos(eta))
    radius = big + small * np.cos(phi)
    return np.column_stack([radius * np.cos(flat[:, 0]), radius * np.sin(flat[:, 0]), small * np.sin(phi)])


def holed_torus(steps, columns=4, rows=3, holes=None):
    """A torus of revolution of columns * rows square cells with round holes in some.

    holes: {(column, row): (center in the cell, radius)} in units of a cell.
    Gives vertices, triangles, tau, and the circles: centers (n, 2) and radii (n,) with the cell's width as 1 / columns.
    """
    if holes is None:
        holes = {(0, 0): ((0.5, 0.5), 0.3), (2, 1): ((0.45, 0.55), 0.2), (1, 2): ((0.5, 0.42), 0.35)}
    size = 2.0 * np.pi / columns
    points, faces, circles = [], [], []
    for i in range(columns):
        for j in range(rows):
            hole = holes.get((i, j))
            corner = size * np.array([i, j], float)
            if hole:
                hole = (corner + size * np.array(hole[0]), size * hole[1])
                circles.append((*hole[0], hole[1]))
            p, f = cell(corner, size, steps, hole)
            faces.append(f + sum(map(len, points)))
            points.append(p)
    points, faces = np.concatenate(points), np.concatenate(faces)
    lifted = torus_point(points, rows / columns)
    vertices, triangles, _ = merged(lifted, faces)
    circles = np.array(circles).reshape(-1, 3) / (2.0 * np.pi)
    return vertices, triangles.astype(np.int32), 1j * rows / columns, circles


def on_sphere(w):
    """Inverse stereographic projection."""
    square = np.abs(w) ** 2
    return np.column_stack([2 * w.real, 2 * w.imag, square - 1]) / (1 + square)[:, None]


def annulus_point(flat):
    """From the cylinder with the period 1, v from the outer rim on, to the round annulus."""
    return np.exp(2j * np.pi * (flat[:, 0] + 1j * flat[:, 1]))


def patchwork(columns, rows, make):
    """Points and faces of cells side by side; make(i, j, corner) gives those of one, and one more array."""
    parts = [make(i, j, np.array([i, j]) / columns) for i in range(columns) for j in range(rows)]
    begin = np.cumsum([0] + [len(part[0]) for part in parts])
    faces = np.concatenate([part[1] + first for part, first in zip(parts, begin, strict=False)])
    return np.concatenate([part[0] for part in parts]), faces, np.concatenate([part[2] for part in parts])


def holed_ring(steps, columns=5, rows=2, holes=None):
    """A round annulus of columns * rows cells, square in the cylinder, with holes, and lifted to the unit sphere.

    holes: {(column, row): (center in the cell, radius)}; they are round in the annulus, the radius being that of the
    cylinder times the scale of the exponential at the center. Gives vertices, triangles, the height over the period,
    for each vertex its place in the cylinder, and the circles: complex centers (n,) and radii (n,).
    """
    circles = []

    def make(i, j, corner):
        hole = (holes or {}).get((i, j))
        if hole is None:
            points, faces = cell(corner, 1 / columns, steps)
        else:
            center = corner + np.array(hole[0]) / columns
            middle = annulus_point(center[None])[0]
            radius = 2 * np.pi * abs(middle) * hole[1] / columns
            circles.append((middle, radius))

            def rim(arm):
                z = np.log1p(2j * np.pi * hole[1] / columns * (arm @ (1, 1j))) / (2j * np.pi)
                return center + np.column_stack([z.real, z.imag])

            points, faces = cell(corner, 1 / columns, steps, (center, hole[1] / columns), rim)
        return points, faces, np.zeros(len(points))

    flat, faces, _ = patchwork(columns, rows, make)
    vertices, triangles, first = merged(on_sphere(annulus_point(flat)), faces)
    centers, radii = np.array([c for c, _ in circles], complex), np.array([r for _, r in circles])
    return vertices, triangles.astype(np.int32), rows / columns, flat[first], (centers, radii)


def slit_cell(corner, size, steps, middle, half, upright):
    """As `cell`, round a slit: confocal ellipses near it. Gives the side of each point too: 0 off the slit."""
    outline = cell(corner, size, steps, (corner + size / 2, size / 4))[0][-4 * steps :] @ (1, 1j)
    turn = 1j if upright else 1.0
    angle = np.angle((outline - middle) / turn)
    depth, outer = max(2, steps // 2), 0.5
    layers = [middle + half * turn * np.cosh(outer * i / depth + 1j * angle) for i in range(depth + 1)]
    layers += [layers[depth] + (outline - layers[depth]) * i / depth for i in range(1, depth + 1)]
    points, count = np.concatenate(layers), len(outline)
    side = np.zeros(len(points))
    side[:count] = np.sin(angle)
    i, j = (grid.ravel() for grid in np.meshgrid(np.arange(2 * depth), np.arange(count), indexing="ij"))
    a, b = i * count + j, i * count + (j + 1) % count
    faces = np.concatenate([np.column_stack([a, a + count, b]), np.column_stack([b, a + count, b + count])])
    return np.column_stack([points.real, points.imag]), faces, side


def opened_slit_ring(steps, upright, columns=4, rows=2):
    """A round annulus with a slit along its radius (upright) or along an arc, opened by Joukowski's map and lifted to
    the sphere: there the slit is a smooth hole. Gives vertices, triangles, the height over the period, and the middle
    and half the length of the slit in the cylinder.
    """
    middle, half = complex(0.47, 0.53) / columns, 0.3 / columns

    def make(i, j, corner):
        if (i, j) == (0, 0):
            return slit_cell(corner, 1 / columns, steps, middle, half, upright)
        points, faces = cell(corner, 1 / columns, steps)
        return points, faces, np.zeros(len(points))

    flat, faces, side = patchwork(columns, rows, make)
    z = annulus_point(flat - (middle.real, 0))  # the slit round the real axis
    if upright:
        low, high = np.exp(-2 * np.pi * (middle.imag + half)), np.exp(-2 * np.pi * (middle.imag - half))
        t = (low + high - 2 * z) / (high - low)
    else:
        rho = np.exp(-2 * np.pi * middle.imag)
        t = (z - rho) / (z + rho) / (1j * np.tan(np.pi * half))
    w = t + np.sqrt(t - 1) * np.sqrt(t + 1)
    on_slit = side != 0
    t = np.clip(t.real, -1, 1)
    w[on_slit] = (t + 1j * np.sign(side) * np.sqrt(1 - t**2))[on_slit]
    vertices, triangles, _ = merged(on_sphere(w), faces)
    return vertices, triangles.astype(np.int32), rows / columns, middle, half


def damaged(random, vertices, triangles, noise=0.03):
    """A surface with some of what happens to meshes, its vertices moved by up to about `noise`."""
    vertices, triangles = vertices.copy(), triangles.copy()
    if random.random() < 0.5:
        vertices *= np.exp(random.normal(0, random.uniform(0, 1.5), 3))
    if random.random() < 0.5:
        vertices += random.normal(0, random.uniform(0, noise), vertices.shape)
    if random.random() < 0.5:
        triangles = np.delete(triangles, random.choice(len(triangles), random.integers(1, 12), replace=False), 0)
    if random.random() < 0.2:
        face = random.integers(0, len(triangles))
        triangles[face] = triangles[face][[0, 2, 1]]
    if random.random() < 0.1:
        vertices = np.round(vertices, 1)
    if random.random() < 0.1:
        vertices[random.integers(0, len(vertices))] = vertices[random.integers(0, len(vertices))]
    if random.random() < 0.1:
        vertices[random.integers(0, len(vertices))] = np.nan
    if random.random() < 0.15:
        vertices *= 10.0 ** random.uniform(-300, 150)
    if random.random() < 0.1:
        vertices = np.concatenate([vertices, vertices[:2]])
    return vertices, triangles


def renumbered(vertices, triangles, seed=5):
    """The surface turned and 1e5 times as large, its vertices and faces in another order. Also the new number of each
    vertex, and the turn (3, 3): rows @ turn.T."""
    random = np.random.default_rng(seed)
    order = random.permutation(len(vertices))
    number = np.argsort(order)
    turn = np.linalg.qr(random.normal(size=(3, 3)))[0]
    turn *= np.sign(np.linalg.det(turn))
    return 1e5 * vertices[order] @ turn.T, number[triangles][::-1].astype(np.int32), number, turn
