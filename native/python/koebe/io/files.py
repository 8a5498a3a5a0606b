"""Files that are complete or absent, and results in them."""

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
    """A file to write. It gets its name once it is complete; after an error nothing of it is left."""
    target = Path(path)
    descriptor, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}.")
    try:
        with os.fdopen(descriptor, "wb") as file:
            yield file
        if os.name == "posix":  # as any other new file
            mask = os.umask(0)
            os.umask(mask)
            os.chmod(name, 0o666 & ~mask)
        os.replace(name, target)
    except BaseException:
        Path(name).unlink(missing_ok=True)
        raise


class Saved:
    """A result that `koebe.load` reads again. Its report is in _report, its surface in _source."""

    _report: dict[str, Any]
    _source: Any

    def _arrays(self) -> dict[str, Any]:
        """Its other arrays, under the library's names."""
        raise NotImplementedError

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a file for `koebe.load`: NumPy's .npz. The file is complete or absent.

        For a mesh of another package its arrays are kept, not the mesh.
        """
        with whole_file(path) as file:
            np.savez_compressed(
                file, kind=np.array(type(self).__name__), report=np.array(json.dumps(self._report)),
                vertices=self._source.vertices, triangles=self._source.triangles, **_kept(self._source),
                **self._arrays(),
            )  # fmt: skip


def _kept(source: Any) -> dict[str, Any]:
    arrays = {name: getattr(source, name) for name in ("kept", "first", "filed")}
    return {name: array for name, array in arrays.items() if array is not None}
