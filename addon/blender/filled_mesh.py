# SPDX-License-Identifier: GPL-3.0-or-later
"""Fills holes of an object's mesh. Plans everything first, then writes, so that the mesh can be restored."""

import itertools
from types import ModuleType
from typing import Any

import bmesh
import bpy
import numpy as np

from . import compat
from .hole_filling import FillError, Filling, chosen_loops, filling
from .mesh_object import MeshObject
from .selection import note_selection, select_none
from .targets import check_mesh
from .transaction import Transaction


class FillPlan:
    """The patches for the chosen holes of one object. Call `free` at the end."""

    def __init__(self, koebe: ModuleType, obj: MeshObject, which: str) -> None:
        """Make the plan; nothing is written. Raises FillError, or TransferError if the mesh cannot be written."""
        check_mesh(obj)
        _check_attributes(obj.data)
        self.obj, self._edited = obj, obj.mode == "EDIT"
        if self._edited:
            obj.update_from_editmode()  # brings the shape keys up to date
            self._mesh = bmesh.from_edit_mesh(obj.data)
        else:
            self._mesh = bmesh.new()
        try:
            if not self._edited:
                self._mesh.from_mesh(obj.data)
            self._mesh.verts.index_update()
            keys = _shape_keys(obj.data)
            taken: set[frozenset[int]] = set()
            self.fillings = [
                filling(koebe, self._mesh, loop, keys) for loop in chosen_loops(self._mesh, which)
            ]
            for one in self.fillings:
                _check_new(one, taken)
        except BaseException:
            self.free()
            raise

    @property
    def faces(self) -> int:
        """Number of faces to add."""
        return sum(len(one.triangles) for one in self.fillings)

    def write(self, run: Transaction, context: bpy.types.Context) -> None:
        """Add the faces, and select them alone."""
        if self._edited:
            note_selection(run, context, [self.obj])
            for elements in _elements(self._mesh):
                for element in elements:
                    element.tag = True
            _tag_examples(self.fillings, False)  # copies would have the tag, too
            run.before_write(_remove_untagged, self.obj, self.fillings)  # all present elements are tagged now
            _fill(self._mesh, self.fillings)
            bmesh.update_edit_mesh(self.obj.data)
            return
        before = bmesh.new()
        before.from_mesh(self.obj.data)
        run.before_write(_put_back, self.obj.data, before)
        _fill(self._mesh, self.fillings)
        self._mesh.to_mesh(self.obj.data)
        self.obj.data.update()

    def free(self) -> None:
        """Free the memory; the plan is unusable afterwards."""
        self.fillings = []
        if not self._edited:
            self._mesh.free()


def _check_attributes(mesh: bpy.types.Mesh) -> None:
    for attribute in mesh.attributes:
        if attribute.data_type == "FLOAT4X4":
            raise FillError(f"the attribute {attribute.name!r} holds matrices: Blender may crash on them")


def _check_new(one: Filling, taken: set[frozenset[int]]) -> None:
    """Raise FillError if two patches would add the same face."""
    rim = [corner.vert.index for corner in one.corners]
    for triangle in one.triangles[(one.triangles < len(rim)).all(axis=1)].tolist():
        face = frozenset(rim[v] for v in triangle)
        if face in taken:
            raise FillError("two holes have the same vertices: select one hole and fill it, then the other")
        taken.add(face)


def _shape_keys(mesh: bpy.types.Mesh) -> dict[str, np.ndarray]:
    """Positions (V, 3) of the vertices in each shape key, by name."""
    if mesh.shape_keys is None:
        return {}
    return {block.name: compat.read(block.data, "co", np.float32, 3) for block in mesh.shape_keys.key_blocks}


def _elements(mesh: bmesh.types.BMesh) -> tuple[Any, Any, Any]:
    return mesh.faces, mesh.edges, mesh.verts


def _fill(mesh: bmesh.types.BMesh, fillings: list[Filling]) -> None:
    """Add the patches to a bmesh and select them."""
    added = []
    for one in fillings:
        rim, beside = [corner.vert for corner in one.corners], one.corners[0].face
        new = [
            mesh.verts.new(position, rim[near]) for position, near in zip(one.vertices, one.continued.nearest.tolist())
        ]
        vertices, triangles = rim + new, one.triangles.tolist()
        faces = [mesh.faces.new([vertices[v] for v in triangle], beside) for triangle in triangles]
        one.continued.give(mesh, one.corners, new, faces, triangles)
        for name, uv in one.uvs.items():
            layer = mesh.loops.layers.uv[name]
            for face, triangle in zip(faces, triangles, strict=True):
                for corner, v in zip(face.loops, triangle, strict=True):
                    corner[layer].uv = uv[v]
        for layer in mesh.loops.layers.uv.values():
            for corner in itertools.chain.from_iterable(face.loops for face in faces):
                corner[layer].pin_uv = False
        added += faces
    select_none(mesh)
    for face in added:
        face.select_set(True)
    mesh.normal_update()


def _tag_examples(fillings: list[Filling], tag: bool) -> None:
    for one in fillings:
        one.corners[0].face.tag = tag
        for corner in one.corners:
            corner.vert.tag = tag


def _remove_untagged(obj: MeshObject, fillings: list[Filling]) -> None:
    """Remove elements that were added to a mesh in Edit Mode: all without a tag, except the examples."""
    mesh = bmesh.from_edit_mesh(obj.data)
    _tag_examples(fillings, True)
    for elements in _elements(mesh):
        for element in reversed([element for element in elements if not element.tag]):
            elements.remove(element)  # from the last on, so that the next ones get their places in order
    mesh.normal_update()
    bmesh.update_edit_mesh(obj.data)


def _put_back(data: bpy.types.Mesh, before: bmesh.types.BMesh) -> None:
    before.to_mesh(data)
    data.update()
