# SPDX-License-Identifier: GPL-3.0-or-later
"""The guide's picture of a textured model: the vase, unrolled, in a pattern that repeats around it.

    blender -b blend_samples/vase.blend --factory-startup --python-exit-code 1 -P scripts/guide_picture.py -- OUT.jpg

The vase is mapped as `addon/batch.py --tube unroll` maps it; the pattern is computed here, so no file goes with it.
"""

import sys
from pathlib import Path

import bpy
import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path[:0] = [str(ROOT / "scripts"), str(ROOT / "tests" / "python")]

import studio  # noqa: E402
from addon_support import addon_module  # noqa: E402

PIXELS = 256
REPEATS = 12.0  # of the pattern around the vase: a whole number, so that it meets itself at the cut
PAPER, INK = (0.93, 0.90, 0.82), (0.05, 0.13, 0.36)


def mapped(obj, domain, squares):
    """Map the object to one of the domains beside the disk; returns what became of its island."""
    options = addon_module("maps.options").Options(checker_size=squares)
    choice = addon_module("maps.domain_table").DOMAINS[domain].choice()
    job = addon_module("jobs.job_of_domain").job_type(choice)([obj], options, choice)
    job.compute()
    job.write()
    (one,) = job.outcomes[0].mapped
    return one


def pattern():
    """One repeat as an image: a flower in a diamond."""
    s, t = np.meshgrid(*2 * [np.linspace(-1, 1, PIXELS, endpoint=False)])
    r, angle, diamond = np.hypot(s, t), np.arctan2(t, s), np.abs(s) + np.abs(t)
    petals = (r < 0.62 * np.abs(np.cos(2 * angle)) ** 0.6) & (r > 0.1)
    ink = petals | (np.abs(diamond - 0.96) < 0.05) | (np.hypot(np.abs(s) - 1, np.abs(t) - 1) < 0.2) | (r < 0.06)
    image = bpy.data.images.new("pattern", PIXELS, PIXELS)
    pixels = np.ones((PIXELS, PIXELS, 4), np.float32)
    pixels[..., :3] = np.where(ink[..., None], INK, PAPER)
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    return image


def textured(image):
    """A glazed material that shows the image by the layer Koebe."""
    material = bpy.data.materials.new("glaze")
    if material.node_tree is None:
        material.use_nodes = True
    nodes, link = material.node_tree.nodes, material.node_tree.links.new
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    surface.inputs["Roughness"].default_value = 0.25
    uv, scale, texture = (nodes.new(f"ShaderNode{kind}") for kind in ("UVMap", "VectorMath", "TexImage"))
    uv.uv_map, scale.operation, texture.image = "Koebe", "SCALE", image
    scale.inputs["Scale"].default_value = REPEATS
    link(uv.outputs["UV"], scale.inputs[0])
    link(scale.outputs[0], texture.inputs["Vector"])
    link(texture.outputs["Color"], surface.inputs["Base Color"])
    return material


def main():
    output = Path(sys.argv[sys.argv.index("--") + 1]).absolute()
    scene = bpy.context.scene
    obj = next(obj for obj in scene.objects if obj.type == "MESH")
    job = addon_module("jobs.map_job").Job([obj], addon_module("maps.options").Options(tube="unroll", checker=False))
    job.compute()
    job.write()
    obj.data.materials.append(textured(pattern()))
    for polygon in obj.data.polygons:
        polygon.use_smooth = True
    studio.surround(scene, (0.75, 0.76, 0.78, 1.0), 0.7)
    render = scene.render
    render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", 16
    scene.view_settings.view_transform = "Standard"
    render.resolution_x, render.resolution_y, render.resolution_percentage = 560, 560, 100
    studio.render(scene, output)


if __name__ == "__main__":
    main()
