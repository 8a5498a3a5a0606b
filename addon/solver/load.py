# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the native package `koebe` when it is first needed.

Blender has already installed an extension's wheel. For a legacy add-on the wheel that fits this interpreter is unpacked
into the add-on's own folder, so that it is removed with the add-on; if that is not writable, into the user's folder, or
else into a private folder that is removed at exit. A checkout uses its build folder. Packages `koebe` from elsewhere
are ignored. The caller names the user's folders.
"""

import atexit
import dataclasses
import importlib
import platform
import shutil
import sys
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from types import ModuleType

from .errors import NativeError
from .wheel import KNOWN, Wheel, WheelError, remove_leftovers
from .wheel_tags import interpreter_tag, module_loads, module_suffixes, wheel_fits

ADDON = Path(__file__).resolve().parent.parent
OWN_PLACE = ADDON / "unpacked"


@dataclasses.dataclass(frozen=True)
class UserFolders:
    """Folders of the user.

    extensions  where this Blender installs extensions, or None
    datafiles   where add-ons up to 0.1 unpacked the wheel, or None
    make_own    makes the folder for the add-on's own files and returns it; None if it cannot be made
    """

    extensions: Path | None
    datafiles: Path | None
    make_own: Callable[[], Path | None]


def load(user: UserFolders) -> ModuleType:
    """The package `koebe`; `user` are the `UserFolders`.

    Raises NativeError, which names this interpreter and the add-on's wheels, or the bad file.
    """
    try:
        if "koebe" in sys.modules:
            return _of_this_version(sys.modules["koebe"])
        return _imported(_folder(user))
    except NativeError:
        raise
    except Exception as error:  # a damaged file can raise anything
        raise NativeError(f"the native module does not load in {_interpreter()}: {error}") from error


def _interpreter() -> str:
    return f"Python {interpreter_tag()} on {sys.platform} {platform.machine()}"


def _of_this_version(module: ModuleType) -> ModuleType:
    """The loaded module, for example after an update of the add-on in the same session."""
    version = getattr(module, "__version__", "unknown")
    if _checkout() is None and version != _fitting_wheel().version:
        raise WheelError(module.__file__, f"is loaded, of another version: {version}", "restart Blender")
    return module


def _imported(folder: Path) -> ModuleType:
    """The package in that folder, whatever other package has that name."""
    sys.path.insert(0, str(folder))
    try:
        return importlib.import_module("koebe")
    except BaseException:
        for name in [name for name in sys.modules if name.partition(".")[0] == "koebe"]:
            del sys.modules[name]
        raise
    finally:
        sys.path.remove(str(folder))


def _checkout() -> Path | None:
    """The build folder, if this is a built checkout."""
    built = ADDON.parent / "build" / "python"
    return built if (ADDON.parent / "CMakeLists.txt").is_file() and (built / "koebe").is_dir() else None


def _folder(user: UserFolders) -> Path:
    """The folder to import the package from, after every file in it was checked."""
    checkout = _checkout()
    if checkout is not None:
        return checkout
    wheel, problem = _fitting_wheel(), None
    for folder, known in _folders(wheel, user):
        try:
            if wheel.ready_in(folder, known):
                _remove_leftovers(folder, wheel, user)
            return folder
        except OSError as error:
            reason = f"cannot be written ({error.strerror or error})"
            problem = WheelError(folder, reason, "make room there or make it writable")
    assert problem is not None  # there is always a folder to try
    raise problem


def _fitting_wheel() -> Wheel:
    wheels = sorted((ADDON / "wheels").glob("koebe-*.whl"))
    for path in reversed(wheels):
        if wheel_fits(path.name):
            wheel = Wheel(path)
            members = wheel.members()
            if members is None or module_loads(module_suffixes(members)):  # damaged wheels are reported later
                return wheel
    have = ", ".join(_brought(path) for path in wheels) or "none"
    raise NativeError(f"no native module for {_interpreter()}; this add-on brings: {have}")


def _brought(path: Path) -> str:
    """A wheel's targets: its tags and, if it serves several Pythons, its modules."""
    tags = "-".join(path.stem.split("-")[-3:])
    modules = module_suffixes(Wheel(path).members() or []) if "-py3-none-" in path.name else []
    return f"{tags} ({', '.join(modules)})" if modules else tags


def _folders(wheel: Wheel, user: UserFolders) -> Iterator[tuple[Path, Path]]:
    """Places of the wheel's files, existing or possible, best first, each with the file that remembers checks."""
    if user.extensions is not None:
        python = f"python{sys.version_info.major}.{sys.version_info.minor}"
        installed = user.extensions / ".local" / "lib" / python / "site-packages"  # where Blender unpacks wheels
        if (installed / wheel.record_name).is_file():
            yield installed, OWN_PLACE / KNOWN
    if sys.platform != "win32":  # Windows does not remove an add-on whose libraries are loaded
        yield _in_place(OWN_PLACE, wheel)
    own = user.make_own()
    if own is not None:
        yield _in_place(own, wheel)
    private = Path(tempfile.mkdtemp(prefix="koebe-"))
    atexit.register(shutil.rmtree, private, ignore_errors=True)
    yield _in_place(private, wheel)


def _in_place(place: Path, wheel: Wheel) -> tuple[Path, Path]:
    return place / wheel.folder_name, place / KNOWN


def _remove_leftovers(folder: Path, wheel: Wheel, user: UserFolders) -> None:
    """Remove files unpacked by other versions: beside this one, and where versions up to 0.1 put them."""
    remove_leftovers(folder.parent, wheel, keep=folder)
    if user.datafiles is not None:
        remove_leftovers(user.datafiles / "koebe_uv", wheel, keep=folder)
