"""Results read from files."""

import json
import os
import zipfile
from types import SimpleNamespace
from typing import Any, TypeVar, overload

import numpy as np

from .errors import InputError
from .labs.fit import FitResult
from .labs.sphere_transfer import loaded_correspondence
from .maps.domain_map import DomainMap
from .maps.result import MapReport, UniformizeResult
from .maps.source import Source

Result = TypeVar("Result")


@overload
def load(path: str | os.PathLike[str]) -> Any: ...
@overload
def load(path: str | os.PathLike[str], kind: type[Result]) -> Result: ...
def load(path: str | os.PathLike[str], kind: type[Any] | None = None) -> Any:
    """Read a result written by `save`, as its class: UniformizeResult, CutResult, PartsResult, SphereMap,
    SphereCorrespondence, ...

    kind   the class that it must have, so that type checkers know it; None: any
    Raises InputError for a file that is not a result, or of another kind, OSError for one that cannot be read.

    >>> import koebe, os, tempfile
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> path = os.path.join(tempfile.mkdtemp(), "face.npz")
    >>> result.save(path)
    >>> bool((koebe.load(path).uv == result.uv).all())
    True
    """
    result = _loaded(path)
    if kind is not None and not isinstance(result, kind):
        raise InputError(f"{os.fspath(path)} has a {type(result).__name__}, not a {kind.__name__}")
    return result


def _loaded(path: str | os.PathLike[str]) -> Any:
    try:
        with np.load(path, allow_pickle=False) as file:
            if "kind" in file and str(file["kind"]) == "SphereCorrespondence":
                return loaded_correspondence(file)
            report = json.loads(str(file["report"]))
            more = {name: file.get(name) for name in ("kept", "first", "filed")}
            source = Source(file["vertices"], file["triangles"], **more)
            before = "CutResult" if report.get("cut") is True else "UniformizeResult"  # 0.1 wrote no kind
            kind = str(file["kind"]) if "kind" in file else before
            kinds: list[type[MapReport]] = [UniformizeResult, FitResult, *DomainMap.__subclasses__()]
            return {of.__name__: of for of in kinds}[kind](report, SimpleNamespace(**file), source)
    except (KeyError, ValueError, TypeError, IndexError, AttributeError, EOFError, zipfile.BadZipFile) as error:
        raise InputError(f"{os.fspath(path)} is no result of koebe: {error}") from None
