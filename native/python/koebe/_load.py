"""Results read from files."""

import json
import os
import zipfile

import numpy as np

from ._cut_result import CutResult
from ._result import Source, UniformizeResult
from .errors import InputError


def load(path: str | os.PathLike[str]) -> UniformizeResult | CutResult:
    """The result that `save` has written. Raises InputError for a file that is none, OSError for one that cannot be
    read."""
    try:
        with np.load(path, allow_pickle=False) as file:
            report, source = json.loads(str(file["report"])), Source(file["vertices"], file["triangles"])
            if report.get("cut") is True:
                return CutResult(report, file["uv"], file["flipped_faces"], source)
            return UniformizeResult(report, file["uv"], file["flipped_faces"], list(file["step_maps"]), source)
    except (KeyError, ValueError, TypeError, IndexError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{os.fspath(path)} is no result of koebe: {error}") from None
