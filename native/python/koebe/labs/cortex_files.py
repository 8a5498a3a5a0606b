"""The files of a hemisphere in the folders of FreeSurfer, fMRIPrep, pycortex and nilearn."""

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from .._arrays import as_flags
from .._options import choice_of, path_of
from .._types import Bools
from ..errors import FileError
from ..io.vertex_fields import NO_LABEL, read_field, read_region

_SIDES = {side: (f"{side[0]}h", side, side[0].upper()) for side in ("left", "right")}
_NAMES = {name: words for side, words in _SIDES.items() for name in (side, words[0], words[2])}

# Where a surface of a name lies, for lh, left and L; and, most exact first, what says where the cortex is.
_SURFACES = (
    "surf/{h}.{name}", "anat/*_hemi-{H}_{name}.surf.gii", "ses-*/anat/*_hemi-{H}_{name}.surf.gii",
    "surfaces/{name}_{h}.gii", "{name}_{side}.gii.gz",
)  # fmt: skip
_REGIONS = (
    "label/{h}.cortex.label", "label/{h}.aparc.annot", "label/{h}.aparc.a2009s.annot",
    "anat/*_hemi-{H}_desc-cortex_mask.label.gii", "ses-*/anat/*_hemi-{H}_desc-cortex_mask.label.gii",
)  # fmt: skip
MAPPED = ("white", "wm", "midthickness")
REGISTERED = ("sphere.reg", "space-fsaverage_desc-reg_sphere", "desc-reg_sphere", "sphere")
_WALL = {"", "???", "unknown", "corpuscallosum", "medial_wall", "medial wall", "background"}  # areas of atlases


class Hemisphere:
    """The files of one hemisphere of a subject. Raises FileError for a folder without them."""

    def __init__(self, folder: str | os.PathLike[str], hemisphere: str) -> None:
        self.folder = Path(path_of(folder, "subject"))
        self.words = dict(zip(("h", "side", "H"), choice_of(hemisphere, "hemisphere", _NAMES), strict=True))
        self.others = {word for words in _SIDES.values() if self.words["h"] not in words for word in words}
        if not self.folder.is_dir():
            raise FileError(f"{self.folder} is no folder of a subject")

    def surface(self, names: Sequence[str]) -> Path:
        """The file of the first of these surfaces that is there."""
        return self._first([place.replace("{name}", name) for name in names for place in _SURFACES], "surface")

    def region(self) -> Path:
        return self._first(_REGIONS, "label of the cortex")

    def _first(self, places: Sequence[str], what: str) -> Path:
        for place in places:
            found = sorted(self.folder.glob(place.format(**self.words)))
            if len(found) > 1:
                raise FileError(f"{self.folder} has several files for one {what}: {found[0].name}, {found[1].name}")
            if found:
                return found[0]
        wanted = ", ".join(place.format(**self.words) for place in places)
        raise FileError(f"{self.folder} has no {what} of the {self.words['side']} hemisphere: sought {wanted}")


def cortex_of(region: object, count: int) -> Bools:
    """(V,) bool, from a file or an array: the vertices of the cortex. Of an atlas the areas that are no wall."""
    if not isinstance(region, (str, os.PathLike)):
        return as_flags(region, "the region", count)
    name = Path(region).name
    if not name.endswith((".annot", ".label.gii")):
        return read_region(region, count)
    field = read_field(region)
    if field.values.shape != (count,):
        raise FileError(f"{region} has {field.values.shape} labels, not one for each of {count} vertices")
    walls = [label for label, text in field.names.items() if text.lower() in _WALL]
    out = [NO_LABEL, *walls] if name.endswith(".annot") else [NO_LABEL, 0, *walls]
    inside: Bools = ~np.isin(field.values, out)
    return inside
