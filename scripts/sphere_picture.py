# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide's picture of a sphere: left a closed head in its checker, right its sphere, and below its UVs.

    blender -b blend_samples/closed_head.blend --python-exit-code 1 -P scripts/sphere_picture.py -- OUT.jpg

The head is mapped as the operator Unwrap to Sphere maps it, with longitudes; the cut is red on both sides. The UVs are
drawn twice as wide as high.
"""

import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))

import guide_picture  # noqa: E402
import render_uv  # noqa: E402
import studio  # noqa: E402
import uv_loops  # noqa: E402

LAYER, CUT = "Koebe", "#d8432b"
SIZE = (1000, 500)
SQUARES = 32.0  # along u
RADIUS, MIDDLE = 0.46, (0.83, 0.46, 0.5)  # of the sphere
WIDTH, HEIGHT, LOWER_LEFT = 1.5, 0.75, (0.08, -0.88)  # of the UV square


def on_sphere(one):
    """The sphere's points (V, 3) in the picture, by the mesh's vertices: seen as the surface is."""
    camera = bpy.context.scene.camera
    view = camera.matrix_world.to_quaternion() if camera else Vector(render_uv.DEFAULT_VIEW).to_track_quat("Z", "Y")
    points = np.zeros((one.island.source_vertex.max() + 1, 3))
    points[one.island.source_vertex] = one.result.points @ np.array(view.to_matrix())
    return RADIUS * points + MIDDLE


def in_the_plane(uv, height=0.0):
    """UVs (n, 2) in the picture."""
    flat = np.array(LOWER_LEFT) + uv * (WIDTH, HEIGHT)
    return np.column_stack([flat, np.full(len(flat), height)])


def cut_edges(one, obj):
    """Both ends of each side of the cut: their vertices and their UVs."""
    uv = np.empty(2 * len(obj.data.loops), np.float32)
    obj.data.uv_layers[LAYER].data.foreach_get("uv", uv)
    uv, cut = uv.reshape(-1, 2).astype(float), set(np.flatnonzero(one.cuts).tolist())
    torn = set(one.torn_faces.tolist())
    for face in obj.data.polygons:
        loops = list(face.loop_indices)
        for here, there in zip(loops, [*loops[1:], loops[0]]):
            if face.index not in torn and obj.data.loops[here].edge_index in cut:
                yield [obj.data.loops[i].vertex_index for i in (here, there)], uv[[here, there]]


def main():
    output = Path(sys.argv[sys.argv.index("--") + 1]).absolute()
    obj = next(obj for obj in bpy.context.scene.objects if obj.type == "MESH")
    one = guide_picture.mapped(obj, "sphere", SQUARES)
    checker = studio.darker_behind(obj.material_slots[0].material.copy())
    vertex, uv, corners, sizes = uv_loops.read_uv_mesh(obj.data, LAYER)
    seen, sphere = render_uv.seen_points(obj, vertex), on_sphere(one)
    place = dict(zip(vertex.tolist(), seen))
    scene = bpy.data.scenes.new("picture")
    bpy.context.window.scene = scene
    for points, smooth in ((seen, True), (sphere[vertex], True), (in_the_plane(uv), False)):
        studio.add_mesh(scene, points, corners, sizes, uv, LAYER, checker, smooth)
    for ends, flat in cut_edges(one, obj):
        studio.add_ring(scene, np.array([place[v] for v in ends]), CUT)
        studio.add_ring(scene, sphere[ends], CUT)
        if abs(flat[:, 1] - 0.5).min() < 0.49:  # a pole is a line of the UVs, and a point of the cut
            studio.add_ring(scene, in_the_plane(flat, 0.01), CUT)
    studio.render_finely(scene, SIZE, output)


if __name__ == "__main__":
    main()
