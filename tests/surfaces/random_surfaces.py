# SPDX-License-Identifier: GPL-3.0-or-later
"""Random surfaces of many kinds, small and unkind: genus 0, connected, at least one loop. NumPy alone.

    make(kind, seed) -> vertices (V, 3), triangles (F, 3), or None if nothing is left

A kind draws points and triangles; `bordered_part` keeps the largest part that is a manifold with a boundary.
"""

from collections import defaultdict

import numpy as np

# ---------------------------------------------------------------- triangulations


def convex_hull(points):
    """Triangles of the hull of points (n, 3), outward, by adding one after the other."""
    middle = points[:4].mean(axis=0)
    faces = np.array([[0, 1, 2], [0, 3, 1], [1, 3, 2], [0, 2, 3]])
    if np.linalg.det(points[1:4] - points[0]) > 0:
        faces = faces[:, ::-1]
    for v in range(4, len(points)):
        a, b, c = points[faces.T]
        normal = np.cross(b - a, c - a)
        seen = ((points[v] - a) * normal).sum(axis=1) > 0
        edges = {(f[k], f[(k + 1) % 3]) for f in faces[seen].tolist() for k in range(3)}
        rim = sorted(edge for edge in edges if edge[::-1] not in edges)
        new = np.array([(*edge, v) for edge in rim]).reshape(-1, 3).astype(int)
        faces = np.concatenate([faces[~seen], new])
    a, b, c = points[faces.T]
    assert (((a - middle) * np.cross(b - a, c - a)).sum(axis=1) > -1e-9).all()
    return faces


def delaunay(plane):
    """The Delaunay triangulation of points (n, 2), counterclockwise: the lower hull on the paraboloid."""
    lifted = np.column_stack([plane, (plane**2).sum(axis=1)])
    faces = convex_hull(lifted)
    a, b, c = lifted[faces.T]
    lower = np.cross(b - a, c - a)[:, 2] < 0
    return faces[lower][:, ::-1]


def bordered_part(vertices, faces):
    """The largest part that is connected by edges, has one fan around each vertex, and a boundary; None if there is
    none."""
    faces = np.asarray(faces)
    while len(faces):
        beside = defaultdict(list)
        for f, face in enumerate(faces.tolist()):
            for k in range(3):
                beside[frozenset((face[k], face[(k + 1) % 3]))].append(f)
        surplus = [f for owners in beside.values() for f in owners[2:]]
        if surplus:
            faces = np.delete(faces, sorted(set(surplus)), axis=0)
            continue
        pairs = [(owners, edge) for edge, owners in beside.items() if len(owners) == 2]
        parts = components(range(len(faces)), [owners for owners, _ in pairs])
        if len(parts) > 1:
            faces = faces[sorted(max(parts, key=len))]
            continue
        fans = components(
            [(f, v) for f, face in enumerate(faces.tolist()) for v in face],
            [((f, v), (g, v)) for (f, g), edge in pairs for v in edge],
        )
        at = defaultdict(list)
        for fan in fans:
            at[fan[0][1]].append(fan)
        lost = {f for several in at.values() for fan in sorted(several, key=len)[:-1] for f, _ in fan}
        if not lost:
            if len(pairs) == len(beside):
                return None
            used, index = np.unique(faces, return_inverse=True)
            return np.array(vertices, float)[used], index.reshape(-1, 3).astype(np.int32)
        faces = np.delete(faces, sorted(lost), axis=0)
    return None


def components(members, links):
    """Lists of members that links join."""
    root = {m: m for m in members}

    def find(m):
        while root[m] != m:
            root[m] = root[root[m]]
            m = root[m]
        return m

    for a, b in links:
        root[find(a)] = find(b)
    parts = defaultdict(list)
    for m in root:
        parts[find(m)].append(m)
    return list(parts.values())


def opened(points, faces, rng):
    """Without some faces: at random, in a few balls, where a few waves are low, or none."""
    way, middle = rng.integers(4), points[faces].mean(axis=1)
    if way == 0:
        return faces[rng.random(len(faces)) > rng.choice([0.05, 0.1, 0.2, 0.3])]
    kept = np.ones(len(faces), bool)
    if way == 1:
        for _ in range(rng.integers(1, 8)):
            away = np.linalg.norm(middle - middle[rng.integers(len(middle))], axis=1)
            kept &= away > 0.25 * rng.random() * np.ptp(points)
    elif way == 2:
        waves = rng.normal(size=(6, 2)) * rng.choice([3, 8, 20]) / max(np.ptp(points), 1e-300)
        kept = np.sin(middle[:, :2] @ waves.T + 7 * rng.random(6)).sum(axis=1) > rng.choice([-2, -1, -0.5])
    return faces[kept]


def without_some(faces, rng, most=5):
    """One to `most` faces fewer, at least one left."""
    fewer = min(len(faces) - 1, rng.integers(1, most + 1))
    return np.delete(faces, rng.choice(len(faces), fewer, replace=False), axis=0)


# ---------------------------------------------------------------- kinds


def planar(rng):
    plane = rng.random((int(rng.choice([4, 5, 6, 8, 12, 20, 30, 60, 120, 300])), 2))
    return np.column_stack([plane, 0 * plane[:, 0]]), opened(plane, delaunay(plane), rng)


def lifted(rng):
    points, faces = planar(rng)
    x, y, _ = points.T
    rough = rng.random() < 0.5
    points[:, 2] = rng.choice([0.1, 1, 10]) * (rng.normal(size=len(x)) if rough else np.sin(5 * x) * np.cos(4 * y))
    return points, faces


def uneven(rng):
    """Points that crowd along two sides."""
    plane = rng.random((int(rng.choice([8, 20, 50, 150])), 2)) ** rng.choice([2, 4, 8])
    plane = np.concatenate([rng.random((4, 2)), plane])
    height = rng.random(len(plane)) * rng.choice([0, 0.1])
    return np.column_stack([plane, height]), opened(plane, delaunay(plane), rng)


def grid(rng):
    m, n = rng.integers(2, 14, 2)
    x, y = np.meshgrid(np.arange(m + 1.0), np.arange(n + 1.0))
    plane = np.column_stack([x.ravel(), y.ravel()])
    i = np.arange(len(plane)).reshape(n + 1, m + 1)
    a, b, c, d = (part.ravel() for part in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
    other = (rng.random(len(a)) < rng.choice([0, 0.5]))[:, None]
    first = np.where(other, np.column_stack([a, b, c]), np.column_stack([a, b, d]))
    second = np.where(other, np.column_stack([a, c, d]), np.column_stack([b, c, d]))
    points = np.column_stack([plane, rng.normal(size=len(plane)) * rng.choice([0, 0, 0.3, 2])])
    if rng.random() < 0.3:
        points *= rng.choice([1, 10, 100], 3)
    return points, opened(plane, np.concatenate([first, second]), rng)


def ball(rng):
    """Points of the unit sphere, and its faces between them."""
    points = rng.normal(size=(int(rng.choice([6, 8, 13, 20, 50, 150, 400])), 3))
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    return points, convex_hull(points)


def sphere(rng):
    points, faces = ball(rng)
    if rng.random() < 0.4:
        points = points * rng.choice([1, 5, 30], 3)
    if rng.random() < 0.5:
        return points, without_some(faces, rng)
    return points, faces[rng.random(len(faces)) > rng.choice([0.05, 0.15, 0.3])]


def limbs(rng):
    """A sphere with a few vertices pulled far out."""
    points, faces = sphere(rng)
    for _ in range(rng.integers(1, 4)):
        points[rng.integers(len(points))] *= rng.choice([3, 10, 100])
    return points, faces


def stacked(rng):
    """Random points on a random combinatorial sphere: faces split, then edges flipped."""
    faces, n = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], 4
    for _ in range(int(rng.choice([3, 6, 10, 20, 50]))):
        i = rng.integers(len(faces))
        a, b, c = faces[i]
        faces[i : i + 1] = [[a, b, n], [b, c, n], [c, a, n]]
        n += 1
    for _ in range(int(rng.choice([0, 3 * n]))):
        flip_one(faces, rng)
    faces = np.array(faces)
    kept = without_some(faces, rng) if rng.random() < 0.5 else faces[rng.random(len(faces)) > rng.choice([0.1, 0.3])]
    return rng.normal(size=(n, 3)), kept


def flip_one(faces, rng):
    """Flips a random edge, unless the new edge is there already."""
    across = {(face[k], face[(k + 1) % 3]): (f, face[(k + 2) % 3]) for f, face in enumerate(faces) for k in range(3)}
    a, b = list(across)[rng.integers(len(across))]
    (f, c), (g, d) = across[a, b], across[b, a]
    if c != d and (c, d) not in across and (d, c) not in across:
        faces[f], faces[g] = [c, a, d], [d, b, c]


def tube(rng):
    around, along = int(rng.integers(3, 14)), int(rng.choice([1, 2, 5, 12, 40]))
    radius = 1 + 0.5 * np.sin(9 * rng.random() + np.linspace(0, 9 * rng.random(), along + 1))
    j, i = (part.ravel() for part in np.meshgrid(np.arange(along + 1), np.arange(around), indexing="ij"))
    angle = 2 * np.pi * i / around + 0.3 * j
    height = rng.choice([0.1, 1, 5, 20]) * j / along
    points = np.column_stack([radius[j] * np.cos(angle), radius[j] * np.sin(angle), height])
    j, i = (part.ravel() for part in np.meshgrid(np.arange(along), np.arange(around), indexing="ij"))
    a, b = j * around + i, j * around + (i + 1) % around
    d, c = a + around, b + around
    faces = np.concatenate([np.column_stack([a, b, d]), np.column_stack([b, c, d])])
    if rng.random() < 0.4:  # closed at one end
        top = len(points)
        rim = along * around + np.arange(around)
        points = np.concatenate([points, [[0, 0, 1.2 * height.max()]]])
        faces = np.concatenate([faces, np.column_stack([rim, np.roll(rim, -1), np.full(around, top)])])
    if rng.random() < 0.4:
        faces = without_some(faces, rng)
    return points + rng.normal(size=points.shape) * rng.choice([0, 0, 0.05]), faces


def ring(rng):
    """Two loops and nothing inside: every vertex on the boundary."""
    m, n = rng.integers(3, 12, 2)
    outer, inner = np.sort(2 * np.pi * rng.random(m)), np.sort(2 * np.pi * rng.random(n))
    radius = rng.choice([0.2, 0.5, 0.9, 0.99])
    angle, scale = np.concatenate([outer, inner]), np.repeat([1.0, radius], [m, n])
    points = np.column_stack([scale * np.cos(angle), scale * np.sin(angle), 0 * angle])
    points[:, 2] += rng.normal(size=len(points)) * rng.choice([0, 0.2])
    i = j = 0
    faces = []
    while i < m or j < n:
        if j >= n or (i < m and (i + 1) * n <= (j + 1) * m):
            faces.append([i % m, (i + 1) % m, m + j % n])
            i += 1
        else:
            faces.append([i % m, m + (j + 1) % n, m + j % n])
            j += 1
    return points, np.array(faces)


def comb(rng):
    """A strip with a tooth on every second triangle."""
    n = 2 * int(rng.integers(2, 12)) + 1
    low = [(i, 0.0) for i in range(n)]
    high = [(i + 0.5, 1.0) for i in range(n - 1)]
    tips = [(i + 1.0, 1 + 5 * rng.random()) for i in range(0, n - 2, 2)]
    faces = [[i, i + 1, n + i] for i in range(n - 1)] + [[n + i, i + 1, n + i + 1] for i in range(n - 2)]
    faces += [[n + i + 1, 2 * n - 1 + i // 2, n + i] for i in range(0, n - 2, 2)]
    plane = np.array(low + high + tips)
    points = np.column_stack([plane, rng.normal(size=len(plane)) * rng.choice([0, 0.5])])
    return points, np.array(faces) if rng.random() < 0.5 else without_some(np.array(faces), rng, 2)


def strip(rng):
    n = int(rng.integers(1, 30))
    i = np.arange(n + 2)
    along = np.cumsum(rng.uniform(0.3, 0.7, n + 2))  # uneven, or it would look the same from both ends
    points = np.column_stack([along, i % 2, rng.normal(size=n + 2) * rng.choice([0, 1])])
    faces = [[k, k + 1, k + 2] if k % 2 else [k, k + 2, k + 1] for k in range(n)]
    return points * rng.choice([1, 50], 3), np.array(faces)


def ears(rng):
    """A disk that grew by one triangle after the other: no vertex inside."""
    points, faces, rim = [[0, 0, 0], [1, 0, 0], [0.5, 1, 0]], [[0, 1, 2]], [(0, 1), (1, 2), (2, 0)]
    for _ in range(int(rng.choice([1, 3, 8, 20, 60]))):
        a, b = rim.pop(rng.integers(len(rim)))
        v = len(points)
        points.append(list((np.array(points[a]) + points[b]) / 2 + rng.normal(size=3)))
        faces.append([b, a, v])
        rim += [(a, v), (v, b)]
    return np.array(points, float), np.array(faces)


def cut_in_four(points, faces):
    """Each face by the middles of its edges: points and faces."""
    edges = np.sort(np.concatenate([faces[:, [k, (k + 1) % 3]] for k in range(3)]), axis=1)
    edges, index = np.unique(edges, axis=0, return_inverse=True)
    x, y, z = len(points) + index.reshape(3, -1)
    points = np.concatenate([points, points[edges].mean(axis=1)])
    a, b, c = faces.T
    return points, np.concatenate([np.column_stack(part) for part in ((a, x, z), (x, b, y), (z, y, c), (x, y, z))])


def refined(rng):
    """A grid with holes, each face cut in four once or twice."""
    part = bordered_part(*grid(rng))
    if part is None:
        return grid(rng)
    points, faces = part
    for _ in range(rng.integers(1, 3)):
        points, faces = cut_in_four(points, faces)
    return points, faces if rng.random() < 0.5 else faces[rng.random(len(faces)) > 0.05]


def degenerate(rng):
    """Another kind, its coordinates spoiled: vertices in one place, on a coarse grid, on a line, of all magnitudes."""
    points, faces = (planar, grid, sphere, tube, stacked)[rng.integers(5)](rng)
    way = rng.integers(5)
    if way == 0:
        points[rng.integers(len(points), size=max(1, len(points) // 5))] = points[rng.integers(len(points))]
    elif way == 1:
        points = np.round(2 * points) / 2
    elif way == 2:
        points[:, 1:] *= 1e-9
    elif way == 3:
        points = points * 10.0 ** rng.integers(-6, 6, size=(len(points), 1))
    else:
        points[:, 1:] = 0
    return points, faces


def ragged(rng):
    """A range scan: wavy, with a ragged rim, hundreds of ears and drop-outs."""
    n = int(rng.choice([400, 1000]))
    plane = rng.random((n, 2))
    faces = delaunay(plane)
    longest = np.linalg.norm(plane[faces] - plane[np.roll(faces, 1, axis=1)], axis=2).max(axis=1)
    faces = faces[longest < 4 / np.sqrt(n)]
    waves = rng.normal(size=(8, 2)) * rng.choice([10, 25, 40])
    level = np.sin(plane[faces].mean(axis=1) @ waves.T + 7 * rng.random(8)).sum(axis=1)
    kept = (level > rng.choice([-1.5, -0.7])) & (rng.random(len(faces)) > rng.choice([0, 0.02, 0.1]))
    return np.column_stack([plane, 0.1 * np.sin(6 * plane[:, 0])]), faces[kept]


def joined(rng):
    """Two parts that hang together by one edge."""
    one, other = bordered_part(*planar(rng)), bordered_part(*planar(rng))
    if one is None or other is None:
        return planar(rng)
    (points, faces), (more, hung) = one, other
    a, b = border_edge(faces, rng)
    c, d = len(points) + border_edge(hung, rng)
    hung = hung + len(points)
    hung = np.where(hung == c, b, np.where(hung == d, a, hung))
    return np.concatenate([points, more + [3, 0, 0]]), np.concatenate([faces, hung])


def border_edge(faces, rng):
    edges = {(f[k], f[(k + 1) % 3]) for f in faces.tolist() for k in range(3)}
    free = sorted(edge for edge in edges if edge[::-1] not in edges)
    return np.array(free[rng.integers(len(free))])


KINDS = {
    kind.__name__: kind
    for kind in (
        planar, lifted, uneven, grid, refined, ragged, joined, sphere, limbs, stacked,
        tube, ring, comb, strip, ears, degenerate,
    )
}  # fmt: skip


def make(kind, seed):
    """The surface of that number, the same on every machine."""
    rng = np.random.default_rng([sorted(KINDS).index(kind), seed])
    points, faces = KINDS[kind](rng)
    return bordered_part(points, faces) if len(faces) else None


# ---------------------------------------------------------------- for the other domains


def closed(rng):
    """A sphere with all its faces, now and then with limbs."""
    points, faces = ball(rng)
    if rng.random() < 0.5:
        points = points * rng.choice([1, 3, 10], 3)
    for _ in range(rng.integers(3)):
        points[rng.integers(len(points))] *= rng.choice([2, 5])
    return points, faces


def tori(rng, holes=True):
    """A torus of uneven rings, now and then with holes."""
    around, along = (int(n) for n in rng.integers(5, 24, 2))
    i, j = (part.ravel() for part in np.meshgrid(np.arange(around), np.arange(along), indexing="ij"))
    u = 2 * np.pi * (i + 0.3 * rng.random(i.shape)) / around
    v = 2 * np.pi * (j + 0.3 * rng.random(i.shape)) / along
    radius = rng.choice([1.5, 3, 8]) + np.cos(v) * (1 + 0.2 * np.sin(3 * u))
    points = np.column_stack([radius * np.cos(u), radius * np.sin(u), np.sin(v)])
    a, b = i * along + j, i * along + (j + 1) % along
    c, d = (i + 1) % around * along + (j + 1) % along, (i + 1) % around * along + j
    faces = np.concatenate([np.column_stack([a, d, b]), np.column_stack([d, c, b])])
    return points, without_some(faces, rng) if holes and rng.random() < 0.5 else faces


def doubled(rng):
    """Two sheets, their loops joined by walls: a handle for each loop but one; now and then with holes."""
    x, y = np.meshgrid(np.arange(15.0), np.arange(15.0))
    plane = np.column_stack([x.ravel(), y.ravel()]) + 0.2 * rng.random((225, 2))
    faces = delaunay(plane)
    spots = 7 + 4 * np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])[rng.permutation(4)[: rng.integers(1, 4)]]
    away = np.linalg.norm(plane[faces].mean(axis=1)[:, None] - spots[None], axis=2).min(axis=1)
    above, faces = bordered_part(np.column_stack([plane, 0 * plane[:, 0]]), faces[away > 1.6])
    below = above.copy()
    above[:, 2] += 1 + 0.5 * rng.random(len(above))
    below[:, 2] -= 1 + 0.5 * rng.random(len(below))
    there = {(face[k], face[(k + 1) % 3]) for face in faces.tolist() for k in range(3)}
    a, b = np.array(sorted(edge for edge in there if edge[::-1] not in there)).T
    n = len(above)
    walls = np.concatenate([np.column_stack([b, a, a + n]), np.column_stack([a + n, b + n, b])])
    faces = np.concatenate([faces, faces[:, ::-1] + n, walls])
    return np.concatenate([above, below]), without_some(faces, rng) if rng.random() < 0.4 else faces


def strewn(rng):
    """Two components, each of another kind, perhaps of very different sizes; some faces turned over, some twice."""
    one = (closed, tori, doubled, sphere, grid)[rng.integers(5)](rng)
    other = (closed, sphere, tube)[rng.integers(3)](rng)
    (points, faces), (more, hung) = one, other
    shift = [3 * np.ptp(points), 0, 0]
    points = np.concatenate([points, more * rng.choice([1e-3, 1, 10]) + shift])
    faces = np.concatenate([faces, hung + len(one[0])])
    if rng.random() < 0.3:
        over = rng.random(len(faces)) < 0.1
        faces[over] = faces[over][:, ::-1]
    if rng.random() < 0.3:
        faces = np.concatenate([faces, faces[rng.integers(len(faces), size=3)]])
    return points, faces


WHOLE_KINDS = {kind.__name__: kind for kind in (closed, tori, doubled, strewn)}  # not to be cut down to a bordered part


def make_whole(kind, seed):
    """A surface of these, or one of KINDS, by its number."""
    if kind in KINDS:
        return make(kind, seed)
    rng = np.random.default_rng([len(KINDS) + sorted(WHOLE_KINDS).index(kind), seed])
    points, faces = WHOLE_KINDS[kind](rng)
    return np.array(points, float), np.array(faces, np.int32)
