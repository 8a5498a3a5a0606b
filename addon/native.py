# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the native package `koebe` when it is first needed.

As an extension Blender has installed the wheel already. As a legacy add-on the wheel that fits this interpreter is
unpacked into the add-on's own folder, so that it goes with the add-on; where that cannot be written, into the user's
folder, or else into a private one that is removed at exit. In a checkout the build folder is used. A package `koebe`
from elsewhere is not looked at.
"""

import atexit
import contextlib
import importlib
import io
import platform
import shutil
import sys
import tempfile
from pathlib import Path

import bpy

from . import compat
from .native_wheel import KNOWN, Wheel, WheelError, remove_leftovers
from .wheel_tags import interpreter_tag, wheel_fits

HERE = Path(__file__).resolve().parent
OWN_PLACE = HERE / "unpacked"


class NativeError(ImportError):
    """The native package is missing, damaged, or was built for another interpreter."""


def load():
    """The package `koebe`.

    Raises NativeError, which names this interpreter and the wheels that the add-on brings, or the file at fault.
    """
    try:
        if "koebe" in sys.modules:
            return _of_this_version(sys.modules["koebe"])
        return _imported(_folder())
    except NativeError:
        raise
    except Exception as error:  # a damaged file can raise anything
        raise NativeError(f"the native module does not load in {_interpreter()}: {error}") from error


def _interpreter():
    return f"Python {interpreter_tag()} on {sys.platform} {platform.machine()}"


def _of_this_version(module):
    """The module that is loaded already, as after an update of the add-on in the same session."""
    version = getattr(module, "__version__", "unknown")
    if _checkout() is None and version != _fitting_wheel().version:
        raise WheelError(module.__file__, f"is loaded, of version {version} and not this add-on's", "restart Blender")
    return module


def _imported(folder):
    """The package in that folder, whatever else there is of that name."""
    sys.path.insert(0, str(folder))
    try:
        return importlib.import_module("koebe")
    except BaseException:
        for name in [name for name in sys.modules if name.partition(".")[0] == "koebe"]:
            del sys.modules[name]
        raise
    finally:
        sys.path.remove(str(folder))


def _checkout():
    """The build folder, if this is a checkout that was built."""
    built = HERE.parent / "build" / "python"
    return built if (HERE.parent / "CMakeLists.txt").is_file() and (built / "koebe").is_dir() else None


def _folder():
    """The folder to import the package from, with every file in it checked."""
    checkout = _checkout()
    if checkout is not None:
        return checkout
    wheel, problem = _fitting_wheel(), None
    for folder, known in _folders(wheel):
        try:
            if wheel.ready_in(folder, known):
                _remove_leftovers(folder, wheel)
            return folder
        except OSError as error:
            reason = f"cannot be written ({error.strerror or error})"
            problem = WheelError(folder, reason, "make room there or make it writable")
    raise problem


def _fitting_wheel():
    wheels = sorted((HERE / "wheels").glob("koebe-*.whl"))
    fitting = [wheel for wheel in wheels if wheel_fits(wheel.name)]
    if not fitting:
        have = ", ".join("-".join(wheel.stem.split("-")[-3:]) for wheel in wheels) or "none"
        raise NativeError(f"no native module for {_interpreter()}; this add-on brings: {have}")
    return Wheel(fitting[-1])


def _folders(wheel):
    """Where the wheel's files are or can be, the best first, each with the file that remembers what was checked."""
    extensions = _user_resource("EXTENSIONS")
    if extensions is not None:
        python = f"python{sys.version_info.major}.{sys.version_info.minor}"
        installed = extensions / ".local" / "lib" / python / "site-packages"  # where Blender unpacks wheels
        if (installed / wheel.record_name).is_file():
            yield installed, OWN_PLACE / KNOWN
    if sys.platform != "win32":  # which lets nobody remove an add-on whose libraries are loaded
        yield _in_place(OWN_PLACE, wheel)
    with contextlib.redirect_stderr(io.StringIO()):  # Blender prints a traceback if it cannot make the folder
        user = compat.user_folder(__package__)
    if user:
        yield _in_place(Path(user), wheel)
    private = Path(tempfile.mkdtemp(prefix="koebe-"))
    atexit.register(shutil.rmtree, private, ignore_errors=True)
    yield _in_place(private, wheel)


def _in_place(place, wheel):
    return place / wheel.folder_name, place / KNOWN


def _remove_leftovers(folder, wheel):
    """Remove what other versions have unpacked: beside this one, and where versions up to 0.1 did it."""
    remove_leftovers(folder.parent, wheel, keep=folder)
    datafiles = _user_resource("DATAFILES")
    if datafiles is not None:
        remove_leftovers(datafiles / "koebe_uv", wheel, keep=folder)


def _user_resource(kind):
    """A folder of the user's, if this Blender has the kind."""
    with contextlib.suppress(TypeError, ValueError):
        path = bpy.utils.user_resource(kind)
        return Path(path) if path else None
    return None
