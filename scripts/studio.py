# SPDX-License-Identifier: GPL-3.0-or-later
"""The look of the pictures: colours, materials, rings, light and camera."""

from pathlib import Path

import bpy
import grain
import numpy as np
from mathutils import Vector

CHECKER = "Koebe Checker"
CHECKER_SIZE = 48.0
PAPER, INK = "#e8e2d6", "#36656f"
BACKDROP = "#e9e6e1"
OUTER = "#24343a"
HOLES = ("#e2583e", "#eda52f", "#8a4f9e", "#3a9bc4", "#5c9e4c", "#cc3f74")
RIM = 0.006  # radius of the rings, where the picture is 4 wide


def loop_colors(circles):
    """Colour per loop: dark for outer ones, which lie in no other circle; the holes take turns."""
    colors = []
    holes = 0
    for i, (center, radius) in enumerate(circles):
        inside = (
            np.linalg.norm(center - other) < size and radius < size for j, (other, size) in enumerate(circles) if j != i
        )
        if any(inside):
            colors.append(HOLES[holes % len(HOLES)])
            holes += 1
        else:
            colors.append(OUTER)
    return colors


def _linear(code):
    """An sRGB colour code as linear RGBA."""
    values = [int(code[i : i + 2], 16) / 255 for i in (1, 3, 5)]
    return [v / 12.92 if v <= 0.04045 else ((v + 0.055) / 1.055) ** 2.4 for v in values] + [1.0]


def _node_material(name):
    """A new material with an empty node tree, and the tree."""
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    return material, material.node_tree


def plain_material(code):
    """A matt colour."""
    material, tree = _node_material(code)
    surface = tree.nodes.new("ShaderNodeBsdfDiffuse")
    surface.inputs["Color"].default_value = _linear(code)
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(surface.outputs[0], output.inputs["Surface"])
    return material


def checker_material(obj, layer):
    """The object's own checker, or one like it, whose back side is darker."""
    own = [slot.material for slot in obj.material_slots if slot.material and slot.material.name.startswith(CHECKER)]
    return darker_behind(own[0].copy() if own else new_checker(layer))


def image_material(image, layer):
    """A matt skin that shows an image by a UV layer, and whose back side is darker."""
    material, tree = _node_material(image.name)
    uv, texture = tree.nodes.new("ShaderNodeUVMap"), tree.nodes.new("ShaderNodeTexImage")
    uv.uv_map, texture.image, texture.extension = layer, image, "EXTEND"
    tree.links.new(uv.outputs["UV"], texture.inputs["Vector"])
    _principled(tree, texture.outputs["Color"])
    return darker_behind(material)


def darker_behind(material):
    """The material with its back side darkened."""
    tree = material.node_tree
    output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
    front = output.inputs["Surface"].links[0].from_socket
    mix, dark = tree.nodes.new("ShaderNodeMixShader"), tree.nodes.new("ShaderNodeBsdfDiffuse")
    half, side = tree.nodes.new("ShaderNodeMath"), tree.nodes.new("ShaderNodeNewGeometry")
    half.operation = "MULTIPLY"
    half.inputs[1].default_value = 0.6
    dark.inputs["Color"].default_value = _linear(OUTER)
    tree.links.new(side.outputs["Backfacing"], half.inputs[0])
    tree.links.new(half.outputs[0], mix.inputs[0])
    tree.links.new(front, mix.inputs[1])
    tree.links.new(dark.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], output.inputs["Surface"])
    return material


def new_checker(layer, ink=INK):
    """A checker by a UV layer, paper and ink."""
    material, tree = _node_material(CHECKER)
    uv, checker = tree.nodes.new("ShaderNodeUVMap"), tree.nodes.new("ShaderNodeTexChecker")
    uv.uv_map = layer
    checker.inputs["Color1"].default_value = _linear(PAPER)
    checker.inputs["Color2"].default_value = _linear(ink)
    checker.inputs["Scale"].default_value = CHECKER_SIZE
    tree.links.new(uv.outputs["UV"], checker.inputs["Vector"])
    _principled(tree, checker.outputs["Color"])
    return material


def _principled(tree, color):
    """A surface of this colour as the tree's output."""
    surface, output = tree.nodes.new("ShaderNodeBsdfPrincipled"), tree.nodes.new("ShaderNodeOutputMaterial")
    surface.inputs["Roughness"].default_value = 0.55
    tree.links.new(color, surface.inputs["Base Color"])
    tree.links.new(surface.outputs["BSDF"], output.inputs["Surface"])


def add_mesh(scene, points, corners, sizes, uv, layer, material, smooth):
    """A mesh object whose UV layer repeats the map; returns its mesh."""
    faces = np.split(corners, np.cumsum(sizes)[:-1])
    mesh = bpy.data.meshes.new("drawn")
    mesh.from_pydata(points.tolist(), [], [face.tolist() for face in faces])
    mesh.uv_layers.new(name=layer).data.foreach_set("uv", uv[corners].astype(np.float32).ravel())
    mesh.polygons.foreach_set("use_smooth", [smooth] * len(sizes))
    mesh.materials.append(material)
    scene.collection.objects.link(bpy.data.objects.new("drawn", mesh))
    return mesh


def add_ring(scene, points, code):
    """A closed tube through points (n, 3), thinner where the ring is small."""
    curve = bpy.data.curves.new("ring", "CURVE")
    curve.dimensions = "3D"
    curve.bevel_depth = np.clip(0.12 * np.ptp(points[:, :2], axis=0).max(), RIM / 3, RIM)
    curve.bevel_resolution = 3
    spline = curve.splines.new("POLY")
    spline.points.add(len(points) - 1)
    spline.points.foreach_set("co", np.column_stack([points, np.ones(len(points))]).astype(np.float32).ravel())
    spline.use_cyclic_u = True
    curve.materials.append(bpy.data.materials.get(code) or plain_material(code))
    scene.collection.objects.link(bpy.data.objects.new("ring", curve))


def add_studio(scene, size, samples):
    """Backdrop, light, camera and render settings."""
    bpy.ops.mesh.primitive_plane_add(size=40.0, location=(0.0, 0.0, -0.025))
    bpy.context.object.data.materials.append(plain_material(BACKDROP))
    for place, energy, width in (((-1.8, 3.4, 5.4), 250.0, 2.2), ((3.5, -1.0, 5.0), 70.0, 4.0)):
        light = bpy.data.lights.new("light", "AREA")
        light.energy, light.size = energy, width
        lamp = bpy.data.objects.new("light", light)
        lamp.location = place
        lamp.rotation_euler = Vector(place).to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(lamp)
    surround(scene, (1.0, 1.0, 1.0, 1.0), 0.55)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type, camera.data.sensor_fit = "ORTHO", "HORIZONTAL"
    camera.data.ortho_scale = max(4.0, 2.0 * size[0] / size[1])
    camera.location = (0.0, 0.0, 10.0)
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = size
    render.resolution_percentage = 100
    render.use_stamp_filename = False  # a picture names no folder of this machine
    scene.view_settings.view_transform = "Standard"
    scene.cycles.device = "CPU"
    scene.cycles.samples = samples
    scene.cycles.adaptive_threshold = 0.02
    scene.cycles.max_bounces = 1


def surround(scene, color, strength):
    """A world that is light in this colour on all sides."""
    scene.world = bpy.data.worlds.new("world")
    if scene.world.node_tree is None:
        scene.world.use_nodes = True
    background = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
    background.inputs["Color"].default_value = color
    background.inputs["Strength"].default_value = strength


def render(scene, path):
    """Render the scene to a file, .jpg or .png, without grain."""
    form = scene.render.image_settings
    form.file_format, form.quality = "JPEG" if Path(path).suffix == ".jpg" else "PNG", 85
    form.color_mode = "RGB"
    scene.cycles.use_denoising = _can_denoise()
    if not scene.cycles.use_denoising:
        grain.render_smoothly(scene, Path(path).absolute())
        return
    scene.render.filepath = str(Path(path).absolute())
    bpy.ops.render.render(write_still=True, scene=scene.name)


def render_finely(scene, size, path):
    """Render the scene in the studio, all its rings equally thin."""
    add_studio(scene, size, 16)
    for curve in bpy.data.curves:
        curve.bevel_depth = 0.006
    render(scene, path)


def _can_denoise():
    """Some distributions build Cycles without OpenImageDenoise."""
    import _cycles

    return _cycles.with_openimagedenoise
