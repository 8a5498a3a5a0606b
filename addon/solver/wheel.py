# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's wheel: unpacked, checked against its RECORD, and repaired file by file.

A damaged library ends the whole program when it is loaded. So every file is first compared with the wheel's RECORD: its
size always, its hash if size and time differ from the last correct check.
"""

import base64
import contextlib
import csv
import hashlib
import io
import json
import os
import shutil
import time
import uuid
import zipfile
from collections.abc import Iterator
from pathlib import Path

SCRATCH = ".unpacking-"  # unfinished folders and files
ABANDONED_SECONDS = 3600.0  # older ones belong to killed programs
KNOWN = "checked.json"  # beside unpacked wheels: size and time of the files with a correct hash
INSTALL_AGAIN = "remove the add-on and install it again"
EMPTY = "its RECORD is empty"

Record = dict[str, tuple[str, int]]  # hash and size of each file


class WheelError(Exception):
    """A file of the native module is unusable."""

    def __init__(self, path: Path | str | None, reason: str, cure: str) -> None:
        super().__init__(path, reason, cure)
        self.path, self.reason, self.cure = path, reason, cure

    def __str__(self) -> str:
        return f"{self.path} {self.reason}: {self.cure}"


class Wheel:
    """A wheel file. Raises WheelError if it must be read and is damaged, OSError if a folder cannot be written."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @property
    def version(self) -> str:
        """The version of its package."""
        return self.path.name.split("-")[1]

    @property
    def record_name(self) -> str:
        """The path of its list of files."""
        return f"{'-'.join(self.path.name.split('-')[:2])}.dist-info/RECORD"

    @property
    def folder_name(self) -> str:
        """The name for a folder with its files, different for every build."""
        return f"{self.path.stem}-{self.path.stat().st_size}"

    def members(self) -> list[str] | None:
        """The names of its files; None if it cannot be read."""
        try:
            with self._opened() as archive:
                return archive.namelist()
        except (WheelError, OSError):
            return None

    def ready_in(self, folder: Path, known_file: Path) -> bool:
        """Make the folder hold the wheel's files, whatever it held before. Returns whether it had to be made."""
        new = not folder.is_dir()
        if new:
            self._unpack(folder)
        record = self._record(folder)
        known = _read_known(known_file).get(str(folder), {})
        stamps, damaged = _check(folder, record, known)
        if damaged:
            with self._opened() as archive:
                for name in damaged:
                    stamps[name] = self._put(archive, record, name, folder)
        if stamps != known:
            _write_known(known_file, str(folder), stamps)
        return new

    def _unpack(self, folder: Path) -> None:
        """Unpack beside and rename, so that the folder is complete or absent, even if other programs unpack it, too."""
        scratch = folder.with_name(f"{SCRATCH}{uuid.uuid4().hex}")
        scratch.mkdir(parents=True)
        try:
            with self._opened() as archive:
                record = self._record()
                for name in [*record, self.record_name]:
                    self._put(archive, record, name, scratch)
            try:
                os.rename(scratch, folder)
            except OSError:
                if not folder.is_dir():  # otherwise another Blender was faster
                    raise
        finally:
            shutil.rmtree(scratch, ignore_errors=True)

    def _put(self, archive: zipfile.ZipFile, record: Record, name: str, folder: Path) -> list[int]:
        """Write one file of the wheel, completely or not at all. Returns its stamp."""
        with self._reading():
            content = archive.read(name)
        if name in record and (_digest(content), len(content)) != record[name]:
            raise WheelError(self.path, f"is damaged ({name} in it is not what its RECORD says)", INSTALL_AGAIN)
        target = folder / name
        target.parent.mkdir(parents=True, exist_ok=True)
        temporary = target.with_name(f"{SCRATCH}{uuid.uuid4().hex}")
        try:
            temporary.write_bytes(content)
            stamp = _stamp(temporary)
            os.replace(temporary, target)
        finally:
            temporary.unlink(missing_ok=True)
        return stamp

    def _record(self, folder: Path | None = None) -> Record:
        """The wheel's files: name -> (hash, size). If the wheel is damaged, from the unpacked RECORD."""
        try:
            with self._opened() as archive, self._reading():
                return _parse(archive.read(self.record_name))
        except WheelError:
            if folder is not None:
                with contextlib.suppress(OSError, TypeError, ValueError, csv.Error):
                    return _parse((folder / self.record_name).read_bytes())
            raise

    @contextlib.contextmanager
    def _opened(self) -> Iterator[zipfile.ZipFile]:
        with self._reading():
            archive = zipfile.ZipFile(self.path)
        with archive:
            yield archive

    @contextlib.contextmanager
    def _reading(self) -> Iterator[None]:
        try:
            yield
        except Exception as error:  # zipfile raises many kinds of errors on damaged bytes
            raise WheelError(self.path, f"is damaged ({error})", INSTALL_AGAIN) from error


def remove_leftovers(place: Path, wheel: Wheel, keep: Path) -> None:
    """Remove from a place for unpacked wheels all others made for the same interpreter, and unfinished work."""
    tags = wheel.path.stem.split("-")[2:5]
    with contextlib.suppress(OSError):
        for other in place.iterdir():
            outdated = other.name.startswith("koebe-") and other.name.split("-")[2:5] == tags
            if other != keep and (outdated or _is_abandoned(other)):
                shutil.rmtree(other, ignore_errors=True)
        place.rmdir()  # only if it is empty


def _is_abandoned(path: Path) -> bool:
    return path.name.startswith(SCRATCH) and time.time() - path.stat().st_mtime > ABANDONED_SECONDS


def _parse(record: bytes) -> Record:
    """The lines of a RECORD that have a hash: name -> (hash, size)."""
    rows = [row for row in csv.reader(io.StringIO(record.decode("utf-8"))) if len(row) == 3 and row[1]]
    if not rows:
        raise ValueError(EMPTY)
    return {name: (digest.removeprefix("sha256="), int(size)) for name, digest, size in rows}


def _check(folder: Path, record: Record, known: dict[str, list[int]]) -> tuple[dict[str, list[int]], list[str]]:
    """Stamps of the files that agree with the record, and the names of the others."""
    stamps, damaged = {}, []
    for name, (digest, size) in record.items():
        path, stamp = folder / name, None
        with contextlib.suppress(OSError):
            found = _stamp(path)
            if found[0] == size and (found == known.get(name) or _digest(path.read_bytes()) == digest):
                stamp = found
        if stamp is None:
            damaged.append(name)
        else:
            stamps[name] = stamp
    return stamps, damaged


def _stamp(path: Path) -> list[int]:
    """Size and time of a file."""
    status = path.stat()
    return [status.st_size, status.st_mtime_ns]


def _digest(content: bytes) -> str:
    """The hash of bytes as in a RECORD."""
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).decode("ascii").rstrip("=")


def _read_known(file: Path) -> dict[str, dict[str, list[int]]]:
    """Stamps by folder and file name; empty if the file cannot be read."""
    with contextlib.suppress(OSError, ValueError):
        known = json.loads(file.read_text(encoding="utf-8"))
        if isinstance(known, dict) and all(isinstance(stamps, dict) for stamps in known.values()):
            return known
    return {}


def _write_known(file: Path, folder: str, stamps: dict[str, list[int]]) -> None:
    """Remember a folder's stamps. If that fails, the hashes are computed again the next time."""
    temporary = file.with_name(f"{SCRATCH}{uuid.uuid4().hex}")
    with contextlib.suppress(OSError):
        file.parent.mkdir(parents=True, exist_ok=True)
        try:
            content = {**_read_known(file), folder: stamps}
            content = {path: of_path for path, of_path in content.items() if Path(path).is_dir()}
            temporary.write_text(json.dumps(content), encoding="utf-8")
            os.replace(temporary, file)
        finally:
            temporary.unlink(missing_ok=True)
