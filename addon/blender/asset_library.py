# SPDX-License-Identifier: GPL-3.0-or-later
"""The add-on's asset library: a file with the node groups in the user's folder, and its entry in the preferences."""

from pathlib import Path
from typing import Any

import bpy

from .node_groups import add_groups, find_groups
from .transaction import Transaction

NAME = "Koebe UV"
FILE = "koebe_nodes.blend"


def find_library(folder: Path) -> Any:
    """The entry of the preferences for the library in a folder, or None."""
    for library in bpy.context.preferences.filepaths.asset_libraries:
        if library.path and Path(bpy.path.abspath(library.path)).resolve() == folder.resolve():
            return library
    return None


def add_library(run: Transaction, folder: Path) -> None:
    """Write the node groups to a file in the folder, and name the folder in the preferences. Raises OSError.

    Groups that this file does not have are made for it, and removed again.
    """
    folder.mkdir(parents=True, exist_ok=True)
    made = add_groups(run)
    part = folder / f".{FILE}.part.blend"
    try:
        bpy.data.libraries.write(str(part), set(find_groups().values()), fake_user=True)
        part.replace(folder / FILE)
    finally:
        part.unlink(missing_ok=True)
        bpy.data.batch_remove([group for name, group in find_groups().items() if name in made])
    if find_library(folder) is None:
        bpy.ops.preferences.asset_library_add(directory=str(folder))
        library = find_library(folder)
        if library is None:
            raise OSError("Blender takes no further asset library")
        library.name = NAME


def remove_library(folder: Path) -> bool:
    """Remove the file and the entry. Returns whether there was one."""
    library = find_library(folder)
    if library is not None:
        libraries = list(bpy.context.preferences.filepaths.asset_libraries)
        bpy.ops.preferences.asset_library_remove(index=libraries.index(library))
    (folder / FILE).unlink(missing_ok=True)
    return library is not None
