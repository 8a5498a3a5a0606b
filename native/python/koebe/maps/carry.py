"""What correspondences of disks and of spheres share: fields at points of triangles, and pairs of landmarks."""

from typing import Any

import numpy as np

from .._arrays import as_values
from .._options import flag, listed
from .._types import Floats, Values, Whole
from ..errors import InputError


def carried(field: Any, triangles: Whole, faces: Whole, weights: Floats, count: int, labels: bool | None) -> Values:
    """A field at points of triangles, from the field at the vertices."""
    values = as_values(field, "the field")
    if values.ndim not in (1, 2) or len(values) != count:
        raise InputError(f"the field has the shape {values.shape}, not a row for each of {count} vertices")
    if values.dtype.kind not in "fiubU":
        raise InputError(f"the field must have numbers or words, not {values.dtype}")
    as_labels = values.dtype.kind != "f" if labels is None else flag(labels, "labels")
    corners, known = triangles[faces], faces >= 0
    if not as_labels and values.dtype.kind == "U":
        raise InputError("words have no mean: carry them as labels")
    if not as_labels:
        linear = np.einsum("vk,vk...->v...", weights, values[corners].astype(np.float64))
        return np.where(known.reshape(-1, *(1,) * (values.ndim - 1)), linear, np.nan)
    if values.ndim == 2:
        columns = [carried(column, triangles, faces, weights, count, True) for column in values.T]
        return np.stack(columns, axis=1) if columns else np.zeros((len(faces), 0), values.dtype)
    here = values[corners]
    votes = np.einsum("vk,vjk->vj", np.nan_to_num(weights), here[:, :, None] == here[:, None, :])
    chosen = np.take_along_axis(here, votes.argmax(axis=1)[:, None], axis=1)[:, 0]
    nothing = {"i": -1, "u": 0, "b": False, "f": np.nan, "U": ""}[values.dtype.kind]
    return np.where(known, chosen, np.array(nothing, values.dtype))


def landmark_pairs(landmarks: Any) -> list[Any]:
    """The landmarks as a list. Raises InputError for one that is no pair."""
    pairs = [] if landmarks is None else listed(landmarks, "landmarks")
    for number, pair in enumerate(pairs):
        if (
            isinstance(pair, (str, bytes))
            or np.ma.isMaskedArray(pair)
            or not hasattr(pair, "__len__")
            or len(pair) != 2
        ):
            raise InputError(f"landmark {number} is no pair: a point on a and one on b", [number], "landmarks")
    return pairs
