# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds the native package `koebe` in Blender's folders for the user's files."""

import contextlib
import io
from pathlib import Path
from types import ModuleType

import bpy

from .. import __name__ as addon_name
from ..blender import compat


def load() -> ModuleType:
    """The package. Raises NativeError."""
    from ..solver import load  # imported at the first map: zip files and more take a fifth of the enabling time

    folders = load.UserFolders(_user_resource("EXTENSIONS"), _user_resource("DATAFILES"), _make_own)
    return load.load(folders)


def _make_own() -> Path | None:
    """The folder for the add-on's own files, or None if it cannot be made."""
    with contextlib.redirect_stderr(io.StringIO()):  # Blender prints a traceback then
        path = compat.user_folder(addon_name)
    return Path(path) if path else None


def _user_resource(kind: str) -> Path | None:
    """A folder of the user, if this Blender has the kind."""
    with contextlib.suppress(TypeError, ValueError):
        path = bpy.utils.user_resource(kind)
        return Path(path) if path else None
    return None
