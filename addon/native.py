# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the native package `koebe` when it is first needed.

As an extension Blender has installed the wheel already. As a legacy add-on the wheel that fits this
interpreter is unpacked into the user's folder. In a checkout the build folder is used.
"""

import importlib
import importlib.util
import os
import platform
import sys
import tempfile
import zipfile
from pathlib import Path

from . import compat
from .wheel_tags import interpreter_tag, wheel_fits

HERE = Path(__file__).resolve().parent


class NativeError(ImportError):
    """The native package is missing or was built for another interpreter."""


def load():
    """The package `koebe`.

    Raises NativeError, which names this interpreter and the wheels that the add-on brings.
    """
    if "koebe" not in sys.modules:
        _make_importable()
    try:
        return importlib.import_module("koebe")
    except ImportError as error:
        raise NativeError(
            f"the native module does not load in {_interpreter()}: {error}"
        ) from error


def _interpreter():
    return f"Python {interpreter_tag()} on {sys.platform} {platform.machine()}"


def _make_importable():
    checkout = HERE.parent / "build" / "python"
    if (HERE.parent / "CMakeLists.txt").is_file() and (checkout / "koebe").is_dir():
        sys.path.insert(0, str(checkout))
    elif importlib.util.find_spec("koebe") is None:
        sys.path.insert(0, str(_unpacked_wheel()))


def _unpacked_wheel():
    wheels = sorted((HERE / "wheels").glob("koebe-*.whl"))
    fitting = [wheel for wheel in wheels if wheel_fits(wheel.name)]
    if not fitting:
        have = ", ".join("-".join(wheel.stem.split("-")[-3:]) for wheel in wheels) or "none"
        raise NativeError(f"no native module for {_interpreter()}; this add-on brings: {have}")
    wheel = fitting[-1]
    folder = Path(compat.user_folder(__package__)) / f"{wheel.stem}-{wheel.stat().st_size}"
    if not folder.is_dir():
        _unpack(wheel, folder)
    return folder


def _unpack(wheel, folder):
    """Unpack beside and rename, so that the folder is whole or absent, whoever else unpacks it too."""
    with tempfile.TemporaryDirectory(dir=folder.parent) as scratch:
        whole = Path(scratch) / "wheel"
        with zipfile.ZipFile(wheel) as archive:
            archive.extractall(whole)
        try:
            os.rename(whole, folder)
        except OSError:
            if not folder.is_dir():  # else another Blender was faster
                raise
