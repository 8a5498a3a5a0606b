# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide's picture of a torus tile: left a bent ring in its checker, right the tile and its copies.

    blender -b --factory-startup --python-exit-code 1 -P scripts/tile_picture.py -- OUT.jpg

The ring has two holes. It is mapped as the operator Unwrap to Torus Tile maps it; the cut is red on both sides.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import guide_picture  # noqa: E402
import render_uv  # noqa: E402
import studio  # noqa: E402
import uv_loops  # noqa: E402

LAYER, CUT = "Koebe", "#d8432b"
AROUND, ACROSS = 72, 40  # quadrilaterals
HOLES = ((10, 12, 7), (44, 30, 5))  # first column and row, and how many of each are left out
SIZE = (1000, 500)
SQUARES = 16.0  # across the UV square
TILE = 0.58  # of half of the right half
PALE = 0.55  # how far the ink of the copies is from paper's


def bent_ring():
    """A torus whose tube is thicker on one side, without the faces of the holes."""
    i, j = np.meshgrid(np.arange(AROUND), np.arange(ACROSS), indexing="ij")
    u, v = 2 * np.pi * i / AROUND, 2 * np.pi * j / ACROSS
    tube = 0.8 + 0.2 * np.cos(u)
    radius, height = 2.0 + tube * np.cos(v), tube * np.sin(v) + 0.35 * np.sin(2 * u)
    points = np.stack([radius * np.cos(u), radius * np.sin(u), height], axis=2).reshape(-1, 3)
    out = {((c + a) % AROUND, (r + b) % ACROSS) for c, r, n in HOLES for a in range(n) for b in range(n)}
    at = lambda i, j: i % AROUND * ACROSS + j % ACROSS  # noqa: E731
    faces = [
        (at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1))
        for i in range(AROUND) for j in range(ACROSS) if (i, j) not in out
    ]  # fmt: skip
    used, index = np.unique(np.array(faces), return_inverse=True)
    mesh = bpy.data.meshes.new("ring")
    mesh.from_pydata(points[used].tolist(), [], index.reshape(-1, 4).tolist())
    obj = bpy.data.objects.new("ring", mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.rotation_euler = (0.0, 0.0, 2.4)
    bpy.context.view_layer.update()
    return obj


def paler(material):
    """A copy of the checker with less of its ink."""
    copy = material.copy()
    fine = copy.node_tree.nodes["Fine"].inputs
    paper, ink = (np.array(fine[name].default_value) for name in ("Color1", "Color2"))
    fine["Color2"].default_value = ink + PALE * (paper - ink)
    copy.node_tree.nodes["Coarse"].inputs["Color2"].default_value = (0.85, 0.85, 0.85, 1.0)
    return copy


def cut_paths(one, obj, seen, vertex, flat):
    """Both ends of each edge along the cut: on the surface, and on both sides of it in the tile."""
    place = dict(zip(vertex.tolist(), seen))
    uvs = uv_by_corner(obj)
    cut = set(np.flatnonzero(one.cuts).tolist())
    for face in obj.data.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, [*loops[1:], loops[0]]):
            if obj.data.loops[here].edge_index in cut:
                yield np.array([place[obj.data.loops[i].vertex_index] for i in (here, there)])
                yield np.array([flat(uvs[i]) for i in (here, there)])


def uv_by_corner(obj):
    values = np.empty(2 * len(obj.data.loops), np.float32)
    obj.data.uv_layers[LAYER].data.foreach_get("uv", values)
    return values.reshape(-1, 2).astype(float)


def main():
    output = Path(sys.argv[sys.argv.index("--") + 1]).absolute()
    obj = bent_ring()
    one = guide_picture.mapped(obj, "torus", SQUARES)
    checker = studio.darker_behind(obj.material_slots[0].material.copy())
    pale = paler(checker)
    vertex, uv, corners, sizes = uv_loops.read_uv_mesh(obj.data, LAYER)
    seen = render_uv.seen_points(obj, vertex)
    scene = bpy.data.scenes.new("picture")
    bpy.context.window.scene = scene
    studio.add_mesh(scene, seen, corners, sizes, uv, LAYER, checker, smooth=True)
    middle = (uv.min(axis=0) + uv.max(axis=0)) / 2

    def flat(points, height=0.0):
        return np.append((points - middle) * 2 * TILE + (1.0, 0.0), height)

    window = 0.92  # of the right half: copies are cut off there
    for a in range(-2, 3):
        for b in range(-2, 3):
            shift = np.array([a, b]) @ one.tile.periods
            points = (uv + shift - middle) * 2 * TILE
            inside = (np.abs(points) < window).all(axis=1)
            ends = np.cumsum(sizes)
            whole = np.array([inside[corners[end - size : end]].all() for end, size in zip(ends, sizes)])
            if not whole.any():
                continue
            kept = np.repeat(whole, sizes)
            level = 0.0 if a or b else 0.004
            at = np.column_stack([points + (1.0, 0.0), np.full(len(points), level)])
            studio.add_mesh(
                scene, at, corners[kept], sizes[whole], uv, LAYER, pale if a or b else checker, smooth=False
            )
    for path in cut_paths(one, obj, seen, vertex, lambda point: flat(point, 0.01)):
        studio.add_ring(scene, path, CUT)
    studio.render_finely(scene, SIZE, output)


if __name__ == "__main__":
    main()
