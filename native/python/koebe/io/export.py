"""Results in the files of other packages."""

import copy
import importlib
import os
import tempfile
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from .._fields import areas
from .._native import _koebe
from .._options import path_of
from .._types import Floats, Ints
from ..errors import FileError, InputError
from .files import whole_file
from .formats import (
    GIFTI,
    MESHIO,
    PYVISTA,
    gifti_of,
    is_freesurfer_name,
    is_patch_name,
    patch_bytes,
    quiet,
    structure_of,
    volume_info,
    volume_meta,
)
from .mesh_copies import LOG_SCALE, SPHERE
from .meshes import is_gifti, kind_of, read_mesh

_SPHERE_RADIUS = 100.0  # millimetres, as FreeSurfer's spheres have it
CUT_TEXT = "the map has cuts, so that a vertex has several places: write a .gii or a VTK file"
FIELDS = (".shape.gii", ".func.gii")
_SEVERAL_FILES = (".xdmf", ".xmf")


def export(result: Any, path: str | os.PathLike[str], as_surface: bool = False) -> None:
    """Writes a result in the format that the file's name says. as_surface: any GIfTI file has the map itself."""
    name = Path(path_of(path)).name
    low = name.lower()
    # Names decide, the longer endings first.
    if low.endswith((".surf.gii", ".surf.gii.gz")) or as_surface and low.endswith(GIFTI):
        content = saved_bytes(low, lambda place: package_of("nibabel").save(_gifti_surface(result, name), place))
    elif low.endswith(FIELDS):
        content = saved_bytes(low, lambda place: package_of("nibabel").save(_gifti_fields(result, name), place))
    elif low.endswith(GIFTI):
        content = saved_bytes(low, lambda place: package_of("nibabel").save(_as(result, "gifti").to_mesh(), place))
    elif low.endswith(MESHIO) and not low.endswith(_SEVERAL_FILES):
        content = saved_bytes(low, lambda place: _write_meshio(place, _as(result, "meshio").to_mesh()))
    elif low.endswith(PYVISTA):
        content = saved_bytes(low, lambda place: _as(result, "pyvista").to_mesh().save(place))
    elif low.endswith(".obj"):
        vertices, triangles = result._source.vertices, result._source.given_triangles
        content = obj_of(vertices, triangles, result.corner_uv).encode()
    elif is_patch_name(path):
        content = _patch(result)
    elif is_freesurfer_name(path):
        points, triangles = flat_surface(result)
        freesurfer, volume = package_of("nibabel.freesurfer"), volume_info(result._source.mesh)
        content = saved_bytes(
            low, lambda place: freesurfer.write_geometry(place, points, triangles, "by koebe", volume_info=volume)
        )
    else:
        raise InputError(
            f"{name}: no format has this name. Known are .gii, .surf.gii, .shape.gii, .vtk, .vtu, .vtp, .obj, "
            "lh.NAME and rh.NAME (FreeSurfer's surfaces) and lh.NAME.patch.flat"
        )
    with whole_file(path) as file:
        file.write(content)


def has_one_place_a_vertex(path: str | os.PathLike[str]) -> bool:
    """Whether files of this name hold a map as a surface, which can have no cuts."""
    surface = Path(path_of(path)).name.lower().endswith((".surf.gii", ".surf.gii.gz"))
    return surface or is_freesurfer_name(path) or is_patch_name(path)


def flat_surface(result: Any) -> tuple[Floats, Ints]:
    """The map as a surface, (V, 3) and its triangles: in the plane z = 0 with the area of the surface, or the sphere of
    radius 100; or the surface itself, if the result is no map. Vertices without a face are at 0. No face of the plane
    turns over by the rounding to 32 bits. Raises InputError for a map with cuts."""
    vertices, triangles = result._source.vertices, result._source.given_triangles
    if getattr(result, "is_surface", False):
        return vertices, triangles
    on_sphere = getattr(result, "points", None)
    if on_sphere is not None:
        return np.nan_to_num(_SPHERE_RADIUS * on_sphere), triangles
    if result.uv.ndim != 2:
        raise InputError(CUT_TEXT)
    on_surface, in_disk = (np.abs(areas(points[triangles])).sum() for points in (vertices, result.uv))
    plane = _koebe.upright_floats(np.nan_to_num(np.sqrt(on_surface / in_disk) * result.uv), triangles)
    return np.column_stack([plane, np.zeros(len(plane))]), triangles


def obj_of(vertices: Floats, triangles: Ints, uv: Floats | None = None) -> str:
    """The text of an OBJ file: the surface, and UVs (F, 3, 2) of corners, each once."""
    lines = [f"v {x!r} {y!r} {z!r}" for x, y, z in vertices.tolist()]
    if uv is None:
        lines += [f"f {a} {b} {c}" for a, b, c in (triangles + 1).tolist()]
    else:
        places, number = np.unique(uv.reshape(-1, 2), axis=0, return_inverse=True)
        lines += [f"vt {u!r} {v!r}" for u, v in places.tolist()]
        rows = np.column_stack([triangles + 1, number.reshape(-1, 3) + 1])
        lines += [f"f {a}/{i} {b}/{j} {c}/{k}" for a, b, c, i, j, k in rows.tolist()]
    return "\n".join(lines) + "\n"


def package_of(package: str) -> Any:
    """The imported package. Raises FileError without it."""
    try:
        return importlib.import_module(package)
    except ImportError:
        extra = package.partition(".")[0]
        raise FileError(f'this format needs {extra}: pip install "koebe[{extra}]"') from None


def _write_meshio(place: str, mesh: Any) -> None:
    with quiet():
        package_of("meshio").write(place, mesh)  # it tells that VTK's vectors get a third number, 0


def saved_bytes(low: str, save: Any) -> bytes:
    """The content of the file that `save` writes under a name with this end."""
    with tempfile.TemporaryDirectory() as folder:
        place = os.path.join(folder, low)
        save(place)
        return Path(place).read_bytes()


def _as(result: Any, kind: str) -> Any:
    """The result with its surface as a mesh of this kind."""
    source = result._source
    if source.mesh is not None and kind_of(source.mesh) == kind:
        return result
    vertices, triangles = source.vertices, source.given_triangles
    if kind == "gifti":
        mesh = gifti_of(vertices, triangles, {})
    elif kind == "meshio":
        mesh = package_of("meshio").Mesh(vertices, [("triangle", triangles)])
    else:
        mesh = package_of("pyvista").PolyData.from_regular_faces(vertices, triangles)
    other = copy.copy(result)
    number = np.arange(len(triangles), dtype=np.int32)
    other._set(_source=replace(source, mesh=mesh, polygons=read_mesh(mesh), polygon=number))
    return other


def _structure(result: Any, name: str) -> str:
    """The cortex that the surface is, by its own file or else by the name."""
    mesh = result._source.mesh
    arrays = mesh.darrays if is_gifti(mesh) else []
    said = [array.meta.get("AnatomicalStructurePrimary", "") for array in arrays]
    return next(filter(None, said), structure_of(name))


def _gifti_surface(result: Any, name: str) -> Any:
    points, triangles = flat_surface(result)
    sphere = hasattr(result, "points")
    kind = "Anatomical" if getattr(result, "is_surface", False) else "Spherical" if sphere else "Flat"
    closed = sphere and not len(result.loops)
    meta = {"AnatomicalStructurePrimary": _structure(result, name), "GeometricType": kind}
    if kind == "Anatomical":
        meta |= volume_meta(volume_info(result._source.mesh) or {})
    return gifti_of(points, triangles, meta, closed)


def _gifti_fields(result: Any, name: str) -> Any:
    """The fields of the vertices as maps of one number each: u, v, the sphere's x, y, z, and the scale."""
    package_of("nibabel")
    gifti = importlib.import_module("nibabel.gifti")
    given = {array.meta["Name"]: array.data for array in _as(result, "gifti").to_mesh().darrays if _is_ours(array)}
    maps = {LOG_SCALE: given[LOG_SCALE], **dict(zip(("koebe_u", "koebe_v"), given["koebe_uv"].T, strict=True))}
    if SPHERE in given:
        maps |= dict(zip(("koebe_x", "koebe_y", "koebe_z"), given[SPHERE].T, strict=True))
    arrays = [
        gifti.GiftiDataArray(np.float32(values), "NIFTI_INTENT_SHAPE", "NIFTI_TYPE_FLOAT32", meta={"Name": title})
        for title, values in maps.items()
    ]
    image = gifti.GiftiImage(darrays=arrays)
    if structure := _structure(result, name):
        image.meta["AnatomicalStructurePrimary"] = structure
    return image


def _is_ours(array: Any) -> bool:
    return str(array.meta.get("Name", "")).startswith("koebe_")


def _patch(result: Any) -> bytes:
    points, triangles = flat_surface(result)
    number = np.unique(triangles)
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    ends, times = np.unique(edges, axis=0, return_counts=True)
    return patch_bytes(number, points[number], np.isin(number, ends[times == 1]))
