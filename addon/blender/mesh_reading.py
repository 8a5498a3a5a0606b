# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender mesh -> arrays. Reads everything and writes nothing."""

import contextlib
from collections.abc import Iterator

import bmesh
import bpy
import numpy as np

from ..surfaces.surface import Surface
from . import compat
from .errors import TransferError
from .mesh_object import MeshObject

SAME_NORMAL = 1e-3  # most difference of a coordinate: Blender keeps custom normals in 16 bits


def read_surface(obj: MeshObject, selected_only: bool, cut_at: str = "nothing") -> Surface:
    """The object's mesh as a `Surface`, in world space without the translation.

    In Edit Mode the mesh's arrays are brought up to date first. With `selected_only` it is the surface of the selected
    faces. With `cut_at` sharp edges, borders of materials or split normals count as seams. A mirrored object keeps its
    face order: lengths and angles are those of the world, and the UVs stay counter-clockwise in the mesh's own order.
    """
    bring_up_to_date(obj)
    with arrays(obj) as mesh:
        mesh.calc_loop_triangles()
        vertex, edge = compat.corner_indices(mesh)
        size = compat.read_indices(mesh.polygons, "loop_total")
        return Surface(
            positions=_world_positions(obj, mesh),
            corner_vertex=vertex,
            corner_edge=edge,
            face_start=compat.read_indices(mesh.polygons, "loop_start"),
            face_size=size,
            seam=compat.seam_edges(mesh) | _further_seams(mesh, cut_at),
            selected=compat.chosen_faces(mesh) if selected_only else np.ones(len(mesh.polygons), dtype=bool),
            triangle_corners=compat.read_indices(mesh.loop_triangles, "loops", 3),
            triangle_face=np.repeat(np.arange(len(size), dtype=np.int32), size - 2),  # in Blender's order
        )


def _further_seams(mesh: bpy.types.Mesh, cut_at: str) -> np.ndarray:
    """The edges (E,) that count as seams, by a word of the option `cut_at`."""
    seams = np.zeros(len(mesh.edges), dtype=bool)
    if cut_at in ("sharp", "normals", "all"):
        seams |= compat.read(mesh.edges, "use_edge_sharp", bool)
    if cut_at in ("materials", "all"):
        seams |= _edges_between(mesh, np.repeat(compat.read(mesh.polygons, "material_index", np.int32),
                                                compat.read_indices(mesh.polygons, "loop_total"))[:, None])  # fmt: skip
    if cut_at in ("normals", "all") and mesh.has_custom_normals:
        seams |= _edges_between(mesh, compat.corner_normals(mesh), SAME_NORMAL)
    return seams


def _edges_between(mesh: bpy.types.Mesh, values: np.ndarray, tolerance: float = 0.0) -> np.ndarray:
    """The edges (E,) at which faces have different values (C, n) at a corner."""
    vertex, edge = compat.corner_indices(mesh)
    size = compat.read_indices(mesh.polygons, "loop_total")
    after = np.arange(1, len(vertex) + 1)
    last = np.cumsum(size) - 1
    after[last] = last + 1 - size
    ends = np.concatenate([np.arange(len(vertex)), after])
    edge = np.concatenate([edge, edge])
    order = np.lexsort((vertex[ends], edge))
    ends, edge = ends[order], edge[order]
    same = (edge[1:] == edge[:-1]) & (vertex[ends[1:]] == vertex[ends[:-1]])
    apart = same & (np.abs(values[ends[1:]] - values[ends[:-1]]).max(axis=1) > tolerance)
    found = np.zeros(len(mesh.edges), dtype=bool)
    found[edge[1:][apart]] = True
    return found


def bring_up_to_date(obj: MeshObject) -> None:
    """Bring the mesh's arrays up to date with all edits."""
    if obj.mode == "EDIT":
        obj.update_from_editmode()


@contextlib.contextmanager
def arrays(obj: MeshObject) -> Iterator[bpy.types.Mesh]:
    """The object's mesh for reading; in Edit Mode as of the last update.

    In Edit Mode Blender hides the mesh's UVs, and from 3.6 on hands over the other data one by one. So this is a
    temporary copy then, which shares data where Blender can.
    """
    if obj.mode != "EDIT":
        yield obj.data
        return
    try:
        yield obj.to_mesh()  # the object itself, without modifiers and shape keys
    finally:
        obj.to_mesh_clear()


def _world_positions(obj: MeshObject, mesh: bpy.types.Mesh) -> np.ndarray:
    positions = compat.vertex_positions(mesh).astype(np.float64)
    to_world = np.array(obj.matrix_world, dtype=np.float64)[:3, :3]
    if np.array_equal(to_world, np.eye(3)):
        return positions
    return np.einsum("ij,kj->ik", positions, to_world)


def face_materials(obj: MeshObject) -> np.ndarray:
    """Number of the material slot of each face (P,), as in `read_surface`."""
    with arrays(obj) as mesh:
        return compat.read(mesh.polygons, "material_index", np.int32)


def read_mark(obj: MeshObject) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Arrays that change whenever the mesh's faces, their directions or its vertices' places change.

    In Edit Mode they are as of the last update of the mesh's arrays.
    """
    with arrays(obj) as mesh:
        vertex, _ = compat.corner_indices(mesh)
        return compat.read_indices(mesh.polygons, "loop_start"), vertex, compat.vertex_positions(mesh)


def read_uv(obj: MeshObject, layer_name: str) -> np.ndarray | None:
    """UVs (C, 2) of the layer of that name, else of the active layer, or None.

    In Edit Mode they are as of the last update, as in `read_surface`.
    """
    layer = obj.data.uv_layers.get(layer_name) or obj.data.uv_layers.active
    return None if layer is None else read_layer(obj, layer.name)


def layer_named(obj: MeshObject, name: str) -> str:
    """The name of the UV layer of that name, or without a name of the active layer. Raises TransferError without it."""
    found = name or getattr(obj.data.uv_layers.active, "name", "")
    if found not in obj.data.uv_layers:
        raise TransferError(f"{obj.name}: it has no UV layer {found!r}" if found else f"{obj.name}: it has no UVs")
    return found


def read_layer(obj: MeshObject, layer_name: str) -> np.ndarray:
    """UVs (C, 2) of the layer of that name, as in `read_uv`."""
    with arrays(obj) as mesh:
        return compat.corner_uv(mesh.uv_layers[layer_name])


def read_layout(obj: MeshObject, layer_name: str) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Vertex (C,) and edge (C,) of each corner, the next corner (C,) of its face, and its UVs (C, 2) in a layer."""
    mesh = obj.data
    vertex, edge = compat.corner_indices(mesh)
    start, size = (compat.read_indices(mesh.polygons, name) for name in ("loop_start", "loop_total"))
    following = np.arange(1, len(vertex) + 1, dtype=np.int32)
    following[start + size - 1] = start
    return vertex, edge, following, read_layer(obj, layer_name)


def pinned_corners(obj: MeshObject, layer_name: str) -> np.ndarray:
    """Whether each corner (C,) is pinned in a UV layer, as in `read_surface`. No corner is in a missing layer."""
    with arrays(obj) as mesh:
        if layer_name not in mesh.uv_layers:
            return np.zeros(len(mesh.loops), dtype=bool)
        return compat.pins(mesh, mesh.uv_layers[layer_name])


def shows_pins(obj: MeshObject, layer_name: str) -> bool:
    """Whether UVs are pinned in a layer, as far as a panel can see at once: in Object Mode."""
    layer = obj.data.uv_layers.get(layer_name)
    if layer is None or obj.mode != "OBJECT" or obj.data.is_editmode or not compat.reads_pins_at_once(obj.data):
        return False
    return bool(compat.pins(obj.data, layer).any())


def selected_edge_corners(obj: MeshObject, layer_name: str, by_uv: bool, corner_edge: np.ndarray) -> np.ndarray:
    """Which corners (C,) are at the start of selected edges, as in `read_surface`.

    by_uv        edges that are selected in the UV layer, not those of the mesh
    corner_edge  (C,) edge of each corner
    """
    with arrays(obj) as mesh:
        if by_uv:
            return compat.selected_uv(mesh, layer_name)[1]
        return compat.read(mesh.edges, "select", bool)[corner_edge]


def vertex_weights(obj: MeshObject, group: str) -> np.ndarray | None:
    """Weights (V,) in [0, 1] of a vertex group, 0 outside it, or None if the object has no such group.

    In Edit Mode they are as in `read_surface`.
    """
    found = obj.vertex_groups.get(group)
    if found is None:
        return None
    index = found.index
    with arrays(obj) as mesh:
        weights = np.zeros(len(mesh.vertices))
        for number, vertex in enumerate(mesh.vertices):
            for element in vertex.groups:
                if element.group == index:
                    weights[number] = element.weight
    return np.clip(weights, 0.0, 1.0)


def selected_vertices(obj: MeshObject) -> np.ndarray:
    """Whether each vertex (V,) of an object in Edit Mode is selected, as in `read_surface`."""
    with arrays(obj) as mesh:
        return compat.read(mesh.vertices, "select", bool)


def shown_faces(obj: MeshObject) -> np.ndarray:
    """Whether each face (P,) is not hidden, as in `read_surface`."""
    with arrays(obj) as mesh:
        return compat.shown_faces(mesh)


def active_vertex(obj: MeshObject) -> int | None:
    """Index of the active vertex of an object in Edit Mode, or None."""
    if obj.mode != "EDIT":
        return None
    active = bmesh.from_edit_mesh(obj.data).select_history.active
    return active.index if isinstance(active, bmesh.types.BMVert) else None


def cursor_place(obj: MeshObject) -> np.ndarray:
    """The place of the 3D cursor in the space of `read_surface`."""
    cursor = bpy.context.scene.cursor.location
    return np.array(cursor, dtype=np.float64) - np.array(obj.matrix_world.translation, dtype=np.float64)
