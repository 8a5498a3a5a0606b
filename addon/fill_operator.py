# SPDX-License-Identifier: GPL-3.0-or-later
"""The operator that fills holes."""

import bmesh
import bpy

from . import hole_filling, native
from .modes import target_objects


class MESH_OT_koebe_fill_holes(bpy.types.Operator):
    """Fill holes with real faces that continue the surface around them. They are selected afterwards, and the UVs
    are continued into them: the inside of a hole's circle is used. This changes the mesh"""

    bl_idname = "mesh.koebe_fill_holes"
    bl_label = "Koebe Fill Holes"
    bl_options = {"REGISTER", "UNDO"}

    which: bpy.props.EnumProperty(
        name="Loops",
        items=[
            (hole_filling.HOLES, "Holes", "All boundary loops but the longest of each connected part"),
            (hole_filling.SELECTED, "Selected", "The boundary loops whose edges are all selected"),
            (hole_filling.ALL, "All", "All boundary loops: the surface is closed"),
        ],
        default=hole_filling.HOLES,
        description="Boundary loops to fill",
    )

    @classmethod
    def poll(cls, context):
        if context.mode not in {"OBJECT", "EDIT_MESH"} or not target_objects(context):
            cls.poll_message_set("Select a mesh object")
            return False
        return True

    def execute(self, context):
        try:
            koebe = native.load()
        except native.NativeError as error:
            self.report({"ERROR"}, f"Koebe UV: {error}")
            return {"CANCELLED"}
        objects = {obj.data: obj for obj in target_objects(context)}
        meshes, problems = {}, []
        for data, obj in objects.items():
            if data.library is not None:
                problems.append(f"{obj.name}: its mesh is linked from another file")
                continue
            mesh = _open(obj)
            try:
                loops = hole_filling.chosen_loops(mesh, self.which)
                meshes[obj] = mesh, [hole_filling.filling(koebe, mesh, loop) for loop in loops]
            except hole_filling.FillError as error:
                problems.append(f"{obj.name}: {error}")
        for obj, (mesh, fillings) in meshes.items():
            _select_only(mesh, hole_filling.add_faces(mesh, fillings))
            _close(obj, mesh)
        if not meshes:
            self.report({"ERROR"}, "Koebe UV: nothing was filled. " + ". ".join(problems))
            return {"CANCELLED"}
        holes = sum(len(fillings) for _, fillings in meshes.values())
        faces = sum(len(one.triangles) for _, fillings in meshes.values() for one in fillings)
        text = f"Koebe UV: {holes} {'hole' if holes == 1 else 'holes'} filled with {faces} faces"
        self.report({"WARNING" if problems else "INFO"}, ". ".join([text, *problems]))
        return {"FINISHED"}


def _open(obj):
    if obj.mode == "EDIT":
        return bmesh.from_edit_mesh(obj.data)
    mesh = bmesh.new()
    mesh.from_mesh(obj.data)
    return mesh


def _close(obj, mesh):
    if obj.mode == "EDIT":
        bmesh.update_edit_mesh(obj.data)
    else:
        mesh.to_mesh(obj.data)
        mesh.free()
        obj.data.update()


def _select_only(mesh, faces):
    for elements in (mesh.verts, mesh.edges, mesh.faces):
        for element in elements:
            element.select_set(False)
    mesh.select_history.clear()
    for face in faces:
        face.select_set(True)
    mesh.normal_update()


def register():
    """Register the operator."""
    bpy.utils.register_class(MESH_OT_koebe_fill_holes)


def unregister():
    """Undo `register`."""
    bpy.utils.unregister_class(MESH_OT_koebe_fill_holes)
