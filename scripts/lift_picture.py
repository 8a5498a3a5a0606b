# SPDX-License-Identifier: GPL-3.0-or-later
"""The pictures of docs/lift.md: a ring with a lattice of hexagons, a lampshade of Voronoi cells, a vase with text; in
lift_sphere.jpg an egg of Voronoi cells, a woven basket, a pebble with text; in lift_rows.jpg a mask of lace with rows
around its eyes and mouth, and a sleeve for a forearm whose holes are smaller at the wrist; in lift_rims.jpg a shield
four times, with the choices at its rims and with sizes by weights.

    blender -b --factory-startup --python-exit-code 1 -P scripts/lift_picture.py -- docs/images/lift.jpg [SAMPLES]

The command `koebe lift` makes them; the environment variable KOEBE_COMMAND may name another one.
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy
import numpy as np
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))

import studio  # noqa: E402

COMMAND = os.environ.get("KOEBE_COMMAND", str(Path(__file__).resolve().parent.parent / "build" / "koebe"))
SIZE = (1280, 500)
VASE_TURN = 1.45  # radians, so that the text faces the camera
HOLES = ((-0.286, -0.816, 0.0), (0.286, -0.816, 0.0), (0.0, -0.933, -0.717))  # of the face: middles of eyes and mouth
SHARP = 0.6  # radians between two faces at an edge that is not smooth


def tube(rows, around, place):
    """A tube of quadrilaterals, cut in two: place(share of the height, angle) -> (n, 3)."""
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows + 1), np.arange(around), indexing="ij"))
    points = place(i / rows, 2 * np.pi * j / around)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(around), indexing="ij"))
    a, b = i * around + j, i * around + (j + 1) % around
    c, d = a + around, b + around
    return points, np.concatenate([np.stack([a, b, d], 1), np.stack([a, d, c], 1)])


def finger_ring(height, angle):
    """A ring for a finger in millimetres, a little rounded outwards."""
    z = 6.4 * (height - 0.5)
    radius = 9.5 + 0.5 * np.cos(np.pi * (height - 0.5))
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), z])


def lampshade(height, angle):
    radius = 5.6 + 2.3 * np.sin(np.pi * (0.12 + 0.78 * height)) - 1.2 * height
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 15.0 * height])


def vase(height, angle):
    """A vase in centimetres."""
    radius = 4.2 + 2.6 * np.sin(np.pi * (0.1 + 1.02 * height**0.9)) + 1.1 * height**6
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 19.0 * height])


def bowl(height, angle):
    radius = 3.2 + 2.6 * np.sin(0.5 * np.pi * height) + 0.35 * height**6
    return np.column_stack([radius * np.cos(angle), radius * np.sin(angle), 6.5 * height])


def forearm(height, angle):
    """A sleeve for a forearm in centimetres, from the wrist upwards: it bends a little, and is flatter at the wrist."""
    radius = 2.9 + 2.1 * np.sin(0.5 * np.pi * np.minimum(1.0, 1.25 * height)) - 0.5 * height**4
    flat = 0.74 + 0.2 * height
    bend = 1.1 * height**2
    return np.column_stack([radius * np.cos(angle) + bend, flat * radius * np.sin(angle), 21.0 * height])


def globe(steps, place):
    """An octahedron divided by steps and put on the unit sphere: place((n, 3)) -> (n, 3)."""
    points, faces, number = [], [], {}

    def vertex(p):
        key = tuple(p)
        if key not in number:
            number[key] = len(points)
            points.append(np.array(p, float) / np.linalg.norm(p))
        return number[key]

    for signs in np.ndindex(2, 2, 2):
        x, y, z = (1 - 2 * k for k in signs)
        for i in range(steps):
            for j in range(steps - i):
                at = [vertex((x * a, y * b, z * (steps - a - b))) for a, b in
                      ((i, j), (i + 1, j), (i, j + 1), (i + 1, j + 1)) if a + b <= steps]  # fmt: skip
                two = [[at[0], at[1], at[2]]] + ([[at[1], at[3], at[2]]] if len(at) == 4 else [])
                faces += two if x * y * z > 0 else [face[::-1] for face in two]
    return place(np.array(points)), np.array(faces)


def egg(p):
    return p * (0.72, 0.72, 1.0) * (1.0 - 0.16 * p[:, 2:])


def pebble(p):
    return p * (1.0, 0.72, 0.5) * (1.0 + 0.06 * p[:, :1])


def write_weave(file, rows):
    """Strands that run over and under each other: two across, and so many along."""
    lines, begin = [], 1

    def strand(middle, across):
        nonlocal begin
        ring = np.arange(12) * np.pi / 6
        for m in middle:
            for a in ring:
                p = m + 0.3 * np.cos(a) * across + (0.0, 0.0, 0.13 * np.sin(a))
                lines.append("v {} {} {}".format(*p))
        for i in range(len(middle) - 1):
            for j in range(12):
                a, b = begin + 12 * i + j, begin + 12 * i + (j + 1) % 12
                lines.append(f"f {a} {b} {b + 12} {a + 12}")
        begin += 12 * len(middle)

    along = np.linspace(0.0, 2.0, 25)
    up = np.linspace(0.0, rows, 12 * rows + 1)
    for j in range(rows):
        wave = 0.17 * (-1) ** j * np.sin(np.pi * along)
        strand(np.column_stack([along, 0 * along + j + 0.5, wave]), np.array([0.0, -1.0, 0.0]))
    for i in range(2):
        wave = -0.17 * (-1) ** i * np.sin(np.pi * up)
        strand(np.column_stack([0 * up + i + 0.5, up, wave]), np.array([1.0, 0.0, 0.0]))
    Path(file).write_text("\n".join(lines) + "\n", encoding="ascii")


def write_text(file, text):
    """The outlines of a text as an SVG drawing."""
    font = bpy.data.curves.new("text", "FONT")
    font.body = text
    obj = bpy.data.objects.new("text", font)
    bpy.context.scene.collection.objects.link(obj)
    path = ""
    for spline in obj.to_curve(bpy.context.evaluated_depsgraph_get()).splines:
        points = list(spline.bezier_points)
        path += f"M{points[0].co.x} {-points[0].co.y}"
        for a, b in zip(points, points[1:] + points[:1]):
            path += "C" + " ".join(f"{p.x} {-p.y}" for p in (a.handle_right, b.handle_left, b.co))
        path += "Z"
    bpy.data.objects.remove(obj)
    text = f'<svg xmlns="http://www.w3.org/2000/svg"><path fill-rule="evenodd" d="{path}"/></svg>'
    Path(file).write_text(text, encoding="ascii")


def read_mesh(file):
    """Points and triangles of an OBJ file."""
    rows = [line.split() for line in Path(file).read_text(encoding="ascii").splitlines()]
    polygons = [[int(corner.split("/")[0]) - 1 for corner in row[1:]] for row in rows if row and row[0] == "f"]
    fans = [(corners[0], *corners[i : i + 2]) for corners in polygons for i in range(1, len(corners) - 1)]
    return np.array([row[1:4] for row in rows if row and row[0] == "v"], float), np.array(fans)


def lifted(points, faces, *options):
    """What `koebe lift` makes of a mesh: points and triangles."""
    with tempfile.TemporaryDirectory() as folder:
        surface, solid = Path(folder) / "in.obj", Path(folder) / "out.obj"
        lines = ["v {} {} {}".format(*p) for p in points] + ["f {} {} {}".format(*f) for f in faces + 1]
        surface.write_text("\n".join(lines) + "\n", encoding="ascii")
        pattern, *rest = options
        subprocess.run([COMMAND, "lift", surface, pattern, solid, *rest], check=True)
        return read_mesh(solid)


def metal(name, color, roughness, metallic):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    surface = material.node_tree.nodes["Principled BSDF"]
    surface.inputs["Base Color"].default_value = color
    surface.inputs["Roughness"].default_value, surface.inputs["Metallic"].default_value = roughness, metallic
    return material


def add(name, solid, material, place, turn, scale):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(solid[0].tolist(), [], solid[1].tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if hasattr(mesh, "use_auto_smooth"):
        mesh.use_auto_smooth, mesh.auto_smooth_angle = True, SHARP
    else:
        mesh.set_sharp_from_angle(angle=SHARP)
    mesh.materials.append(material)
    obj = bpy.data.objects.new(name, mesh)
    obj.location, obj.rotation_euler, obj.scale = place, turn, (scale,) * 3
    bpy.context.scene.collection.objects.link(obj)


def add_lamp(place, energy, size, color=(1.0, 1.0, 1.0), at=(0.0, 0.0, 0.5)):
    light = bpy.data.lights.new("light", "AREA")
    light.energy, light.size, light.color = energy, size, color
    lamp = bpy.data.objects.new("light", light)
    lamp.location = place
    lamp.rotation_euler = (Vector(place) - Vector(at)).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(lamp)


def add_tubes():
    ring = lifted(*tube(24, 240, finger_ring), "hexagons", "--shape", "ring", "--perforate", "--repeats", "36",
                  "--bridge", "0.45", "--thickness", "1.1")  # fmt: skip
    shade = lifted(*tube(90, 220, lampshade), "voronoi", "--shape", "ring", "--perforate", "--size", "2.4",
                   "--bridge", "0.5", "--thickness", "0.45")  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        drawing = Path(folder) / "text.svg"
        write_text(drawing, "Koebe")
        text = lifted(*tube(240, 300, vase), drawing, "--shape", "ring", "--size", "13", "--height", "0.25",
                      "--thickness", "0.5")  # fmt: skip
    add("ring", ring, metal("gold", (0.9, 0.6, 0.22, 1.0), 0.22, 1.0), (-2.15, 0.0, 0.88), (0.62, -0.3, 0.0), 0.105)
    add("shade", shade, metal("clay", (0.62, 0.55, 0.47, 1.0), 0.6, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.0), 0.135)
    add("vase", text, metal("glaze", (0.05, 0.2, 0.3, 1.0), 0.25, 0.0), (2.1, 0.1, 0.0), (0.0, 0.0, VASE_TURN), 0.105)


def add_spheres():
    hollow = lifted(*globe(64, egg), "voronoi", "--shape", "sphere", "--perforate", "--size", "0.3", "--bridge", "0.07",
                    "--thickness", "0.06")  # fmt: skip
    with tempfile.TemporaryDirectory() as folder:
        weave, drawing = Path(folder) / "weave.obj", Path(folder) / "text.svg"
        write_weave(weave, 10)
        basket = lifted(*tube(60, 240, bowl), weave, "--shape", "ring", "--repeats", "22")
        write_text(drawing, "Koebe")
        points, faces = globe(80, pebble)
        front = np.argmin(points[:, 1] + 3.0 * abs(points[:, 0]))
        text = lifted(points, faces, drawing, "--shape", "sphere", "--around", str(front),
                      "--size", "1.1", "--height", "0.035")  # fmt: skip
    add("egg", hollow, metal("shell", (0.75, 0.5, 0.3, 1.0), 0.35, 0.0), (-2.2, 0.0, 0.96), (0.0, 0.0, 0.3), 0.86)
    add("basket", basket, metal("willow", (0.4, 0.22, 0.09, 1.0), 0.55, 0.0), (0.1, 0.3, 0.04), (0.0, 0.0, 0.0), 0.19)
    add("pebble", text, metal("slate", (0.13, 0.16, 0.2, 1.0), 0.4, 0.0), (2.25, -0.2, 0.5), (-0.5, 0.0, 0.0), 1.0)


def finer(points, faces):
    """The triangles of a smooth surface through the mesh."""
    mesh = bpy.data.meshes.new("coarse")
    mesh.from_pydata(points.tolist(), [], faces.tolist())
    obj = bpy.data.objects.new("coarse", mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.modifiers.new("fine", "SUBSURF").levels = 2
    fine = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    fine.calc_loop_triangles()
    result = np.array([v.co for v in fine.vertices]), np.array([t.vertices for t in fine.loop_triangles])
    bpy.data.objects.remove(obj)
    return result


def lace_mask():
    """The sample's face, its eyes and mouth ringed by rows of slots, and filled with circles."""
    points, faces = finer(*read_mesh(Path(__file__).resolve().parent.parent / "blend_samples" / "face.obj"))
    holes = [points[np.argmin(np.linalg.norm(points - middle, axis=1))] for middle in HOLES]
    for rim, repeats in zip(holes, (12, 12, 14), strict=True):
        at = int(np.argmin(np.linalg.norm(points - rim, axis=1)))  # the vertex is still there
        points, faces = lifted(points, faces, "stripes", "--around", str(at), "--rows", "4", "--repeats", str(repeats),
                               "--size", "0.1", "--bridge", "0.035", "--perforate")  # fmt: skip
    return lifted(points, faces, "circles", "--size", "0.085", "--bridge", "0.022", "--perforate")


def add_rows():
    sleeve = lifted(*tube(120, 200, forearm), "hexagons", "--shape", "ring", "--perforate", "--repeats", "22",
                    "--bridge", "0.3", "--thickness", "0.3")  # fmt: skip
    lace = metal("lace", (0.03, 0.03, 0.045, 1.0), 0.55, 0.0)
    add("mask", lace_mask(), lace, (-1.05, 0.0, 1.3), (0.0, 0.0, 0.2), 1.05)
    add("sleeve", sleeve, metal("nylon", (0.1, 0.16, 0.24, 1.0), 0.5, 0.0), (1.35, 0.2, 0.0), (0.0, 0.0, 0.4), 0.105)


def shield(height, angle):
    """A bent plate with a hole, from the outer rim inwards."""
    radius = 1.0 - 0.72 * height
    x, z = radius * np.cos(angle), 1.12 * radius * np.sin(angle) + 0.1 * height
    return np.column_stack([x, 0.35 * x**2 + 0.2 * z**2 - 0.3, z])


def add_rims():
    points, faces = tube(60, 180, shield)
    glaze = metal("glaze", (0.08, 0.2, 0.28, 1.0), 0.35, 0.0)
    with tempfile.TemporaryDirectory() as folder:
        weights = Path(folder) / "weights.txt"
        shares = np.clip(0.62 + 0.5 * points[:, 2] / 1.12, 0, 1)
        weights.write_text("\n".join(map(str, shares)), encoding="ascii")
        for k, more in enumerate((["--rim", "leave"], ["--rim", "clip"], ["--rim", "whole"],
                                  ["--rim", "whole", "--graded", weights])):  # fmt: skip
            plate = lifted(points, faces, "hexagons", "--perforate", "--size", "0.21", "--bridge", "0.045",
                           "--thickness", "0.05", *more)  # fmt: skip
            add(f"plate {k}", plate, glaze, (2.1 * (k - 1.5) * 0.78, 0.2, 0.93), (0.0, 0.0, 0.0), 0.78)


def main():
    out, *samples = sys.argv[sys.argv.index("--") + 1 :]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    {"lift_sphere": add_spheres, "lift_rows": add_rows, "lift_rims": add_rims}.get(Path(out).stem, add_tubes)()
    bpy.ops.mesh.primitive_plane_add(size=60.0)
    bpy.context.object.data.materials.append(studio.plain_material(studio.BACKDROP))
    add_lamp((-3.0, -3.5, 5.0), 170.0, 2.5)
    add_lamp((4.0, -2.0, 3.5), 50.0, 3.0)
    glow = bpy.data.lights.new("glow", "POINT")
    glow.energy, glow.color, glow.shadow_soft_size = 16.0, (1.0, 0.72, 0.4), 0.12
    if Path(out).stem == "lift_rims":  # it would shine between the plates
        glow.energy = 0.0
    lamp = bpy.data.objects.new("glow", glow)
    lamp.location = (0.0, 0.1, 1.0)
    scene.collection.objects.link(lamp)
    studio.surround(scene, (0.9, 0.93, 1.0, 1.0), 0.42)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.lens = 50.0
    camera.location = (0.05, -10.2, 3.6)
    camera.rotation_euler = (Vector((0.05, 0.0, 0.98)) - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.collection.objects.link(camera)
    scene.camera = camera
    render = scene.render
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = SIZE
    render.use_stamp_filename = False
    scene.view_settings.view_transform = "Standard"
    scene.cycles.device, scene.cycles.samples, scene.cycles.adaptive_threshold = "CPU", int(*samples or [72]), 0.03
    scene.cycles.max_bounces = 3
    studio.render(scene, out)


main()
