"""A .blend file around one mesh: the object, a camera on its best side, three soft lights."""

import gzip
from pathlib import Path

import bpy
from mathutils import Vector


def new_scene(name, points, faces):
    """An empty file with the object of this name; returns it."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([tuple(map(float, p)) for p in points], [], [[int(v) for v in face] for face in faces])
    if mesh.validate():
        raise ValueError(f"{name}: faces with repeated or missing vertices")
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    obj = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    obj.select_set(True)
    return obj


def light_and_frame(obj, view):
    """Camera and lights for an object seen from direction `view`; light comes from the camera's upper left."""
    scene = bpy.context.scene
    corners = [Vector(corner) for corner in obj.bound_box]
    center = sum(corners, Vector()) / 8
    size = max((corner - center).length for corner in corners)
    camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    camera.data.lens = 85.0
    camera.data.clip_end = 100.0 * size
    camera.rotation_euler = Vector(view).to_track_quat("Z", "Y").to_euler()
    turn = camera.rotation_euler.to_matrix()
    camera.location = center + turn @ Vector((0.0, 0.0, 5.6 * size))
    for name, place, energy, width in (
        ("Key", (-2.0, 2.2, 2.6), 120.0, 1.6),
        ("Fill", (3.0, 0.2, 2.0), 28.0, 3.0),
        ("Rim", (1.2, 2.4, -2.4), 70.0, 1.6),
    ):
        light = bpy.data.objects.new(name, bpy.data.lights.new(name, "AREA"))
        light.data.energy = energy * size**2
        light.data.size = width * size
        light.location = center + turn @ (size * Vector(place))
        light.rotation_euler = (light.location - center).to_track_quat("Z", "Y").to_euler()
        scene.collection.objects.link(light)
    scene.render.resolution_x, scene.render.resolution_y = 1200, 1200


def save(path):
    """Save the open file, compressed, without the notes that Blender makes in it of where it was saved and of the
    user's home folder."""
    draft = Path(path).absolute()
    draft.unlink(missing_ok=True)  # Blender would keep it as a backup
    bpy.ops.wm.save_as_mainfile(filepath=str(draft), compress=False, check_existing=False)
    content = draft.read_bytes()
    for place in (str(draft).encode(), str(Path.home()).encode() + b"\0"):
        content = content.replace(place, bytes(len(place)))
    draft.write_bytes(gzip.compress(content, 9, mtime=0))
