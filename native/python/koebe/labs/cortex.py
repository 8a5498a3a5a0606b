"""A cortical hemisphere laid flat, from the folder of its subject."""

import os
import re
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from .._comparable import Result
from .._fields import areas
from .._native import _koebe
from .._option_table import rows
from .._options import callback, number, path_of, token
from .._progress import Shown
from .._types import Bools, Floats, Whole
from .._watched import watched
from ..errors import FileError, InputError
from ..io.export import FIELDS, export
from ..io.files import whole_file
from ..io.formats import (
    GIFTI,
    PATCH,
    Patch,
    head_of,
    is_freesurfer_name,
    is_patch_name,
    patch_bytes,
    read_patch,
)  # fmt: skip
from ..maps.input import surface_of
from ..maps.parts import parts
from ..maps.result import MapReport
from ..maps.uniformize import uniformize
from .cortex_cuts import ONE_PART, cheapest_cuts, largest_piece, template_cuts
from .cortex_files import MAPPED, REGISTERED, Hemisphere, cortex_of

_MOST_LOOSE = 0.05  # share of the cortex that cuts may part from the rest
PathLike = str | os.PathLike[str]


@dataclass(frozen=True, eq=False, repr=False)
class FlatCortex(Result):
    """The result of `cortex`.

    map       of the hemisphere without the wall and the cuts, with figures, `warnings`, save and plot: a PartsResult,
              or a UniformizeResult if there are holes beside the wall
    places    (V, 2) float64, in the surface's unit (millimetres), of the surface's area, the front of the brain and its
              top as a view from outside has them; NaN at vertices that are left out
    wall      (V,) bool: not of the cortex
    cuts      (V,) bool: left out along cuts, or parted from the rest by them
    left_out  share of the cortex's area in faces at cuts
    """

    map: MapReport
    places: Floats
    wall: Bools
    cuts: Bools
    left_out: float

    def _drawing(self) -> dict[str, Any]:
        return {"corners": self.places[self.map.triangles]}

    def __repr__(self) -> str:
        return f"<koebe.FlatCortex {self.figures}>"

    @property
    def figures(self) -> str:
        """In one line: faces, the share that is left out at cuts, the mean angle error, flipped faces."""
        return (
            f"{self.map.face_count} faces, {self.left_out:.1%} left out at cuts, "
            f"angle error {self.map.angle_error_deg['mean']:.3g} deg, {self.map.flipped} flipped"
        )

    def write(self, path: PathLike) -> None:
        """Write the flat map. The file is complete or absent.

        lh.NAME.flat.patch.3d, lh.NAME.patch.flat    FreeSurfer's flat patch
        lh.NAME.patch.3d           the cut surface, not flat: what mris_flatten and autoflatten flatten
        flat_lh.gii, NAME.flat.surf.gii    GIfTI: pycortex's database, nilearn, Workbench
        Any other name is that of a format of `UniformizeResult.export`.
        """
        low = Path(path_of(path)).name.lower()
        if is_patch_name(path) and "flat" not in low:
            kept = np.flatnonzero(np.isfinite(self.places[:, 0]))
            with whole_file(path) as file:
                file.write(patch_bytes(kept, self.map.vertices[kept], _at_border(self.map.triangles)[kept]))
        elif is_patch_name(path):
            export(self._with(self.places @ [[0.0, 1.0], [-1.0, 0.0]]), path)  # pycortex turns patches back
        elif is_freesurfer_name(path) or low.endswith(GIFTI) and not low.endswith(FIELDS):
            export(self._with(self.places), path, as_surface=True)
        else:
            export(self.map, path)

    def _with(self, places: Floats) -> Any:
        return SimpleNamespace(**{**vars(self.map), "uv": places})


@watched()
def cortex(
    subject: PathLike,
    hemisphere: str,
    *,
    surface: str | None = None,
    region: Any = None,
    cuts: PathLike | None = None,
    even: float = 0.825,
    darts: float = 0.005,
    progress: Shown = None,
    cancel: "_koebe.CancelToken | None" = None,
) -> FlatCortex:
    """Lay a hemisphere of the cortex flat: the medial wall is left out, cuts are found, and no face turns over.

    subject     folder of a subject of FreeSurfer (surf, label) or fMRIPrep (anat), of pycortex's database, or nilearn's
    hemisphere  'left' or 'right', also 'lh' or 'rh'
    surface     the name of the surface that is mapped; None: white, else wm or midthickness
    region      what the cortex is: a label, an annotation or a GIfTI file of labels, or (V,) bool. None: the subject's
                cortex.label, desc-cortex_mask or aparc.annot; without them what `cuts` has
    cuts        a flat map or a patch of FreeSurfer, autoflatten or pycortex. One of this subject says what is left out.
                One of another brain, fsaverage's for example, beside its sphere (lh.sphere.reg; sphere_left.gii), has
                its cuts carried over through the registered spheres. None: where cuts lower the distortion most
    even        E, from conformal (0) to true to size (1), as for `uniformize`
    darts       how many cuts are found, as for `parts`
    progress, cancel    as for `uniformize`
    Needs nibabel. Raises FileError for files that are missing, damaged or of different surfaces, InputError,
    TopologyError, SolverError, Cancelled, OSError.

    >>> import koebe
    >>> flat = koebe.cortex("derivatives/sub-01", "left")  # doctest: +SKIP
    >>> flat.write("flat_lh.gii")  # doctest: +SKIP
    """
    # Options, before a file is read.
    files = Hemisphere(subject, hemisphere)
    evenness, many = number(even, rows("uniformize")["even"]), number(darts, rows("parts")["darts"])
    callback(progress, "progress")
    stop = token(cancel, "cancel")
    # The surface, and what a template or the region leaves of it.
    path = files.surface(MAPPED if surface is None else [surface])
    given: Any = surface_of(path)
    points, triangles = given.vertices, given.triangles
    template = None if cuts is None else _template(cuts, files, len(points), triangles)
    if template is not None and template.sphere is None:
        triangles = triangles[template.kept]
        given = (points, triangles)
    else:
        given = path
    if given is path or region is not None:
        wall = ~cortex_of(files.region() if region is None else region, len(points))
    else:
        wall = np.zeros(len(points), bool)
    wall = largest_piece(points, triangles, wall)
    found = np.zeros(len(points), bool)
    if template is None:
        found = cheapest_cuts(points, triangles, wall, many, stop)
    elif template.sphere is not None:
        sphere = files.surface(REGISTERED)
        found = template_cuts(_unit(sphere, triangles), triangles, wall, template.sphere, template.faces, template.kept)
    mask = largest_piece(points, triangles, wall | found)
    whole, uncut, kept = (_area(points, triangles, out) for out in (wall, wall | found, mask))
    if uncut - kept > _MOST_LOOSE * whole:
        raise InputError(f"the cuts part the cortex: {(uncut - kept) / whole:.0%} of it would be left out")
    flat, uv = _flat(given, mask, evenness, progress, stop)
    return FlatCortex(flat, _upright(flat, uv, files.words["side"]), wall, mask & ~wall, float(1.0 - kept / whole))


def _flat(given: Any, mask: Bools, even: float, progress: Shown, stop: Any) -> tuple[MapReport, Floats]:
    """The map, and (V, 2) its places, NaN where no face is left.

    A part is relaxed from a map that is even already: in a disk, tongues between cuts can be thinner than its unit. But
    a part with two loops is opened along a slit, so that a disk is taken then.
    """
    part = parts(given, mask=mask, price=ONE_PART, darts=0.0, even=even, loops="free", progress=progress, cancel=stop)
    uv = np.full((len(mask), 2), np.nan)
    uv[part.triangles] = part.uv
    if len(part.parts) == 1 and np.array_equal(uv[part.triangles], part.uv):
        return part, uv
    disk = uniformize(given, mask=mask, even=even, loops="free" if even else "auto", progress=progress, cancel=stop)
    return disk, np.asarray(disk.uv)


@dataclass(frozen=True)
class _Template:
    """A flat map: its sphere (V', 3), or None if it is the subject's own; the faces, and which of them are flat."""

    sphere: Floats | None
    faces: Whole
    kept: Bools


def _template(path: PathLike, files: Hemisphere, count: int, triangles: Whole) -> _Template:
    # The other hemisphere's name.
    words = set(re.split("[._-]", Path(path).name))
    if others := words & files.others:
        raise InputError(f"{os.fspath(path)} is of the other hemisphere: {min(others)}")
    flat = read_patch(path) if head_of(path) == PATCH else surface_of(path, degenerate=True)
    # A flat map of another subject lies beside its sphere, whose faces count.
    sphere = None
    if not Path(path).resolve().is_relative_to(files.folder.resolve()):
        beside = _sphere_beside(Path(path))
        whole = surface_of(beside)
        sphere, count, triangles = _unit(beside, whole.triangles), len(whole.vertices), whole.triangles
    what = "the surface" if sphere is None else "its sphere"
    # A patch names its vertices; a flat surface has the faces that are kept.
    if isinstance(flat, Patch):
        if not len(flat.vertices) or flat.vertices.max() >= count:
            raise FileError(f"{os.fspath(path)} names vertices that are not among the {count} of {what}")
        inside = np.zeros(count, bool)
        inside[flat.vertices] = True
        kept = inside[triangles].all(axis=1)
    else:
        if len(flat.vertices) != count:
            raise FileError(f"{os.fspath(path)} has {len(flat.vertices)} vertices, {what} has {count}")
        keys, own = (
            np.sort(faces, axis=1).astype(np.int64) @ [count**2, count, 1] for faces in (flat.triangles, triangles)
        )
        kept = np.isin(own, keys)
        if not np.isin(keys, own).all():
            raise FileError(f"{os.fspath(path)} has faces that {what} does not have")
    if not kept.any():
        raise FileError(f"{os.fspath(path)} has no face of {what}")
    return _Template(sphere, triangles, np.asarray(kept))


def _sphere_beside(path: Path) -> Path:
    names = [f"{path.name[:2]}.sphere.reg", f"{path.name[:2]}.sphere", path.name.replace("flat", "sphere")]
    for name in names:
        if name != path.name and (path.parent / name).is_file():
            return path.parent / name
    raise FileError(f"{path} is of another subject, and no sphere lies beside it: sought {', '.join(names)}")


def _unit(path: Path, triangles: Whole) -> Floats:
    """The sphere's vertices as unit vectors. Raises FileError for other triangles, or for no sphere."""
    sphere = surface_of(path)
    if not np.array_equal(sphere.triangles, triangles):
        raise FileError(f"{path} has other faces than the surface")
    length = np.linalg.norm(sphere.vertices, axis=1)
    if not length.min() > 0.5 * length.max():
        raise FileError(f"{path} is no sphere round 0: its vertices are {length.min():.3g} to {length.max():.3g} away")
    return sphere.vertices / length[:, None]


def _at_border(triangles: Whole) -> Bools:
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    ends, times = np.unique(edges, axis=0, return_counts=True)
    found = np.zeros(triangles.max() + 1, bool)
    found[ends[times == 1]] = True
    return found


def _area(points: Floats, triangles: Whole, out: Bools) -> float:
    return float(np.abs(areas(points[triangles[~out[triangles].any(axis=1)]])).sum())


def _upright(flat: MapReport, uv: Floats, side: str) -> Floats:
    """(V, 2) the map in the surface's size, turned so that front and top lie as in a view from outside."""
    inside = np.isfinite(uv[:, 0])
    z = uv @ [1.0, 1.0j]
    size = np.sqrt(_area(flat.vertices, flat.triangles, ~inside) / abs(_area(uv, flat.triangles, ~inside)))
    model = flat.vertices[inside] @ [0.0, -1.0 if side == "left" else 1.0, 1.0j]
    turn = np.vdot(z[inside] - z[inside].mean(), model - model.mean())
    z = (z - z[inside].mean()) * size * (turn / abs(turn) if abs(turn) > 0.0 else 1.0)
    return np.stack([z.real, z.imag], axis=1)
