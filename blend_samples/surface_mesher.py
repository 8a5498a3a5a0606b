"""Even triangle meshes of curved surfaces between smooth boundary curves.

The vertices of every boundary loop lie on the given curve; the inner ones start as a Poisson disk sample, are
joined by a constrained Delaunay triangulation in a plane chart, and then relaxed on the surface: edges are flipped
until opposite angles sum to at most pi, and vertices move to the density-weighted centroid of their triangles
[Du, Faber, Gunzburger 1999, "Centroidal Voronoi tessellations"; Alliez et al. 2005, section 3].
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mathutils import Vector, kdtree
from mathutils.geometry import delaunay_2d_cdt
from triangle_edges import area_vectors, corners, edge_keys, excess_angles, flip, inner_edges, largest_of_neighbours


@dataclass
class Surface:
    """A surface and its plane chart. All functions take and return arrays of points.

    chart: (n, 3) -> (n, 2); lift: (n, 2) -> (n, 3), its inverse; project: (n, 3) near the surface -> (n, 3) on it;
    spacing: (n, 3) -> (n,), the wished edge length.
    """

    chart: Callable
    lift: Callable
    project: Callable
    spacing: Callable


def mesh_surface(surface, outer, holes, rounds=60, seed=1):
    """Vertices (V, 3) and triangles (F, 3) between closed curves (n, 3) on the surface, the outer one and the holes.

    The triangles turn as the outer curve does in the chart when it runs counterclockwise.
    """
    rings = [surface.project(resample_closed(curve, surface.spacing)) for curve in [outer, *holes]]
    fixed = np.concatenate(rings)
    points = np.concatenate([fixed, _scatter(surface, rings, np.random.default_rng(seed))])
    triangles = _triangulate(surface.chart(points), rings, surface)
    for _ in range(rounds):
        triangles = _flip_to_delaunay(points, triangles)
        points[len(fixed) :] = _relaxed(surface, points, triangles)[len(fixed) :]
    points[len(fixed) :] = surface.project(points[len(fixed) :])
    return points, _flip_to_delaunay(points, triangles)


def refine(points, triangles, project):
    """Each triangle cut in four; midpoints of boundary edges by the four-point rule, so that the loops stay smooth."""
    edges, owners = np.unique(np.sort(corners(triangles), axis=1), axis=0, return_inverse=True)
    owners = owners.reshape(-1)
    middle = points[edges].mean(axis=1)
    on_loop = np.bincount(owners) == 1
    neighbours = [[] for _ in points]
    for a, b in edges[on_loop]:
        neighbours[a].append(b)
        neighbours[b].append(a)
    for e in np.flatnonzero(on_loop):
        a, b = edges[e]
        before, after = sum(neighbours[a]) - b, sum(neighbours[b]) - a
        middle[e] = (9 * (points[a] + points[b]) - points[before] - points[after]) / 16
    ab, bc, ca = len(points) + owners.reshape(3, -1)
    a, b, c = triangles.T
    parts = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return project(np.concatenate([points, middle])), np.concatenate([np.stack(part, axis=1) for part in parts])


def closed_spline(control, rounds=6):
    """Points of the closed uniform cubic B-spline with these control points, by repeated subdivision."""
    points = np.asarray(control, float)
    for _ in range(rounds):
        before, after = np.roll(points, 1, axis=0), np.roll(points, -1, axis=0)
        pairs = np.stack([(before + 6 * points + after) / 8, (points + after) / 2], axis=1)
        points = pairs.reshape(-1, points.shape[1])
    return points


def resample_closed(curve, spacing):
    """Points along a closed polyline (n, 3), their distances in proportion to spacing and as near to it as a whole
    number of steps allows."""
    ring = np.concatenate([curve, curve[:1]])
    steps = np.linalg.norm(np.diff(ring, axis=0), axis=1) / spacing((ring[1:] + ring[:-1]) / 2)
    length = np.concatenate([[0.0], np.cumsum(steps)])
    count = max(8, round(length[-1]))
    at = np.arange(count) * length[-1] / count
    return np.stack([np.interp(at, length, ring[:, k]) for k in range(ring.shape[1])], axis=1)


def _scatter(surface, rings, random):
    """A Poisson disk sample of the inside of the rings, with radius 0.8 spacing, that also keeps off the rings."""
    outlines = [surface.chart(ring) for ring in rings]
    fixed = np.concatenate(rings)
    rim_steps = np.linalg.norm(np.concatenate([np.diff(outline, axis=0) for outline in outlines[1:]]), axis=1)
    plane_step = np.percentile(rim_steps, 30) / 2
    low, high = outlines[0].min(axis=0), outlines[0].max(axis=0)
    grid = np.stack(np.meshgrid(*(np.arange(a, b, plane_step) for a, b in zip(low, high))), axis=-1).reshape(-1, 2)
    grid = grid[_inside(grid, outlines)]
    candidates = surface.lift(grid + random.uniform(-0.2, 0.2, grid.shape) * plane_step)
    radius = 0.8 * surface.spacing(candidates)
    tree = kdtree.KDTree(len(candidates))
    for i, p in enumerate(candidates.tolist()):
        tree.insert(p, i)
    tree.balance()
    free = np.ones(len(candidates), bool)
    for p, r in zip(fixed.tolist(), 0.75 * surface.spacing(fixed)):
        free[[i for _, i, _ in tree.find_range(p, r)]] = False
    chosen = []
    for i in random.permutation(len(candidates)):
        if free[i]:
            chosen.append(i)
            free[[j for _, j, _ in tree.find_range(candidates[i], radius[i])]] = False
    return candidates[chosen]


def _inside(points, outlines):
    """Which plane points lie in the first outline and in none of the others, by the parity of ray crossings."""
    inside = np.zeros(len(points), bool)
    x, y = points.T
    for outline in outlines:
        for (ax, ay), (bx, by) in zip(outline, np.roll(outline, -1, axis=0)):
            if ay != by:
                inside ^= ((ay > y) != (by > y)) & (x < ax + (y - ay) * (bx - ax) / (by - ay))
    return inside


def _triangulate(plane, rings, surface):
    """Constrained Delaunay triangles of plane points, the first of which are the rings in order; only those between
    the rings, counterclockwise."""
    starts = np.cumsum([0] + [len(ring) for ring in rings])
    edges = [(int(s + i), int(s + (i + 1) % (e - s))) for s, e in zip(starts, starts[1:]) for i in range(e - s)]
    result = delaunay_2d_cdt([Vector(p) for p in plane.tolist()], edges, [], 0, 1e-12)
    origin = np.array([ids[0] for ids in result[3]])
    if len(origin) != len(plane):
        raise ValueError("boundary curves cross or touch in the chart")
    triangles = origin[np.array(result[2])]
    outlines = [surface.chart(ring) for ring in rings]
    return triangles[_inside(plane[triangles].mean(axis=1), outlines)]


def _flip_to_delaunay(points, triangles, limit=50):
    """Inner edges flipped, independent ones at a time, until the two angles that face each sum to at most pi."""
    triangles = triangles.copy()
    for _ in range(limit):
        flips = _flippable(points, triangles)
        if not len(flips[0]):
            break
        flip(triangles, *flips)
    return triangles


def _flippable(points, triangles):
    """Edges to flip, no two with a triangle in common: left and right triangle, ends a and b, apexes c and d."""
    left, right, a, b, c, d = inner_edges(triangles, len(points))
    excess = excess_angles(points, a, b, c, d)
    folds = np.minimum(_same_side(points, (a, b, c), (a, d, c)), _same_side(points, (a, b, c), (d, b, c)))
    key = edge_keys(*corners(triangles).T, len(points))
    excess[(folds <= 0) | np.isin(edge_keys(c, d, len(points)), key)] = 0.0
    chosen = largest_of_neighbours(excess, left, right, len(triangles))
    return [x[chosen] for x in (left, right, a, b, c, d)]


def _same_side(points, one, other):
    """Inner product of the two triangles' area vectors."""
    return np.sum(area_vectors(points, np.stack(one, axis=1)) * area_vectors(points, np.stack(other, axis=1)), axis=1)


def _relaxed(surface, points, triangles):
    """Every vertex at the centroid of its triangles, each weighted by area / spacing^4, moved back to the surface."""
    centers = points[triangles].mean(axis=1)
    weight = np.linalg.norm(area_vectors(points, triangles), axis=1) / surface.spacing(centers) ** 4
    moved = np.zeros_like(points)
    total = np.zeros(len(points))
    for k in range(3):
        total += np.bincount(triangles[:, k], weight, len(points))
        for axis in range(3):
            moved[:, axis] += np.bincount(triangles[:, k], weight * centers[:, axis], len(points))
    return surface.project(moved / total[:, None])
