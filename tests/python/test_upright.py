"""Straight edges along the axes, up in the world upwards, grids as rectangles, margins in pixels, equal pieces."""

import koebe
import numpy as np
import pytest
from cli_support import triangles_of


def turned(points, seed):
    """The points after some rotation."""
    turn, _ = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))
    return points @ (turn * np.sign(np.linalg.det(turn)))


def grid(n, m, width=1.5, height=1.0):
    """The parameters of a grid's vertices, and its quadrilaterals."""
    u, v = np.meshgrid(np.linspace(0.0, width, n + 1), np.linspace(0.0, height, m + 1), indexing="ij")
    corner = (np.arange(n)[:, None] * (m + 1) + np.arange(m)).ravel()
    return u.ravel(), v.ravel(), np.stack([corner, corner + m + 1, corner + m + 2, corner + 1], axis=-1)


def plus(size=3):
    """A flat plus of squares. The smallest rectangle round it stands on its corner."""
    u, v, quads = grid(3 * size, 3 * size, 3.0, 3.0)
    middle = np.stack([u, v], axis=-1)[quads].mean(axis=1)
    quads = quads[(np.abs(middle - 1.5) < 0.5).any(axis=1)]
    used, faces = np.unique(quads, return_inverse=True)
    return np.stack([u, v, 0 * u], axis=-1)[used], triangles_of(faces.reshape(quads.shape))


def cubes(count, seed=4, edge=1.0):
    """Separate cubes, turned at random, each numbered anew, and not all with the same diagonals first."""
    random = np.random.default_rng(seed)
    at = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)], float) * edge
    quads = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
    vertices, triangles = [], []
    for k in range(count):
        number = random.permutation(8)
        vertices.append(np.empty((8, 3)))
        vertices[-1][number] = turned(at - 0.5 * edge, seed + k) + [2.0 * k, 0.0, 0.0]
        triangles.append(random.permutation(number[triangles_of(quads)]) + 8 * k)
    return np.concatenate(vertices), np.concatenate(triangles)


def outline(triangles, uv):
    """(E, 2, 2) the ends of the edges in the UVs that two triangles do not share there."""
    ends = np.concatenate([uv[:, [k, (k + 1) % 3]] for k in range(3)])
    names = np.sort(np.unique(ends.reshape(-1, 2), axis=0, return_inverse=True)[1].reshape(-1, 2), axis=1)
    _, first, count = np.unique(names, axis=0, return_index=True, return_counts=True)
    return ends[first[count == 1]]


def off_axes(edges):
    """The largest angle of an edge to the nearest axis, in radians."""
    along = np.abs(edges[:, 1] - edges[:, 0])
    return (along.min(axis=1) / along.max(axis=1)).max()


def least_gap(one, other):
    """The least distance of two outlines that do not cross."""
    found = np.inf
    for a, b in ((one, other), (other, one)):
        points, start, way = a[:, None, 0], b[None, :, 0], (b[:, 1] - b[:, 0])[None]
        along = np.clip(((points - start) * way).sum(-1) / (way * way).sum(-1), 0.0, 1.0)
        found = min(found, np.linalg.norm(start + along[..., None] * way - points, axis=-1).min())
    return found


@pytest.mark.parametrize("seed", range(3))
def test_straight_edges_lie_along_the_axes(seed):
    vertices, triangles = plus()
    result = koebe.parts(turned(vertices, seed), triangles)
    assert len(result.parts) == 1 and off_axes(outline(triangles, result.uv)) < 1e-6


@pytest.mark.parametrize("about", [0.0, 0.7, 2.0])
def test_up_in_the_world_is_up_in_the_texture(about):
    """A wall that is longer than it is high."""
    u, v, quads = grid(6, 4, 1.5, 1.0)
    vertices, triangles = np.stack([np.cos(about) * u, np.sin(about) * u, v], axis=-1), triangles_of(quads)
    uv = koebe.parts(vertices, triangles, polygon=np.repeat(np.arange(len(quads)), 2)).uv.reshape(-1, 2)
    up = np.linalg.lstsq(np.column_stack([vertices[triangles.ravel()], np.ones(len(uv))]), uv, rcond=None)[0][2]
    assert up[1] > 0.3 and abs(up[0]) < 1e-6


def test_a_waved_grid_is_a_rectangle_with_straight_rows():
    u, v, quads = grid(24, 16)
    vertices = np.stack([u, v, 0.06 * np.sin(5.0 * u) * np.cos(2.5 * v)], axis=-1)
    triangles, polygon = triangles_of(quads), np.repeat(np.arange(len(quads)), 2)
    result = koebe.parts(turned(vertices, 1), triangles, polygon=polygon)
    assert len(result.parts) == 1 and result.angle_error_deg["mean"] < 3.0 and result.flipped == 0
    edges = outline(triangles, result.uv)
    assert off_axes(edges) < 1e-9 and len(edges) == 2 * (24 + 16)
    assert len(np.unique(edges[..., 0].round(9))) in (25, 17)
    # A dome is no rectangle, unless that is wanted.
    dome = np.stack([u, v, 2.0 * u * (1.5 - u) * v * (1.0 - v) * 4.0], axis=-1)
    for rectify in (False, True):
        result = koebe.parts(dome, triangles, polygon=polygon, darts=0, price=1.0, rectify=rectify)
        assert (off_axes(outline(triangles, result.uv)) < 1e-9) == rectify and result.flipped == 0


def test_a_frustum_with_noise_keeps_its_lengths():
    """Its side is a grid of quadrilaterals, and rows of one width would stretch it."""
    n, noise = 12, np.random.default_rng(1)
    turn = np.arange(n) * 2.0 * np.pi / n
    rings = [np.stack([r * np.cos(turn), r * np.sin(turn), 0.0 * turn + z], axis=-1) for r, z in ((1, 0), (0.65, 9.2))]
    vertices = np.concatenate([*rings, [[0, 0, 0], [0, 0, 9.2]]])
    vertices += 3.2e-3 * noise.normal(size=vertices.shape)
    here, after = np.arange(n), np.roll(np.arange(n), -1)
    side = triangles_of(np.stack([here, after, after + n, here + n], axis=-1))
    ends = [[[2 * n, b, a], [2 * n + 1, a + n, b + n]] for a, b in zip(here, after, strict=True)]
    triangles = np.concatenate([side, np.reshape(ends, (-1, 3))])
    polygon = np.concatenate([np.repeat(here, 2), n + np.arange(2 * n)])
    result = koebe.parts(vertices, triangles, polygon=polygon)
    assert result.whole > 0.99 and result.density_ratio_5_95 < 1.01


@pytest.mark.parametrize(("margin", "pixels"), [(8, 2048), (0, 512), (4, 128), (40.5, 1024)])
def test_islands_keep_the_margin_in_pixels(margin, pixels):
    pieces = [plus(2), plus(1), *([turned(p, k) * (0.5 + 0.2 * k), t] for k, (p, t) in enumerate([plus(1)] * 3))]
    starts = np.cumsum([0] + [len(points) for points, _ in pieces])
    vertices = np.concatenate([points + [4.0 * k, 0, 0] for k, (points, _) in enumerate(pieces)])
    triangles = np.concatenate([faces + start for (_, faces), start in zip(pieces, starts, strict=False)])
    result = koebe.parts(vertices, triangles, margin=margin, pixels=pixels)
    assert len(result.parts) == len(pieces) and result.margin == pytest.approx(margin)
    outlines = [outline(triangles[part["faces"]], result.uv[part["faces"]]) for part in result.parts]
    gaps = [least_gap(one, other) for k, one in enumerate(outlines) for other in outlines[:k]]
    assert min(gaps) >= margin / pixels
    assert result.uv.min() >= 0.5 * margin / pixels and result.uv.max() <= 1.0 - 0.5 * margin / pixels


def test_many_islands_keep_the_margin_that_the_report_has():
    vertices, triangles = cubes(20)
    result = koebe.parts(vertices, triangles, margin=300, pixels=1024)
    assert 0.0 < result.margin < 300.0
    outlines = [outline(triangles[part["faces"]], result.uv[part["faces"]]) for part in result.parts]
    gaps = [least_gap(one, other) for k, one in enumerate(outlines) for other in outlines[:k]]
    assert min(gaps) >= result.margin / 1024.0


def test_disks_of_a_cut_mesh_keep_the_margin_in_pixels():
    vertices, triangles = cubes(3)
    uv = koebe.uniformize(vertices, triangles, cut=True, margin=64, pixels=1024).uv.reshape(3, -1, 2)
    outlines = [outline(triangles[:12], one.reshape(-1, 3, 2)) for one in uv]
    assert min(least_gap(outlines[i], outlines[j]) for i in range(3) for j in range(i)) >= 64.0 / 1024.0 - 1e-9


def test_equal_cubes_are_cut_alike_and_stacked_without_turning_one_over():
    vertices, triangles = cubes(12)
    apart, stacked = koebe.parts(vertices, triangles), koebe.parts(vertices, triangles, stack=True)
    per_cube = len(apart.parts) // 12
    assert len(stacked.parts) == 12 * per_cube and len(stacked.stacked) == 11 * per_cube
    assert not any(one["mirrored"] for one in stacked.stacked)
    for result in (apart, stacked):
        a, b = result.uv[:, 1] - result.uv[:, 0], result.uv[:, 2] - result.uv[:, 0]
        assert (a[:, 0] * b[:, 1] > a[:, 1] * b[:, 0]).all()
    # Side by side each island has the same outline as one of the first cube, up to quarter turns.
    islands = [apart.uv[np.asarray(part["faces"])].reshape(-1, 2) for part in apart.parts]
    first = [k for k, part in enumerate(apart.parts) if part["faces"][0] < 12]
    assert len(first) == per_cube
    for one in islands:
        turns = [one @ np.linalg.matrix_power([[0, 1], [-1, 0]], k) for k in range(4)]
        corners = [(at - at.min(axis=0), islands[k] - islands[k].min(axis=0)) for at in turns for k in first]
        gaps = [np.linalg.norm(at[:, None] - like, axis=-1) for at, like in corners if len(at) == len(like)]
        assert min(max(gap.min(axis=0).max(), gap.min(axis=1).max()) for gap in gaps) < 1e-6


def prism(outline, height):
    """A solid over a convex outline (n, 2)."""
    n = len(outline)
    vertices = np.array([[x, y, z] for z in (0.0, height) for x, y in outline])
    k, fan = np.arange(n), np.array([[0, i, i + 1] for i in range(1, n - 1)])
    walls = triangles_of(np.stack([k, (k + 1) % n, (k + 1) % n + n, k + n], axis=-1))
    return vertices, np.concatenate([fan[:, ::-1], fan + n, walls])


def circle(n):
    return np.stack([np.cos(2 * np.pi * np.arange(n) / n), np.sin(2 * np.pi * np.arange(n) / n)], axis=-1)


def test_hard_surfaces_are_reported_and_cut_as_asked_for():
    vertices, triangles = cubes(1)
    for options, parts in (({}, 2), ({"cut_hard": True}, 6), ({"cut_hard": True, "hard_angle": 91}, 2)):
        result = koebe.parts(turned(vertices, 1), triangles, **options)
        assert (len(result.parts), result.regions, result.whole) == (parts, 6, 1.0), options
        assert result.aligned == 1.0 and result.angle_error_deg["max"] < 1e-3
    bent = koebe.parts(vertices, triangles, darts=0, even=0)  # nothing is laid flat
    assert bent.regions == 6 and bent.whole < 1.0
    assert koebe.parts(vertices, triangles, no_hard=True).whole < 1.0
    octagon = prism(circle(8), 2.0)  # its walls meet at 45 degrees
    assert [len(koebe.parts(*octagon, cut_hard=True, hard_angle=angle).parts) for angle in (40, 50)] == [10, 3]


def test_long_thin_strips_are_cut_so_that_all_islands_become_larger():
    coin = prism(circle(64), 0.1)
    result = koebe.parts(*coin)
    longest = max(np.ptp(result.uv[part["faces"]].reshape(-1, 2), axis=0).max() for part in result.parts)
    assert len(result.parts) == 5 and result.whole == 1.0 and result.coverage > 0.5
    assert longest * np.sqrt(1 / result.coverage) < 1.155 + 1e-6
    assert len(koebe.flatten(*coin).pieces) == 3  # a pattern is packed onto no square
    alone = koebe.parts(*prism(circle(64), 2.0))  # the side of a tin is not thin
    assert len(alone.parts) == 3


def test_holes_that_meet_at_a_point_neither_bend_nor_cut_a_plate():
    """The flat image touches itself there, so both corners are drawn a little apart."""
    u, v, quads = grid(12, 12)
    holes = {(2, 2), (3, 3), (8, 3), (7, 4), (6, 5), (5, 9)}
    triangles = quads[[divmod(k, 12) not in holes for k in range(144)]][:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    result = koebe.parts(turned(np.stack([u, v, 0 * u], axis=-1), 3), triangles)
    assert (len(result.parts), result.whole, result.cut_length, result.flipped) == (1, 1.0, 0.0, 0)


@pytest.mark.parametrize("seed", range(3))
def test_slivers_that_flip_by_rounding_bend_no_plate(seed):
    # Every second vertex of an edge is off its line by less than 32 bits can store.
    random = np.random.default_rng(seed)
    off = np.where(np.arange(13) % 2 == 1, 1e-10, 0.0)
    line = np.stack([np.linspace(0.0, 2.0, 13), off, 0.0 * off], axis=-1)
    vertices = turned(np.concatenate([line, [[random.uniform(0.5, 1.5), 1.0, 0.0]]]), seed)
    slivers = [[k, k + 2, k + 1] for k in range(0, 12, 2)]
    triangles = np.array([[k, k + 1, 13] for k in range(12)] + slivers)
    result = koebe.parts(vertices, triangles)
    size = np.sqrt(result.coverage)  # the surface has the area 1
    assert (len(result.parts), result.flipped, result.overlaps) == (1, 0, 0)
    for k in range(3):
        length = np.linalg.norm(vertices[triangles[:, k]] - vertices[triangles[:, k - 1]], axis=1)
        stored = np.linalg.norm(result.uv[:, k] - result.uv[:, k - 1], axis=1)
        assert np.abs(stored - size * length).max() < 1e-5


@pytest.mark.parametrize("seed", [0, 1, 2, 4])
def test_faces_that_meet_in_t_junctions_stay_flat_and_whole(seed):
    # A folded sheet with vertices in the middle of edges, which only the face on one side has.
    random = np.random.default_rng(seed)
    u, v, quads = grid(8, 6)
    vertices = np.stack([np.minimum(u, 0.75), v, np.maximum(0.0, u - 0.75)], axis=-1)
    triangles, count = triangles_of(quads).tolist(), len(vertices)
    for _ in range(6):
        face, k = triangles[random.integers(len(triangles))], random.integers(3)
        start, end, last = face[k], face[(k + 1) % 3], face[(k + 2) % 3]
        if max(face) < count:
            triangles.remove(face)
            triangles += [[start, len(vertices), last], [len(vertices), end, last]]
            vertices = np.concatenate([vertices, [0.5 * (vertices[start] + vertices[end])]])
    result = koebe.parts(turned(vertices, 2), np.array(triangles))
    assert (result.whole, result.flipped, result.overlaps) == (1.0, 0, 0) and result.regions >= 2
