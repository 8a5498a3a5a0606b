"""Surfaces in the files of other packages: GIfTI and FreeSurfer's by nibabel, VTK's by meshio or PyVista.

The packages are imported when a file needs them.
"""

import contextlib
import importlib
import importlib.util
import io
import os
import re
import warnings
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .._comparable import Result
from .._native import _koebe
from .._options import path_of
from .._types import Bools, Floats, Ints, Whole
from ..errors import FileError, InputError, KoebeError

NATIVE: tuple[str, ...] = tuple(_koebe.mesh_formats)
MESHIO = (".vtk", ".vtu", ".xdmf", ".xmf", ".msh", ".mesh", ".meshb", ".med", ".su2", ".tec", ".inp", ".bdf", ".nas")
PYVISTA = (".vtp",)
GIFTI = (".gii", ".gii.gz")

_TRIANGLES, _QUADS, _CURV = b"\xff\xff\xfe", b"\xff\xff\xfd", b"\xff\xff\xff"  # how FreeSurfer's files begin
PATCH = b"\xff\xff\xff\xff"
_HEMISPHERE = {"l": "CortexLeft", "r": "CortexRight"}


@contextlib.contextmanager
def read_by(package: str, path: str | os.PathLike[str]) -> Iterator[Any]:
    """The package, to read a file with. Raises FileError if it cannot, OSError for a file that cannot be opened."""
    with open(path, "rb"):
        pass  # errors of the system, as they are
    try:
        module = importlib.import_module(package)
    except ImportError:
        extra = package.partition(".")[0]
        raise FileError(f'{os.fspath(path)} needs {extra}: pip install "koebe[{extra}]"') from None
    try:
        with warnings.catch_warnings(), np.errstate(all="ignore"):
            warnings.simplefilter("ignore")
            yield module
    except KoebeError:
        raise
    except (Exception, SystemExit) as error:  # each package has its own, and meshio ends the process
        said = str(error) if isinstance(error, Exception) else "its format is another"
        raise FileError(f"{os.fspath(path)} cannot be read: {said or type(error).__name__}") from None


@contextlib.contextmanager
def quiet() -> Iterator[None]:
    """Keeps to itself what meshio prints."""
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        yield


def is_freesurfer_name(path: str | os.PathLike[str]) -> bool:
    """Whether the name is FreeSurfer's: lh.white, rh.sphere, lh.cortex.patch.flat."""
    name = Path(path).name
    return bool(re.match(r"[lr]h\.", name)) and not name.lower().endswith((*NATIVE, *MESHIO, *PYVISTA, *GIFTI))


def is_patch_name(path: str | os.PathLike[str]) -> bool:
    return ".patch" in Path(path).name or Path(path).name.endswith(".flat")


def head_of(path: str | os.PathLike[str]) -> bytes:
    """The first four bytes of a file."""
    with open(path_of(path), "rb") as file:
        return file.read(4)


def is_old_quads(path: str | os.PathLike[str]) -> bool:
    """Whether the file is FreeSurfer's first kind of surface: quadrilaterals, and coordinates in hundredths. It begins
    like a file of values at vertices: only the length tells."""
    with open(path, "rb") as file:
        head = file.read(9)
    if len(head) < 9 or head[:3] != _CURV:
        return False
    vertices, quads = (int.from_bytes(head[at : at + 3], "big") for at in (3, 6))
    return bool(quads) and os.path.getsize(path) == len(head) + 6 * vertices + 12 * quads


def is_foreign_surface(path: str | os.PathLike[str]) -> bool:
    """Whether another package reads the surface in this file."""
    name = Path(path).name.lower()
    if name.endswith((*GIFTI, *MESHIO, *PYVISTA)):
        return True
    if name.endswith(NATIVE) or not os.path.isfile(path):
        return False
    return head_of(path)[:3] in (_TRIANGLES, _QUADS, _CURV)


def read_surface(path: str | os.PathLike[str]) -> Any:
    """The mesh in a file: a GiftiImage, a meshio Mesh or a PyVista PolyData. Raises FileError, InputError, OSError."""
    name = Path(path).name.lower()
    if name.endswith(GIFTI):
        with read_by("nibabel", path) as nibabel:
            image = nibabel.load(os.fspath(path))
            if not hasattr(image, "darrays"):
                raise FileError(f"{os.fspath(path)} is no GIfTI file")
            for array in image.darrays:  # nibabel reads them now
                np.asarray(array.data)
            return image
    if name.endswith(PYVISTA):
        with read_by("pyvista", path) as pyvista:
            return pyvista.read(os.fspath(path))
    if name.endswith(MESHIO):
        return _by_meshio(path, name)
    return _freesurfer(path)


def _by_meshio(path: str | os.PathLike[str], name: str) -> Any:
    try:
        with read_by("meshio", path) as meshio, quiet():
            return meshio.read(os.fspath(path))
    except FileError as error:
        if not name.endswith((".vtk", ".vtu")) or importlib.util.find_spec("pyvista") is None:
            raise
        try:
            with read_by("pyvista", path) as pyvista:  # the polygons of VTK's old files
                mesh = pyvista.read(os.fspath(path))
        except FileError:
            raise error from None
        if not getattr(mesh, "n_cells", 0):
            raise
        return mesh


def _freesurfer(path: str | os.PathLike[str]) -> Any:
    """FreeSurfer's surface as a GiftiImage, in FreeSurfer's coordinates."""
    head = head_of(path)
    if head == PATCH:
        raise InputError(
            f"{os.fspath(path)} is a patch, which has no faces: give the surface that it was cut from, with "
            "mask=~koebe.read_region(patch, vertices)"
        )
    if head[:3] == _CURV and not is_old_quads(path):
        raise InputError(f"{os.fspath(path)} has values at vertices, no surface: koebe.read_field reads it")
    with read_by("nibabel.freesurfer", path) as freesurfer, warnings.catch_warnings():
        warnings.simplefilter("ignore")  # most surfaces of other programs know no volume
        try:
            points, triangles, volume = freesurfer.read_geometry(os.fspath(path), read_metadata=True)
        except (OSError, ValueError):
            (points, triangles), volume = freesurfer.read_geometry(os.fspath(path)), {}
    return gifti_of(points, triangles, {"AnatomicalStructurePrimary": structure_of(path), **volume_meta(volume)})


def volume_meta(volume: Mapping[str, Any]) -> dict[str, str]:
    """FreeSurfer's volume info in FreeSurfer's words of GIfTI, if it is valid."""
    if not str(volume.get("valid", "")).startswith("1"):
        return {}
    words = {
        key: f"{number:.10g}" for row, keys in _VOLUME.items() for key, number in zip(keys, volume[row], strict=True)
    }
    return words | {_VOLUME_FILE: volume["filename"]}


def volume_info(mesh: Any) -> dict[str, Any] | None:
    """The volume info of a GiftiImage for nibabel's write_geometry. None if there is none, and for points in the
    scanner's coordinates, to which FreeSurfer would add the centre twice."""
    for array in getattr(mesh, "darrays", []):
        meta = dict(array.meta)
        if getattr(array.coordsys, "dataspace", 0) == _SCANNER:
            return None
        try:
            rows = {row: np.array([float(meta[key]) for key in keys]) for row, keys in _VOLUME.items()}
        except (KeyError, ValueError):
            continue
        rows["volume"] = rows["volume"].astype(int)
        name = meta.get(_VOLUME_FILE, "")
        return {"head": np.array([2, 0, 20]), "valid": "1  # volume info valid", "filename": name, **rows}
    return None


def structure_of(path: str | os.PathLike[str]) -> str:
    """The cortex that a file's name stands for, in the words of GIfTI, or an empty text."""
    found = re.match(r"([lr])h\.", Path(path).name) or re.search(r"[._]([LR])[._]", Path(path).name)
    return _HEMISPHERE[found[1].lower()] if found else ""


def gifti_of(points: Floats, triangles: Ints, meta: dict[str, str], closed: bool = False) -> Any:
    """A GiftiImage with two arrays, as Workbench wants surfaces."""
    gifti = importlib.import_module("nibabel.gifti")
    said = {name: value for name, value in meta.items() if value}
    places = gifti.GiftiDataArray(np.float32(points), "NIFTI_INTENT_POINTSET", "NIFTI_TYPE_FLOAT32", meta=said)
    topology = {"TopologicalType": "Closed" if closed else "Open"}
    faces = gifti.GiftiDataArray(np.int32(triangles), "NIFTI_INTENT_TRIANGLE", "NIFTI_TYPE_INT32", meta=topology)
    return gifti.GiftiImage(darrays=[places, faces])


@dataclass(frozen=True, eq=False, repr=False)
class Patch(Result):
    """A patch of FreeSurfer: some vertices of a surface, and their places.

    vertices   (n,) int32, ascending
    points     (n, 3) float64; of a flat patch the third is 0
    border     (n,) bool: at the patch's border
    """

    vertices: Ints
    points: Floats
    border: Bools

    def _drawing(self) -> dict[str, Any]:
        return {"points": self.points[:, :2]}

    def __repr__(self) -> str:
        return f"<koebe.Patch {len(self.vertices)} vertices, {int(self.border.sum())} at the border>"


# The rows of FreeSurfer's volume info, and the words for their numbers that FreeSurfer writes into GIfTI.
_VOLUME = {
    "volume": ("VolGeomWidth", "VolGeomHeight", "VolGeomDepth"),
    "voxelsize": ("VolGeomXsize", "VolGeomYsize", "VolGeomZsize"),
    **{f"{axis.lower()}ras": tuple(f"VolGeom{axis}_{way}" for way in "RAS") for axis in "XYZC"},
}
_VOLUME_FILE = "VolGeomFname"
_SCANNER = 1  # NIFTI_XFORM_SCANNER_ANAT
_PATCH_ROW = np.dtype([("vertex", ">i4"), ("point", ">f4", 3)])


def read_patch(path: str | os.PathLike[str]) -> Patch:
    """Read a patch of FreeSurfer (lh.cortex.patch.3d, lh.cortex.patch.flat): its vertices' numbers and places.

    A patch has no faces: they are those of the surface it was cut from. Raises FileError, OSError.

    >>> import koebe, os, tempfile
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> path = os.path.join(tempfile.mkdtemp(), "lh.face.patch.flat")
    >>> result.export(path)
    >>> koebe.read_patch(path)
    <koebe.Patch 2309 vertices, 243 at the border>
    """
    text = Path(path_of(path)).read_bytes()
    if text[:4] != PATCH or len(text) < 8:
        raise FileError(f"{os.fspath(path)} is no patch of FreeSurfer")
    count = int.from_bytes(text[4:8], "big", signed=True)
    if count < 0 or len(text) != 8 + count * _PATCH_ROW.itemsize:
        raise FileError(f"{os.fspath(path)} is cut off: {len(text)} bytes for {count} vertices")
    rows = np.frombuffer(text, _PATCH_ROW, count, 8)
    number = rows["vertex"].astype(np.int64)
    vertices, points = np.abs(number) - 1, rows["point"].astype(np.float64)
    order = np.argsort(vertices, kind="stable")
    twice = len(np.unique(vertices)) < count
    if twice or (number == 0).any() or not np.isfinite(points).all():
        raise FileError(f"{os.fspath(path)} is damaged: a vertex twice, a vertex 0, or a place that is not finite")
    return Patch(vertices[order].astype(np.int32), points[order], (number < 0)[order])


def patch_bytes(vertices: Whole, points: Floats, border: Bools) -> bytes:
    """The file of a patch; vertices at the border have negative numbers, and all count from 1."""
    rows = np.zeros(len(vertices), _PATCH_ROW)
    rows["vertex"] = np.where(border, -1, 1) * (np.asarray(vertices, np.int64) + 1)
    rows["point"] = points
    return PATCH + len(rows).to_bytes(4, "big") + rows.tobytes()
