"""Values and labels at vertices, in the files of FreeSurfer, GIfTI and CIFTI, by nibabel."""

import os
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .._arrays import as_values
from .._comparable import Result
from .._options import choice_of, path_of, whole
from .._types import Bools, Floats, Values
from ..errors import FileError, InputError
from .export import package_of, saved_bytes
from .files import whole_file
from .formats import head_of, read_by, read_patch, structure_of

_LABEL = 1002  # NIfTI's intent code
_CIFTI = {"left": "CIFTI_STRUCTURE_CORTEX_LEFT", "right": "CIFTI_STRUCTURE_CORTEX_RIGHT"}
NO_LABEL = -1
_MOST_LABELS = 1 << 14  # of an annotation, whose table has a row for each
Color = tuple[float, float, float, float]


@dataclass(frozen=True, eq=False, repr=False)
class VertexField(Result):
    """Values at the vertices of a surface.

    values   (V,), or (V, k) for k maps: float64, NaN where a file has none; or labels, int32, -1 where it has none
    names    label -> its name; empty for values
    colors   label -> red, green, blue and alpha, from 0 to 1
    """

    values: Values
    names: dict[int, str] = field(default_factory=dict)
    colors: dict[int, Color] = field(default_factory=dict)

    def __repr__(self) -> str:
        of = f"{len(self.names)} labels" if self.names else "values"
        return f"<koebe.VertexField {self.values.shape} {of}>"

    def _drawing(self) -> dict[str, Any]:
        return {"values": self.values}

    def __array__(self, dtype: Any = None, copy: Any = None) -> Values:
        return np.array(self.values, dtype=dtype)


def read_field(path: str | os.PathLike[str], *, hemisphere: str | None = None) -> VertexField:
    """Read values or labels at vertices from a file of FreeSurfer, GIfTI or CIFTI.

    path         lh.curv, lh.sulc, lh.thickness and others of this kind; lh.NAME.annot; .shape.gii, .func.gii,
                 .label.gii; .dscalar.nii, .dlabel.nii
    hemisphere   'left' or 'right', of a CIFTI file with both
    Labels are whole numbers, and `names` says what they stand for. CIFTI leaves out vertices: they have the label -1,
    or the value NaN. Needs nibabel. Raises FileError, OptionError, OSError.

    >>> import koebe, numpy as np, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "lh.areas.annot")
    >>> koebe.write_field(path, [0, 1, 1, -1], names={0: "V1", 1: "V2"})
    >>> labels = koebe.read_field(path)
    >>> labels.values, labels.names
    (array([ 0,  1,  1, -1], dtype=int32), {0: 'V1', 1: 'V2'})
    """
    name = Path(path_of(path)).name.lower()
    if hemisphere is not None:
        choice_of(hemisphere, "hemisphere", _CIFTI)
    if name.endswith(".nii"):
        with read_by("nibabel", path) as nibabel:
            return _from_cifti(nibabel.load(os.fspath(path)), path, hemisphere)
    if name.endswith((".gii", ".gii.gz")):
        with read_by("nibabel", path) as nibabel:
            return _from_gifti(nibabel.load(os.fspath(path)), path)
    with read_by("nibabel.freesurfer", path) as freesurfer:
        if name.endswith(".annot"):
            labels, table, names = freesurfer.read_annot(os.fspath(path))
            known = {number: text.decode("utf-8", "replace") for number, text in enumerate(names)}
            known = {number: text for number, text in known.items() if text != f"unused {number}"}
            shades = {number: _shade(row[:3], 255.0 - row[3]) for number, row in enumerate(table)}
            return VertexField(np.where(np.isin(labels, list(known)), labels, NO_LABEL).astype(np.int32), known, shades)
        # FreeSurfer's new format: 3 bytes, three whole numbers, floats. The old one: twice 3 bytes, 16-bit numbers.
        size = os.path.getsize(path)
        if head_of(path)[:3] == b"\xff\xff\xff":
            with open(path, "rb") as file:
                count = int.from_bytes(file.read(7)[3:], "big", signed=True)
            if size != 15 + 4 * count:
                raise FileError(f"{os.fspath(path)} is cut off, or has no values at vertices")
        elif size != 6 + 2 * int.from_bytes(head_of(path)[:3], "big"):
            raise FileError(f"{os.fspath(path)} has no values at vertices in FreeSurfer's format")
        return VertexField(np.asarray(freesurfer.read_morph_data(os.fspath(path)), np.float64))


def _shade(color: Any, alpha: float) -> Color:
    red, green, blue = (float(part) / 255.0 for part in color)
    return red, green, blue, float(alpha) / 255.0


def _from_gifti(image: Any, path: Any) -> VertexField:
    arrays = [array for array in getattr(image, "darrays", []) if np.ndim(array.data) == 1]
    if not arrays or len({len(array.data) for array in arrays}) != 1:
        raise FileError(f"{os.fspath(path)} has no values at vertices")
    columns = np.column_stack([array.data for array in arrays])
    values = columns[:, 0] if len(arrays) == 1 else columns
    if any(array.intent != _LABEL for array in arrays):
        return VertexField(values.astype(np.float64))
    table = {label.key: label for label in image.labeltable.labels}
    colors = {key: _four(one.rgba) for key, one in table.items()}
    names = {key: one.label or "" for key, one in table.items() if key != NO_LABEL}
    return VertexField(values.astype(np.int32), names, colors)


def _four(color: Any) -> Color:
    red, green, blue, alpha = (0.0 if part is None else float(part) for part in color)
    return red, green, blue, alpha


def _from_cifti(image: Any, path: Any, hemisphere: str | None) -> VertexField:
    axes = [image.header.get_axis(number) for number in range(2)]
    models = {name: (rows, axis) for name, rows, axis in axes[1].iter_structures()}
    here = [side for side, structure in _CIFTI.items() if structure in models]
    if hemisphere is None and len(here) != 1:
        raise FileError(f"{os.fspath(path)} has {' and '.join(here) or 'no cortex'}: say which hemisphere")
    side = hemisphere or here[0]
    if side not in here:
        raise FileError(f"{os.fspath(path)} has no {side} cortex")
    rows, axis = models[_CIFTI[side]]
    given = np.asarray(image.get_fdata())[:, rows].T
    labels = hasattr(axes[0], "label")
    values = np.full((axis.nvertices[_CIFTI[side]], given.shape[1]), NO_LABEL if labels else np.nan)
    values[axis.vertex] = given
    if values.shape[1] == 1:
        values = values[:, 0]
    if not labels:
        return VertexField(values)
    table = {key: entry for each in axes[0].label for key, entry in each.items() if key != NO_LABEL}
    names, colors = ({key: entry[part] for key, entry in table.items()} for part in (0, 1))
    return VertexField(values.astype(np.int32), names, colors)


def read_region(path: str | os.PathLike[str], vertex_count: int) -> Bools:
    """(V,) bool: the vertices that a file names. `mask=~region` leaves out all others.

    path           a label (lh.cortex.label) or a patch of FreeSurfer: the vertices that it lists; or a file as for
                   read_field: the vertices whose value is not 0, nor NaN, nor a missing label
    vertex_count   of the surface
    Raises FileError, also if the file is of a surface with another number of vertices.

    >>> import koebe, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "lh.cortex.shape.gii")
    >>> koebe.write_field(path, [0.0, 1.0, 1.0, 0.0])
    >>> koebe.read_region(path, 4)
    array([False,  True,  True, False])
    """
    count = whole(vertex_count, "vertex_count", least=1)
    if head_of(path) == b"\xff\xff\xff\xff":
        listed = read_patch(path).vertices
    elif Path(path).name.endswith(".label"):
        with read_by("nibabel.freesurfer", path) as freesurfer:
            listed = np.atleast_1d(freesurfer.read_label(os.fspath(path)))
    else:
        values = read_field(path).values
        inside = (values != 0) & ~np.isnan(values) & (values != NO_LABEL if values.dtype.kind == "i" else True)
        if inside.shape != (count,):
            raise FileError(f"{os.fspath(path)} has {inside.shape} values, not one for each of {count} vertices")
        return inside
    if len(listed) and not 0 <= listed.min() <= listed.max() < count:
        raise FileError(f"{os.fspath(path)} names vertices that are not among {count}")
    region = np.zeros(count, bool)
    region[listed] = True
    return region


def write_field(
    path: str | os.PathLike[str],
    values: Any,
    *,
    names: Mapping[int, str] | None = None,
    colors: Mapping[int, Color] | None = None,
    hemisphere: str | None = None,
) -> None:
    """Write values or labels at vertices to a file that read_field reads. The file is complete or absent.

    path         its name says the format, as for read_field
    values       (V,) numbers, or for .annot, .label.gii and .dlabel.nii labels: whole numbers, -1 where there is none.
                 Or a VertexField, whose names and colours are written too
    names, colors    of the labels
    hemisphere   'left' or 'right', for CIFTI; None: by the name (lh., rh., .L., .R.)
    CIFTI leaves out vertices whose value is NaN or whose label is -1. FreeSurfer's values are 0 where yours are NaN.
    Needs nibabel. Raises InputError, OSError.

    >>> import koebe, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "lh.height.dscalar.nii")
    >>> koebe.write_field(path, [0.5, 1.0, float("nan")])
    >>> koebe.read_field(path).values
    array([0.5, 1. , nan])
    """
    if isinstance(values, VertexField):
        names, colors, values = names or values.names, colors or values.colors, values.values
    # What no file can hold.
    array = as_values(values, "the values")
    if array.ndim != 1 or array.dtype.kind not in "fiub" or not len(array):
        raise InputError(f"the values must be (V,) numbers, not {array.shape} {array.dtype}")
    for name, given in (("names", names), ("colors", colors)):
        if given is not None and not isinstance(given, Mapping):
            raise TypeError(f"{name} must be a dict, not {given!r}")
    if array.dtype.kind == "f" and (np.abs(array[np.isfinite(array)]) > np.finfo(np.float32).max).any():
        raise InputError("the values are beyond floats of 32 bits, which the files have")
    low = Path(path_of(path)).name.lower()
    # What files of labels cannot hold.
    as_labels = low.endswith((".annot", ".label.gii", ".dlabel.nii"))
    if as_labels and (array.dtype.kind == "f" or array.min() < NO_LABEL):
        raise InputError(f"{low} has labels: whole numbers from 0, and -1 for none, not {array.dtype}")
    if low.endswith(".annot") and array.max() >= _MOST_LABELS:
        raise InputError(f"{low} has labels below {_MOST_LABELS}, not {array.max()}")
    # Each label that occurs has a name and a colour.
    known = {int(key): str(text) for key, text in (names or {}).items() if int(key) != NO_LABEL}
    if as_labels:
        known |= {int(key): f"label {key}" for key in np.unique(array) if key != NO_LABEL and int(key) not in known}
    shades = {key: _color(key, colors or {}) for key in known}
    if low.endswith(".annot"):
        content = saved_bytes(low, lambda place: _save_annot(place, array, known, shades))
    elif low.endswith((".gii", ".gii.gz")):
        image = _gifti(array, known, shades, structure_of(path), as_labels)
        content = saved_bytes(low, lambda place: package_of("nibabel").save(image, place))
    elif low.endswith((".dscalar.nii", ".dlabel.nii")):
        image = _cifti(array, known, shades, _side(path, hemisphere), as_labels)
        content = saved_bytes(low, lambda place: package_of("nibabel").save(image, place))
    elif low.endswith(".nii"):
        raise InputError(f"{low}: no format has this name. Known are .dscalar.nii and .dlabel.nii")
    else:
        numbers = np.where(np.isnan(array), 0.0, array)
        freesurfer = package_of("nibabel.freesurfer")
        content = saved_bytes(low, lambda place: freesurfer.write_morph_data(place, numbers.astype(np.float32)))
    with whole_file(path) as file:
        file.write(content)


def _color(key: int, colors: Mapping[int, Color]) -> Color:
    """The label's colour; without one, colours that are far apart."""
    if key in colors:
        red, green, blue, alpha = colors[key]
        return float(red), float(green), float(blue), float(alpha)
    red, green, blue = (((key + 1) * step % 256) / 255.0 for step in (97, 157, 211))  # different for 256 labels
    return red, green, blue, 1.0


def _save_annot(place: str, labels: Floats, names: dict[int, str], colors: dict[int, Color]) -> None:
    """Labels are distinguished by their colours in this format, so each has a colour of its own, none of them black."""
    keys = range(max(names, default=0) + 1)  # the format numbers labels without gaps
    taken: set[tuple[int, ...]] = {(0, 0, 0)}
    table = np.zeros((len(keys), 5), np.int64)
    for row, key in enumerate(keys):
        shade = np.round(255.0 * np.array(_color(key, colors)[:3])).astype(int)
        while tuple(shade) in taken:
            shade = (shade + (1, 7, 29)) % 256
        taken.add(tuple(shade))
        table[row, :3] = shade
    words = [names.get(key, f"unused {key}") for key in keys]
    package_of("nibabel.freesurfer").write_annot(place, labels.astype(np.int64), table, words, fill_ctab=True)


def _gifti(values: Floats, names: Any, colors: Any, structure: str, labels: bool) -> Any:
    gifti = package_of("nibabel.gifti")
    if not labels:
        data, intent, kind = np.float32(values), "NIFTI_INTENT_SHAPE", "NIFTI_TYPE_FLOAT32"
    else:
        data, intent, kind = np.int32(values), "NIFTI_INTENT_LABEL", "NIFTI_TYPE_INT32"
    image = gifti.GiftiImage(darrays=[gifti.GiftiDataArray(data, intent, kind, meta={"Name": "koebe"})])
    if structure:
        image.meta["AnatomicalStructurePrimary"] = structure
    unknown = {NO_LABEL: "???"} if labels and (values == NO_LABEL).any() else {}
    for key, text in {**unknown, **names}.items():
        red, green, blue, alpha = colors.get(key, (0.0, 0.0, 0.0, 0.0))
        label = gifti.GiftiLabel(key, red, green, blue, alpha)
        label.label = text
        image.labeltable.labels.append(label)
    return image


def _side(path: Any, hemisphere: str | None) -> str:
    if hemisphere is not None:
        return choice_of(hemisphere, "hemisphere", {side: side for side in _CIFTI})
    named = {"CortexLeft": "left", "CortexRight": "right"}.get(structure_of(path))
    if named is None:
        raise InputError("say which hemisphere the values are of: hemisphere='left' or 'right'")
    return named


def _cifti(values: Floats, names: Any, colors: Any, side: str, labels: bool) -> Any:
    cifti = package_of("nibabel.cifti2")
    inside = values != NO_LABEL if labels else ~np.isnan(values.astype(np.float64))
    if not inside.any():
        raise InputError("no vertex has a value")
    model = cifti.BrainModelAxis.from_mask(inside, name=f"cortex_{side}")
    if labels:
        table = {0: ("???", (0.0, 0.0, 0.0, 0.0)), **{key: (text, colors[key]) for key, text in names.items()}}
        rows: Any = cifti.LabelAxis(["koebe"], [table])
    else:
        rows = cifti.ScalarAxis(["koebe"])
    image = cifti.Cifti2Image(np.float32(values[inside])[None], header=(rows, model))
    image.update_headers()
    return image
