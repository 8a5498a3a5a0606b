# SPDX-License-Identifier: GPL-3.0-or-later
"""The files of a batch run: tells them apart, and writes each completely or not at all."""

import contextlib
import json
import math
import os
import shutil
import stat
import tempfile
import time
import unicodedata
import uuid
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from .exit_and_signals import BROKEN, USAGE, Stop

PREFIX, SUFFIX = ".koebe-", ".blend"  # of temporary files; Blender may add a missing suffix
ABANDONED_SECONDS = 24 * 3600.0  # older ones belong to killed runs
LONGEST_PATH = 1022  # bytes of a path in Blender, with the "@" that it adds while writing

Writer = Callable[[Any], None]  # takes a path, or a descriptor if there is no file


class Target:
    """A file to write. Symbolic links are followed; a target that cannot be renamed onto is written to directly.

    Raises Stop with USAGE if it cannot be written, before a long computation.
    """

    def __init__(self, given: str, scratch: bool = False) -> None:
        """`scratch`: another process moves the file to its place; it does not exist yet, and is written directly."""
        self.given, self._scratch = given, scratch
        path = os.path.realpath(given)
        self.path = Path(path[1:] if path.startswith("//") else path)  # Blender takes it for the .blend's folder
        self._temporary: Path | None = None
        self._write: Writer | None = None
        try:
            self._sink = _sink(given)
            if not self.direct:
                self._require_writable()
        except OSError as error:
            raise Stop(USAGE, f"{given} cannot be written: {error.strerror or error}") from None

    @property
    def direct(self) -> bool:
        """Whether it is written to directly: a device, a pipe, or the file that this process prints to."""
        return self._sink is not None

    def _require_writable(self) -> None:
        folder = self.path.parent
        if not folder.is_dir():
            raise Stop(USAGE, f"{self.given} cannot be written: there is no folder {folder}")
        if self.path.is_dir() or self.given.endswith(os.sep):
            raise Stop(USAGE, f"{self.given} cannot be written: it is a folder")
        if self.path.is_symlink():
            raise Stop(USAGE, f"{self.given} cannot be written: it is a link to itself")
        if self.path.exists() and not os.access(self.path, os.W_OK):
            raise Stop(USAGE, f"{self.given} cannot be written: it is write-protected")
        if len(os.fsencode(folder)) + 50 > LONGEST_PATH:
            raise Stop(USAGE, f"{self.given} cannot be written: the path is too long for Blender")
        with tempfile.TemporaryFile(dir=folder, prefix=PREFIX):
            pass

    def fill(self, write: Writer) -> None:
        """Let `write(path)` make the whole file beside its place. `put` moves it there."""
        if self.direct:
            self._write = write
            return
        _remove_abandoned(self.path.parent)
        # No file of that name may exist: Blender would keep it as a backup.
        other = self.path if self._scratch else self.path.with_name(f"{PREFIX}{uuid.uuid4().hex}{SUFFIX}")
        temporary = self._temporary = other
        with self._failure():
            write(str(temporary))
            with open(temporary, "rb+") as file:
                os.fsync(file.fileno())  # a disk may only now report that it is full
            if self.path.exists() and not self._scratch:
                shutil.copymode(self.path, temporary)

    def put(self) -> None:
        """Move the file to its place."""
        with self._failure():
            if self._write is not None:
                self._write(os.dup(self._sink) if isinstance(self._sink, int) else self._sink)
            elif self._temporary is not None:
                os.replace(self._temporary, self.path)
                self._temporary = None

    def discard(self) -> None:
        """Remove the file unless it was put to its place, and Blender's leftovers of it."""
        for ending in ("", "@") if self._temporary is not None else ():
            with contextlib.suppress(OSError):
                os.unlink(f"{self._temporary}{ending}")

    @contextlib.contextmanager
    def _failure(self) -> Iterator[None]:
        try:
            yield
        except (OSError, RuntimeError) as error:
            reason = getattr(error, "strerror", None) or str(error)
            raise Stop(BROKEN, f"{self.given} cannot be written (is the disk full?): {reason.strip()}") from None


def write_all(makers: dict[Target, Writer], last_chance: Callable[[], None]) -> None:
    """Fill every target by its maker, then put them to their places in order. If one fails, put none.

    `last_chance` is called before the first is put, and may raise.
    """
    try:
        for target, make in makers.items():
            target.fill(make)
        last_chance()
        for target in makers:
            target.put()
    finally:
        for target in makers:
            target.discard()


def save_json(path: str | int, content: dict[str, Any]) -> None:
    """Save plain values in a file or a descriptor, for a device or a pipe after its earlier content."""
    with open(path, "a", encoding="utf-8") as file:
        file.write(json.dumps(_finite(content), indent=1, allow_nan=False) + "\n")


def _finite(value: Any) -> Any:
    """The value with null for numbers that JSON does not have."""
    if isinstance(value, dict):
        return {key: _finite(one) for key, one in value.items()}
    if isinstance(value, list | tuple):
        return [_finite(one) for one in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


def is_same(one: str | Path, other: str | Path) -> bool:
    """Whether two paths are one file: through links and hard links, and where case does not matter."""
    with contextlib.suppress(OSError):
        return os.path.samefile(one, other)
    if os.path.exists(one) or os.path.exists(other):
        return False
    one, other = Path(os.path.realpath(one)), Path(os.path.realpath(other))
    with contextlib.suppress(OSError):
        return os.path.samefile(one.parent, other.parent) and _folded(one.name) == _folded(other.name)
    return False


def _folded(name: str) -> str:
    return unicodedata.normalize("NFC", name).casefold()


def _sink(path: str) -> int | str | None:
    """What to open instead of replacing the file: a descriptor of this process, the path, or None."""
    try:
        status = os.stat(path)
    except FileNotFoundError:
        return None
    for descriptor in (1, 2):  # opening it again would overwrite what is printed
        with contextlib.suppress(OSError):
            if os.path.samestat(os.fstat(descriptor), status):
                return descriptor
    return None if stat.S_ISREG(status.st_mode) or stat.S_ISDIR(status.st_mode) else path


def _remove_abandoned(folder: Path) -> None:
    """Remove the files of killed runs in a folder."""
    for path in folder.glob(f"{PREFIX}{'[0-9a-f]' * 32}{SUFFIX}*"):
        with contextlib.suppress(OSError):
            if time.time() - path.stat().st_mtime > ABANDONED_SECONDS:
                path.unlink()
