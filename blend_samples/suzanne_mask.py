"""The front of Blender's own Suzanne, with eyes and mouth open."""

import bmesh
import bpy
from mathutils import Vector

CUT = Vector((0.0, -0.485, 0.0))
BACKWARD = Vector((0.0, 1.0, 0.0))
SUBDIVISIONS = 3
# The floor of the pit that is Suzanne's mouth, in the undivided model: |x|, depth y and height z.
PIT = ((0.0, 0.10), (-0.68, -0.60), (-0.88, -0.74))


def suzanne_mask():
    """Points and faces: eyes taken out, mouth pit opened, subdivided, cut just behind the brows, along the muzzle."""
    cage = bmesh.new()
    bmesh.ops.create_monkey(cage)
    eyes = [v for part in _parts(cage) if len(part) < 100 for v in part]
    pit = [v for v in cage.verts if all(low <= x <= high for x, (low, high) in zip((abs(v.co.x), *v.co.yz), PIT))]
    bmesh.ops.delete(cage, geom=eyes + pit, context="VERTS")
    head = _subdivided(cage)
    _cut(head)
    points = [tuple(v.co) for v in head.verts]
    faces = [[v.index for v in face.verts] for face in head.faces]
    head.free()
    return points, faces


def _parts(bm):
    """The vertices of each connected part."""
    left = set(bm.verts)
    while left:
        part, front = set(), [left.pop()]
        while front:
            v = front.pop()
            part.add(v)
            near = {e.other_vert(v) for e in v.link_edges} & left
            left -= near
            front += near
        yield sorted(part, key=lambda v: v.index)


def _subdivided(cage):
    """The Catmull-Clark surface of a cage, which is freed."""
    mesh = bpy.data.meshes.new("cage")
    cage.to_mesh(mesh)
    cage.free()
    obj = bpy.data.objects.new("cage", mesh)
    bpy.context.scene.collection.objects.link(obj)
    obj.modifiers.new("Subdivision", "SUBSURF").levels = SUBDIVISIONS
    result = bmesh.new()
    result.from_object(obj, bpy.context.evaluated_depsgraph_get())
    bpy.data.objects.remove(obj)
    bpy.data.meshes.remove(mesh)
    return result


def _cut(bm):
    """Keep what is before the cut plane. Vertices nearer to it than 0.35 of their shortest edge are moved onto it
    first, so that no sliver arises."""
    for v in bm.verts:
        offset = (v.co - CUT).dot(BACKWARD)
        if abs(offset) < 0.35 * min(e.calc_length() for e in v.link_edges):
            v.co -= offset * BACKWARD
    everything = bm.verts[:] + bm.edges[:] + bm.faces[:]
    bmesh.ops.bisect_plane(bm, geom=everything, dist=1e-6, plane_co=CUT, plane_no=BACKWARD, clear_outer=True)
    bmesh.ops.triangulate(bm, faces=[face for face in bm.faces if len(face.verts) > 4])
    bm.verts.index_update()
