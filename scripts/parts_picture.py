# SPDX-License-Identifier: GPL-3.0-or-later
"""A model unwrapped to parts, and drawn: left in a checker whose ink is each part's own, right its parts in the UVs.

    blender -b IN.blend --factory-startup --python-exit-code 1 -P scripts/parts_picture.py -- --output OUT.png [options]

    --report FILE      the figures, as JSON
    --blend FILE       the file with the UVs
    --evenness X       the panel's slider, 0 to 1 (0.5)
    --darts D          the panel's darts, 0 to 1 (by default the panel's)
    --important X,Y,Z,R    weight 1 at this place, shares of the model's box, and less up to R of its longest side away
    --density D        texel density in pixels per unit on a texture of 2,048 pixels
    --stack            parts that are copies or mirror images lie on each other
    --size 1200x600    width and height in pixels; OUT may be a .jpg
    --samples N        Cycles samples per pixel (12)

The guide's pictures are those of hand and mug at 1000x500. The file has one mesh, which is mapped as the operator Koebe
Unwrap to Parts maps it. IN is not changed.
"""

import argparse
import json
import sys
from pathlib import Path

import bpy
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))

import guide_picture  # noqa: E402
import render_uv  # noqa: E402
import studio  # noqa: E402
import uv_loops  # noqa: E402

LAYER = "Koebe"
INKS = ("#36656f", "#b5533c", "#6b7f3a", "#7a5b8e", "#b8862f", "#3f6ea3", "#a34e70", "#4b8a72")


def parse():
    """The options after "--"."""
    parser = argparse.ArgumentParser(prog="parts_picture.py", description=__doc__.splitlines()[0])
    parser.add_argument("--output", type=Path, required=True)
    parser.add_argument("--report", type=Path)
    parser.add_argument("--blend", type=Path)
    parser.add_argument("--evenness", type=float, default=0.5)
    parser.add_argument("--darts", type=float)
    parser.add_argument("--important", type=lambda text: tuple(map(float, text.split(","))))
    parser.add_argument("--density", type=float)
    parser.add_argument("--stack", action="store_true")
    parser.add_argument("--size", type=lambda text: tuple(map(int, text.split("x"))), default=(1200, 600))
    parser.add_argument("--samples", type=int, default=12)
    return parser.parse_args(sys.argv[sys.argv.index("--") + 1 :])


def weigh(obj, place):
    """A vertex group whose weights fall off around a place. @return its name"""
    points = np.empty(3 * len(obj.data.vertices), np.float32)
    obj.data.vertices.foreach_get("co", points)
    points = points.reshape(-1, 3)
    size = np.ptp(points, axis=0)
    away = np.linalg.norm(points - points.min(axis=0) - size * place[:3], axis=1) / size.max()
    group = obj.vertex_groups.new(name="important")
    for v, weight in enumerate(np.clip(1.5 - 1.5 * away / place[3], 0.0, 1.0).tolist()):
        group.add([v], weight, "REPLACE")
    return group.name


def unwrapped(obj, options):
    """Map the object; returns the result and each face's part."""
    module = guide_picture.addon_module
    chosen = {"evenness": options.evenness, "stack_mirrored": options.stack}
    if options.darts is not None:
        chosen["darts"] = options.darts
    if options.important:
        chosen["importance"] = weigh(obj, options.important)
    if options.density:
        chosen |= {"texels": "number", "density": options.density}
    choice = module("maps.options").PartsChoice(**chosen)
    job = module("jobs.parts_job").PartsJob([obj], module("maps.options").Options(checker=False), choice)
    job.compute()
    job.write()
    outcome = job.outcomes[0]
    if not outcome.mapped:
        sys.exit(f"parts_picture: {outcome.error or outcome.not_written}")
    part = np.zeros(len(obj.data.polygons), np.int32)
    result = outcome.mapped[0].result
    part[outcome.task.surface.triangle_face] = result.part
    return result, part


def figures(result):
    """What expected.json has bounds for, and more."""
    return {
        "parts": len(result.parts),
        "triangles": len(result.part),
        "cut_length": result.cut_length,
        "density": result.density_ratio_5_95,
        "angle_error": result.angle_error_deg["mean"],
        "flipped": result.flipped,
        "below_resolution": result.below_resolution,
        "seconds": result.seconds["total"],
    }


def draw(obj, part, options):
    """Render model and layout in a scene of their own."""
    vertex, uv, corners, sizes = uv_loops.read_uv_mesh(obj.data, LAYER)
    surface = render_uv.seen_points(obj, vertex)
    flat = np.column_stack([(uv - 0.5) * 2 * render_uv.CELL + (1.0, 0.0), np.zeros(len(uv))])
    inks = [studio.darker_behind(studio.new_checker(LAYER, ink)) for ink in INKS]
    scene = bpy.data.scenes.new("picture")
    bpy.context.window.scene = scene
    for points, smooth in ((surface, True), (flat, False)):
        mesh = studio.add_mesh(scene, points, corners, sizes, uv, LAYER, inks[0], smooth)
        for ink in inks[1:]:
            mesh.materials.append(ink)
        mesh.polygons.foreach_set("material_index", part % len(INKS))
    studio.add_studio(scene, options.size, options.samples)
    studio.render(scene, options.output)


def main():
    options = parse()
    obj = next(obj for obj in bpy.context.scene.objects if obj.type == "MESH")
    result, part = unwrapped(obj, options)
    if options.report:
        options.report.write_text(json.dumps(figures(result), indent=1) + "\n", encoding="utf-8")
    if options.blend:
        bpy.ops.wm.save_as_mainfile(filepath=str(options.blend.absolute()), copy=True)
    draw(obj, part, options)


if __name__ == "__main__":
    main()
