"""Results read from files."""

import os
import zipfile
import zlib
from typing import Any, TypeVar, overload

import numpy as np

from ._options import path_of
from ._saved import made_of
from .errors import InputError

Result = TypeVar("Result")
_OF_DAMAGE = (KeyError, ValueError, TypeError, IndexError, AttributeError, EOFError, zipfile.BadZipFile, zlib.error)


@overload
def load(path: str | os.PathLike[str]) -> Any: ...
@overload
def load(path: str | os.PathLike[str], kind: type[Result]) -> Result: ...
def load(path: str | os.PathLike[str], kind: type[Any] | None = None) -> Any:
    """Read a result of any kind that its `save` wrote, as its class.

    kind   the class that it must have, so that type checkers know it; None: any
    Raises InputError for a file that is not a result, or of another kind, OSError for one that cannot be read.

    >>> import koebe, os, tempfile
    >>> result = koebe.uniformize("blend_samples/face.obj")
    >>> path = os.path.join(tempfile.mkdtemp(), "face.npz")
    >>> result.save(path)
    >>> bool((koebe.load(path).uv == result.uv).all())
    True
    """
    path_of(path)
    if kind is not None and not isinstance(kind, type):
        raise TypeError(f"kind must be a class, not {kind!r}")
    result = _loaded(path)
    if kind is not None and not isinstance(result, kind):
        raise InputError(f"{os.fspath(path)} has a {type(result).__name__}, not a {kind.__name__}")
    return result


def _loaded(path: str | os.PathLike[str]) -> Any:
    try:
        with np.load(path, allow_pickle=False) as file:
            return made_of(file)
    except _OF_DAMAGE as error:
        raise InputError(f"{os.fspath(path)} is no result of koebe: {error}") from None
