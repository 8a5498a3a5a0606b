#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How exact are the circles of a polyhedron itself? Domains whose circles are known are lifted to surfaces. The faces
of each mesh are then cut in four, in their own planes, again and again: the same polyhedron on finer and finer meshes.

    bench/doc_figures.py measure polyhedron

The limit is the circle domain of the polyhedron. Its error is compared with its first variation (Hadamard's): chords
instead of arcs move the rim inwards, by a twelfth of its geodesic curvature times the square of the chord in the mean
(docs/numerics.md, "The angles", N4).
"""

from functools import cache

import mesh_regions
import numpy as np
import random_surfaces
import table_surfaces

FACES = 16000
CUTS = 3  # the finest mesh has 4 ** CUTS times as many faces
DRAWN = 4  # holes of a random domain
MODES, SAMPLES = 24, 200  # of the first variation: powers about each centre, points on each circle

FIVE_CIRCLES = ((0.0, 1.0), (0.45 + 0.25j, 0.18), (-0.4 + 0.35j, 0.22), (-0.1 - 0.5j, 0.2), (0.42 - 0.4j, 0.12))


def drawn_circles(seed):
    """The unit circle and holes in it at random, apart from each other by the smaller radius at least."""
    rng, found = np.random.default_rng(seed), [(0.0, 1.0)]
    while len(found) <= DRAWN:
        center, radius = complex(*rng.uniform(-0.8, 0.8, 2)), rng.uniform(0.1, 0.25)
        fits = abs(center) + 1.5 * radius < 1.0
        if fits and all(abs(center - c) > radius + r + min(radius, r) for c, r in found[1:]):
            found.append((center, radius))
    return tuple(found)


# ---------------------------------------------------------------- surfaces


def plane(z):
    return np.column_stack([z.real, z.imag, 0.0 * z.real])


def polynomial(z):
    return plane(z + 0.3 * z**2 + 0.05j * z**3)


def sphere(z):
    s = 1.0 + abs(z) ** 2
    return np.column_stack([2.0 * z.real / s, 2.0 * z.imag / s, 2.0 / s - 1.0])


def enneper(z):
    w = np.conj(z) - z**3 / 3.0  # of points of the surface: u + u v^2 - u^3 / 3, -(v + v u^2 - v^3 / 3)
    return np.column_stack([w.real, -w.imag, (z**2).real])


# The conformal immersion, and the derivative in z of the logarithm of its scale, twice.
LIFTS = {
    "plane": (plane, lambda z: 0.0 * z),
    "polynomial": (polynomial, lambda z: (0.6 + 0.3j * z) / (1.0 + 0.6 * z + 0.15j * z**2)),
    "sphere": (sphere, lambda z: -2.0 * np.conj(z) / (1.0 + abs(z) ** 2)),
    "Enneper": (enneper, lambda z: 2.0 * np.conj(z) / (1.0 + abs(z) ** 2)),
}


@cache
def meshed(circles, faces=FACES):
    """Complex points (V), the circles' first, triangles (F, 3), and the number of points on each circle."""
    area = np.pi * (2.0 - sum(r**2 for _, r in circles))
    h = np.sqrt(4.0 * area / (np.sqrt(3.0) * faces))
    counts = [max(8, round(2.0 * np.pi * r / h)) for _, r in circles]
    rims = [c + r * np.exp(2j * np.pi * np.arange(n) / n) for (c, r), n in zip(circles, counts)]
    polygons = [np.column_stack([rim.real, rim.imag]) for rim in rims]
    points, triangles = table_surfaces.planar_mesh(polygons, (faces + sum(counts)) // 2)
    return points @ [1.0, 1j], triangles, counts


# ---------------------------------------------------------------- measured


def inversive_distances(circles):
    """Of all pairs of circles (center, radius): no Moebius map changes them."""
    pairs = [(a, b) for i, a in enumerate(circles) for b in circles[:i]]
    return np.array([abs(abs(c - e) ** 2 - r**2 - s**2) / (2.0 * r * s) for (c, r), (e, s) in pairs])


def relative(found, circles):
    return inversive_distances(found) / inversive_distances(circles) - 1.0


def circles_found(koebe, points, triangles, counts):
    """In the order of the domain's circles, which the first vertex of each tells."""
    result = koebe.uniformize(points, triangles, tolerance=1e-9)
    rank = {int(v): k for k, loop in enumerate(result.loops) for v in loop}
    ranks = [rank[int(first)] for first in np.cumsum([0, *counts[:-1]])]
    return [(complex(*result.centers[k]), float(result.radii[k])) for k in ranks]


def rims_refined(points, triangles):
    """Each face with one edge on the boundary cut in two, by the middle of that edge: points, triangles."""
    on_rim = {tuple(edge) for edge in mesh_regions.boundary_edges(triangles).tolist()}
    added, faces = [], []
    for a, b, c in triangles.tolist():
        start = next(((u, v, w) for u, v, w in ((a, b, c), (b, c, a), (c, a, b)) if (u, v) in on_rim), None)
        if start is None:
            faces.append((a, b, c))
            continue
        u, v, w = start
        middle = len(points) + len(added)
        added.append((points[u] + points[v]) / 2.0)
        faces += [(u, middle, w), (middle, v, w)]
    return np.vstack([points, added]), np.array(faces, np.int32)


def refined_errors(koebe, lift, circles, faces=FACES, cuts=CUTS):
    """Relative errors of the inversive distances (cuts + 2, pairs): on the mesh, with finer rims, with its faces cut
    again and again."""
    plane_points, triangles, counts = meshed(circles, faces)
    points, errors = LIFTS[lift][0](plane_points), []
    finer = rims_refined(points, triangles)
    for cut in range(cuts + 1):
        if cut:
            points, triangles = random_surfaces.cut_in_four(points, triangles)
        errors.append(relative(circles_found(koebe, points, triangles, counts), circles))
    errors.insert(1, relative(circles_found(koebe, *finer, counts), circles))
    return np.array(errors)


# ---------------------------------------------------------------- predicted


def first_variation(circles, inward):
    """What a small move of the rims does to the circles: centres and radii. `inward` has the move to the centre at
    SAMPLES points of each circle. z + F maps the moved domain to circles, F holomorphic: Re (F / n) - inward =
    Re (a / n) + b on each rim, n its normal, a and b the changes of centre and radius; both 0 for the unit circle."""
    turn = np.exp(2j * np.pi * np.arange(SAMPLES) / SAMPLES)
    rows = []
    for k, (center, radius) in enumerate(circles):
        z = center + radius * turn
        basis = [z**m for m in range(MODES)]
        basis += [((z - c) / r) ** -m for c, r in circles[1:] for m in range(1, MODES)]
        columns = [(unit * column / turn).real for column in basis for unit in (1.0, 1j)]
        for j in range(1, len(circles)):
            on = float(j == k)
            columns += [-on * (1.0 / turn).real, -on * (1j / turn).real, -on * np.ones(SAMPLES)]
        rows.append(np.column_stack(columns))
    found = np.linalg.lstsq(np.vstack(rows), np.concatenate(inward), rcond=None)[0]
    change = found[-3 * (len(circles) - 1) :].reshape(-1, 3)
    return [circles[0]] + [(c + complex(a, b), r + s) for (c, r), (a, b, s) in zip(circles[1:], change)]


def predicted_errors(lift, circles, faces=FACES):
    """Of the polyhedron, from its rims alone: chords for arcs."""
    counts, turn = meshed(circles, faces)[2], np.exp(2j * np.pi * np.arange(SAMPLES) / SAMPLES)
    inward = []
    for (center, radius), count in zip(circles, counts):
        curvature = 1.0 / radius + (turn * LIFTS[lift][1](center + radius * turn)).real
        inward.append((2.0 * np.pi * radius / count) ** 2 / 12.0 * curvature)
    return relative(first_variation(circles, inward), circles)


# ---------------------------------------------------------------- table


DOMAINS = {"five circles": FIVE_CIRCLES, "drawn circles": drawn_circles(1)}
ROWS = [f"{domain}, {lift}" for domain in DOMAINS for lift in LIFTS]
HEAD = [
    "domain, surface", "faces as given", "rim faces in 2", "each in 4", "in 16", "in 64",
    "limit: the polyhedron", "first variation",
]  # fmt: skip


def polyhedron_limit(errors):
    """For ever finer meshes on the same faces: the error of a mesh goes with h^2."""
    return errors[-1] + (errors[-1] - errors[-2]) / 3.0


def cells(koebe, row):
    """Each error is the largest of all pairs of circles."""
    domain, lift = row.rsplit(", ", 1)
    circles = DOMAINS[domain]
    errors = refined_errors(koebe, lift, circles)
    limit = polyhedron_limit(errors)
    return [f"{abs(error).max():.1e}" for error in (*errors, limit, predicted_errors(lift, circles))]
