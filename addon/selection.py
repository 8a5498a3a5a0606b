# SPDX-License-Identifier: GPL-3.0-or-later
"""Selects elements of meshes in Edit Mode."""

import bmesh
import bpy

from .offenders import EDGES, FACES, VERTICES, offending_elements


def enter_edit_mode(context, obj):
    """Make the object the active one and enter Edit Mode with it, unless it is there already."""
    if obj.mode == "EDIT":
        return
    if context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for other in context.selected_objects:
        other.select_set(False)
    obj.select_set(True)
    context.view_layer.objects.active = obj
    bpy.ops.object.mode_set(mode="EDIT")


def select_only(context, chosen):
    """Select these elements and nothing else: `chosen` lists (object in Edit Mode, kind, indices).

    The select mode becomes that of the kinds. Indices that no longer exist are passed over.
    """
    kinds = {kind for _, kind, _ in chosen}
    context.tool_settings.mesh_select_mode = (VERTICES in kinds, EDGES in kinds, FACES in kinds)
    meshes = {obj: bmesh.from_edit_mesh(obj.data) for obj, _, _ in chosen}
    for mesh in meshes.values():
        for elements in (mesh.verts, mesh.edges, mesh.faces):
            elements.ensure_lookup_table()
            for element in elements:
                element.select_set(False)
        mesh.select_history.clear()
    for obj, kind, indices in chosen:
        mesh = meshes[obj]
        elements = {VERTICES: mesh.verts, EDGES: mesh.edges, FACES: mesh.faces}[kind]
        for index in indices:
            if index < len(elements):
                elements[index].select_set(True)
    for obj, mesh in meshes.items():
        mesh.select_flush_mode()
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def edges_along(obj, vertices):
    """Edges of an object in Edit Mode along a closed loop of vertices, as far as they still exist."""
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    known = [mesh.verts[v] for v in vertices if v < len(mesh.verts)]
    edges = [mesh.edges.get(pair) for pair in zip(known, known[1:] + known[:1], strict=True) if pair[0] != pair[1]]
    return [edge.index for edge in edges if edge is not None]


def select_offenders(context, job):
    """Select what is wrong with the islands that failed, in those objects that are in Edit Mode."""
    chosen = [
        (obj, *offending_elements(task.surface, failure))
        for obj, task, outcome in zip(job.objects, job.tasks, job.outcomes, strict=True)
        if obj.mode == "EDIT"
        for failure in outcome.failed
    ]
    if chosen:
        select_only(context, chosen)
