# SPDX-License-Identifier: GPL-3.0-or-later
"""Marks edges as seams, in Object Mode and in Edit Mode."""

import bmesh
import numpy as np

from . import compat
from .errors import TransferError
from .mesh_object import MeshObject
from .mesh_reading import arrays
from .transaction import Transaction


def mark_seams(run: Transaction, obj: MeshObject, edges: np.ndarray) -> None:
    """Make these edges (E,) bool of the mesh that was read seams. Other seams stay. Raises TransferError."""
    taken = compat.seam_name_taken(obj.data)
    if taken is not None:
        raise TransferError(f"the name {taken!r} is taken by other data: give that data another name")
    with arrays(obj) as mesh:
        before = compat.seam_edges(mesh)
    after = before | edges
    if (after == before).all():
        return
    run.before_write(_write, obj, before, not compat.has_seams(obj.data))
    _write(obj, after)


def _write(obj: MeshObject, seams: np.ndarray, none_at_all: bool = False) -> None:
    if obj.mode != "EDIT":
        compat.set_seam_edges(obj.data, seams, none_at_all)
        obj.data.update()
        return
    edited = bmesh.from_edit_mesh(obj.data)
    edited.edges.ensure_lookup_table()
    for index, edge in enumerate(edited.edges):
        if edge.seam != bool(seams[index]):
            edge.seam = bool(seams[index])
    bmesh.update_edit_mesh(obj.data, loop_triangles=False, destructive=False)
