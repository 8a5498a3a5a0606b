"""Reads meshes of other packages as arrays: PyVista, VTK, trimesh, meshio, nibabel's GIfTI. The meshes are recognized
by their classes, so that no package is imported here. Any other object with points and faces can be read: nilearn's,
Open3D's, BrainSpace's, MNE's. mesh_copies.py writes into copies of them.

Each holds vertices and cells, some of which are faces. Other cells (points, lines) are kept and carry no values.
"""

import importlib
import importlib.util
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .._types import Floats, Whole
from ..errors import InputError

VTK_PIXEL = 8  # number of VTK's cell type: a quadrilateral with its last two corners exchanged

_POINTS, _TRIANGLES = 1008, 1009  # NIfTI's intent codes
_VTK_FACES = {5: "triangle", 7: "polygon", 9: "quad"}  # numbers of VTK's cell types
_VTK_NO_FACES = {1, 2, 3, 4}  # points and lines


@dataclass(frozen=True)
class Polygons:
    """The faces of a mesh of another package.

    vertices   (V, 3) as in the mesh
    corners    vertex of each corner, face after face
    begin      (P + 1,) first corner of each face
    cell       (P,) the number of each face among all cells
    cell_count of all cells
    """

    vertices: Floats
    corners: Whole
    begin: Whole
    cell: Whole
    cell_count: int


def is_mesh(thing: Any) -> bool:
    return kind_of(thing) is not None


def plain(mesh: Any) -> Any:
    """The mesh that is given back: of a scene all of its meshes in one, of VTK a PyVista PolyData, with triangles in
    place of strips. Raises InputError for a scene without triangles, or a brain in two parts."""
    kind = kind_of(mesh)
    if kind == "scene":
        meshes = [one for one in mesh.dump() if kind_of(one) == "trimesh" and len(one.faces)]
        if not meshes:
            raise InputError("the scene has no triangles")
        mesh = importlib.import_module("trimesh.util").concatenate(meshes)
    elif kind == "parts":
        mesh = getattr(mesh, "mesh", mesh)  # of a SurfaceImage
        if len(mesh.parts) != 1:
            raise InputError(f"the mesh has the parts {', '.join(mesh.parts)}: give one of them, mesh.parts['left']")
        (mesh,) = mesh.parts.values()
    elif kind == "vtk":
        try:
            mesh = importlib.import_module("pyvista").wrap(getattr(mesh, "VTKObject", mesh))
        except (NotImplementedError, TypeError) as error:
            raise InputError(f"VTK's object is no surface: {error}") from None
    if kind_of(mesh) == "pyvista" and getattr(mesh, "n_strips", False):
        mesh = _without_strips(mesh)
    return mesh


def can_give_back(mesh: Any) -> bool:
    """Whether a copy of this plain mesh can have fields."""
    return kind_of(mesh) not in (None, "points")


def read_mesh(mesh: Any) -> Polygons:
    """The faces of a plain mesh. Raises InputError for a mesh without faces, or with cells that are not faces of a
    surface."""
    readers = {"trimesh": _from_trimesh, "pyvista": _from_pyvista, "meshio": _from_meshio, "gifti": _from_gifti,
               "points": _from_points}  # fmt: skip
    polygons = readers[kind_of(mesh) or "meshio"](mesh)
    if not len(polygons.cell):
        raise InputError("the mesh has no faces")
    return polygons


def is_gifti(mesh: Any) -> bool:
    """Whether the mesh keeps its vertices: other files of a cortex count on their number."""
    return kind_of(mesh) == "gifti"


def padded(sizes: Whole, corners: Whole) -> Whole:
    """The cells as in VTK's files: each one's size, then its corners."""
    return np.insert(corners, np.concatenate([[0], np.cumsum(sizes)[:-1]]).astype(np.int64), sizes)


def kind_of(thing: Any) -> str | None:
    """The package whose mesh it is, or None."""
    names = {(base.__module__.partition(".")[0], base.__name__) for base in type(thing).__mro__}
    if ("trimesh", "Trimesh") in names:
        return "trimesh"
    if ("trimesh", "Scene") in names:
        return "scene"
    if names & {("pyvista", "PolyData"), ("pyvista", "UnstructuredGrid")}:
        return "pyvista"
    if ("nibabel", "GiftiImage") in names:
        return "gifti"
    if ("meshio", "Mesh") in names:
        return "meshio"
    if names & {("nilearn", "PolyMesh"), ("nilearn", "SurfaceImage")}:
        return "parts"
    has_vtk = hasattr(thing, "VTKObject") or ("vtkmodules", "vtkPolyData") in names  # BrainSpace wraps VTK's objects
    if has_vtk and importlib.util.find_spec("pyvista"):
        return "vtk"
    return "points" if _points_and_faces(thing) else None


def _points_and_faces(thing: Any) -> tuple[str, str] | None:
    """The names of the points and the faces of any object that has both: as attributes, or as MNE's dicts have them."""
    if isinstance(thing, type):
        return None
    if isinstance(thing, Mapping):
        return ("rr", "tris") if "rr" in thing and "tris" in thing else None
    if hasattr(thing, "Points") and hasattr(thing, "GetPolys2D"):  # BrainSpace's
        return "Points", "GetPolys2D"
    points = next((name for name in ("vertices", "points", "coordinates") if hasattr(thing, name)), None)
    faces = next((name for name in ("faces", "triangles") if hasattr(thing, name)), None)
    return None if points is None or faces is None else (points, faces)


def _from_trimesh(mesh: Any) -> Polygons:
    faces = np.asarray(mesh.faces)
    return _polygons(mesh.vertices, [faces], [np.arange(len(faces))], len(faces))


def _from_pyvista(mesh: Any) -> Polygons:
    if hasattr(mesh, "celltypes"):
        types = np.asarray(mesh.celltypes)
        pixels = types == VTK_PIXEL
        others = set(types.tolist()) - {*_VTK_FACES, *_VTK_NO_FACES, VTK_PIXEL}
        if others:
            raise InputError(
                f"the grid has cells of VTK's types {sorted(others)}, which are no triangles, quadrilaterals or "
                "polygons: give mesh.extract_surface()"
            )
        sizes, corners = unpadded(mesh.cells)
        begin = np.concatenate([[0], np.cumsum(sizes)])
        for first in begin[:-1][pixels]:
            corners[[first + 2, first + 3]] = corners[[first + 3, first + 2]]
        is_face = pixels | np.isin(types, list(_VTK_FACES))
        kept = np.repeat(is_face, sizes)
        return _packed(mesh.points, corners[kept], sizes[is_face], np.flatnonzero(is_face), len(types))
    sizes, corners = unpadded(mesh.faces)
    before = mesh.n_verts + mesh.n_lines  # VTK numbers them first
    return _packed(mesh.points, corners, sizes, before + np.arange(len(sizes)), mesh.n_cells)


def _without_strips(mesh: Any) -> Any:
    """A PolyData with the triangles of the strips behind its other cells, every second one turned round. Each triangle
    has its strip's data."""
    sizes, corners = unpadded(mesh.strips)
    counts = np.maximum(sizes - 2, 0)
    first = np.repeat(np.cumsum(sizes) - sizes, counts)
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    at, turned = first + place, place % 2
    triangles = np.stack([corners[at + turned], corners[at + 1 - turned], corners[at + 2]], axis=1)
    old_sizes, old_corners = unpadded(mesh.faces)
    faces = padded(np.append(old_sizes, np.full(len(at), 3)), np.append(old_corners, triangles))
    parts = {name: np.array(getattr(mesh, name)) for name in ("verts", "lines") if len(getattr(mesh, name))}
    result = type(mesh)(np.asarray(mesh.points), faces=faces, **parts)
    before = mesh.n_cells - len(sizes)
    cell = np.append(np.arange(before), before + np.repeat(np.arange(len(sizes)), counts))
    result.point_data.update(mesh.point_data)
    for name, values in mesh.cell_data.items():
        result.cell_data[name] = np.asarray(values)[cell]
    result.field_data.update(mesh.field_data)
    return result


def _from_meshio(mesh: Any) -> Polygons:
    blocks, cells, begin = [], [], 0
    for block in mesh.cells:
        if block.type in ("triangle", "quad") or block.type.startswith("polygon"):
            blocks.append(block.data)
            cells.append(begin + np.arange(len(block.data)))
        elif block.type not in ("vertex", "line"):
            raise InputError(f"the mesh has cells of the type {block.type!r}: only triangles, quads and polygons")
        begin += len(block.data)
    return _polygons(mesh.points, blocks, cells, begin)


def _from_points(mesh: Any) -> Polygons:
    name, of_faces = _points_and_faces(mesh) or ("vertices", "faces")
    points, faces = (mesh[one] if isinstance(mesh, Mapping) else getattr(mesh, one) for one in (name, of_faces))
    if of_faces == "GetPolys2D":
        faces = faces()
    if not isinstance(faces, (list, tuple)):
        faces = np.asarray(faces)
        if faces.ndim != 2 and faces.dtype != object:
            raise InputError(f"faces must be (F, n) whole numbers, or a list of polygons, not {faces.shape}")
    if np.ma.is_masked(points) or np.ma.is_masked(faces):
        raise InputError(f"{name} and faces must not be masked")
    return _polygons(points, [faces], [np.arange(len(faces))], len(faces))


def _from_gifti(image: Any) -> Polygons:
    points, triangles = ([a.data for a in image.darrays if a.intent == intent] for intent in (_POINTS, _TRIANGLES))
    if len(points) != 1 or len(triangles) != 1:
        counts = f"{len(points)} arrays of points and {len(triangles)} of triangles"
        raise InputError(f"the image has {counts}, not one of each")
    return _polygons(points[0], [triangles[0]], [np.arange(len(triangles[0]))], len(triangles[0]))


def _polygons(vertices: Any, blocks: list[Any], cells: Sequence[Whole], cell_count: int) -> Polygons:
    """Blocks of faces: tables (k, n), or lists of faces of any sizes."""
    sizes, corners = [np.zeros(0, np.int64)], [np.zeros(0, np.int64)]
    for block in blocks:
        faces = [np.asarray(face) for face in block] if is_ragged(block) else np.asarray(block)
        if isinstance(faces, list) and any(face.ndim != 1 for face in faces):
            raise InputError("each face of the mesh must be a list of vertices")
        sizes.append(np.array([len(face) for face in faces], dtype=np.int64))
        named = np.concatenate(faces) if isinstance(faces, list) else faces.ravel()
        if named.dtype.kind not in "iu":
            raise InputError(f"faces of the mesh must name vertices by whole numbers, not {named.dtype}")
        corners.append(named.astype(np.int64))  # numbers of 2^63 and more become negative: no vertices either
    number = np.concatenate([np.zeros(0, np.int64), *cells])
    return _packed(vertices, np.concatenate(corners), np.concatenate(sizes), number, cell_count)


def is_ragged(block: Any) -> bool:
    return len(block) > 0 and (not isinstance(block, np.ndarray) or block.dtype == object)


def _packed(vertices: Any, corners: Whole, sizes: Whole, cell: Whole, cell_count: int) -> Polygons:
    points = np.asarray(vertices)
    if points.ndim == 2 and points.shape[1] == 2:  # meshio keeps planar meshes like this
        points = np.column_stack([points, np.zeros(len(points), points.dtype)])
    begin = np.concatenate([[0], np.cumsum(sizes)])
    return Polygons(points, corners, begin, cell, cell_count)


def unpadded(padded: Any) -> tuple[Whole, Whole]:
    """Sizes (P,) and corners of cells filed one after another, each as its size and its corners."""
    flat = np.array(padded, dtype=np.int64)
    if len(flat) and len(flat) % (flat[0] + 1) == 0:  # all of one size: no loop
        table = flat.reshape(-1, flat[0] + 1)
        if (table[:, 0] == flat[0]).all():
            return table[:, 0].copy(), table[:, 1:].ravel()
    sizes, at = [], 0
    while at < len(flat):
        sizes.append(flat[at])
        at += flat[at] + 1
    counts = np.array(sizes, dtype=np.int64)
    heads = np.concatenate([[0], np.cumsum(counts + 1)])[:-1].astype(np.int64)
    return counts, np.delete(flat, heads)
