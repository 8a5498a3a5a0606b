# SPDX-License-Identifier: GPL-3.0-or-later
"""Every difference between Blender versions that the add-on meets, found by feature, not by number."""

import bpy
import numpy as np


def corner_uv(layer):
    """UV coordinates (C, 2) of a UV layer, in 32 bits. The mesh must not be in Edit Mode."""
    values = np.empty(2 * len(layer.data), dtype=np.float32)
    collection, name = _uv_collection(layer)
    collection.foreach_get(name, values)
    return values.reshape(-1, 2)


def set_corner_uv(layer, uv):
    """Write UV coordinates (C, 2) into a UV layer. The mesh must not be in Edit Mode."""
    collection, name = _uv_collection(layer)
    collection.foreach_set(name, np.ascontiguousarray(uv, dtype=np.float32).ravel())


def _uv_collection(layer):
    if hasattr(layer, "uv"):  # 3.5 on
        return layer.uv, "vector"
    return layer.data, "uv"


def enable_nodes(material):
    """Give a new material its node tree (5.0 on it has one from the start)."""
    if material.node_tree is None:
        material.use_nodes = True


def user_folder(package):
    """A folder for the add-on's own files, made if it is missing."""
    if package.startswith("bl_ext.") and hasattr(bpy.utils, "extension_path_user"):
        return bpy.utils.extension_path_user(package, create=True)
    return bpy.utils.user_resource("DATAFILES", path="koebe_uv", create=True)
