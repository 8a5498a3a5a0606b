"""Copies of meshes of other packages, with fields of a map or with other vertices: PyVista, trimesh, meshio, GIfTI."""

import copy
import importlib
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Floats, Whole
from .meshes import VTK_PIXEL, Polygons, is_ragged, kind_of, padded, unpadded

UV, LOG_SCALE, ANGLE_ERROR, VERTEX = "koebe_uv", "koebe_log_scale", "koebe_angle_error", "koebe_vertex"
CORNER_UV, SPHERE = "koebe_corner_uv", "koebe_sphere"

_SHAPE, _VECTOR, _NONE = 2005, 1007, 0  # NIfTI's intent codes


@dataclass(frozen=True)
class Fields:
    """What a map says of a mesh.

    uv       (V, 2) texture coordinates; NaN where a vertex has none, or several
    points   the fields of the vertices: name -> (V,) or (V, k)
    faces    the fields of the faces: name -> (P,) or (P, k)
    """

    uv: Floats
    points: dict[str, Floats]
    faces: dict[str, Floats]


def mesh_with_fields(mesh: Any, polygons: Polygons, fields: Fields) -> Any:
    """A copy of the mesh with texture coordinates and fields."""
    # Cells that are no faces (points, lines) have NaN.
    of_cells = {}
    for name, values in fields.faces.items():
        of_cells[name] = np.full((polygons.cell_count, *values.shape[1:]), np.nan)
        of_cells[name][polygons.cell] = values
    # Each package has its own place for fields.
    kind = kind_of(mesh)
    if kind == "trimesh":
        result = mesh.copy()
        _put_uv(result, fields.uv)
        result.vertex_attributes.update(fields.points)
        result.face_attributes.update(of_cells)
    elif kind == "pyvista":
        result = mesh.copy(deep=True)
        for name, values in {UV: fields.uv, **fields.points}.items():
            result.point_data[name] = values
        for name, values in of_cells.items():
            result.cell_data[name] = values
        result.active_texture_coordinates = fields.uv
    elif kind == "gifti":
        result = copy.deepcopy(mesh)
        gifti = importlib.import_module("nibabel.gifti")
        for name, values in {UV: fields.uv, **fields.points, **of_cells}.items():
            intent = _NONE if name in of_cells else _SHAPE if values.ndim == 1 else _VECTOR
            array = gifti.GiftiDataArray(np.float32(values), intent, "NIFTI_TYPE_FLOAT32", meta={"Name": name})
            result.add_gifti_data_array(array)
    else:
        result = copy.deepcopy(mesh)
        result.point_data.update({UV: fields.uv, **fields.points})
        ends = np.cumsum([len(block.data) for block in result.cells])[:-1]
        for name, values in of_cells.items():
            result.cell_data[name] = np.split(values, ends)
    return result


def mesh_with_vertices(mesh: Any, polygons: Polygons, old: Whole, corners: Whole) -> Any:
    """A copy of the mesh, of any kind that does not keep its vertices, with other vertices under its faces, and the
    field koebe_vertex.

    old      (n,) the vertex that each new one is a copy of; the first V are the old ones, in their order
    corners  (C,) new vertex of each corner of the polygons
    Points and lines keep their vertices. New vertices carry their old vertices' data.
    """
    kind = kind_of(mesh)
    if kind == "trimesh":
        trimesh = importlib.import_module("trimesh")
        result = trimesh.Trimesh(
            np.asarray(mesh.vertices)[old],
            corners.reshape(-1, 3),
            process=False,
            metadata=copy.deepcopy(mesh.metadata),
            vertex_attributes={name: np.asarray(values)[old] for name, values in mesh.vertex_attributes.items()},
            face_attributes={name: np.array(values) for name, values in mesh.face_attributes.items()},
        )
        result.vertex_attributes[VERTEX] = old
        _copy_visual(mesh.visual, result, old)
    elif kind == "pyvista":
        result = _pyvista_with_vertices(mesh, polygons, old, corners)
        result.point_data[VERTEX] = old
    else:
        result = copy.deepcopy(mesh)
        result.points = np.asarray(mesh.points)[old]
        result.point_data = {name: np.asarray(values)[old] for name, values in mesh.point_data.items()}
        result.point_data[VERTEX] = old
        # Corners are in the order of the blocks.
        begin = 0
        for block in result.cells:
            if block.type in ("vertex", "line"):
                continue
            sizes = [len(face) for face in block.data]
            part = corners[begin : begin + sum(sizes)]
            begin += sum(sizes)
            if is_ragged(block.data):
                block.data = np.split(part, np.cumsum(sizes)[:-1])
            else:
                block.data = part.reshape(len(sizes), -1).astype(np.asarray(block.data).dtype)
    return result


def _copy_visual(visual: Any, mesh: Any, old: Whole) -> None:
    """Give a Trimesh the colours or the material of another one, whose vertices `old` it has."""
    kind = getattr(visual, "kind", None)
    if kind == "vertex":
        mesh.visual.vertex_colors = np.asarray(visual.vertex_colors)[old]
    elif kind == "face":
        mesh.visual.face_colors = np.array(visual.face_colors)
    elif kind == "texture":
        mesh.visual = type(visual)(material=visual.material)
        mesh.visual.vertex_attributes.update(
            {name: np.asarray(one)[old] for name, one in visual.vertex_attributes.items()}
        )


def _put_uv(mesh: Any, uv: Floats) -> None:
    """Give a Trimesh UVs. Its material stays, and its colours are where trimesh keeps them beside UVs."""
    old = mesh.visual
    kind = getattr(old, "kind", None)
    new = importlib.import_module("trimesh.visual").TextureVisuals(uv=uv, material=getattr(old, "material", None))
    if kind == "texture":
        new.vertex_attributes.update({name: one for name, one in old.vertex_attributes.items() if name != "uv"})
    elif kind == "vertex":
        mesh.vertex_attributes["color"] = new.vertex_attributes["color"] = np.array(old.vertex_colors)
    elif kind == "face":
        mesh.face_attributes["color"] = np.array(old.face_colors)
    mesh.visual = new


def _pyvista_with_vertices(mesh: Any, polygons: Polygons, old: Whole, corners: Whole) -> Any:
    """A PolyData or UnstructuredGrid with these vertices."""
    sizes = np.diff(polygons.begin)
    heads = polygons.begin[:-1]
    if hasattr(mesh, "celltypes"):
        types = np.asarray(mesh.celltypes)
        cell_sizes, all_corners = unpadded(mesh.cells)
        begin = np.concatenate([[0], np.cumsum(cell_sizes)])
        ordered = corners.copy()
        # VTK lists the corners of a pixel row by row, not round it.
        for first in heads[types[polygons.cell] == VTK_PIXEL]:
            ordered[[first + 2, first + 3]] = ordered[[first + 3, first + 2]]
        within = np.arange(len(corners)) - np.repeat(heads, sizes)
        all_corners[np.repeat(begin[polygons.cell], sizes) + within] = ordered
        result = type(mesh)(padded(cell_sizes, all_corners), types, np.asarray(mesh.points)[old])
    else:
        parts = {name: np.array(getattr(mesh, name)) for name in ("verts", "lines") if len(getattr(mesh, name))}
        result = type(mesh)(np.asarray(mesh.points)[old], faces=padded(sizes, corners), **parts)
    for name, values in mesh.point_data.items():
        result.point_data[name] = np.asarray(values)[old]
    for name, values in mesh.cell_data.items():
        result.cell_data[name] = np.array(values)
    for name, values in mesh.field_data.items():
        result.field_data[name] = np.array(values)
    return result
