# SPDX-License-Identifier: GPL-3.0-or-later
"""Cycles pictures without grain, where Blender is built without OpenImageDenoise, as Debian's is."""

import itertools
import tempfile
from pathlib import Path

import bpy
import numpy as np

LIGHT = ("DiffDir", "DiffInd", "GlossDir", "GlossInd")
PASSES = ("Image", *LIGHT, "DiffCol", "GlossCol", "Normal", "Depth")
STEPS = (1, 2, 4, 8, 16)  # pixels between the taps of the filter, one pass each
CONTRAST = 0.2  # difference of log light, in the mean of 9 pixels, that still counts as grain
TURN = 0.25  # distance of two normals that are alike
GAP = 0.02  # depth beside the tangent plane, in units of the scene


def rendered_passes(scene):
    """Render the scene: name of a pass -> array (height, width, 3), rows from below."""
    layer = scene.view_layers[0]
    for name in ("diffuse_direct", "diffuse_indirect", "diffuse_color", "glossy_direct", "glossy_indirect",
                 "glossy_color", "normal", "z"):  # fmt: skip
        setattr(layer, f"use_pass_{name}", True)
    scene.use_nodes = True
    tree = scene.node_tree
    tree.nodes.clear()
    source, files = tree.nodes.new("CompositorNodeRLayers"), tree.nodes.new("CompositorNodeOutputFile")
    source.scene = scene
    tree.links.new(source.outputs["Image"], tree.nodes.new("CompositorNodeComposite").inputs["Image"])
    files.format.file_format, files.format.color_depth, files.format.exr_codec = "OPEN_EXR", "32", "NONE"
    files.file_slots.clear()
    with tempfile.TemporaryDirectory() as folder:
        files.base_path = folder
        for name in PASSES:
            files.file_slots.new(name)
            tree.links.new(source.outputs[name], files.inputs[name])
        bpy.ops.render.render(scene=scene.name)
        return {name: _pixels(next(Path(folder).glob(f"{name}[0-9]*"))) for name in PASSES}


def _pixels(path):
    image = bpy.data.images.load(str(path))
    width, height = image.size
    values = np.empty(4 * width * height, np.float32)
    image.pixels.foreach_get(values)
    bpy.data.images.remove(image)
    return values.reshape(height, width, 4)[..., :3]


def smooth(light, normal, depth):
    """Light averaged over pixels of one smooth surface: edge-avoiding wavelets [Dammertz et al. 2010].

    @param light, normal (h, w, 3); @param depth (h, w)
    """
    slopes = np.gradient(depth)
    for step in STEPS:
        total, weights = np.zeros_like(light), np.zeros_like(depth)
        (high, wide), near = depth.shape, np.pad(light.mean(axis=2), 1, mode="edge")
        near = sum(near[i : i + high, j : j + wide] for i, j in itertools.product(range(3), repeat=2))
        tone = np.log(near / 9 + 1e-3)
        rim = [(step, step)] * 2
        framed = [np.pad(a, rim + [(0, 0)] * (a.ndim - 2), mode="edge") for a in (light, tone, normal, depth)]
        for down, right in itertools.product((-1, 0, 1), repeat=2):
            here = np.s_[step * (1 + down) :, step * (1 + right) :]
            there = [a[here][:high, :wide] for a in framed]
            off = np.abs(there[3] - depth - step * (down * slopes[0] + right * slopes[1])) / (GAP * step)
            off += np.abs(there[1] - tone) / CONTRAST + ((there[2] - normal) ** 2).sum(axis=2) / TURN**2
            weight = np.exp(-off) / 2 ** (abs(down) + abs(right))
            total += weight[..., None] * there[0]
            weights += weight
        light = total / weights[..., None]
    return light


def render_smoothly(scene, path):
    """Render the scene to a file: its light is smoothed, its colours are not."""
    found = rendered_passes(scene)
    image, depth = found["Image"].copy(), np.minimum(found["Depth"][..., 0], 1e3)
    for kind in ("Diff", "Gloss"):
        light = found[f"{kind}Dir"] + found[f"{kind}Ind"]
        image += (smooth(light, found["Normal"], depth) - light) * found[f"{kind}Col"]
    height, width = depth.shape
    picture = bpy.data.images.new("picture", width, height, float_buffer=True)
    picture.pixels.foreach_set(np.dstack([image, np.ones_like(depth)]).ravel())
    picture.save_render(str(path), scene=scene)
