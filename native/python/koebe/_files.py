"""Files that are whole or absent; results in them."""

import json
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

import numpy as np


@contextmanager
def whole_file(path: str | os.PathLike[str]) -> Iterator[BinaryIO]:
    """A file to write, which gets its name when all of it is there; on an error nothing is left of it."""
    target = Path(path)
    descriptor, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(descriptor, "wb") as file:
            yield file
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


class Saved:
    """A result that `koebe.load` reads again: its report and its surface are in _report and _source."""

    _report: dict[str, Any]
    _source: Any

    def _arrays(self) -> dict[str, Any]:
        """What it holds beside them, by the names under which the library gives it."""
        raise NotImplementedError

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write all of it to a file, which `koebe.load` reads: NumPy's .npz. The file is whole or absent.

        Of a mesh of another package its arrays are kept, not the mesh.
        """
        with whole_file(path) as file:
            np.savez_compressed(
                file, kind=np.array(type(self).__name__), report=np.array(json.dumps(self._report)),
                vertices=self._source.vertices, triangles=self._source.triangles, **self._arrays(),
            )  # fmt: skip
