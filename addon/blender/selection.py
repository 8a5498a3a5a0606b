# SPDX-License-Identifier: GPL-3.0-or-later
"""Selects elements of meshes in Edit Mode, or objects, and notes the selection before."""

import dataclasses
import itertools
import operator
from collections.abc import Iterable, Sequence
from typing import Any

import bmesh
import bpy

from ..surfaces.offending_elements import EDGES, FACES, VERTICES
from .mesh_object import MeshObject, mesh_objects
from .targets import with_own_meshes
from .transaction import Transaction


@dataclasses.dataclass
class Selection:
    """What is selected in a mesh in Edit Mode.

    mode     its select mode, which the scene's may differ from
    flags    whether each vertex, edge and face is selected
    history  the last selected elements in order, by kind and number
    active   the number of the active face, or None
    """

    mode: set[str]
    flags: list[list[bool]]
    history: list[tuple[str, int]]
    active: int | None

    @classmethod
    def of(cls, obj: MeshObject) -> "Selection":
        """The selection now."""
        mesh = bmesh.from_edit_mesh(obj.data)
        by_kind = _by_kind(mesh)
        for elements in by_kind.values():
            elements.index_update()
        flags = [list(map(operator.attrgetter("select"), elements)) for elements in by_kind.values()]
        order: Any = mesh.select_history  # by number, as Python 3.13 does not iterate over it
        last = [order[i] for i in range(len(order))]
        history = [(VERTICES if isinstance(one, bmesh.types.BMVert) else EDGES if isinstance(one, bmesh.types.BMEdge)
                    else FACES, one.index) for one in last]  # fmt: skip
        active = mesh.faces.active
        return cls(set(mesh.select_mode), flags, history, None if active is None else active.index)

    @property
    def mode_flags(self) -> tuple[bool, ...]:
        """The mode as the scene's setting has it."""
        return tuple(kind in self.mode for kind in ("VERT", "EDGE", "FACE"))

    def restore(self, obj: MeshObject) -> None:
        """Select these elements alone again, in the same mode."""
        mesh = bmesh.from_edit_mesh(obj.data)
        if mesh.select_mode != self.mode:
            mesh.select_mode = self.mode
        if Selection.of(obj) == self:
            return
        select_none(mesh)
        by_kind = _by_kind(mesh)
        for elements, chosen in zip(by_kind.values(), self.flags, strict=True):
            elements.ensure_lookup_table()
            for element in itertools.compress(elements, chosen):
                element.select_set(True)
        for kind, index in self.history:
            mesh.select_history.add(by_kind[kind][index])
        mesh.faces.active = None if self.active is None else mesh.faces[self.active]
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def select_only(
    run: Transaction, context: bpy.types.Context, chosen: Sequence[tuple[MeshObject, str, Iterable[int]]]
) -> None:
    """Select these elements alone. `chosen` lists (object in Edit Mode, kind, indices).

    The select mode follows the kinds. Indices that no longer exist are ignored.
    """
    kinds = {kind for _, kind, _ in chosen}
    objects = list(dict.fromkeys(obj for obj, _, _ in chosen))
    note_selection(run, context, _edited(context))  # all, as they share the select mode
    context.tool_settings.mesh_select_mode = (VERTICES in kinds, EDGES in kinds, FACES in kinds)
    meshes = {obj: bmesh.from_edit_mesh(obj.data) for obj in objects}
    for mesh in meshes.values():
        select_none(mesh)
    for obj, kind, indices in chosen:
        mesh = meshes[obj]
        elements = _by_kind(mesh)[kind]
        elements.ensure_lookup_table()
        for index in indices:
            if index < len(elements):
                elements[index].select_set(True)
    for obj, mesh in meshes.items():
        mesh.select_flush_mode()
        bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)


def select_none(mesh: bmesh.types.BMesh) -> None:
    """Deselect all of a bmesh."""
    for elements in (mesh.faces, mesh.edges, mesh.verts):
        for element in elements:
            element.select_set(False)
    mesh.select_history.clear()


def _by_kind(mesh: bmesh.types.BMesh) -> dict[str, Any]:
    return {VERTICES: mesh.verts, EDGES: mesh.edges, FACES: mesh.faces}


def _edited(context: bpy.types.Context) -> list[MeshObject]:
    return with_own_meshes(obj for obj in mesh_objects(context.view_layer.objects) if obj.mode == "EDIT")


def note_selection(run: Transaction, context: bpy.types.Context, objects: list[MeshObject]) -> None:
    """Note the select mode, and the selection in the meshes of objects in Edit Mode."""
    for obj in objects:
        run.before_write(Selection.of(obj).restore, obj)
    run.before_write(_restore_select_mode, context.tool_settings, tuple(context.tool_settings.mesh_select_mode))


def _restore_select_mode(settings: bpy.types.ToolSettings, mode: tuple[bool, bool, bool]) -> None:
    settings.mesh_select_mode = mode


def edges_along(obj: MeshObject, vertices: list[int], closed: bool = True) -> list[int | None]:
    """Edges of an object in Edit Mode along a path of vertices; of a closed path also from its end to its start.

    None for an edge that no longer exists.
    """
    mesh = bmesh.from_edit_mesh(obj.data)
    mesh.verts.ensure_lookup_table()
    pairs = zip(vertices, vertices[1:] + vertices[:1] if closed else vertices[1:], strict=closed)
    known = [[mesh.verts[v] for v in pair if v < len(mesh.verts)] for pair in pairs if pair[0] != pair[1]]
    edges = [mesh.edges.get(pair) if len(pair) == 2 else None for pair in known]
    return [None if edge is None else edge.index for edge in edges]


def select_objects(run: Transaction, context: bpy.types.Context, made: list[bpy.types.Object]) -> None:
    """Select these objects alone, and make the first one active."""
    layer = context.view_layer
    chosen = [obj.name for obj in layer.objects if obj.select_get(view_layer=layer)]
    active = layer.objects.active and layer.objects.active.name
    run.before_write(_restore_objects, layer, chosen, active)
    for obj in layer.objects:
        obj.select_set(obj in made, view_layer=layer)
    layer.objects.active = made[0]


def _restore_objects(layer: bpy.types.ViewLayer, chosen: list[str], active: str | None) -> None:
    for obj in layer.objects:
        obj.select_set(obj.name in chosen, view_layer=layer)
    layer.objects.active = layer.objects.get(active) if active else None
