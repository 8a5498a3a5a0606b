"""Balls of polygons, closed and with holes, and what the layouts of spheres promise, told without the add-on."""

import sys
from pathlib import Path

import bmesh
import numpy as np
import scenes

sys.path.append(str(Path(__file__).resolve().parents[1] / "python"))
from sphere_surfaces import led_back  # noqa: E402,F401

LAYOUTS = ("equirectangular", "octahedral")


def ball_arrays(n=16, m=10, holes=(), turn=None, stretch=(1.0, 1.2, 1.5)):
    """A ball of quadrilaterals between two n-gons, without the faces (i, j) of `holes`; j = -1 and j = m - 1 are the
    n-gons. Its axis is turned, so that a layout's cut follows none of its lines."""
    height = np.pi * (np.arange(m) + 0.5) / m - np.pi / 2
    around = 2 * np.pi * np.arange(n) / n
    i, j = np.meshgrid(np.arange(n), np.arange(m), indexing="ij")
    longitude, latitude = around[i] + 0.2 * np.sin(3.0 * height[j]), height[j]
    points = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)],
                      axis=2).reshape(-1, 3)  # fmt: skip
    at = lambda i, j: i % n * m + j  # noqa: E731
    faces = {(i, j): [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(n) for j in range(m - 1)}
    faces[0, -1] = [at(i, 0) for i in range(n)][::-1]
    faces[0, m - 1] = [at(i, m - 1) for i in range(n)]
    kept = [face for key, face in faces.items() if key not in holes]
    used = np.unique(np.concatenate(kept))
    number = np.zeros(len(points), int)
    number[used] = np.arange(len(used))
    if turn is None:
        turn = (0.5, 0.3)
    a, b = turn
    rotation = np.array([[1, 0, 0], [0, np.cos(a), -np.sin(a)], [0, np.sin(a), np.cos(a)]]) @ np.array(
        [[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])  # fmt: skip
    return points[used] @ rotation.T * stretch, [number[face].tolist() for face in kept]


def add_ball(name="Ball", **options):
    obj = scenes.add_object(name, *ball_arrays(**options))
    scenes.select(obj)
    return obj


def join_faces(random, obj, share):
    """Some inner edges of the object's mesh dissolved, so that it has polygons of all sizes."""
    edited = bmesh.new()
    edited.from_mesh(obj.data)
    for _ in range(2):
        met, chosen = set(), []
        for edge in [edge for edge in edited.edges if len(edge.link_faces) == 2 and random.random() < share]:
            one, two = edge.link_faces
            around = {*one.verts, *two.verts}
            if one != two and len({*one.verts} & {*two.verts}) == 2 and not met & around:
                chosen.append(edge)
                met |= around
        bmesh.ops.dissolve_edges(edited, edges=chosen)
        edited.edges.ensure_lookup_table()
    edited.to_mesh(obj.data)
    edited.free()
    return obj


def sides_of_edges(mesh, uv):
    """Of each edge with two faces: of each end the UVs on both sides (n, 2, 2, 2), and the faces (n, 2)."""
    found = {}
    for face in mesh.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, [*loops[1:], loops[0]]):
            places = {mesh.loops[i].vertex_index: uv[i] for i in (here, there)}
            found.setdefault(mesh.loops[here].edge_index, []).append((face.index, places))
    both = [pair for pair in found.values() if len(pair) == 2 and len(pair[0][1]) == 2]
    ends = [[[one[v], other[v]] for v in one] for (_, one), (_, other) in both]
    return np.array(ends, float).reshape(-1, 2, 2, 2), np.array([[a, b] for (a, _), (b, _) in both]).reshape(-1, 2)


def are_continued(ends, layout):
    """(n,) whether the two sides of edges are the same edge of the continued pattern: both ends led by one of its
    motions."""
    here, there = ends[:, :, 0], ends[:, :, 1]
    shift = here - there
    alike = (shift[:, 0] == shift[:, 1]).all(axis=1) & (np.rint(shift) == shift).all(axis=(1, 2))
    if layout == "equirectangular":
        pole = (here[..., 1] == 0) | (here[..., 1] == 1)
        whole = (np.rint(shift) == shift).all(axis=2) & (shift[..., 1] == 0)
        return (alike & whole.all(axis=1)) | ((pole | whole).all(axis=1) & pole.any(axis=1))
    turn = here + there
    turned = (turn[:, 0] == turn[:, 1]).all(axis=1) & (np.rint(turn) == turn).all(axis=(1, 2))
    return (alike & (shift[:, 0].sum(axis=1) % 2 == 0)) | (turned & (turn[:, 0].sum(axis=1) % 2 == 1))
