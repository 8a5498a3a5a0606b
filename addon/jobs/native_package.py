# SPDX-License-Identifier: GPL-3.0-or-later
"""The native package `koebe`, looked for in the folders that Blender has for the user's files."""

import contextlib
import io
from pathlib import Path
from types import ModuleType

import bpy

from .. import __name__ as addon_name
from ..blender import compat
from ..solver.load import UserFolders
from ..solver.load import load as load_with


def load() -> ModuleType:
    """The package. Raises NativeError."""
    return load_with(UserFolders(_user_resource("EXTENSIONS"), _user_resource("DATAFILES"), _make_own))


def _make_own() -> Path | None:
    """The folder for the add-on's own files, or None where it cannot be made."""
    with contextlib.redirect_stderr(io.StringIO()):  # Blender prints a traceback then
        path = compat.user_folder(addon_name)
    return Path(path) if path else None


def _user_resource(kind: str) -> Path | None:
    """A folder of the user's, if this Blender has the kind."""
    with contextlib.suppress(TypeError, ValueError):
        path = bpy.utils.user_resource(kind)
        return Path(path) if path else None
    return None
