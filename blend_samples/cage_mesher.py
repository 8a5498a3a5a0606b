"""Quad meshes of implicit surfaces: a cage of few quads, extruded as modellers do, then subdivided by the rule of
Catmull and Clark (1978) and moved onto the surface, level by level.

A ring is a closed run of vertices, counterclockwise as seen from where the tube that it ends goes on. A patch is a
grid of vertices (rows, columns) whose quads are the cage's; seen from outside, columns run to the right and rows up.
"""

import numpy as np

GRAIN = 2.0**-14  # coordinates are multiples of it: the same in every version of NumPy, and mirror images to the bit


class Cage:
    """Vertices and quads in the making.

    points   their coordinates, a list of (x, y, z)
    quads    a list of four vertices each, counterclockwise as seen from outside
    """

    def __init__(self):
        self.points, self.quads = [], []

    def add(self, points):
        """New vertices; returns their numbers in the shape of the array (..., 3)."""
        points = np.asarray(points, float)
        first = len(self.points)
        self.points.extend(points.reshape(-1, 3).tolist())
        return np.arange(first, len(self.points)).reshape(points.shape[:-1])

    def box(self, sizes, place):
        """The surface of a block of cells, sizes (a, b, c); place maps points (n, 3) of [-1, 1]^3 to where they go.

        Returns its six patches by name: left, right (x low, high), front, back (y), bottom, top (z).
        """
        a, b, c = sizes
        grid = np.stack(np.meshgrid(*(np.linspace(-1.0, 1.0, n + 1) for n in sizes), indexing="ij"), axis=-1)
        outer = (np.abs(grid) == 1.0).any(axis=-1)
        ids = np.full((a + 1, b + 1, c + 1), -1)
        ids[outer] = self.add(place(grid[outer]))
        patches = {
            "left": ids[0, ::-1].T, "right": ids[-1].T, "front": ids[:, 0].T, "back": ids[::-1, -1].T,
            "bottom": ids[:, ::-1, 0].T, "top": ids[:, :, -1].T,
        }  # fmt: skip
        for patch in patches.values():
            self.fill(patch)
        return patches

    def fill(self, patch):
        """The quads of a patch."""
        corners = patch[:-1, :-1], patch[:-1, 1:], patch[1:, 1:], patch[1:, :-1]
        self.quads.extend(np.stack(corners, axis=-1).reshape(-1, 4).tolist())

    def open(self, patch):
        """Take a patch's quads away; returns the ring around the hole, from the patch's first vertex."""
        gone = set(map(frozenset, _quads_of(patch)))
        self.quads = [quad for quad in self.quads if frozenset(quad) not in gone]
        return np.concatenate([patch[0, :-1], patch[:-1, -1], patch[-1, :0:-1], patch[:0:-1, 0]])

    def tube(self, ring, sections):
        """A tube from a ring through sections (each (n, 3), point by point above the ring's); returns all its rings."""
        rings = [ring, *(self.add(section) for section in sections)]
        for low, high in zip(rings, rings[1:]):
            self.quads.extend(np.stack([low, np.roll(low, -1), np.roll(high, -1), high], axis=1).tolist())
        return np.array(rings)

    def cap(self, ring, columns, rows, shift=0):
        """Close a ring of 2 (columns + rows) vertices; its vertex `shift` is the patch's first. Returns the patch."""
        ring = np.roll(ring, -shift)
        patch = np.full((rows + 1, columns + 1), -1)
        patch[0, :-1], rest = ring[:columns], ring[columns:]
        patch[:-1, -1], rest = rest[:rows], rest[rows:]
        patch[-1, :0:-1], patch[:0:-1, 0] = rest[:columns], rest[columns:]
        points = np.array(self.points)
        for i in range(1, rows):
            for j in range(1, columns):
                s, t = j / columns, i / rows
                across = (1 - s) * points[patch[i, 0]] + s * points[patch[i, -1]]
                along = (1 - t) * points[patch[0, j]] + t * points[patch[-1, j]]
                patch[i, j] = self.add((across + along) / 2)
        self.fill(patch)
        return patch

    def mesh(self, project, relaxing=(12, 8, 4)):
        """Points (V, 3) and quads (F, 4), moved onto the surface by project and relaxed so many times at each level:
        one level more than subdivisions."""
        used, quads = np.unique(np.array(self.quads), return_inverse=True)
        points, quads = np.array(self.points)[used], quads.reshape(-1, 4)
        for level, rounds in enumerate(relaxing):
            points, quads = catmull_clark(points, quads) if level else (points, quads)
            for _ in range(rounds):
                points = project(relaxed(points, quads))
        for _ in range(60):
            points = unfolded(points, quads)
        return np.round(points / GRAIN) * GRAIN, quads


def _quads_of(patch):
    return np.stack([patch[:-1, :-1], patch[:-1, 1:], patch[1:, 1:], patch[1:, :-1]], axis=-1).reshape(-1, 4).tolist()


def oval(count, columns, rows, shift=0):
    """Plane points (count, 2) of the unit circle for the vertices of a ring that a patch of these sizes would close:
    its corners lie at 45 degrees."""
    ends = np.cumsum([0, columns, rows, columns, rows])
    turn = np.interp((np.arange(count) - shift) % count, ends, -0.75 * np.pi + np.pi / 2 * np.arange(5))
    return np.stack([np.cos(turn), np.sin(turn)], axis=1)


def section(outline, center, right, up):
    """An outline (n, 2) of the plane in space: center + x right + y up."""
    center, right, up = (np.asarray(vector, float) for vector in (center, right, up))
    return center + outline[:, :1] * right + outline[:, 1:] * up


def limb_sections(outline, joints, radii, right, count, side=1):
    """Sections of a limb through joints (n, 3), counted from the one after the first: at even steps along a smooth
    curve, `count` of them, as wide as radii (n, 2) say: to the right, which is a direction, and upwards. With side -1
    all of it is mirrored in x."""
    centers, widths = (smooth_rows(np.asarray(values, float), count) for values in (joints, radii))
    ahead = np.gradient(centers, axis=0)
    ahead /= np.linalg.norm(ahead, axis=1)[:, None]
    ups = np.cross(ahead, np.asarray(right, float))
    ups /= np.linalg.norm(ups, axis=1)[:, None]
    rights = side * np.cross(ups, ahead)
    mirror = np.array([side, 1.0, 1.0])
    return [
        section(outline, mirror * center, width[0] * mirror * across, width[1] * mirror * up)
        for center, width, across, up in zip(centers[1:], widths[1:], rights[1:], ups[1:])
    ]


def smooth_rows(values, count):
    """count + 1 rows at even steps from the first row to the last, the line between them rounded at its corners."""
    at = np.linspace(0.0, len(values) - 1.0, 40 * len(values))
    fine = np.stack([np.interp(at, np.arange(len(values)), column) for column in values.T], axis=1)
    reach = 36
    padded = np.concatenate([2 * fine[0] - fine[reach:0:-1], fine, 2 * fine[-1] - fine[-2 : -reach - 2 : -1]])
    kernel = np.hanning(2 * reach + 1)
    fine = np.stack([np.convolve(column, kernel / kernel.sum(), "valid") for column in padded.T], axis=1)
    steps = np.linspace(0, len(fine) - 1, count + 1)
    return np.stack([np.interp(steps, np.arange(len(fine)), column) for column in fine.T], axis=1)


def edges_of(quads):
    """Edges (E, 2), for each corner of each quad the edge to the next one (F, 4), and of each edge the number of its
    quads."""
    ends = np.sort(np.stack([quads, np.roll(quads, -1, axis=1)], axis=-1).reshape(-1, 2), axis=1)
    edges, owner, uses = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    return edges, owner.reshape(quads.shape), uses


def _sum_at(index, values, count):
    return np.stack([np.bincount(index, values[:, k], count) for k in range(3)], axis=1)


def catmull_clark(points, quads):
    """One subdivision; boundary edges by the cubic B-spline rule."""
    count = len(points)
    edges, owner, uses = edges_of(quads)
    middles, centers = points[edges].mean(axis=1), points[quads].mean(axis=1)
    rim = uses == 1
    beside = _sum_at(owner.ravel(), np.repeat(centers, 4, axis=0), len(edges))
    edge_points = np.where(rim[:, None], middles, (2 * middles + beside) / 4)
    valence = np.bincount(edges.ravel(), minlength=count)[:, None]
    faces_at = np.bincount(quads.ravel(), minlength=count)[:, None]
    around = _sum_at(quads.ravel(), np.repeat(centers, 4, axis=0), count) / faces_at
    along = _sum_at(edges.ravel(), np.repeat(middles, 2, axis=0), count) / valence
    moved = (around + 2 * along + (valence - 3) * points) / valence
    on_rim = np.zeros(count, bool)
    on_rim[edges[rim]] = True
    rim_sum = _sum_at(edges[rim].ravel(), np.repeat(middles[rim], 2, axis=0), count)
    moved[on_rim] = points[on_rim] / 2 + rim_sum[on_rim] / 4
    a = count + np.arange(len(edges))[owner]
    middle = count + len(edges) + np.arange(len(quads))
    parts = [np.stack([quads[:, k], a[:, k], middle, a[:, k - 1]], axis=1) for k in range(4)]
    return np.concatenate([moved, edge_points, centers]), np.concatenate(parts)


def relaxed(points, quads, step=0.5):
    """Every inner vertex moved to the mean of its quads' centers by a step, along the surface alone; a vertex of the
    rim stays."""
    count = len(points)
    edges, _, uses = edges_of(quads)
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    normals = np.cross(c - a, d - b)
    weight = np.linalg.norm(normals, axis=1)
    total = np.bincount(quads.ravel(), np.repeat(weight, 4), count)
    centers = (a + b + c + d) / 4
    wished = _sum_at(quads.ravel(), np.repeat(centers * weight[:, None], 4, axis=0), count) / total[:, None]
    normal = _sum_at(quads.ravel(), np.repeat(normals, 4, axis=0), count)
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    move = wished - points
    move -= np.sum(move * normal, axis=1)[:, None] * normal
    move[edges[uses == 1]] = 0.0
    return points + step * move


def unfolded(points, quads):
    """Vertices of quads that are folded onto a neighbour, as in a crease narrower than a quad, moved to the mean of
    their quads' centers; the crease is filled a little."""
    _, owner, _ = edges_of(quads)
    a, b, c, d = (points[quads[:, k]] for k in range(4))
    normals = np.cross(c - a, d - b)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    order = np.argsort(owner.ravel(), kind="stable")
    edge, face = owner.ravel()[order], order // 4
    twin = np.flatnonzero(edge[1:] == edge[:-1])
    left, right = face[twin], face[twin + 1]
    sharp = np.sum(normals[left] * normals[right], axis=1) < 0.3
    moving = np.unique(quads[np.concatenate([left[sharp], right[sharp]])])
    at = np.bincount(quads.ravel(), minlength=len(points))[:, None]
    means = _sum_at(quads.ravel(), np.repeat((a + b + c + d) / 4, 4, axis=0), len(points)) / at
    moved = points.copy()
    moved[moving] = means[moving]
    return moved
