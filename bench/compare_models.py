# SPDX-License-Identifier: GPL-3.0-or-later
"""The models of bench/compare.py, as triangles: Blender's own, this project's samples, scans where they are beside.

The variable MODELS of the environment names a folder of OBJ or OFF files, to compare on these as well.
"""

import os
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
SHARED = ROOT.parent / "shared" / "meshes"
SAMPLES = ROOT / "blend_samples"

BLENDERS_OWN = {
    "Suzanne": lambda mesh: (mesh.primitive_monkey_add(), subdivide(2)),
    "sphere": lambda mesh: mesh.primitive_uv_sphere_add(segments=64, ring_count=32),
    "torus": lambda mesh: mesh.primitive_torus_add(major_segments=96, minor_segments=32),
    "cube": lambda mesh: (mesh.primitive_cube_add(), subdivide(4)),
    "cylinder": lambda mesh: mesh.primitive_cylinder_add(vertices=64),
    "cone": lambda mesh: mesh.primitive_cone_add(vertices=64),
}
SAMPLE_FILES = ("character", "hand", "mug", "closed_head", "face_five_holes", "perforated_panel", "bowl", "vase",
                "suzanne_mask")  # fmt: skip
SCANS = (
    "good/cat_8k_2.obj", "good/makehuman_body_13k_8.obj", "good/os_plane_holes.obj", "good/bear_14k_10.obj",
    "good/choi_lion5.obj", "good/choi_alex3.obj", "good/ict_head_neutral.obj", "good/mediapipe_face_3.obj",
    "good/fig10_nefertiti_18k_5.obj", "good/demosthenes_15holes.obj", "good/cgal_pig.obj", "good/vtk_torso.obj",
    "hostile/genus1_kitten_closed.off", "hostile/genus2_one_loop.off",
)  # fmt: skip


def subdivide(levels):
    """Catmull and Clark's subdivision of the active object, applied."""
    import bpy

    modifier = bpy.context.object.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = levels
    bpy.ops.object.modifier_apply(modifier=modifier.name)


def names():
    """The models that the algorithm was made with, as far as they are here."""
    return [*BLENDERS_OWN, *SAMPLE_FILES, *(Path(scan).stem for scan in SCANS if (SHARED / scan).exists())]


def unseen():
    """The files of the folder MODELS: name -> path."""
    folder = os.environ.get("MODELS")
    found = sorted(Path(folder).iterdir()) if folder else []
    return {path.stem: path for path in found if path.suffix in (".obj", ".off")}


def arrays(name):
    """Vertices (V, 3) and triangles (F, 3)."""
    path = {**unseen(), **{Path(scan).stem: SHARED / scan for scan in SCANS}}.get(name)
    return read(path) if path else from_blender(name)


def from_blender(name):
    import bpy

    bpy.ops.wm.read_factory_settings(use_empty=True)
    if name in BLENDERS_OWN:
        BLENDERS_OWN[name](bpy.ops.mesh)
    else:
        bpy.ops.wm.open_mainfile(filepath=str(SAMPLES / f"{name}.blend"))
    obj = next(one for one in bpy.data.objects if one.type == "MESH")
    mesh = obj.evaluated_get(bpy.context.evaluated_depsgraph_get()).to_mesh()
    mesh.calc_loop_triangles()
    points = np.empty(3 * len(mesh.vertices))
    mesh.vertices.foreach_get("co", points)
    triangles = np.empty(3 * len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles)
    return points.reshape(-1, 3), triangles.reshape(-1, 3)


def read(path):
    """An OBJ or OFF file of polygons, as fans of triangles."""
    words = [line.split() for line in path.read_text().splitlines() if line.strip() and line[0] != "#"]
    if path.suffix == ".obj":
        points = [line[1:4] for line in words if line[0] == "v"]
        faces = [[int(word.split("/")[0]) - 1 for word in line[1:]] for line in words if line[0] == "f"]
    else:
        counts = words[1] if len(words[0]) == 1 else words[0][1:]
        rest = words[2 if len(words[0]) == 1 else 1:]
        points = [line[:3] for line in rest[: int(counts[0])]]
        faces = [[int(word) for word in line[1 : 1 + int(line[0])]]
                 for line in rest[int(counts[0]) : int(counts[0]) + int(counts[1])]]  # fmt: skip
    triangles = [[face[0], one, other] for face in faces for one, other in zip(face[1:], face[2:])]
    return np.array(points, float), np.array(triangles, np.int32)
