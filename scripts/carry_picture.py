# SPDX-License-Identifier: GPL-3.0-or-later
"""The picture of one texture on two faces: in the UV square, on the face it was painted for, carried to another one.

    blender -b blend_samples/face_five_holes.blend --factory-startup --python-exit-code 1 \\
        -P scripts/carry_picture.py -- OUT.png [--fit-holes] [--size 1750x700] [--samples 48]

The add-on of this checkout maps the first face and carries the texture. In the UV square the first face's holes are
open, the second's, after the alignment, ringed.
"""

import argparse
import sys
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))

import face_paint  # noqa: E402
import render_uv  # noqa: E402
import studio  # noqa: E402
import uv_loops  # noqa: E402
from guide_picture import addon_module  # noqa: E402

SAMPLES = Path(__file__).resolve().parent.parent / "blend_samples"
OTHER, LAYER, PIXELS = "face_surprised", "Koebe", 2048
VIEW = (0.34, -1.0, 0.0)
PLACES = (-1.5, 0.32, 1.72)  # of the UV square and the two faces in a picture 5 wide
RING = "#1668d8"


def parse():
    """The options after "--"."""
    parser = argparse.ArgumentParser(prog="carry_picture.py", description=__doc__.splitlines()[0])
    parser.add_argument("output", type=Path)
    parser.add_argument("--fit-holes", action="store_true")
    parser.add_argument("--size", type=render_uv._size, default=(1750, 700), metavar="WIDTHxHEIGHT")
    parser.add_argument("--samples", type=int, default=48)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def add_other():
    """The second face, beside the first in the scene."""
    with bpy.data.libraries.load(str(SAMPLES / f"{OTHER}.blend")) as (_, loaded):
        loaded.objects = [OTHER]
    bpy.context.scene.collection.objects.link(loaded.objects[0])
    bpy.context.view_layer.update()
    return loaded.objects[0]


def map_and_carry(source, target, fit_holes):
    """UVs for the first face, and for the second such that the texture of the first fits it."""
    job = addon_module("jobs.map_job").Job([source], addon_module("maps.options").Options(checker=False))
    job.compute()
    job.write()
    job = addon_module("jobs.shape_jobs").CarryJob([source, target], LAYER, fit_holes)
    job.compute()
    job.write(with_material=False)
    return job.carried[0]


def holes_of(circles):
    """Eyes, nostrils and mouth among the circles of a face that stands upright in the unit disk."""
    holes = sorted(((complex(*center), radius) for center, radius in circles), key=lambda hole: hole[1])[:-1]
    nostrils, mouth = holes[:2], min(holes[2:], key=lambda hole: hole[0].imag)
    eyes = sorted((hole for hole in holes[2:] if hole is not mouth), key=lambda hole: hole[0].real)
    return eyes, nostrils, mouth


def painted(circles):
    """The texture as an image."""
    eyes, nostrils, mouth = holes_of(circles)
    colors = face_paint.sugar_skull(PIXELS, eyes, nostrils, mouth)
    image = bpy.data.images.new("sugar skull", PIXELS, PIXELS)
    pixels = np.ones((PIXELS, PIXELS, 4), np.float32)
    pixels[..., :3] = colors
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    return image


def main():
    options = parse()
    source = next(obj for obj in bpy.context.scene.objects if obj.type == "MESH")
    target = add_other()
    carried = map_and_carry(source, target, options.fit_holes)
    print(f"holes apart by {carried.residual:.4f}, worst {carried.largest:.4f}, {carried.angle_error:.2f} deg, "
          f"{carried.flipped} flips")  # fmt: skip
    bpy.context.scene.camera.rotation_euler = Vector(VIEW).to_track_quat("Z", "Y").to_euler()
    bpy.context.view_layer.update()
    meshes = [uv_loops.read_uv_mesh(obj.data, LAYER) for obj in (source, target)]
    seen = [render_uv.seen_points(obj, vertex) for obj, (vertex, *_) in zip((source, target), meshes)]
    loops = [uv_loops.boundary_loops(corners, sizes) for _, _, corners, sizes in meshes]
    circles = [[uv_loops.fitted_circle(uv[loop]) for loop in rims] for (_, uv, *_), rims in zip(meshes, loops)]
    disk = [[(2.0 * center - 1.0, 2.0 * radius) for center, radius in one] for one in circles]
    material = studio.image_material(painted(disk[0]), LAYER)

    scene = bpy.data.scenes.new("picture")
    bpy.context.window.scene = scene
    flat = np.column_stack([render_uv.CELL * (2.0 * meshes[0][1] - 1.0), np.zeros(len(meshes[0][1]))])
    seen = [points + (1.0, 0.0, 0.0) for points in seen]
    drawn = ((meshes[0], flat, False), (meshes[0], seen[0], True), (meshes[1], seen[1], True))
    for ((_, uv, corners, sizes), points, smooth), place in zip(drawn, PLACES):
        studio.add_mesh(scene, points + (place, 0.0, 0.0), corners, sizes, uv, LAYER, material, smooth)
    turn = np.linspace(0, 2 * np.pi, 256, endpoint=False)
    ring = np.column_stack([np.cos(turn), np.sin(turn), np.zeros(256)])
    for center, radius in disk[1]:
        if radius < 0.9:
            middle = np.append(render_uv.CELL * center, 0.01) + (PLACES[0], 0.0, 0.0)
            studio.add_ring(scene, middle + render_uv.CELL * radius * ring, RING)
    studio.add_studio(scene, options.size, options.samples)
    studio.render(scene, options.output)


if __name__ == "__main__":
    main()
