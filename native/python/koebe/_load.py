"""Results read from files."""

import json
import os
import zipfile
from types import SimpleNamespace
from typing import Any

import numpy as np

from .errors import InputError
from .labs.fit import FitResult
from .labs.sphere_transfer import loaded_correspondence
from .maps.cut_result import CutResult
from .maps.domain_map import DomainMap
from .maps.parts import PartsResult
from .maps.result import Source, UniformizeResult


def load(path: str | os.PathLike[str]) -> Any:
    """Read a result written by `save`, as its class: UniformizeResult, CutResult, PartsResult, SphereMap,
    SphereCorrespondence, ...

    Raises InputError for a file that is not a result, OSError for one that cannot be read.

    >>> import koebe, os, tempfile
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> path = os.path.join(tempfile.mkdtemp(), "face.npz")
    >>> result.save(path)
    >>> bool((koebe.load(path).uv == result.uv).all())
    True
    """
    try:
        with np.load(path, allow_pickle=False) as file:
            if "kind" in file and str(file["kind"]) == "SphereCorrespondence":
                return loaded_correspondence(file)
            report = json.loads(str(file["report"]))
            more = {name: file.get(name) for name in ("kept", "first", "filed")}
            source = Source(file["vertices"], file["triangles"], **more)
            uv, flipped = file["uv"], file["flipped_faces"]
            before = "CutResult" if report.get("cut") is True else "UniformizeResult"  # 0.1 wrote no kind
            kind = str(file["kind"]) if "kind" in file else before
            if kind == "UniformizeResult":
                return UniformizeResult(report, uv, flipped, list(file["step_maps"]), source, file.get("conformal_uv"))
            if kind == "FitResult":
                return FitResult(report, uv, flipped, file["mu"], source, file.get("conformal_uv"))
            if kind == "CutResult":
                return CutResult(report, uv, flipped, source)
            if kind == "PartsResult":
                return PartsResult(report, uv, file["part"], flipped, source)
            domain_maps = {of.__name__: of for of in DomainMap.__subclasses__()}
            return domain_maps[kind](report, SimpleNamespace(**file), source)
    except (KeyError, ValueError, TypeError, IndexError, AttributeError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{os.fspath(path)} is no result of koebe: {error}") from None
