# SPDX-License-Identifier: GPL-3.0-or-later
"""One picture of a mapped surface: left the surface in its checker, right its circle domain in the same checker.

    blender -b IN.blend --python-exit-code 1 -P scripts/render_uv.py -- --output OUT.png [options]
    python scripts/render_uv.py IN.blend -- --output OUT.png [options]          (with the bpy module)

    --object NAME      default: the first mesh that has the layer
    --layer NAME       the UV layer (Koebe)
    --size 1200x600    width and height in pixels
    --samples N        Cycles samples per pixel (12)

The surface is seen as the file's camera sees it. The domain is drawn from the UV coordinates alone, by quarter turns
the way up that the surface is; the ring around each hole is the circle fitted to the hole's UV loop, in the colour of
the same loop's rim on the surface.
The file itself is not changed.
"""

import argparse
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))

import studio  # noqa: E402
import uv_loops  # noqa: E402

DEFAULT_VIEW = (0.4, -1.0, 0.35)
# The picture is 4 x 2 units: one square of side 2 for the surface, one for the domain.
CELL = 0.86


def parse():
    """The options after "--"."""
    before, given = sys.argv, []
    if "--" in sys.argv:
        at = sys.argv.index("--")
        before, given = sys.argv[:at], sys.argv[at + 1 :]
    parser = argparse.ArgumentParser(prog="render_uv.py", description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True, metavar="OUT.png")
    parser.add_argument("--object", metavar="NAME")
    parser.add_argument("--layer", default="Koebe")
    parser.add_argument("--size", type=_size, default=(1200, 600), metavar="WIDTHxHEIGHT")
    parser.add_argument("--samples", type=int, default=12)
    options = parser.parse_args(given)
    if not bpy.app.binary_path:
        bpy.ops.wm.open_mainfile(filepath=str(Path(before[-1]).absolute()))
    return options


def _size(text):
    width, height = text.lower().split("x")
    return int(width), int(height)


def find_object(name, layer):
    """The mesh object to draw."""
    for obj in bpy.context.scene.objects:
        if obj.type == "MESH" and name in (None, obj.name) and layer in obj.data.uv_layers:
            return obj
    sys.exit(f"render_uv: no mesh object {name or ''} with a UV layer {layer!r}")


def seen_points(obj, vertex):
    """The surface's points as the file's camera sees them (x right, y up, z towards it), to fit the left square."""
    points = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", points)
    camera = bpy.context.scene.camera
    view = camera.matrix_world.to_quaternion() if camera else Vector(DEFAULT_VIEW).to_track_quat("Z", "Y")
    turn = np.array(view.to_matrix().transposed() @ obj.matrix_world.to_3x3())
    points = points.astype(float).reshape(-1, 3) @ turn.T
    low, high = points.min(axis=0), points.max(axis=0)
    points = (points - (low + high) / 2) * 2 * CELL / (high - low)[:2].max()
    return (points + (-1.0, 0.0, 0.1 - points[:, 2].min()))[vertex]


def quarter_turn(uv, seen):
    """The rotation by a multiple of 90 degrees, as a matrix (2, 2), that brings UV points nearest to seen ones, up to
    shift and scale."""
    correlation = (uv - uv.mean(axis=0)).T @ (seen - seen.mean(axis=0))
    turns = [np.linalg.matrix_power([[0, 1], [-1, 0]], k) for k in range(4)]
    return max(turns, key=lambda turn: np.sum(correlation * turn))


def flat_points(uv, circles, turn):
    """The UV points in the right square, and the centers and radii of the loops' circles there."""
    low = np.min([center - radius for center, radius in circles], axis=0)
    high = np.max([center + radius for center, radius in circles], axis=0)
    scale = 2 * CELL / (high - low).max()
    middle = (low + high) / 2

    def place(q):
        return (q - middle) * scale @ turn + (1.0, 0.0)

    return place(uv), [(place(center), radius * scale) for center, radius in circles]


def main():
    options = parse()
    obj = find_object(options.object, options.layer)
    vertex, uv, corners, sizes = uv_loops.read_uv_mesh(obj.data, options.layer)
    loops = uv_loops.boundary_loops(corners, sizes)
    circles = [uv_loops.fitted_circle(uv[loop]) for loop in loops]
    surface = seen_points(obj, vertex)
    flat, rings = flat_points(uv, circles, quarter_turn(uv, surface[:, :2]))
    material = studio.checker_material(obj, options.layer)

    scene = bpy.data.scenes.new("picture")
    bpy.context.window.scene = scene
    flat = np.column_stack([flat, np.zeros(len(flat))])
    for points, smooth in ((surface, True), (flat, False)):
        studio.add_mesh(scene, points, corners, sizes, uv, options.layer, material, smooth)
    turn = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    circle = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(256)])
    for loop, (center, radius), code in zip(loops, rings, studio.loop_colors(circles)):
        studio.add_ring(scene, surface[loop], code)
        studio.add_ring(scene, np.append(center, 0.0) + radius * circle, code)
    studio.add_studio(scene, options.size, options.samples)
    studio.render(scene, options.output)


if __name__ == "__main__":
    main()
